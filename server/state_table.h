// Which method is allowed in which state: the one table behind every wrong_state error and proto/README.md.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "proto/messages.h"

namespace headrace::server {

struct StateRule {
    std::string_view method;
    bool empty, loading, idle, running, faulted;
};

// Methods that are not listed are allowed in every state. `loading` also covers loading over an existing scene.
inline constexpr std::array<StateRule, 20> kStateTable{{
    // clang-format off
    // method            empty  loading idle   running faulted
    {"scene.load",      true,   false,  true,   false,  true},
    {"scene.get",       false,  true,   true,   true,   true},
    {"sim.reset",       false,  false,  true,   false,  true},
    {"sim.step",        false,  false,  true,   false,  false},
    {"sim.run",         false,  false,  true,   false,  false},
    {"sim.pause",       false,  false,  true,   true,   false},
    {"sim.resume",      false,  false,  true,   true,   false},
    {"sim.cancel",      true,   true,   true,   true,   true},
    {"params.get",      false,  true,   true,   true,   true},
    {"params.set",      false,  false,  true,   true,   false},
    {"objects.list",    false,  true,   true,   true,   true},
    {"objects.add",     false,  false,  true,   true,   false},
    {"objects.move",    false,  false,  true,   true,   false},
    {"objects.remove",  false,  false,  true,   true,   false},
    {"probes.list",     false,  true,   true,   true,   true},
    {"probes.get",      false,  true,   true,   true,   true},
    {"probes.add",      false,  false,  true,   true,   false},
    {"probes.remove",   false,  false,  true,   true,   false},
    {"sim.inspect",     false,  false,  true,   true,   true},
    {"record.start",    false,  false,  true,   true,   false},
    // clang-format on
}};

// The error wrong_state (busy while loading) for a method that is not allowed now, with the remedy; else nothing.
std::optional<proto::Error> refuse_in_state(std::string_view method, proto::SimState state);

std::string_view state_name(proto::SimState state);

}  // namespace headrace::server
