#include <catch2/catch.hpp>

#include "client/jobs.h"

using namespace headrace;
using namespace headrace::client;

TEST_CASE("Jobs.FractionRunsFromStartToEnd") {
    proto::JobReply start;
    start.step = 100;
    start.time = 1.0;
    proto::RunUntil until;
    until.time = 3.0;
    CHECK(*run_fraction(until, start, 150, 1.5) == 0.25);
    CHECK(*run_fraction(until, start, 400, 4.0) == 1.0);
    until = {};
    until.duration = 2.0;
    CHECK(*run_fraction(until, start, 200, 2.0) == 0.5);
    until = {};
    until.step = 200;
    CHECK(*run_fraction(until, start, 125, 1.25) == 0.25);
    until = {};
    until.steps = 200;
    CHECK(*run_fraction(until, start, 200, 2.0) == 0.5);
}

TEST_CASE("Jobs.OpenEndHasNoFraction") {
    proto::RunUntil until;
    CHECK_FALSE(run_fraction(until, {}, 1, 1));
    until.at_rest = true;
    CHECK_FALSE(run_fraction(until, {}, 1, 1));
}

TEST_CASE("Jobs.LineSaysHowItEnded") {
    proto::JobReply job;
    job.state = proto::JobState::finished;
    job.step = 1'234;
    job.time = 12.34;
    proto::RunUntil until;
    CHECK(job_line(job, until) == "done: step 1,234, t 12.34 s");
    until.at_rest = true;
    CHECK(job_line(job, until) == "at rest: step 1,234, t 12.34 s");
    job.state = proto::JobState::paused;
    CHECK(job_line(job, until) == "paused: step 1,234, t 12.34 s");
}

TEST_CASE("Jobs.FaultNamesCriterionParticleAndRemedy") {
    proto::FaultReport fault;
    fault.criterion = "left_domain";
    fault.particle = 1'702;
    fault.remedy = "reduce time_step";
    const proto::Error error = fault_error(fault);
    CHECK(error.code == proto::ErrorCode::faulted);
    CHECK(error.message.find("left_domain: particle 1,702") == 0);
    CHECK(error.hint == "reduce time_step");
}
