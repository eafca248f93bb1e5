// The plan of a step as the client shows it.
#pragma once

#include <string>
#include <vector>

#include "proto/messages.h"

namespace headrace::client {

// A line per stage: "  1.23 s  45 %  density: sum over neighbours", "viscosity: skipped, coefficient is 0". The times
// and their shares are left out while nothing has been timed.
std::vector<std::string> plan_lines(const std::vector<proto::PlanStage>& plan);

// Where most of the time went: "pressure_force 41 %, continuity 20 %, neighbours 15 %"; empty while nothing was timed.
std::string busiest_stages(const std::vector<proto::PlanStage>& plan);

}  // namespace headrace::client
