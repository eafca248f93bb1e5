#include <catch2/catch.hpp>

#include "server/job.h"

using namespace headrace;
using server::Job;
using server::Place;

namespace {

constexpr double kDt = 0.01;  // [s]

proto::JobState state_at(const Job& job, const Place& now, bool at_rest = false) {
    const auto end = job.end(now, kDt, at_rest);
    return end ? end->state : proto::JobState::running;
}

}  // namespace

TEST_CASE("Job.EndsAtItsStepOrTime") {
    proto::RunUntil until;
    SECTION("absolute step") {
        until.step = 12;
        const Job job = Job::make(1, until, {10, 0.1}, 30.0);
        CHECK(state_at(job, {11, 0.11}) == proto::JobState::running);
        CHECK(state_at(job, {12, 0.12}) == proto::JobState::finished);
    }
    SECTION("steps from now") {
        until.steps = 12;
        const Job job = Job::make(1, until, {10, 0.1}, 30.0);
        CHECK(state_at(job, {21, 0.21}) == proto::JobState::running);
        CHECK(state_at(job, {22, 0.22}) == proto::JobState::finished);
    }
    SECTION("absolute time, reached within rounding") {
        until.time = 0.3;
        const Job job = Job::make(1, until, {0, 0.0}, 30.0);
        double t = 0.0;
        for (int k = 0; k < 30; ++k) t += kDt;  // 0.30000000000000004 or just below: both count
        CHECK(state_at(job, {29, t - kDt}) == proto::JobState::running);
        CHECK(state_at(job, {30, t - 1e-12}) == proto::JobState::finished);
    }
    SECTION("duration") {
        until.duration = 0.05;
        const Job job = Job::make(1, until, {10, 0.1}, 30.0);
        CHECK(state_at(job, {14, 0.14}) == proto::JobState::running);
        CHECK(state_at(job, {15, 0.15}) == proto::JobState::finished);
    }
}

TEST_CASE("Job.WaitingForRestHasATimeOutEvenIfNobodyGivesOne") {
    proto::RunUntil until;
    until.at_rest = true;
    const Job job = Job::make(1, until, {10, 1.0}, 5.0);
    CHECK(state_at(job, {11, 1.01}) == proto::JobState::running);
    CHECK(state_at(job, {11, 1.01}, true) == proto::JobState::finished);
    CHECK(state_at(job, {500, 6.0}) == proto::JobState::timed_out);
    CHECK(state_at(job, {500, 6.0}, true) == proto::JobState::finished);
}

TEST_CASE("Job.AProbesValueEndsItAndIsTheReason") {
    proto::RunUntil until;
    until.probe = {"gauge", 0.3, {}};
    const Job job = Job::make(1, until, {0, 0.0}, 30.0);
    CHECK_FALSE(job.end({5, 0.05}, kDt, true));
    const auto end = job.end({5, 0.05}, kDt, false, "probe gauge is 0.31 m, above 0.3 m");
    REQUIRE(end);
    CHECK(end->state == proto::JobState::finished);
    CHECK(end->reason == "probe gauge is 0.31 m, above 0.3 m");
    // Another job's probe does not end one that has none.
    CHECK_FALSE(Job::make(2, {}, {0, 0.0}, 30.0).end({5, 0.05}, kDt, false, "probe gauge is 0.31 m, above 0.3 m"));
}

TEST_CASE("Job.WithoutATargetItNeverEndsByItself") {
    const Job job = Job::make(1, {}, {0, 0.0}, 5.0);
    CHECK(state_at(job, {1'000'000, 1e6}, true) == proto::JobState::running);
}

TEST_CASE("Job.APaceHoldsTheNextStepBack") {
    Job job = Job::make(1, {}, {0, 0.0}, 5.0);
    CHECK_FALSE(job.next_step_at({0, 0.0}, kDt).has_value());
    job.pace = 2.0;  // two simulated seconds per wall second
    const auto at = job.next_step_at({100, 1.0}, kDt);
    REQUIRE(at.has_value());
    CHECK(std::chrono::duration<double>(*at - job.pace_wall).count() == Approx(1.01 / 2.0));
}
