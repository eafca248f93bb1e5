#include <catch2/catch.hpp>

#include "client/plan_text.h"

namespace headrace::client {

namespace {

const std::vector<proto::PlanStage> kTimed{{"neighbours", true, "cells in 2D", 0.5},
                                           {"viscosity", false, "coefficient is 0", 0.0},
                                           {"pressure_force", true, "", 1.5}};

}  // namespace

TEST_CASE("Plan text: each stage has a line with its time and its share, a skipped one says why") {
    CHECK(plan_lines(kTimed) == std::vector<std::string>{"      0.5 s  25 %  neighbours: cells in 2D",
                                                         "                  viscosity: skipped, coefficient is 0",
                                                         "      1.5 s  75 %  pressure_force"});
}

TEST_CASE("Plan text: nothing timed, no times") {
    std::vector<proto::PlanStage> plan = kTimed;
    for (proto::PlanStage& stage : plan) stage.seconds = 0.0;
    CHECK(plan_lines(plan) == std::vector<std::string>{"neighbours: cells in 2D",
                                                       "viscosity: skipped, coefficient is 0", "pressure_force"});
    CHECK(busiest_stages(plan).empty());
}

TEST_CASE("Plan text: the busiest stages come first, idle ones not at all") {
    CHECK(busiest_stages(kTimed) == "pressure_force 75 %, neighbours 25 %");
}

}  // namespace headrace::client
