// A scene that tries to break a model, and the criteria by which the run is judged. For the tests and for
// `headrace_bench stability`.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "server/scene/run.h"

namespace headrace::stability {

struct Scenario {
    std::string name;     // row of the table
    std::string variant;  // column
    proto::SceneDesc scene;
    double duration{};                  // [s] simulated
    std::size_t most_steps{1'000'000};  // the run ends there if it comes first

    // Called before each step; may change parameters and objects. Returns true when it did: stored energy, momentum
    // and step are then compared with those after the change.
    std::function<bool(scene::Run& run)> disturb;

    bool is_brief{false};            // part of the tests
    bool is_beyond_limits{false};    // of the stated limits: the run may stop itself
    bool conserves_momentum{false};  // neither walls nor other forces than gravity
    bool has_moving_walls{false};    // they may do work
    double judged_from{0.0};         // [s] density and distances count from then on: bad starts need time to mend
};

// One criterion: the largest value of the run over its bound.
struct Criterion {
    const char* name{};
    bool is_hard{};  // else: a run that exceeds it is poor, not wrong
    double value{};
    double bound{};

    double margin() const { return value / bound; }
};

// passed: all criteria kept. bounded: the run stopped itself with a named fault beyond the stated limits, or exceeded a
// soft criterion. failed: everything else.
enum class Verdict { passed, bounded, failed };
const char* name_of(Verdict verdict);

struct Outcome {
    std::string name, variant;
    Verdict verdict{};
    std::vector<Criterion> criteria;
    std::string fault;  // criterion, particle, place, remedy; empty: none
    std::size_t particles{}, steps{};
    double simulated{};  // [s]
    double wall{};       // [s]

    const Criterion& worst() const;  // largest margin
};

// Errors: the model refuses the scene.
proto::Result<Outcome> run_scenario(const Scenario& scenario);

// One line for a person.
std::string describe(const Outcome& outcome);

std::vector<Scenario> step_scenarios();         // long and short steps
std::vector<Scenario> impact_scenarios();       // blocks, drops and jets on walls and pools
std::vector<Scenario> gap_scenarios();          // columns of 1 to 3 spacings
std::vector<Scenario> disturbance_scenarios();  // parameters and walls changed while running
std::vector<Scenario> start_scenarios();        // coincident and random starts, negative pressure
std::vector<Scenario> rest_scenarios();         // 10^5 steps of still water
std::vector<Scenario> random_scenarios();       // a hundred seeds

const std::vector<Scenario>& scenarios();  // all, in this order

}  // namespace headrace::stability
