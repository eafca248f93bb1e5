// The runs behind the diagrams of run time against error: for each case and option a ladder of resolutions.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/accuracy_row.h"
#include "tests/validation/support/case.h"

namespace headrace::bench {

// What a ladder changes against the model's defaults.
struct LadderOption {
    std::string name;  // "default", "R/dp=2.4", "c0 x 0.5", "shifting=false", "stiff"
    std::string model{"wcsph"};
    double support_over_spacing{0.0};  // 0: the model's default
    double sound_speed_factor{1.0};
    proto::Parameters parameters;
};

// Resolution alone, then R/dp, c0, and the numerical options; the thesis's model as it is and stiffened. `quick`: the
// default and R/dp alone.
std::vector<LadderOption> ladder_options(bool quick);

struct LadderPlan {
    std::vector<std::string> cases;  // none: all that have a ladder
    std::string model;               // only this one; empty: all
    std::string csv;                 // is appended to; runs found in it are not repeated
    bool quick{false};               // the three coarsest resolutions
    double budget{1e30};             // [s] after which no further run is begun
    double longest{20.0};            // [s] a run may be expected to take
};

// Returns false when the budget ended it.
bool run_ladders(const LadderPlan& plan);

}  // namespace headrace::bench
