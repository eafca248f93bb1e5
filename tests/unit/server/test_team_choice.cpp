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
    TeamChoice team(most);
    Steps steps = run(team, 60.0, idle);
    CHECK(team.threads() == most);
    // Trials of 50 ms after pauses of 0.2, 0.4, .. 20 s: nine in a minute.
    CHECK(steps.with_threads[most] > 0.99 * 60.0);
}

TEST_CASE("TeamChoice.LeavesThreadsThatWaitForABusyMachine") {
    TeamChoice team(2);
    Steps steps = run(team, 30.0, busy);
    CHECK(team.threads() == 1);
    // The first window and pause, and what trials of the slower one take: 10 steps of 12 ms seven times.
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

TEST_CASE("TeamChoice.LeavesLongStepsAlone") {
    // Their loops balance what other programs take.
    TeamChoice team(2);
    const Steps steps = run(team, 60.0, [](int) { return 0.2; });
    CHECK(steps.with_threads.size() == 1);
    CHECK(team.threads() == 2);
}

TEST_CASE("TeamChoice.HasNothingToChooseWithOneThread") {
    TeamChoice team(1);
    run(team, 1.0, idle);
    CHECK(team.threads() == 1);
}
