#include "client/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "client/text.h"

namespace headrace::client {

namespace {

using namespace std::chrono_literals;

constexpr auto kBarPeriod = 100ms;     // redrawing faster than it can be read
constexpr auto kLinePeriod = 5s;       // plain lines: so often at least while something changes ...
constexpr double kLineFraction = 0.1;  // ... or at each tenth
constexpr int kBarCells = 24;
constexpr double kEtaFrom = 0.01;  // before that share is done an estimate is noise

}  // namespace

Progress::Progress(std::ostream& out, bool is_terminal, std::string label, Now now)
    : out_(out),
      is_terminal_(is_terminal),
      label_(std::move(label)),
      now_(std::move(now)),
      begun_(now_()),
      last_(begun_) {}

Progress::~Progress() {
    finish();
}

std::string Progress::line(std::optional<double> fraction, const std::string& detail) const {
    std::string text = label_;
    if (fraction) {
        const double share = std::clamp(*fraction, 0.0, 1.0);
        if (is_terminal_) {
            const int full = static_cast<int>(std::lround(share * kBarCells));
            text += " [" + std::string(static_cast<std::size_t>(full), '#') +
                    std::string(static_cast<std::size_t>(kBarCells - full), ' ') + "]";
        }
        text += " " + std::to_string(static_cast<int>(std::floor(share * 100.0))) + " %";
    }
    if (!detail.empty()) text += (text.empty() ? "" : "  ") + detail;
    if (fraction && *fraction >= kEtaFrom && *fraction < 1.0) {
        const double spent = std::chrono::duration<double>(now_() - begun_).count();
        text += ", ETA " + duration_text(spent * (1.0 - *fraction) / *fraction);
    }
    return text;
}

void Progress::update(std::optional<double> fraction, const std::string& detail) {
    const auto now = now_();
    if (is_terminal_) {
        if (has_bar_ && now - last_ < kBarPeriod) return;
        out_ << "\r\x1b[K" << line(fraction, detail) << std::flush;  // clears the rest of the line
        has_bar_ = true;
        last_ = now;
        return;
    }
    const bool is_next_tenth =
        fraction && std::floor(*fraction / kLineFraction + 1e-9) > std::floor(last_fraction_ / kLineFraction + 1e-9);
    if (!is_next_tenth && now - last_ < kLinePeriod) return;
    out_ << line(fraction, detail) << "\n" << std::flush;
    last_ = now;
    last_fraction_ = fraction.value_or(last_fraction_);
}

void Progress::finish() {
    if (!has_bar_) return;
    out_ << "\r\x1b[K" << std::flush;
    has_bar_ = false;
}

Progress make_progress(std::string label) {
    return {std::cerr, isatty(STDERR_FILENO) != 0, std::move(label)};
}

}  // namespace headrace::client
