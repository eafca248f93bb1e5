// The scene document, member by member.
#include <set>

#include "proto/json_describe.h"
#include "proto/version.h"

namespace headrace::proto {

namespace {

constexpr std::size_t kMaxFileName = 1000;    // characters
constexpr std::size_t kMaxSceneItems = 1000;  // fluids, objects or events of a scene
constexpr std::size_t kMaxParameters = 256;
constexpr std::size_t kMaxShapeParts = 100;  // of a difference or an intersection
constexpr std::size_t kMaxTableRows = 100'000;

constexpr std::string_view kAxes[]{"x", "y", "z"};

// Two corners of a volume. Where the dimensions are not known (an object added later), z may be flat.
void describe_corners(Visitor& v, Vec3& min, Vec3& max) {
    v.required("min", min, {.meaning = "lower corner", .unit = "m"});
    v.required("max", max, {.meaning = "upper corner, above the lower one along every axis", .unit = "m"});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool may_be_flat = axis == 2 && v.dimensions != 3;
        if (may_be_flat ? min[axis] <= max[axis] : min[axis] < max[axis]) continue;
        v.refuse("max[" + std::to_string(axis) + "]", "must be greater than min along " + std::string(kAxes[axis]),
                 "min is the lower corner, max the upper one [m]");
    }
}

bool is_zero(const Vec3& x) {
    return x[0] == 0.0 && x[1] == 0.0 && x[2] == 0.0;
}

template <class Named>
void refuse_double_names(Visitor& v, const std::vector<Named>& items, const std::string& list) {
    std::set<std::string_view> seen;
    for (std::size_t k = 0; k < items.size(); ++k)
        if (!seen.insert(items[k].name).second)
            v.refuse(list + "[" + std::to_string(k) + "].name", "is used twice: \"" + items[k].name + "\"",
                     "give each its own name");
}

}  // namespace

void describe(Visitor& v, BoxDesc& box) {
    describe_corners(v, box.min, box.max);
}

void describe(Visitor& v, SphereDesc& sphere) {
    v.required("center", sphere.center, {.meaning = "centre", .unit = "m"});
    v.required("radius", sphere.radius, {.meaning = "radius", .unit = "m", .range = kPositive});
}

void describe(Visitor& v, CylinderDesc& cylinder) {
    v.required("from", cylinder.from, {.meaning = "centre of one flat end", .unit = "m"});
    v.required("to", cylinder.to, {.meaning = "centre of the other", .unit = "m"});
    v.required("radius", cylinder.radius, {.meaning = "radius", .unit = "m", .range = kPositive});
    if (v.dimensions == 2) v.refuse({}, "is for 3 dimensions only", "in 2D a disc is a sphere");
    if (cylinder.from == cylinder.to)
        v.refuse("to", "must differ from `from`", "give the centres of the two flat ends [m]");
}

void describe(Visitor& v, PlaneDesc& plane) {
    v.required("point", plane.point, {.meaning = "a point of the plane", .unit = "m"});
    v.required("normal", plane.normal,
               {.meaning = "objects: towards the fluid; fluids: out of the fluid; of any length", .unit = "1"});
    if (is_zero(plane.normal)) v.refuse("normal", "must not be zero", "give a direction, of any length");
}

void describe(Visitor& v, DifferenceDesc& difference) {
    v.required("of", difference.of,
               {.meaning = "inside the first and in none of the others", .min_items = 2, .max_items = kMaxShapeParts});
}

void describe(Visitor& v, IntersectionDesc& intersection) {
    v.required("of", intersection.of, {.meaning = "inside all", .min_items = 2, .max_items = kMaxShapeParts});
}

void describe(Visitor& v, TableDesc& table) {
    v.required("table", table.rows,
               {.meaning = "rows of [t, value...], t in s rising: smooth between rows, constant before and after them",
                .min_items = 2,
                .max_items = kMaxTableRows});
}

void describe(Visitor& v, FluidStartDesc& start) {
    v.optional("relaxed", start.relaxed,
               {.meaning = "push the particles apart until they are evenly spread and follow curved surfaces"});
    v.optional("jitter", start.jitter,
               {.meaning = "largest random displacement of each lattice point along each axis, in spacings",
                .unit = "1",
                .range = between(0.0, 0.5)});
    v.optional("seed", start.seed, {.meaning = "of the random displacement"});
}

void describe(Visitor& v, ParticleFileDesc& particles) {
    v.required(
        "file", particles.file,
        {.meaning = "path below the server's data folder: .npz with arrays position, velocity, pressure; .csv or "
                    ".ply as headrace convert writes them. Positions are needed",
         .max_length = kMaxFileName});
}

void describe(Visitor& v, FluidDesc& fluid) {
    v.required("name", fluid.name, {.meaning = "name of the fluid volume", .text = Text::name});
    // A box of no extent stands for none: no scene can have it.
    std::optional<ShapeDesc> shape = fluid.shape == ShapeDesc{} ? std::nullopt : std::optional(fluid.shape);
    v.optional("shape", shape, {.meaning = "volume that is filled with particles"});
    v.optional("particles", fluid.particles, {.meaning = "particles of a file instead"});
    v.exactly_one({{"shape", shape.has_value()}, {"particles", fluid.particles.has_value()}});
    fluid.shape = shape.value_or(ShapeDesc{});
    v.optional("velocity", fluid.velocity,
               {.meaning = "velocity at the start: numbers, or expressions in x, y, z", .unit = "m/s"});
    v.optional("pressure", fluid.pressure,
               {.meaning = "pressure at the start: a number, or an expression in x, y, z", .unit = "Pa"});
    std::optional<bool> hydrostatic = fluid.hydrostatic ? std::optional(true) : std::nullopt;
    v.optional(
        "hydrostatic", hydrostatic,
        {.meaning = "start with the pressure of still fluid below this volume's highest point", .only_true = true});
    fluid.hydrostatic = hydrostatic.value_or(false);
    v.at_most_one({{"particles", fluid.particles.has_value()}, {"hydrostatic", fluid.hydrostatic}});
    v.at_most_one({{"pressure", fluid.pressure.has_value()}, {"hydrostatic", fluid.hydrostatic}});
    v.unless_default("start", fluid.start, {.meaning = "how its particles stand at the start"});
}

void describe(Visitor& v, MotionDesc& motion) {
    v.optional("displacement", motion.displacement,
               {.meaning = "expressions in t, or a table with rows [t, x, y, z] (2D: [t, x, y])", .unit = "m"});
    v.optional("angle", motion.angle,
               {.meaning = "turn about the axis through the pivot: an expression in t, or a table with rows [t, angle]",
                .unit = "rad"});
    v.optional("pivot", motion.pivot,
               {.meaning = "a point of the axis, at the object's place at the start", .unit = "m"});
    v.unless_default("axis", motion.axis, {.meaning = "of the turn, of any length; 2D: always z", .unit = "1"},
                     MotionDesc{}.axis);
    if (is_zero(motion.axis)) v.refuse("axis", "must not be zero", "give a direction, of any length");
}

void describe(Visitor& v, ObjectDesc& object) {
    v.required("name", object.name, {.meaning = "name of the collision object", .text = Text::name});
    v.optional("role", object.role, {.meaning = "a container keeps the fluid inside, an obstacle keeps it out"});
    v.required("shape", object.shape, {.meaning = "its surface", .choices = kPrimitiveShapes});
    if (object.shape.index() >= kPrimitiveShapes)
        v.refuse("shape", "must be a box, a sphere, a cylinder or a plane",
                 "give each part an object of its own; differences and intersections are for fluids");
    v.optional("slip", object.slip,
               {.meaning = "does the fluid slip along it or stick to it; absent: the model's parameter wall_slip"});
    v.optional("motion", object.motion, {.meaning = "prescribed motion relative to its place at the start"});
    v.optional("surface_velocity", object.surface_velocity,
               {.meaning = "expressions in t: the surface slides in itself, as a belt does", .unit = "m/s"});
}

void describe(Visitor& v, DomainDesc& domain) {
    describe_corners(v, domain.min, domain.max);
    v.unless_default("periodic", domain.periodic, {.meaning = "per axis: what leaves at max enters at min"});
}

void describe(Visitor& v, AtRestDesc& at_rest) {
    v.optional("speed_factor", at_rest.speed_factor,
               {.meaning = "a particle is slow below this times sqrt(|g| H), H the fluid's height along gravity",
                .unit = "1",
                .range = kPositive});
    v.optional("share", at_rest.share,
               {.meaning = "share of particles that must be slow", .unit = "1", .range = {0.0, 1.0, true}});
    v.optional("duration", at_rest.duration,
               {.meaning = "simulated time for which it must hold", .unit = "s", .range = kNotNegative});
    v.optional("timeout", at_rest.timeout,
               {.meaning = "simulated time after which waiting gives up", .unit = "s", .range = kPositive});
}

void describe(Visitor& v, RemoveObjectAction& action) {
    v.required("name", action.name, {.meaning = "object to remove", .text = Text::name});
}

void describe(Visitor& v, MoveObjectAction& action) {
    v.required("name", action.name, {.meaning = "object to move", .text = Text::name});
    v.required("to", action.to, {.meaning = "new centre of the shape's bounding box", .unit = "m"});
}

void describe(Visitor& v, SetParametersAction& action) {
    v.required("parameters", action.parameters,
               {.meaning = "model parameters to set", .min_items = 1, .max_items = kMaxParameters});
}

void describe(Visitor&, PauseAction&) {}

void describe(Visitor& v, SceneEventDesc& event) {
    std::optional<bool> at_rest = event.at_rest ? std::optional(true) : std::nullopt;
    v.optional("at_rest", at_rest, {.meaning = "fires when the fluid comes to rest", .only_true = true});
    event.at_rest = at_rest.value_or(false);
    v.optional("time", event.time, {.meaning = "fires at this simulated time", .unit = "s", .range = kNotNegative});
    v.optional("step", event.step, {.meaning = "fires before this step", .unit = "1", .range = kNotNegative});
    v.optional("probe", event.probe, {.meaning = "fires at the first sample for which it holds"});
    v.required("action", event.action, {.meaning = "what happens"});
    v.exactly_one({{"at_rest", event.at_rest},
                   {"time", event.time.has_value()},
                   {"step", event.step.has_value()},
                   {"probe", event.probe.has_value()}});
}

void describe(Visitor& v, OutputDesc& output) {
    v.optional("interval", output.interval,
               {.meaning = "simulated time between frames of a recording", .unit = "s", .range = kPositive});
    v.optional("fields", output.fields, {.meaning = "particle fields of a recording", .min_items = 1});
}

void describe(Visitor& v, SceneDesc& scene) {
    int version = kSceneVersion;
    v.tolerate_text("$schema");
    v.required("headrace_scene", version,
               {.meaning = "version of the scene document", .range = between(kSceneVersion, kSceneVersion)});
    v.required("name", scene.name, {.meaning = "name of the scene", .text = Text::name});
    v.optional("description", scene.description,
               {.meaning = "what the scene shows and where it is from", .max_length = 4096});
    v.optional("dimensions", scene.dimensions, {.meaning = "2 or 3", .range = between(2, 3)});
    v.dimensions = scene.dimensions;
    v.optional("model", scene.model, {.meaning = "simulation model", .text = Text::name});
    v.optional("parameters", scene.parameters,
               {.meaning = "overrides of the model's defaults", .max_items = kMaxParameters});
    v.required("spacing", scene.spacing,
               {.meaning = "initial spacing of the particles", .unit = "m", .range = kPositive});
    v.required("domain", scene.domain, {.meaning = "a particle outside faults the run"});
    v.unless_default("body_force", scene.body_force,
                     {.meaning = "acceleration of the fluid beside gravity, a parameter of the model: numbers, or "
                                 "expressions in x, y, z, t",
                      .unit = "m/s^2"});
    v.optional("frame_acceleration", scene.frame_acceleration,
               {.meaning = "acceleration of the frame the scene is told in (a shaken tank): expressions in t, or a "
                           "table with rows [t, x, y, z] (2D: [t, x, y])",
                .unit = "m/s^2"});
    v.required("fluids", scene.fluids,
               {.meaning = "volumes of fluid at the start", .min_items = 1, .max_items = kMaxSceneItems});
    v.optional("objects", scene.objects,
               {.meaning = "collision objects, tested in this order", .max_items = kMaxSceneItems});
    v.optional("probes", scene.probes, {.meaning = "what is measured", .max_items = kMaxSceneItems});
    v.optional("events", scene.events, {.meaning = "what happens by itself", .max_items = kMaxSceneItems});
    v.optional("at_rest", scene.at_rest, {.meaning = "when the fluid counts as being at rest"});
    v.optional("output", scene.output, {.meaning = "what recordings hold unless they say otherwise"});
    v.dimensions = 0;
    refuse_double_names(v, scene.fluids, "fluids");
    refuse_double_names(v, scene.objects, "objects");
    refuse_double_names(v, scene.probes, "probes");
}

}  // namespace headrace::proto
