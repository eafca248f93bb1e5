#include "server/scene/body_force.h"

#include <cmath>

#include "proto/values/curves.h"
#include "proto/values/expressions.h"
#include "server/solver/parallel.h"

namespace headrace::scene {

using proto::Done;
using proto::Error;
using proto::ErrorCode;
using proto::Result;

namespace {

// Owner: the simulation thread, which calls it once a step.
class Field {
  public:
    Field(int dimensions, std::array<Formula, 3> force, std::array<Curve, 3> frame)
        : dimensions_(dimensions),
          force_{FormulaTeam(std::move(force[0])), FormulaTeam(std::move(force[1])), FormulaTeam(std::move(force[2]))},
          frame_(std::move(frame)) {}

    bool is_zero() const {
        for (int k = 0; k < dimensions_; ++k)
            if (!force_[k].formula().is_zero() || !frame_[k].is_zero()) return false;
        return true;
    }

    void add(double t, const solver::Particles& particles, solver::VectorField& a) {
        for (int axis = 0; axis < dimensions_; ++axis) {
            FormulaTeam& force = force_[axis];
            const bool varies = force.formula().uses_position();
            const double uniform = (varies ? 0.0 : force.formula()({}, t)) - frame_[axis].value(t);
            if (varies) force.prepare(solver::max_threads());
            if (!varies && uniform == 0.0) continue;
            solver::parallel_for(particles.size(), solver::kParticleBlock,
                                 [&](std::size_t begin, std::size_t end, int thread) {
                                     for (std::size_t i = begin; i < end; ++i)
                                         a[axis][i] += uniform + (varies ? force(thread, place(particles, i), t) : 0.0);
                                 });
        }
    }

  private:
    solver::Vec3 place(const solver::Particles& particles, std::size_t i) const {
        return {particles.x[0][i], particles.x[1][i], dimensions_ == 3 ? particles.x[2][i] : 0.0};
    }

    int dimensions_;
    std::array<FormulaTeam, 3> force_;  // [m/s^2]
    std::array<Curve, 3> frame_;        // [m/s^2]
};

}  // namespace

Result<std::optional<solver::BodyForce>> make_body_force(const proto::SceneDesc& scene) {
    const Symbols symbols{.dimensions = scene.dimensions, .spacing = scene.spacing, .position = true, .time = true};
    auto force = compile_vector(scene.body_force, symbols, "scene.body_force");
    if (!force) return force.error();
    std::array<Curve, 3> frame;
    if (scene.frame_acceleration) {
        auto curves =
            make_curves(*scene.frame_acceleration, scene.dimensions, scene.spacing, "scene.frame_acceleration");
        if (!curves) return curves.error();
        frame = std::move(*curves);
        const bool is_table = std::holds_alternative<proto::TableDesc>(*scene.frame_acceleration);
        for (int k = 0; k < scene.dimensions; ++k)
            if (!std::isfinite(frame[k].value(0.0)))
                return Error{ErrorCode::scene_invalid, "is " + std::to_string(frame[k].value(0.0)) + " at t = 0",
                             "scene.frame_acceleration" + (is_table ? "" : "[" + std::to_string(k) + "]"),
                             "look for a division by zero or a root of a negative number"};
    }
    const auto field = std::make_shared<Field>(scene.dimensions, std::move(*force), std::move(frame));
    if (field->is_zero()) return std::optional<solver::BodyForce>{};
    return std::optional<solver::BodyForce>(
        [field](double t, const solver::Particles& particles, solver::VectorField& a) { field->add(t, particles, a); });
}

proto::Status check_body_force(const proto::SceneDesc& scene, const solver::BodyForce& force,
                               const solver::Particles& particles) {
    solver::VectorField a;
    for (int axis = 0; axis < scene.dimensions; ++axis) a[axis].assign(particles.size(), 0.0);
    force(0.0, particles, a);
    for (int axis = 0; axis < scene.dimensions; ++axis)
        for (std::size_t i = 0; i < particles.size(); ++i) {
            if (std::isfinite(a[axis][i])) continue;
            const solver::Vec3 x{particles.x[0][i], particles.x[1][i], scene.dimensions == 3 ? particles.x[2][i] : 0.0};
            return Error{ErrorCode::scene_invalid, "is " + value_at_text(a[axis][i], x, scene.dimensions) + ", t = 0",
                         "scene.body_force[" + std::to_string(axis) + "]", "it must be finite wherever there is fluid"};
        }
    return Done{};
}

}  // namespace headrace::scene
