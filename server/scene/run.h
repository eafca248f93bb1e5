// A built scene: particles, objects, model and clock, without any thread. What the simulation thread steps, and what
// tests and benchmarks use directly.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "server/scene/build_control.h"
#include "server/scene/sampling.h"
#include "server/solver/diagnostics.h"
#include "server/solver/model.h"

namespace headrace::scene {

inline constexpr std::size_t kMostObjects = 1'000;

class Run {
  public:
    // Validates the scene's meaning (values, overlaps with the model's table, counts) and builds it: samples the
    // fluids or reads them from files below `data_folder`, makes the model, computes the first densities and forces.
    // Errors: scene_invalid, parameter_not_found with the JSON path below "scene"; cancelled.
    static proto::Result<std::unique_ptr<Run>> build(const proto::SceneDesc& scene, BuildControl* control = nullptr,
                                                     const std::filesystem::path& data_folder = {});

    // One step of the model. Precondition: no fault so far.
    const solver::StepReport& step();

    const proto::SceneDesc& scene() const { return scene_; }  // as loaded
    const solver::Particles& particles() const { return particles_; }
    const solver::Model& model() const { return *model_; }
    const solver::StepReport& last_report() const { return report_; }
    std::uint64_t step_number() const { return step_number_; }
    double time() const { return time_; }                  // [s]
    double fluid_height() const { return fluid_height_; }  // [m] extent of the fluid along gravity at load

    std::vector<solver::Stage> plan() const;
    solver::Diagnostics diagnostics() const;

    // What the next step sees besides the particles; valid until the next step or mutation.
    solver::Surroundings surroundings() const {
        return {objects_, domain_, time_, body_force_ ? &*body_force_ : nullptr, objects_version_};
    }
    // Probes of energies: costs time only while on.
    void follow_energies(bool on) { model_->follow_energies(on); }

    // Mutations between steps. Errors carry the path below "params".
    proto::Status set_parameters(const proto::Parameters& values, proto::Parameters* previous = nullptr);
    const std::vector<proto::ObjectDesc>& objects() const { return object_descs_; }
    proto::Status add_object(const proto::ObjectDesc& object);
    proto::Status move_object(const std::string& name, const std::optional<proto::Vec3>& to,
                              const std::optional<proto::Vec3>& by);
    proto::Status remove_object(const std::string& name);

  private:
    Run() = default;
    proto::Result<std::size_t> find_object(const std::string& name) const;
    proto::Result<solver::CollisionObject> make_object(const proto::ObjectDesc& object, const std::string& path) const;
    proto::Status check_objects(const solver::CollisionObject& object, std::size_t replaced,
                                const std::string& path) const;
    proto::Status check_parameters(const proto::Parameters& values) const;

    proto::SceneDesc scene_;
    solver::Particles particles_;
    std::vector<proto::ObjectDesc> object_descs_;   // as they are now
    std::vector<solver::CollisionObject> objects_;  // the same, for the solver
    std::uint64_t objects_version_{0};              // counts their changes
    solver::Domain domain_;
    std::optional<solver::BodyForce> body_force_;
    std::unique_ptr<solver::Model> model_;
    solver::StepReport report_;
    std::uint64_t step_number_{0};
    double time_{0.0};
    double fluid_height_{0.0};
};

}  // namespace headrace::scene
