// Which files of single frames a conversion has written: after a failure those behind the last whole frame go again.
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace headrace::client {

class FrameFiles {
  public:
    // `extensions`: of the files that each frame gets, in the order in which they are written; "": that one gets none.
    FrameFiles(std::filesystem::path folder, std::string stem, std::vector<std::string> extensions, std::size_t frames)
        : folder_(std::move(folder)), stem_(std::move(stem)), extensions_(std::move(extensions)), written_(frames) {}

    // The next file of the frame is there. On any thread, of one frame one after the other.
    void add(std::size_t frame) { ++written_[frame]; }

    // Removes what add() has told of the frames from `first` on; files of others that have such names stay.
    void remove_from(std::size_t first) const;

    bool has_any() const;  // whether frames get files at all

  private:
    std::filesystem::path folder_;
    std::string stem_;
    std::vector<std::string> extensions_;
    std::vector<std::atomic<std::size_t>> written_;  // by frame: how many files
};

}  // namespace headrace::client
