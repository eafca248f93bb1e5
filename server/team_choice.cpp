#include "server/team_choice.h"

#include <algorithm>
#include <cmath>

namespace headrace::server {
namespace {

// Long enough to tell: some time slices of a busy machine, and what is not done in every step.
constexpr double kWindow = 0.05;  // [s]
constexpr int kWindowSteps = 10;
// Before the first trial, and after one that paid. Trials of what turns out to be slower get rarer.
constexpr double kFirstPause = 0.2, kLongestPause = 20.0;  // [s]
constexpr double kPauseOverTrial = 10.0;                   // at least
constexpr double kFaster = 0.9;                            // share of the time, from which a change pays
constexpr double kWorse = 1.5;                             // something has happened: tries at once
constexpr double kLongStep = 0.02;                         // [s]

}  // namespace

void TeamChoice::note(double seconds) {
    if (most_ < 2) return;
    window_.seconds += seconds;
    ++window_.steps;
    since_trial_ += seconds;
    if (is_trial())
        judge_trial();
    else if (window_.steps >= kWindowSteps && window_.seconds >= kWindow)
        judge_settled();
}

// Ends when it cannot pay any more, so that it never takes longer than its steps would have taken anyway.
void TeamChoice::judge_trial() {
    const bool is_lost = window_.seconds > kFaster * mean_ * trial_steps_;
    if (!is_lost && window_.steps < trial_steps_) return;
    if (is_lost) {
        threads_ = settled_;
        pause_ = std::min(2.0 * pause_, kLongestPause);
    } else {
        mean_ = window_.seconds / window_.steps;
        pause_ = kFirstPause;
    }
    decided_mean_ = mean_;
    settled_ = 0;
    since_trial_ = 0.0;
    window_ = {};
}

void TeamChoice::judge_settled() {
    mean_ = window_.seconds / window_.steps;
    window_ = {};
    if (mean_ > kLongStep) return take_all();
    if (decided_mean_ == 0.0) decided_mean_ = mean_;
    trial_steps_ = std::max(kWindowSteps, static_cast<int>(std::ceil(kWindow / mean_)));
    pause_ = mean_ > kWorse * decided_mean_ ? kFirstPause : std::max(pause_, kPauseOverTrial * trial_steps_ * mean_);
    if (since_trial_ < pause_) return;
    settled_ = threads_;
    threads_ = candidate();
}

void TeamChoice::take_all() {
    threads_ = most_;
    decided_mean_ = 0.0;
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
