#include "server/scene/run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "proto/suggest.h"
#include "proto/values/expressions.h"
#include "server/scene/body_force.h"
#include "server/scene/collision_objects.h"
#include "server/scene/particle_file.h"
#include "server/scene/shapes.h"
#include "server/scene/starts.h"
#include "server/scene/validate.h"
#include "server/solver/faults.h"
#include "server/solver/models/registry.h"

namespace headrace::scene {

namespace {

using proto::Done;
using proto::Error;
using proto::ErrorCode;
using proto::Result;
using proto::Status;

constexpr const char* kOtherModelHint = "leave it out, or choose another model: scene.model";

// A command's object was refused, not a scene's.
Error as_params_error(Error error) {
    if (error.code == ErrorCode::scene_invalid) error.code = ErrorCode::invalid_params;
    return error;
}

// Why the run cannot begin: a particle at fault, or speeds and forces that leave no time step.
Status check_beginning(const solver::StepReport& report, const solver::Model& model, int dimensions) {
    if (report.fault) {
        const solver::Fault& fault = *report.fault;
        return Error{ErrorCode::scene_invalid,
                     std::string("at the start ") + solver::name_of(fault.kind) + " of particle " +
                         std::to_string(fault.particle) + " at " + place_text(fault.x, dimensions),
                     "scene", fault.remedy};
    }
    if (model.time_step() > 0.0 && std::isfinite(model.time_step())) return Done{};
    return Error{ErrorCode::scene_invalid, "the first time step is " + std::to_string(model.time_step()) + " s",
                 "scene", "look for speeds, accelerations, motions or parameters of absurd size"};
}

// Extent of the particles against gravity, one spacing for the particles' own size included; without gravity the
// largest extent.
double height_of(const solver::Particles& particles, const solver::Vec3& gravity, double spacing) {
    const double g = std::hypot(gravity[0], gravity[1], gravity[2]);
    double height = 0.0;
    for (int axis = 0; axis < particles.dimensions; ++axis) {
        const auto [low, high] = std::minmax_element(particles.x[axis].begin(), particles.x[axis].end());
        const double extent = *high - *low + spacing;
        if (g == 0.0)
            height = std::max(height, extent);
        else
            height += extent * std::abs(gravity[axis]) / g;
    }
    return height;
}

}  // namespace

// An object as the model takes it. Errors: scene_invalid below `path`.
Result<solver::CollisionObject> Run::make_object(const proto::ObjectDesc& object, const std::string& path) const {
    auto collision = make_collision_object(object, scene_.dimensions, scene_.spacing, path);
    if (!collision) return collision;
    if (const auto refusal = model_->refuse_object(*collision))
        return Error{ErrorCode::scene_invalid, *refusal, path, kOtherModelHint};
    if (Status status = check_turn(object, *collision, domain_, scene_.dimensions, path); !status)
        return status.error();
    return collision;
}

// Together, not one by one: what they need adds up. The object at `replaced` is another one now, or a new one.
Status Run::check_objects(const solver::CollisionObject& object, std::size_t replaced, const std::string& path) const {
    std::vector<solver::CollisionObject> objects = objects_;
    objects.resize(std::max(objects.size(), replaced + 1));
    objects[replaced] = object;
    const auto refusal = model_->refuse_objects(objects, domain_, time_);
    if (!refusal) return Done{};
    return Error{ErrorCode::limit_exceeded, *refusal, path,
                 "make the object smaller: one that moves counts as a whole"};
}

Result<std::unique_ptr<Run>> Run::build(const proto::SceneDesc& scene, BuildControl* control,
                                        const std::filesystem::path& data_folder) {
    BuildControl nobody;
    BuildControl& watched = control != nullptr ? *control : nobody;
    auto files = read_fluid_files(scene, data_folder);
    if (!files) return files.error();
    if (Status status = validate(scene, watched, *files); !status) return status.error();

    std::unique_ptr<Run> run(new Run);
    run->scene_ = scene;
    run->domain_ = {scene.domain.min, scene.domain.max, scene.domain.periodic};
    run->model_ = solver::make_model(scene.model, scene.dimensions, scene.spacing, scene.parameters);
    if (const auto refusal = run->model_->refuse_domain(run->domain_))
        return Error{ErrorCode::scene_invalid, *refusal, "scene.domain",
                     "change scene.domain, or choose another model: scene.model"};
    run->object_descs_ = scene.objects;
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
        auto object = run->make_object(scene.objects[k], "scene.objects[" + std::to_string(k) + "]");
        if (!object) return object.error();
        run->objects_.push_back(std::move(*object));
    }
    auto body_force = make_body_force(scene);
    if (!body_force) return body_force.error();
    run->body_force_ = std::move(*body_force);
    if (const auto refusal = run->model_->refuse_body_force(); refusal && run->body_force_)
        return Error{ErrorCode::scene_invalid, *refusal,
                     scene.frame_acceleration ? "scene.frame_acceleration" : "scene.body_force", kOtherModelHint};

    Result<solver::Particles> particles = place_fluids(scene, watched, *files);
    if (!particles) return particles.error();
    run->particles_ = std::move(*particles);
    run->fluid_height_ = height_of(run->particles_, run->model_->gravity(), scene.spacing);
    if (Status status = set_start(scene, *run->model_, run->surroundings(), run->particles_, *files); !status)
        return status.error();
    if (run->body_force_)
        if (Status status = check_body_force(scene, *run->body_force_, run->particles_); !status) return status.error();
    run->report_ = run->model_->initialise(run->particles_, run->surroundings());
    if (Status status = check_beginning(run->report_, *run->model_, scene.dimensions); !status) return status.error();
    if (watched.cancelled) return cancelled_error();
    watched.progress = 1.0;
    return run;
}

const solver::StepReport& Run::step() {
    report_ = model_->step(particles_, surroundings());
    ++step_number_;
    time_ += report_.dt;
    return report_;
}

std::vector<solver::Stage> Run::plan() const {
    return model_->plan(surroundings());
}

solver::Diagnostics Run::diagnostics() const {
    return solver::compute_diagnostics(particles_, model_->gravity());
}

// Why the model would not have taken the scene with these values: a support too wide for its periods and walls.
Status Run::check_parameters(const proto::Parameters& values) const {
    solver::ParameterMap all = model_->parameters();
    if (solver::check_parameters(model_->parameter_table(), values)) return Done{};  // the model says it better
    for (const auto& [name, value] : values) all.insert_or_assign(name, value);
    const auto candidate = solver::make_model(scene_.model, scene_.dimensions, scene_.spacing, all);
    if (candidate->support_radius() == model_->support_radius()) return Done{};
    auto refusal = candidate->refuse_domain(domain_);
    if (!refusal) refusal = candidate->refuse_objects(objects_, domain_, time_);
    if (!refusal) return Done{};
    return Error{ErrorCode::invalid_params, *refusal, "params.parameters", "choose a smaller support"};
}

Status Run::set_parameters(const proto::Parameters& values, proto::Parameters* previous) {
    if (Status status = check_parameters(values); !status) return status;
    const solver::ParameterMap before = model_->parameters();
    if (const auto refusal = model_->set_parameters(values))
        return parameter_error(*refusal, model_->parameter_table(), "params.parameters");
    if (previous != nullptr)
        for (const auto& [name, value] : values) previous->insert_or_assign(name, before.at(name));
    return Done{};
}

Result<std::size_t> Run::find_object(const std::string& name) const {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < object_descs_.size(); ++k) {
        if (object_descs_[k].name == name) return k;
        names.push_back(object_descs_[k].name);
    }
    return Error{ErrorCode::object_not_found, "no object \"" + name + "\"", "params.name",
                 names.empty() ? "the scene has no objects" : proto::suggest(name, names)};
}

Status Run::add_object(const proto::ObjectDesc& object) {
    if (Status status = validate_object(object, scene_.dimensions, "params.object"); !status)
        return as_params_error(status.error());
    if (find_object(object.name))
        return Error{ErrorCode::object_exists, "there is an object \"" + object.name + "\" already",
                     "params.object.name", "choose another name, or objects.remove it first"};
    if (object_descs_.size() >= kMostObjects)
        return Error{ErrorCode::limit_exceeded, "there are " + std::to_string(kMostObjects) + " objects already",
                     "params.object", "objects.remove some first"};
    auto collision = make_object(object, "params.object");
    if (!collision) return as_params_error(collision.error());
    if (Status status = check_objects(*collision, objects_.size(), "params.object"); !status) return status;
    object_descs_.push_back(object);
    objects_.push_back(std::move(*collision));
    ++objects_version_;
    return Done{};
}

Status Run::move_object(const std::string& name, const std::optional<proto::Vec3>& to,
                        const std::optional<proto::Vec3>& by) {
    const Result<std::size_t> found = find_object(name);
    if (!found) return found.error();
    proto::ObjectDesc& object = object_descs_[*found];
    proto::Vec3 displacement = by.value_or(proto::Vec3{});
    if (to) {
        const proto::Vec3 center = center_of(object.shape);
        for (int k = 0; k < scene_.dimensions; ++k) displacement[k] = (*to)[k] - center[k];
    }
    proto::ObjectDesc moved = moved_by(object, displacement);
    if (Status status = validate_object(moved, scene_.dimensions, "params"); !status)
        return Error{ErrorCode::invalid_params, "the object would leave the range of numbers",
                     to ? "params.to" : "params.by", "move it by less"};
    auto collision = make_object(moved, "params");
    if (!collision) return as_params_error(collision.error());
    if (Status status = check_objects(*collision, *found, to ? "params.to" : "params.by"); !status) return status;
    object = std::move(moved);
    objects_[*found] = std::move(*collision);
    ++objects_version_;
    return Done{};
}

Status Run::remove_object(const std::string& name) {
    const Result<std::size_t> found = find_object(name);
    if (!found) return found.error();
    object_descs_.erase(object_descs_.begin() + static_cast<std::ptrdiff_t>(*found));
    objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(*found));
    ++objects_version_;
    return Done{};
}

}  // namespace headrace::scene
