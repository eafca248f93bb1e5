#include "server/team_choice.h"

#include <algorithm>

namespace headrace::server {
namespace {

constexpr double kWindow = 0.05;  // [s]
constexpr int kWindowSteps = 10;
// Trials of a number that turns out to be the slower one get rarer.
constexpr double kFirstPause = 0.2, kLongestPause = 20.0;  // [s]
constexpr double kFaster = 0.9;                            // share of the time, from which a change pays
constexpr double kWorse = 1.5;                             // something has happened: tries at once
// Loops of steps as long as this balance what other programs take, and a trial would cost too much.
constexpr double kLongStep = 0.1;  // [s]

}  // namespace

bool TeamChoice::Window::is_full() const {
    return steps >= kWindowSteps && seconds >= kWindow;
}

void TeamChoice::note(double seconds) {
    if (most_ < 2) return;
    window_.seconds += seconds;
    ++window_.steps;
    since_trial_ += seconds;
    // A trial that is clearly lost need not be seen to its end.
    const bool is_lost = settled_ != 0 && window_.seconds > 3.0 * kWindowSteps * settled_mean_ + kWindow;
    if (window_.is_full() || is_lost) {
        judge(window_);
        window_ = {};
    }
}

void TeamChoice::judge(const Window& window) {
    const double mean = window.mean();
    if (settled_ != 0) {  // a trial ends
        const bool pays = mean < kFaster * settled_mean_;
        if (!pays) threads_ = settled_;
        pause_ = pays ? kFirstPause : std::min(2.0 * pause_, kLongestPause);
        settled_ = 0;
        since_trial_ = 0.0;
        settled_mean_ = decided_mean_ = pays ? mean : settled_mean_;
        return;
    }
    settled_mean_ = mean;
    if (decided_mean_ == 0.0) decided_mean_ = mean;
    if (mean > kLongStep) return;
    if (pause_ == 0.0) pause_ = kFirstPause;
    if (mean > kWorse * decided_mean_) pause_ = kFirstPause;
    if (since_trial_ < pause_) return;
    settled_ = threads_;
    threads_ = candidate();
}

// Half as many, one and twice as many by turns, where they are others than now. One, since half of many may wait as
// long as all.
int TeamChoice::candidate() {
    for (;;) {
        const int turn = turn_++ % 3;
        const int wanted = turn == 0 ? std::max(1, threads_ / 2) : turn == 1 ? 1 : std::min(2 * threads_, most_);
        if (wanted != threads_) return wanted;
    }
}

}  // namespace headrace::server
