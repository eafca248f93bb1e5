// How far a run or a conversion is: a bar on a terminal, now and then a plain line elsewhere.
#pragma once

#include <chrono>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

namespace headrace::client {

class Progress {
  public:
    using Clock = std::chrono::steady_clock;
    using Now = std::function<Clock::time_point()>;

    // `label` opens each line ("wave.mcap"). The stream outlives the object.
    Progress(std::ostream& out, bool is_terminal, std::string label, Now now = Clock::now);
    ~Progress();  // ends the bar's line

    // `fraction` 0..1, nothing when the end is unknown; `detail` such as "t 0.84 s, 567 steps/s".
    void update(std::optional<double> fraction, const std::string& detail);
    void finish();  // the bar goes; what follows starts on a clean line

  private:
    std::string line(std::optional<double> fraction, const std::string& detail) const;

    std::ostream& out_;
    bool is_terminal_;
    std::string label_;
    Now now_;
    Clock::time_point begun_;
    Clock::time_point last_;
    double last_fraction_{0.0};
    bool has_bar_{false};
};

// On standard error, a terminal or not as it is.
Progress make_progress(std::string label);

}  // namespace headrace::client
