#include "server/scene/validate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>
#include <vector>

#include "proto/suggest.h"
#include "proto/values/expressions.h"
#include "server/scene/body_force.h"
#include "server/scene/collision_objects.h"
#include "server/scene/sampling.h"
#include "server/scene/shapes.h"
#include "server/solver/models/registry.h"

namespace headrace::scene {

namespace {

using proto::Done;
using proto::Error;
using proto::ErrorCode;
using proto::is_finite;
using proto::Status;

Error invalid(std::string path, std::string message, std::string hint) {
    return {ErrorCode::scene_invalid, std::move(message), std::move(path), std::move(hint)};
}

// Enough of them to be copied into a document.
std::string digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.10g", value);
    return text;
}

std::string indexed(const char* list, std::size_t index) {
    return std::string("scene.") + list + "[" + std::to_string(index) + "]";
}

Status validate_basics(const proto::SceneDesc& scene) {
    if (scene.dimensions != 2 && scene.dimensions != 3)
        return invalid("scene.dimensions", "must be 2 or 3", "choose 2 or 3");
    if (!(std::isfinite(scene.spacing) && scene.spacing > 0.0))
        return invalid("scene.spacing", "must be greater than 0 m", "give the particle spacing in m");
    for (int k = 0; k < scene.dimensions; ++k)
        if (!(std::isfinite(scene.domain.min[k]) && std::isfinite(scene.domain.max[k]) &&
              scene.domain.min[k] < scene.domain.max[k]))
            return invalid("scene.domain", "max must be greater than min on each axis, both finite",
                           "give a box that holds every container");
    if (scene.dimensions == 2 && scene.domain.periodic[2])
        return invalid("scene.domain.periodic[2]", "must be false in a scene of 2 dimensions",
                       "leave the third value out");
    const auto models = solver::model_names();
    if (std::find(models.begin(), models.end(), scene.model) == models.end())
        return invalid("scene.model", "no model \"" + scene.model + "\"", proto::suggest(scene.model, models));
    return Done{};
}

Status validate_parameters(const proto::SceneDesc& scene) {
    const auto table = solver::model_parameter_table(scene.model, scene.dimensions, scene.spacing);
    if (const auto refusal = solver::check_parameters(table, scene.parameters))
        return parameter_error(*refusal, table, "scene.parameters");
    for (std::size_t k = 0; k < scene.events.size(); ++k)
        if (const auto* action = std::get_if<proto::SetParametersAction>(&scene.events[k].action))
            if (const auto refusal = solver::check_parameters(table, action->parameters))
                return parameter_error(*refusal, table, indexed("events", k) + ".action.set_parameters");
    return Done{};
}

Status validate_objects(const proto::SceneDesc& scene) {
    std::set<std::string> names;
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
        if (Status status = validate_object(scene.objects[k], scene.dimensions, indexed("objects", k)); !status)
            return status;
        if (!names.insert(scene.objects[k].name).second)
            return invalid(indexed("objects", k) + ".name",
                           "there is an object \"" + scene.objects[k].name + "\" already",
                           "names of objects are unique");
    }
    for (std::size_t k = 0; k < scene.events.size(); ++k) {
        const std::string* name = nullptr;
        std::string member;
        if (const auto* remove = std::get_if<proto::RemoveObjectAction>(&scene.events[k].action)) {
            name = &remove->name;
            member = "remove_object";
        } else if (const auto* move = std::get_if<proto::MoveObjectAction>(&scene.events[k].action)) {
            name = &move->name;
            member = "move_object";
        }
        if (name != nullptr && !names.contains(*name))
            return invalid(indexed("events", k) + ".action." + member + ".name", "no object \"" + *name + "\"",
                           proto::suggest(*name, {names.begin(), names.end()}));
    }
    return Done{};
}

Status validate_fluid_start(const proto::FluidDesc& fluid, const std::string& path) {
    if (fluid.pressure && fluid.hydrostatic)
        return invalid(path + ".hydrostatic", "cannot be given together with pressure", "give one of the two");
    if (!(fluid.start.jitter >= 0.0 && fluid.start.jitter <= 0.5))
        return invalid(path + ".start.jitter", "must be at least 0 and at most 0.5 spacings",
                       "at 0.5 two particles may meet; 0.1 to 0.2 is usual");
    return Done{};
}

// A fluid from one end of a period to the other must go on beyond it as it does inside.
Status validate_period(const proto::SceneDesc& scene, const proto::FluidDesc& fluid, const std::string& path) {
    const proto::BoxDesc bounds = bounding_box(fluid.shape);
    for (int k = 0; k < scene.dimensions; ++k) {
        const double period = scene.domain.max[k] - scene.domain.min[k];
        const double slack = 1e-6 * scene.spacing;  // a thousandth of what would be felt
        const bool spans = bounds.min[k] <= scene.domain.min[k] + slack && bounds.max[k] >= scene.domain.max[k] - slack;
        if (!scene.domain.periodic[k] || !spans) continue;
        const double cells = period / scene.spacing, whole = std::max(1.0, std::round(cells));
        if (std::abs(cells - whole) <= 1e-6 * whole) continue;
        return invalid(path + ".shape",
                       "fills a period of " + digits(cells) + " spacings: the lattice would not go on evenly",
                       "make the domain a whole number of spacings along that axis, or scene.spacing " +
                           digits(period / whole) + " m");
    }
    return Done{};
}

// Shapes and counts; cheap, so that a scene of absurd size is refused before a particle is made.
Status validate_fluids(const proto::SceneDesc& scene) {
    if (scene.fluids.empty()) return invalid("scene.fluids", "there is no fluid", "give at least one fluid");
    std::set<std::string> names;
    std::int64_t count = 0;
    for (std::size_t k = 0; k < scene.fluids.size(); ++k) {
        const proto::FluidDesc& fluid = scene.fluids[k];
        const std::string path = indexed("fluids", k);
        if (!names.insert(fluid.name).second)
            return invalid(path + ".name", "there is a fluid \"" + fluid.name + "\" already", "names are unique");
        if (Status status = validate_fluid_start(fluid, path); !status) return status;
        if (fluid.particles) continue;
        if (Status status = validate_shape(fluid.shape, scene.dimensions, path + ".shape"); !status) return status;
        if (!is_finite(bounding_box(fluid.shape), scene.dimensions))
            return invalid(path + ".shape", "has no end", "intersect the plane with a shape that has one");
        if (Status status = validate_period(scene, fluid, path); !status) return status;
        const std::int64_t cells = lattice_size(fluid.shape, scene.dimensions, scene.spacing);
        if (cells == 0)
            return invalid(path + ".shape", "is thinner than half a spacing, it holds no particle",
                           "enlarge it or reduce scene.spacing");
        if (cells > kMostParticles || (count += cells) > kMostParticles)
            return Error{ErrorCode::limit_exceeded,
                         "the fluids give more than " + std::to_string(kMostParticles) + " particles", "scene.spacing",
                         "enlarge scene.spacing or shrink the fluids"};
    }
    return Done{};
}

// What expressions and tables say; a start outside of the fluid's own place is no matter here.
Status validate_formulas(const proto::SceneDesc& scene) {
    const Symbols symbols{.dimensions = scene.dimensions, .spacing = scene.spacing, .position = true};
    for (std::size_t k = 0; k < scene.fluids.size(); ++k) {
        const std::string path = indexed("fluids", k);
        const auto velocity = compile_vector(scene.fluids[k].velocity, symbols, path + ".velocity");
        if (!velocity) return velocity.error();
        if (!scene.fluids[k].pressure) continue;
        const auto pressure = Formula::compile(*scene.fluids[k].pressure, symbols, path + ".pressure");
        if (!pressure) return pressure.error();
    }
    if (const auto force = make_body_force(scene); !force) return force.error();
    return Done{};
}

struct Misplaced {
    std::string message;
    std::string hint;  // what to do besides changing the fluid; begins with a verb
};

// Why the fluid cannot start with a particle at x; nothing: it can. `slack` [m]: how far x may be off.
std::optional<Misplaced> check_place(const proto::SceneDesc& scene,
                                     const std::vector<std::optional<solver::RigidState>>& states, const proto::Vec3& x,
                                     double slack) {
    for (std::size_t k = 0; k < states.size(); ++k) {
        const proto::ObjectDesc& object = scene.objects[k];
        if (may_hold_fluid(object, states[k], x, scene.dimensions, slack)) continue;
        if (std::holds_alternative<proto::PlaneDesc>(object.shape))
            return Misplaced{"reaches behind plane \"" + object.name + "\"",
                             "move the plane; its normal points towards the fluid"};
        if (object.role == proto::ObjectRole::container)
            return Misplaced{"reaches out of container \"" + object.name + "\"", "enlarge the container"};
        return Misplaced{"overlaps obstacle \"" + object.name + "\"", "move the obstacle"};
    }
    if (!contains(proto::BoxDesc{scene.domain.min, scene.domain.max}, x, scene.dimensions))
        return Misplaced{"reaches out of the domain", "enlarge scene.domain"};
    return std::nullopt;
}

// A start inside an obstacle or outside a container would be a violent projection at the first step.
Status validate_start(const proto::SceneDesc& scene, BuildControl& control, const FluidFiles& files) {
    std::vector<std::optional<solver::RigidState>> states(scene.objects.size());  // of the moving objects
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
        auto object = make_collision_object(scene.objects[k], scene.dimensions, scene.spacing, indexed("objects", k));
        if (!object) return object.error();
        if (object->motion) states[k] = object->motion(0.0);
    }
    for (std::size_t k = 0; k < scene.fluids.size(); ++k) {
        Status outcome = Done{};
        const auto file = files.find(k);
        const bool is_file = file != files.end();
        const std::string path = indexed("fluids", k) + (is_file ? ".particles" : ".shape");
        const std::int64_t cells = is_file ? static_cast<std::int64_t>(file->second.x.size())
                                           : lattice_size(scene.fluids[k].shape, scene.dimensions, scene.spacing);
        std::int64_t points = 0;
        const auto check = [&](const proto::Vec3& x) {
            ++points;
            if (points % 65'536 == 0) control.progress = 0.4 * static_cast<double>(points) / static_cast<double>(cells);
            const double slack = 1e-9 * scene.spacing + (is_file ? rounding_at(x, scene.dimensions) : 0.0);
            if (const auto wrong = check_place(scene, states, x, slack)) {
                const std::string particle =
                    "particle " + std::to_string(points - 1) + " at " + place_text(x, scene.dimensions);
                outcome = is_file ? invalid(path, wrong->message + " with " + particle,
                                            "leave the particle out of the file, or " + wrong->hint)
                                  : invalid(path, wrong->message, "shrink the fluid, or " + wrong->hint);
            }
            return outcome.ok() && !control.cancelled;
        };
        if (is_file)
            std::all_of(file->second.x.begin(), file->second.x.end(), check);
        else
            for_each_lattice_point(scene.fluids[k].shape, scene.dimensions, scene.spacing, check);
        if (control.cancelled) return cancelled_error();
        if (!outcome) return outcome;
        if (points == 0) return invalid(path, "holds no particle", "enlarge it or reduce scene.spacing");
    }
    return Done{};
}

}  // namespace

proto::Error parameter_error(const solver::ParameterError& refusal, const std::vector<solver::ParameterInfo>& table,
                             const std::string& path) {
    if (!refusal.unknown)
        return {path.starts_with("scene") ? ErrorCode::scene_invalid : ErrorCode::invalid_params, refusal.message,
                path + "." + refusal.name, refusal.hint};
    std::vector<std::string> names;
    for (const solver::ParameterInfo& info : table) names.push_back(info.name);
    return {ErrorCode::parameter_not_found, "no parameter \"" + refusal.name + "\"", path + "." + refusal.name,
            proto::suggest(refusal.name, names)};
}

proto::Error cancelled_error() {
    return {ErrorCode::cancelled, "loading was cancelled", "", "load it again"};
}

proto::Status validate(const proto::SceneDesc& scene, BuildControl& control, const FluidFiles& files) {
    for (const auto& check :
         {validate_basics, validate_parameters, validate_objects, validate_fluids, validate_formulas})
        if (Status status = check(scene); !status) return status;
    return validate_start(scene, control, files);
}

}  // namespace headrace::scene
