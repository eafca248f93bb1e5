// Fluids made by hand and a model that only answers, for the tests of probes.
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "server/probes/probe.h"

namespace headrace::test {

using solver::Vec3;

inline constexpr double kRestDensity = 1000.0;  // [kg/m^3]

class StillModel final : public solver::Model {
  public:
    explicit StillModel(double support) : support_(support) {}

    std::string_view name() const override { return "still"; }
    solver::StepReport initialise(solver::Particles&, const solver::Surroundings&) override { return {}; }
    solver::StepReport step(solver::Particles&, const solver::Surroundings&) override { return {}; }
    double time_step() const override { return 1e-3; }
    std::string_view time_step_limit() const override { return "fixed"; }
    double particle_mass() const override { return 1.0; }
    double rest_density() const override { return kRestDensity; }
    double support_radius() const override { return support_; }
    Vec3 gravity() const override { return {}; }
    const std::vector<solver::ParameterInfo>& parameter_table() const override { return table_; }
    solver::ParameterMap parameters() const override { return {}; }
    std::optional<solver::ParameterError> set_parameters(const solver::ParameterMap&) override { return {}; }
    std::string strategy() const override { return "none"; }
    std::vector<solver::Stage> plan(const solver::Surroundings&) const override { return {}; }
    std::optional<std::string> refuse_object(const solver::CollisionObject&) const override { return {}; }
    std::optional<std::string> refuse_domain(const solver::Domain&) const override { return {}; }
    std::vector<solver::ObjectLoad> object_loads(const solver::Particles&, const solver::Surroundings&) const override {
        return loads;
    }

    std::vector<solver::ObjectLoad> loads;

  private:
    double support_;
    std::vector<solver::ParameterInfo> table_;
};

// Particles of a lattice of spacing dx where `inside` holds, each displaced by at most jitter * dx along each axis.
inline solver::Particles make_fluid(int dimensions, double dx, const Vec3& min, const Vec3& max,
                                    const std::function<bool(const Vec3&)>& inside, double jitter = 0.0,
                                    unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-jitter * dx, jitter * dx);
    std::vector<Vec3> points;
    const auto count = [&](int k) { return k < dimensions ? static_cast<int>((max[k] - min[k]) / dx + 0.5) : 1; };
    for (int i = 0; i < count(0); ++i)
        for (int j = 0; j < count(1); ++j)
            for (int k = 0; k < count(2); ++k) {
                Vec3 x{min[0] + (i + 0.5) * dx, min[1] + (j + 0.5) * dx,
                       dimensions == 3 ? min[2] + (k + 0.5) * dx : 0.0};
                if (!inside(x)) continue;
                for (int axis = 0; axis < dimensions; ++axis) x[axis] += shift(random);
                points.push_back(x);
            }
    solver::Particles particles;
    particles.dimensions = dimensions;
    particles.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        particles.id[i] = static_cast<solver::Index>(i);
        for (int axis = 0; axis < dimensions; ++axis) particles.x[axis][i] = points[i][axis];
        particles.rho[i] = kRestDensity;
        particles.m[i] = kRestDensity * std::pow(dx, dimensions);
    }
    return particles;
}

inline solver::Particles make_box(int dimensions, double dx, const Vec3& min, const Vec3& max, double jitter = 0.0,
                                  unsigned seed = 1) {
    return make_fluid(
        dimensions, dx, min, max, [](const Vec3&) { return true; }, jitter, seed);
}

inline Vec3 position(const solver::Particles& particles, std::size_t i) {
    return {particles.x[0][i], particles.x[1][i], particles.dimensions == 3 ? particles.x[2][i] : 0.0};
}

// A field of the particles from a formula.
inline void set_field(const solver::Particles& particles, std::vector<double>& field,
                      const std::function<double(const Vec3&)>& value) {
    for (std::size_t i = 0; i < particles.size(); ++i) field[i] = value(position(particles, i));
}

// A probe's values for a fluid; `objects` and `domain` as given.
struct Scene {
    const solver::Particles& particles;
    const solver::Model& model;
    double spacing{};
    std::vector<solver::CollisionObject> objects{};
    solver::Domain domain{{-100, -100, -100}, {100, 100, 100}, {}};

    probes::RunView view(std::uint64_t step = 0, double time = 0.0) const {
        return {particles, model, {objects, domain}, spacing, step, time};
    }
    proto::ProbeRow measure(const proto::ProbeKind& kind) const {
        const proto::ProbeDesc desc{"probe", kind, {}, {}};
        const auto probe = probes::make_probe(desc, particles.dimensions);
        const probes::RunView run = view();
        std::vector<probes::Region> regions;
        if (const auto region = probe->region(model.support_radius())) regions.push_back(*region);
        const auto nearby = probes::find_nearby(particles, domain, regions);
        proto::ProbeRow values(probe->columns().size());
        probe->sample(run, nearby.empty() ? std::span<const probes::NearParticle>() : nearby[0], values);
        return values;
    }
};

inline solver::CollisionObject box_object(const char* name, solver::Role role, const Vec3& min, const Vec3& max) {
    solver::Box box;
    for (int k = 0; k < 3; ++k) {
        box.center[k] = 0.5 * (min[k] + max[k]);
        box.half_extent[k] = 0.5 * (max[k] - min[k]);
    }
    solver::CollisionObject object;
    object.name = name;
    object.role = role;
    object.shape = box;
    return object;
}

}  // namespace headrace::test
