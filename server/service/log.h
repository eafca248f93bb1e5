// Diagnostics for the person who runs the server: one line each on standard error.
#pragma once

#include <optional>
#include <string_view>

namespace headrace::server {

enum class LogLevel { error, warn, info, debug };

std::optional<LogLevel> find_log_level(std::string_view name);

// A value: whoever logs holds a copy. Lines of several threads do not mix.
class Log {
  public:
    explicit Log(LogLevel threshold = LogLevel::warn) : threshold_(threshold) {}

    bool wants(LogLevel level) const { return level <= threshold_; }
    void operator()(LogLevel level, std::string_view text) const;

  private:
    LogLevel threshold_;
};

}  // namespace headrace::server
