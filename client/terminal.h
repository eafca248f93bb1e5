// The terminal as a canvas: the alternate screen, keys without Return. Plain ANSI and termios: a dashboard of some
// twenty lines needs no more of a terminal than every one of today has, and no library.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/result.h"

namespace headrace::client {

// Owner: one thread; one at a time. However the program ends, by its destructor, a signal or a crash, the terminal is
// as before; Ctrl-Z gives it back while the program is stopped.
class Terminal {
  public:
    struct Size {
        int rows{24}, columns{80};
    };

    // Error: usage with the hint, when standard input or output is no terminal.
    static proto::Status check(const std::string& hint);
    static proto::Result<std::unique_ptr<Terminal>> open(const std::string& hint);
    ~Terminal();
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    Size size() const;
    // Shows the lines, cut to the screen.
    void draw(const std::vector<std::string>& lines);
    // A key, or nothing when none comes in time, or the size has changed. Keys that send several bytes (arrows) are
    // passed over; Escape alone is '\x1b'. At the end of input: 'q'.
    std::optional<char> key(std::chrono::milliseconds timeout);

  private:
    Terminal() = default;
};

// The first `columns` characters of UTF-8 text, each of which is as wide as a letter. ANSI sequences take no room.
std::string cut_to_width(const std::string& text, int columns);

}  // namespace headrace::client
