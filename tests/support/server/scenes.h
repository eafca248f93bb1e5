// Cheap scenes that reach each state of the server.
#pragma once

#include <nlohmann/json.hpp>

namespace headrace::test {

using Json = nlohmann::ordered_json;

// 100 particles in two dimensions in a tank that they fill partly; steps take microseconds.
Json pond();

// A drop that leaves its domain within a few steps: nothing holds it.
Json doomed_drop();

// 98,304 particles in three dimensions: a step takes long enough for a command to come meanwhile.
Json deep_tank();

// Two million particles: takes long enough to load for a command to come meanwhile.
Json lake();

// `pond` that counts as being at rest after 0.02 s, whatever it does.
Json calm_pond();

}  // namespace headrace::test
