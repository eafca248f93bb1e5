#include "tests/validation/support/case.h"

#include <cmath>

#include "tests/validation/support/measures.h"
#include "tests/validation/support/reference_data.h"

namespace headrace::validation {

namespace {

constexpr double kRho = 1000.0;           // [kg/m^3]
constexpr double kCheck = 1.0;            // [s] between two looks at the kinetic energy
constexpr double kSteady = 1e-4;          // [1/s] relative change of the kinetic energy
constexpr double kReachInSpacings = 2.5;  // of the interpolation

// The walls take part in the interpolation: points along them, a spacing apart, move as they do.
void add_wall_points(solver::Particles& particles, double spacing) {
    const auto count = static_cast<int>(std::round(1 / spacing));
    const auto add = [&](double x, double y, double u) {
        particles.x[0].push_back(x);
        particles.x[1].push_back(y);
        particles.v[0].push_back(u);
        particles.v[1].push_back(0.0);
        particles.id.push_back(static_cast<solver::Index>(particles.id.size()));
    };
    for (int k = 0; k < count; ++k) {
        const double s = (k + 0.5) / count;
        add(s, 0.0, 0.0);
        add(s, 1.0, 1.0);
        add(0.0, s, 0.0);
        add(1.0, s, 0.0);
    }
}

double root_mean_square(const std::vector<double>& a, const std::vector<double>& b) {
    double square = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(square / static_cast<double>(a.size()));
}

// From rest until the kinetic energy no longer changes.
class Cavity : public RegularObserver {
  public:
    Cavity(double end, std::size_t column) : RegularObserver(end, kCheck), column_(column) {}

    void sample(const scene::Run& run) override {
        const double energy = kinetic_energy(run.particles());
        is_steady_ = run.time() > 5 * kCheck && std::abs(energy / energy_ - 1) / kCheck < kSteady;
        energy_ = energy;
        particles_ = run.particles();
        spacing_ = run.scene().spacing;
    }

    bool is_finished() const override { return is_steady_; }

    std::vector<Measured> measured() const override {
        solver::Particles particles = particles_;
        add_wall_points(particles, spacing_);
        const Table u = load_reference("lid_driven_cavity/u_centreline_computed_full.csv");
        const Table v = load_reference("lid_driven_cavity/v_centreline_computed_full.csv");
        if (u.empty() || v.empty()) return {};
        std::vector<solver::Vec3> vertical, horizontal;
        for (const double y : u[0]) vertical.push_back({0.5, y, 0.0});
        for (const double x : v[0]) horizontal.push_back({x, 0.5, 0.0});
        const double reach = kReachInSpacings * spacing_;
        const double error_u = root_mean_square(interpolate(particles, particles.v[0], vertical, reach), u[column_]);
        const double error_v = root_mean_square(interpolate(particles, particles.v[1], horizontal, reach), v[column_]);
        return {{"l2_centreline", std::max(error_u, error_v)}, {"l2_u", error_u}, {"l2_v", error_v}};
    }

  private:
    std::size_t column_;  // of the tables
    bool is_steady_{false};
    double energy_{0.0};  // [J/m]
    double spacing_{};    // [m]
    solver::Particles particles_;
};

Case make(double reynolds, std::size_t column, double resolution, double end, std::vector<Target> targets) {
    Case one;
    one.name = "cavity_re" + std::to_string(static_cast<int>(reynolds));
    one.folder = "cavity";
    one.length_name = "L";
    one.length = 1.0;
    one.resolution = resolution;
    one.ladder = {20, 30, 40, 50, 70};
    one.targets = std::move(targets);
    one.main_metric = "l2_centreline";
    one.is_long = reynolds > 100;
    one.adapt = [=](proto::SceneDesc& scene, double) { scene.parameters["viscosity"] = kRho / reynolds; };
    one.observe = [=](const scene::Run&, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Cavity>(end, column);
    };
    return one;
}

}  // namespace

std::vector<Case> cavity_cases() {
    return {make(100, 1, 50, 30.0, {{"l2_u", 0.01, 0.003}, {"l2_v", 0.01, 0.003}}), make(400, 2, 100, 60.0, {}),
            make(1000, 3, 100, 100.0, {{"l2_u", 0.03, 0.01}, {"l2_v", 0.03, 0.01}})};
}

}  // namespace headrace::validation
