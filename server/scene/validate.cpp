#include "server/scene/validate.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "proto/suggest.h"
#include "server/scene/sampling.h"
#include "server/scene/shapes.h"
#include "server/solver/models/registry.h"

namespace headrace::scene {

namespace {

using proto::Done;
using proto::Error;
using proto::ErrorCode;
using proto::Status;

Error invalid(std::string path, std::string message, std::string hint) {
    return {ErrorCode::scene_invalid, std::move(message), std::move(path), std::move(hint)};
}

std::string indexed(const char* list, std::size_t index) {
    return std::string("scene.") + list + "[" + std::to_string(index) + "]";
}

Status validate_shape(const proto::ShapeDesc& shape, int dimensions, const std::string& path) {
    if (const auto* box = std::get_if<proto::BoxDesc>(&shape)) {
        for (int k = 0; k < dimensions; ++k) {
            if (!std::isfinite(box->min[k]) || !std::isfinite(box->max[k]))
                return invalid(path + ".box", "corners must be finite", "give lengths in m");
            if (!(box->min[k] < box->max[k]))
                return invalid(path + ".box.max[" + std::to_string(k) + "]", "must be greater than min on each axis",
                               "swap the corners, or give the box an extent");
        }
        return Done{};
    }
    const auto& sphere = std::get<proto::SphereDesc>(shape);
    for (int k = 0; k < dimensions; ++k)
        if (!std::isfinite(sphere.center[k]))
            return invalid(path + ".sphere.center", "must be finite", "give lengths in m");
    if (!(std::isfinite(sphere.radius) && sphere.radius > 0.0))
        return invalid(path + ".sphere.radius", "must be greater than 0 m", "give a radius in m");
    return Done{};
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
        if (Status status = validate_shape(fluid.shape, scene.dimensions, path + ".shape"); !status) return status;
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

// A start inside an obstacle or outside a container would be a violent projection at the first step.
Status validate_start(const proto::SceneDesc& scene, BuildControl& control) {
    const proto::ShapeDesc domain = proto::BoxDesc{scene.domain.min, scene.domain.max};
    const double slack = 1e-9 * scene.spacing;  // rounding in the document
    for (std::size_t k = 0; k < scene.fluids.size(); ++k) {
        Status outcome = Done{};
        const std::string path = indexed("fluids", k) + ".shape";
        const std::int64_t cells = lattice_size(scene.fluids[k].shape, scene.dimensions, scene.spacing);
        std::int64_t points = 0;
        for_each_lattice_point(scene.fluids[k].shape, scene.dimensions, scene.spacing, [&](const proto::Vec3& x) {
            ++points;
            if (points % 65'536 == 0) control.progress = 0.4 * static_cast<double>(points) / static_cast<double>(cells);
            if (!contains(domain, x, scene.dimensions))
                outcome = invalid(path, "reaches out of the domain", "enlarge scene.domain");
            for (const proto::ObjectDesc& object : scene.objects) {
                const bool is_container = object.role == proto::ObjectRole::container;
                if (contains(object.shape, x, scene.dimensions, is_container ? slack : -slack) == is_container)
                    continue;
                outcome = is_container ? invalid(path, "reaches out of container \"" + object.name + "\"",
                                                 "shrink the fluid or enlarge the container")
                                       : invalid(path, "overlaps obstacle \"" + object.name + "\"",
                                                 "shrink the fluid or move the obstacle");
            }
            return outcome.ok() && !control.cancelled;
        });
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

proto::Status validate_object(const proto::ObjectDesc& object, int dimensions, const std::string& path) {
    if (object.name.empty()) return invalid(path + ".name", "is empty", "name the object");
    return validate_shape(object.shape, dimensions, path + ".shape");
}

proto::Error cancelled_error() {
    return {ErrorCode::cancelled, "loading was cancelled", "", "load it again"};
}

proto::Status validate(const proto::SceneDesc& scene, BuildControl& control) {
    for (const auto& check : {validate_basics, validate_parameters, validate_objects, validate_fluids})
        if (Status status = check(scene); !status) return status;
    return validate_start(scene, control);
}

}  // namespace headrace::scene
