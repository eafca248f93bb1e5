// What a client may ask for: the scene document as plain structs. SI units throughout; y is up by convention of the
// presets, gravity decides. In 2D scenes the third component of every vector is 0 and may be left out of the JSON.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "proto/fields.h"

namespace headrace::proto {

using Vec3 = std::array<double, 3>;

// Axis-aligned box (2D: rectangle) from corner to corner [m].
struct BoxDesc {
    Vec3 min{};
    Vec3 max{};
};

// Sphere (2D: disc) [m].
struct SphereDesc {
    Vec3 center{};
    double radius{};
};

using ShapeDesc = std::variant<BoxDesc, SphereDesc>;

// A volume of fluid at the start, filled with a lattice of the scene's spacing: particle centres at
// min + (k + 1/2) spacing, kept where the centre lies inside the shape.
struct FluidDesc {
    std::string name;
    ShapeDesc shape;
    Vec3 velocity{};  // [m/s], uniform at the start
};

// A container keeps the fluid inside its shape, an obstacle keeps it out.
enum class ObjectRole { container, obstacle };

// A named collision object. It can be added, moved and removed while running.
struct ObjectDesc {
    std::string name;
    ObjectRole role{ObjectRole::obstacle};
    ShapeDesc shape;
};

// A value of a model parameter; which kind, unit and range each has is the model's table (`describe`).
using ParameterValue = std::variant<double, bool, std::string, Vec3>;
using Parameters = std::map<std::string, ParameterValue>;

struct DomainDesc {
    Vec3 min{};  // [m] a particle outside faults the run
    Vec3 max{};
};

// When the fluid counts as being at rest.
struct AtRestDesc {
    // A particle's speed counts as slow below factor * sqrt(|g| H), H the fluid's height along gravity at load.
    double speed_factor{0.05};
    // Share of particles that must be slow, 0 < share <= 1. 1: the largest speed decides.
    double share{0.95};
    double duration{0.5};  // [s] simulated time for which it must hold: longer than a turning point of a slosh
    double timeout{30.0};  // [s] simulated time after which waiting gives up and says so
};

// What a scene event does: the subset of commands that a scene may issue itself.
struct RemoveObjectAction {
    std::string name;
};
struct MoveObjectAction {
    std::string name;
    Vec3 to{};  // [m] new centre of the shape's bounding box
};
struct SetParametersAction {
    Parameters parameters;
};
struct PauseAction {};
using SceneAction = std::variant<RemoveObjectAction, MoveObjectAction, SetParametersAction, PauseAction>;

// Exactly one of the triggers is set. Fires once per run (again after sim.reset).
struct SceneEventDesc {
    bool at_rest{false};
    std::optional<double> time;  // [s]
    std::optional<long long> step;
    SceneAction action;
};

struct OutputDesc {
    double interval{0.01};  // [s] simulated time between frames of a recording that does not say otherwise
    FieldSet fields{kDefaultFields};
};

struct SceneDesc {
    std::string name;
    std::string description;
    int dimensions{3};            // 2 or 3
    std::string model{"thesis"};  // name in the model registry
    Parameters parameters;        // overrides of the model's defaults
    double spacing{};             // [m] initial particle spacing
    DomainDesc domain;
    std::vector<FluidDesc> fluids;
    std::vector<ObjectDesc> objects;
    std::vector<SceneEventDesc> events;
    AtRestDesc at_rest;
    OutputDesc output;
};

}  // namespace headrace::proto
