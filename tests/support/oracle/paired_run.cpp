#include "tests/support/oracle/paired_run.h"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>

#include "server/solver/models/registry.h"

namespace headrace::oracle {

namespace {

using solver::Role;

const double kThesisSpacing = std::cbrt(0.02 / 998.29);  // [m]

solver::CollisionObject box(Role role, const Vec3& min, const Vec3& max) {
    solver::Box shape;
    for (int axis = 0; axis < 3; ++axis) {
        shape.center[axis] = 0.5 * (min[axis] + max[axis]);
        shape.half_extent[axis] = 0.5 * (max[axis] - min[axis]);
    }
    return {"box", role, shape};
}

solver::Domain domain_around(const Vec3& min, const Vec3& max) {
    const double margin = 0.05;
    return {{min[0] - margin, min[1] - margin, min[2] - margin}, {max[0] + margin, max[1] + margin, max[2] + margin}};
}

template <class T>
T value_of(const solver::ParameterMap& parameters, const char* name) {
    return std::get<T>(parameters.at(name));
}

}  // namespace

std::vector<Vec3> make_lattice(const Setup& setup) {
    std::vector<Vec3> positions;
    for (int k2 = 0; k2 < setup.counts[2]; ++k2)
        for (int k1 = 0; k1 < setup.counts[1]; ++k1)
            for (int k0 = 0; k0 < setup.counts[0]; ++k0) {
                const std::array<int, 3> k{k0, k1, k2};
                Vec3 x{};
                for (int axis = 0; axis < setup.dimensions; ++axis)
                    x[axis] = setup.min[axis] + (k[axis] + 0.5) * setup.spacing;
                positions.push_back(x);
            }
    return positions;
}

Setup small_dam_break() {
    Setup setup;
    const double s = kThesisSpacing;
    setup.spacing = s;
    setup.counts = {10, 10, 10};
    const Vec3 far_corner{30.0 * s, 20.0 * s, 10.0 * s};
    setup.objects = {box(Role::container, {}, far_corner)};
    setup.domain = domain_around({}, far_corner);
    return setup;
}

Setup bowl() {
    Setup setup;
    const double s = kThesisSpacing, radius = 0.4;
    setup.spacing = s;
    setup.counts = {13, 13, 13};
    // Low enough for the cube's lower corners to meet the bowl within the first steps.
    setup.min = {-6.5 * s, -10.0 * s, -6.5 * s};
    setup.objects = {{"bowl", Role::container, solver::Sphere{{}, radius}}};
    setup.domain = domain_around({-radius, -radius, -radius}, {radius, radius, radius});
    return setup;
}

Setup flat_dam_break() {
    Setup setup;
    const double s = 0.0136;
    setup.dimensions = 2;
    setup.spacing = s;
    setup.counts = {20, 40, 1};
    const Vec3 far_corner{80.0 * s, 60.0 * s, 0.0};
    setup.objects = {box(Role::container, {}, far_corner)};
    setup.domain = domain_around({}, far_corner);
    return setup;
}

Setup obstacle_dam_break() {
    Setup setup = small_dam_break();
    const double s = setup.spacing;
    setup.velocity = {2.0, 0.0, 0.0};  // to reach all of them before chaos sets in
    // Sunk into the floor: below its centre it pushes particles out of the tank.
    setup.objects.push_back({"sphere", Role::obstacle, solver::Sphere{{11.5 * s, 1.0 * s, 3.0 * s}, 2.0 * s}});
    setup.objects.push_back(box(Role::obstacle, {11.0 * s, -s, 6.0 * s}, {15.0 * s, 2.0 * s, 9.0 * s}));
    // Thinner than the way of a step: only a swept test stops the particles.
    setup.objects.push_back(box(Role::obstacle, {13.0 * s, 4.0 * s, -s}, {13.1 * s, 21.0 * s, 11.0 * s}));
    return setup;
}

Setup column() {
    Setup setup;
    const double s = kThesisSpacing;
    setup.spacing = s;
    setup.counts = {10, 20, 15};
    const Vec3 far_corner{10.0 * s, 30.0 * s, 15.0 * s};
    setup.objects = {box(Role::container, {}, far_corner)};
    setup.domain = domain_around({}, far_corner);
    // With 0.01 s the compressed column boils for ever.
    setup.overrides["time_step"] = 0.005;
    return setup;
}

FastRun::FastRun(const Setup& setup)
    : setup_(setup), model_(solver::make_model("thesis", setup.dimensions, setup.spacing, setup.overrides)) {
    omp_set_num_threads(1);  // a few thousand particles: waiting for other threads costs more than they bring
    const std::vector<Vec3> lattice = make_lattice(setup);
    particles_.dimensions = setup.dimensions;
    particles_.resize(lattice.size());
    for (std::size_t i = 0; i < lattice.size(); ++i) {
        particles_.id[i] = static_cast<solver::Index>(i);
        for (int axis = 0; axis < setup.dimensions; ++axis) {
            particles_.x[axis][i] = lattice[i][axis];
            particles_.v[axis][i] = setup.velocity[axis];
        }
    }
    model_->initialise(particles_, {setup_.objects, setup_.domain});
}

void FastRun::step() {
    const solver::StepReport report = model_->step(particles_, {setup_.objects, setup_.domain});
    if (report.fault) throw std::runtime_error("fault at particle " + std::to_string(report.fault->particle));
}

ThesisOracle make_oracle(const Setup& setup, const solver::ParameterMap& parameters) {
    ThesisParameters table;
    table.dt = value_of<double>(parameters, "time_step");
    table.g = value_of<solver::Vec3>(parameters, "gravity");
    table.rho0 = value_of<double>(parameters, "rest_density");
    table.m = value_of<double>(parameters, "particle_mass");
    table.mu = value_of<double>(parameters, "viscosity");
    table.sigma = value_of<double>(parameters, "surface_tension");
    table.l = value_of<double>(parameters, "surface_tension_threshold");
    table.k = value_of<double>(parameters, "stiffness");
    table.c_R = value_of<double>(parameters, "restitution");
    table.h = value_of<double>(parameters, "support_radius");
    table.pressure_form = value_of<std::string>(parameters, "pressure_form") == "symmetric" ? PressureForm::symmetric
                                                                                            : PressureForm::averaged;
    if (setup.dimensions == 2) table.g[2] = 0.0;
    ThesisOracle oracle(setup.dimensions, table, setup.objects);
    for (const Vec3& x : make_lattice(setup)) oracle.add_particle(x, setup.velocity);
    oracle.initialise();
    return oracle;
}

Deviation compute_deviation(const solver::Particles& fast, const ThesisOracle& oracle, double spacing) {
    Deviation largest, scale;
    for (std::size_t slot = 0; slot < fast.size(); ++slot) {
        const Particle& plain = oracle.particles().at(fast.id[slot]);
        // A NaN must win and stay.
        const auto note = [](double& worst, double difference) {
            if (!std::isnan(worst) && !(std::abs(difference) <= worst)) worst = std::abs(difference);
        };
        for (int axis = 0; axis < fast.dimensions; ++axis) {
            note(largest.x, (fast.x[axis][slot] - plain.x[axis]) / spacing);
            note(largest.v, fast.v[axis][slot] - plain.v[axis]);
            note(largest.v_half, fast.v_half[axis][slot] - plain.v_half[axis]);
            note(largest.a, fast.a[axis][slot] - plain.a[axis]);
            note(scale.v, plain.v[axis]);
            note(scale.v_half, plain.v_half[axis]);
            note(scale.a, plain.a[axis]);
        }
        note(largest.rho, fast.rho[slot] - plain.rho);
        note(largest.p, fast.p[slot] - plain.p);
        note(scale.rho, plain.rho);
        note(scale.p, plain.p);
    }
    const auto relative = [](double difference, double whole) { return whole > 0.0 ? difference / whole : difference; };
    return {largest.x,
            relative(largest.v, scale.v),
            relative(largest.v_half, scale.v_half),
            relative(largest.a, scale.a),
            relative(largest.rho, scale.rho),
            relative(largest.p, scale.p)};
}

Statistics compute_statistics(const solver::Particles& particles, double m, double g) {
    Statistics statistics;
    statistics.front = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < particles.size(); ++i) {
        statistics.front = std::max(statistics.front, particles.x[0][i]);
        statistics.mean_density += particles.rho[i] / static_cast<double>(particles.size());
        for (int axis = 0; axis < particles.dimensions; ++axis)
            statistics.energy += 0.5 * m * particles.v[axis][i] * particles.v[axis][i];
        statistics.energy += m * g * particles.x[1][i];
    }
    return statistics;
}

Statistics compute_statistics(const ThesisOracle& oracle, double m, double g) {
    Statistics statistics;
    statistics.front = -std::numeric_limits<double>::infinity();
    for (const Particle& i : oracle.particles()) {
        statistics.front = std::max(statistics.front, i.x[0]);
        statistics.mean_density += i.rho / static_cast<double>(oracle.particles().size());
        for (double component : i.v) statistics.energy += 0.5 * m * component * component;
        statistics.energy += m * g * i.x[1];
    }
    return statistics;
}

}  // namespace headrace::oracle
