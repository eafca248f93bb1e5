// The number of threads that are faster is found, kept, and left again when the machine changes.
#include <catch2/catch.hpp>
#include <functional>
#include <map>

#include "server/team_choice.h"

using headrace::server::TeamChoice;

namespace {

struct Steps {
    double seconds{};                    // they took in all
    std::map<int, double> with_threads;  // [s] of them with so many
};

// Steps for `span` seconds, each as long as `step` says of its threads.
Steps run(TeamChoice& team, double span, const std::function<double(int)>& step) {
    Steps done;
    while (done.seconds < span) {
        const int threads = team.threads();
        const double seconds = step(threads);
        team.note(seconds);
        done.seconds += seconds;
        done.with_threads[threads] += seconds;
    }
    return done;
}

double idle(int threads) {
    return 2e-3 / (0.2 + 0.8 * threads);
}
// Each of a hundred waits for a second thread costs a part of a time slice.
double busy(int threads) {
    return threads == 1 ? 2e-3 : 12e-3;
}

}  // namespace

TEST_CASE("TeamChoice.TakesAllThreadsOfAnIdleMachineAndTriesSeldom") {
    const int most = GENERATE(2, 3, 16);
    const double longest = GENERATE(1.0, 20.0, 60.0, 1000.0);  // [of idle()] steps from 0.15 ms to 1 s with all threads
    TeamChoice team(most);
    const auto step = [&](int threads) { return longest * idle(threads); };
    Steps steps = run(team, 120.0, step);
    // Without trials; the steps that were done, told by what they took.
    double whole = 0.0;
    for (const auto& [threads, seconds] : steps.with_threads) whole += seconds * step(most) / step(threads);
    // A trial takes no longer than the pause before it by a tenth, less each time: below 5 % in the first seconds, 1 %
    // after a minute.
    CHECK(whole > 0.98 * steps.seconds);
}

TEST_CASE("TeamChoice.LeavesThreadsThatWaitForABusyMachine") {
    TeamChoice team(2);
    Steps steps = run(team, 30.0, busy);
    CHECK(team.threads() == 1);
    // The first window and pause, and trials of the slower one: 50 ms after pauses of 0.5, 1, 2, 4, .. s.
    CHECK(steps.with_threads[2] < 0.05 * 30.0);
}

TEST_CASE("TeamChoice.FindsTheNumberInBetween") {
    TeamChoice team(16);
    run(team, 30.0, [](int threads) { return threads <= 4 ? 8e-3 / threads : 20e-3; });
    CHECK(team.threads() == 4);
}

TEST_CASE("TeamChoice.FollowsTheMachine") {
    TeamChoice team(2);
    run(team, 60.0, idle);
    REQUIRE(team.threads() == 2);
    run(team, 1.0, busy);  // noticed at once, since a step takes longer by far
    CHECK(team.threads() == 1);
    run(team, 60.0, busy);
    REQUIRE(team.threads() == 1);
    run(team, 25.0, idle);  // at the next trial, 20 s later at most
    CHECK(team.threads() == 2);
}

TEST_CASE("TeamChoice.LeavesLongStepsAllThreads") {
    // Their loops balance what other programs take.
    TeamChoice team(2);
    run(team, 5.0, busy);
    REQUIRE(team.threads() == 1);
    run(team, 5.0, [](int) { return 0.1; });  // more has come to do
    CHECK(team.threads() == 2);
    const Steps steps = run(team, 60.0, [](int) { return 0.1; });
    CHECK(steps.with_threads.size() == 1);
}

TEST_CASE("TeamChoice.HasNothingToChooseWithOneThread") {
    TeamChoice team(1);
    run(team, 1.0, idle);
    CHECK(team.threads() == 1);
}
