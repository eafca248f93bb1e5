#include "server/service/log.h"

#include <unistd.h>

#include <array>
#include <string>

namespace headrace::server {

namespace {
constexpr std::array<std::string_view, 4> kNames{"error", "warn", "info", "debug"};
}

std::optional<LogLevel> find_log_level(std::string_view name) {
    for (std::size_t k = 0; k < kNames.size(); ++k)
        if (kNames[k] == name) return static_cast<LogLevel>(k);
    return std::nullopt;
}

void Log::operator()(LogLevel level, std::string_view text) const {
    if (!wants(level)) return;
    std::string line = "headraced: ";
    if (level != LogLevel::error) line.append(kNames[static_cast<std::size_t>(level)]).append(": ");
    line.append(text).append("\n");
    // One write per line, so that lines of several threads stay whole. Nobody is left to tell when it fails.
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace headrace::server
