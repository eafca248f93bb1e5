#include "server/state_table.h"

#include <string>
#include <utility>

namespace headrace::server {

using proto::SimState;

namespace {

constexpr std::array<SimState, 5> kStates{SimState::empty, SimState::loading, SimState::idle, SimState::running,
                                          SimState::faulted};

bool is_allowed(const StateRule& rule, SimState state) {
    switch (state) {
        case SimState::empty:
            return rule.empty;
        case SimState::loading:
            return rule.loading;
        case SimState::idle:
            return rule.idle;
        case SimState::running:
            return rule.running;
        case SimState::faulted:
            return rule.faulted;
    }
    return false;
}

// The way out of a state in which a method is refused.
std::string_view remedy(SimState state) {
    switch (state) {
        case SimState::empty:
            return "load a scene first (scene.load)";
        case SimState::loading:
            return "ask again when the scene is loaded, or end the load with sim.cancel";
        case SimState::idle:
            return "";
        case SimState::running:
            return "wait for the run to end (job.wait), or sim.pause or sim.cancel first";
        case SimState::faulted:
            return "sim.status tells the fault; sim.reset or scene.load starts anew";
    }
    return "";
}

std::string allowed_states(const StateRule& rule) {
    std::string names;
    for (SimState state : kStates) {
        if (!is_allowed(rule, state)) continue;
        if (!names.empty()) names += ", ";
        names += state_name(state);
    }
    return names;
}

}  // namespace

std::optional<proto::Error> refuse_in_state(std::string_view method, SimState state) {
    for (const StateRule& rule : kStateTable) {
        if (rule.method != method) continue;
        if (is_allowed(rule, state)) return std::nullopt;
        const std::string name(method);
        if (state == SimState::loading)
            return proto::Error{proto::ErrorCode::busy, name + " must wait: a scene is being loaded", "method",
                                std::string(remedy(state))};
        return proto::Error{proto::ErrorCode::wrong_state,
                            name + " is not allowed while " + std::string(state_name(state)) +
                                "; it is allowed while " + allowed_states(rule),
                            "method", std::string(remedy(state))};
    }
    return std::nullopt;
}

std::string_view state_name(SimState state) {
    switch (state) {
        case SimState::empty:
            return "empty";
        case SimState::loading:
            return "loading";
        case SimState::idle:
            return "idle";
        case SimState::running:
            return "running";
        case SimState::faulted:
            return "faulted";
    }
    return "unknown";
}

}  // namespace headrace::server
