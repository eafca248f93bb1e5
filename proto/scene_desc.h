// What a client may ask for: the scene document as plain structs. SI units throughout; y is up by convention of the
// presets, gravity decides. In 2D scenes the third component of every vector is 0 and may be left out of the JSON.
#pragma once

#include <array>
#include <cstdint>
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

    bool operator==(const BoxDesc&) const = default;
};

// Sphere (2D: disc) [m].
struct SphereDesc {
    Vec3 center{};
    double radius{};

    bool operator==(const SphereDesc&) const = default;
};

// Round cylinder with flat ends [m]: from `from` to `to` along its axis. 3D only; in 2D a disc is a sphere.
struct CylinderDesc {
    Vec3 from{};
    Vec3 to{};
    double radius{};

    bool operator==(const CylinderDesc&) const = default;
};

// Half space [m]. As a fluid's shape and as an obstacle's: the side the normal points away from. Objects: the fluid is
// on the side the normal points to.
struct PlaneDesc {
    Vec3 point{};
    Vec3 normal{};  // need not have length 1

    bool operator==(const PlaneDesc&) const = default;
};

struct ShapeDesc;

// Inside the first and in none of the others.
struct DifferenceDesc {
    std::vector<ShapeDesc> of;  // at least two; the first must be bounded

    bool operator==(const DifferenceDesc& other) const;
};

// Inside all of them.
struct IntersectionDesc {
    std::vector<ShapeDesc> of;  // at least two; at least one must be bounded

    bool operator==(const IntersectionDesc& other) const;
};

// Fluids may have any; objects only the four primitives. (A struct, because shapes hold shapes.)
struct ShapeDesc : std::variant<BoxDesc, SphereDesc, CylinderDesc, PlaneDesc, DifferenceDesc, IntersectionDesc> {
    using variant::variant;
};
inline bool DifferenceDesc::operator==(const DifferenceDesc& other) const {
    return of == other.of;
}
inline bool IntersectionDesc::operator==(const IntersectionDesc& other) const {
    return of == other.of;
}

// A number, or an expression in x, y, z [m] and t [s] (muParser syntax; constants of the scene: pi, dx = spacing).
using Scalar = std::variant<double, std::string>;
using ScalarVec3 = std::array<Scalar, 3>;

// Values over time: rows of [t, value...]; smooth (cubic) between rows, constant before the first and after the last.
struct TableDesc {
    std::vector<std::vector<double>> rows;
};

// How the particles of a fluid volume stand at the start.
struct FluidStartDesc {
    bool relaxed{false};   // pushed apart until they are evenly spread and follow curved surfaces
    double jitter{0.0};    // random displacement of each lattice point, at most so many spacings along each axis
    std::int64_t seed{0};  // of the displacement

    bool operator==(const FluidStartDesc&) const = default;
};

// Particles of a file below the server's data folder: .npz, .csv or .ply.
struct ParticleFileDesc {
    std::string file;

    bool operator==(const ParticleFileDesc&) const = default;
};

// A volume of fluid at the start, filled with a lattice of the scene's spacing: particle centres at
// min + (k + 1/2) spacing, kept where the centre lies inside the shape. Or particles from a file.
struct FluidDesc {
    std::string name;
    ShapeDesc shape;                            // without meaning where there are `particles`
    std::optional<ParticleFileDesc> particles;  // instead of the shape; what velocities and pressures it has hold
    ScalarVec3 velocity{};                      // [m/s] at t = 0
    std::optional<Scalar> pressure;             // [Pa] at t = 0; absent: 0, or hydrostatic
    bool hydrostatic{false};                    // pressure of still fluid below this volume's highest point
    FluidStartDesc start;
};

// A container keeps the fluid inside its shape, an obstacle keeps it out.
enum class ObjectRole { container, obstacle };

enum class WallSlip { free_slip, no_slip };

// Prescribed motion of an object relative to its place at the start: turned about the pivot, then displaced. Each part
// is an expression in t or a table of [t, value]; absent: none.
struct MotionDesc {
    std::optional<std::variant<ScalarVec3, TableDesc>> displacement;  // [m]; table rows: t, x, y(, z)
    std::optional<std::variant<Scalar, TableDesc>> angle;             // [rad] about `axis` through `pivot`
    Vec3 pivot{};                                                     // [m]
    Vec3 axis{0.0, 0.0, 1.0};                                         // 2D: always z
};

// A named collision object. It can be added, moved and removed while running.
struct ObjectDesc {
    std::string name;
    ObjectRole role{ObjectRole::obstacle};
    ShapeDesc shape;
    std::optional<WallSlip> slip;  // absent: the model's `wall_slip` parameter
    std::optional<MotionDesc> motion;
    std::optional<ScalarVec3> surface_velocity;  // [m/s], expressions in t: a surface that slides in itself (a belt)
};

// A value of a model parameter; which kind, unit and range each has is the model's table (`describe`).
using ParameterValue = std::variant<double, bool, std::string, Vec3>;
using Parameters = std::map<std::string, ParameterValue>;

struct DomainDesc {
    Vec3 min{};  // [m] a particle outside faults the run
    Vec3 max{};
    std::array<bool, 3> periodic{};  // along x, y, z: what leaves at max enters at min
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

// A probe's value passes a threshold: `probe` names it, "name.member" where it has several (forces: tank.fx).
struct ProbeConditionDesc {
    std::string probe;
    std::optional<double> above;  // exactly one of the two; in the probe's unit
    std::optional<double> below;
};

// Exactly one of the triggers is set. Fires once per run (again after sim.reset).
struct SceneEventDesc {
    bool at_rest{false};
    std::optional<double> time;  // [s]
    std::optional<long long> step;
    std::optional<ProbeConditionDesc> probe;  // first sample for which it holds
    SceneAction action;
};

// ---- probes: what is measured while the run goes on -----------------------------------------------------------------

struct PressureProbe {  // [Pa] at a point, or the mean over a disc (2D: segment) of this radius facing `normal`
    Vec3 point{};
    double radius{0.0};  // [m]
    Vec3 normal{};       // needed when radius > 0
};
struct VelocityProbe {  // [m/s] vector at a point
    Vec3 point{};
};
enum class LevelSurface { highest, lowest };
struct LevelProbe {  // [m] distance from `from` to the fluid's `surface` on the line towards `to`
    Vec3 from{};
    Vec3 to{};
    LevelSurface surface{LevelSurface::highest};
};
enum class ProfileField { pressure, density, velocity_x, velocity_y, velocity_z };
struct ProfileProbe {  // `field` at `points` equidistant points from `from` to `to`, ends included
    Vec3 from{};
    Vec3 to{};
    std::int64_t points{50};
    ProfileField field{ProfileField::pressure};
};
struct FrontProbe {  // [m] largest coordinate along `direction` of any particle's edge (centre + spacing/2)
    Vec3 direction{1.0, 0.0, 0.0};
};
struct DischargeProbe {  // [m^3/s] (2D: m^2/s) through the plane, positive along the normal
    Vec3 point{};
    Vec3 normal{};
};
struct ForceProbe {  // force [N] (2D: N/m) and torque [N m] about `about` of the fluid on the object
    std::string object;
    Vec3 about{};
};
struct EnergyProbe {};   // kinetic, potential, internal, dissipated, work, balance [J] (2D: J/m)
struct DensityProbe {};  // mean and largest |rho/rho0 - 1| [1], fluid volume [m^3]

using ProbeKind = std::variant<PressureProbe, VelocityProbe, LevelProbe, ProfileProbe, FrontProbe, DischargeProbe,
                               ForceProbe, EnergyProbe, DensityProbe>;

struct ProbeDesc {
    std::string name;
    ProbeKind kind;
    std::optional<double> interval;           // [s] simulated time between samples; absent: the output interval
    std::optional<std::int64_t> every_steps;  // samples every so many steps instead
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
    ScalarVec3 body_force{};  // [m/s^2] beside gravity, a parameter of the model
    std::optional<std::variant<ScalarVec3, TableDesc>> frame_acceleration;  // [m/s^2] of the frame the scene is told in
    std::vector<FluidDesc> fluids;
    std::vector<ObjectDesc> objects;
    std::vector<ProbeDesc> probes;
    std::vector<SceneEventDesc> events;
    AtRestDesc at_rest;
    OutputDesc output;
};

}  // namespace headrace::proto
