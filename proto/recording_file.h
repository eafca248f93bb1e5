// A file descriptor with the two things recordings do: append whole pieces, read at an offset.
#pragma once

#include <sys/uio.h>

#include <cstdint>
#include <filesystem>
#include <span>

#include "proto/mcap.h"
#include "proto/result.h"

namespace headrace::proto::recording {

class File {
  public:
    // For writing. Takes an advisory lock, so that two writers never share a file. Errors: file_error.
    static Result<File> create(const std::filesystem::path& path, bool overwrite);
    static Result<File> open(const std::filesystem::path& path);

    File(File&& other) noexcept;
    File& operator=(File&&) = delete;
    ~File();

    const std::filesystem::path& path() const { return path_; }
    std::uint64_t size() const { return size_; }  // when opened, plus what was appended

    // All the bytes or an error; after an error the file is cut back to where it was, if the system lets us.
    Status append(std::span<const mcap::ByteView> pieces);
    // Precondition: offset + out.size() <= size().
    Status read(std::uint64_t offset, std::span<std::byte> out) const;

  private:
    File(std::filesystem::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

    std::filesystem::path path_;
    int descriptor_;
    std::uint64_t size_{0};
};

Error file_error(const std::filesystem::path& path, const std::string& what, const std::string& hint);

}  // namespace headrace::proto::recording
