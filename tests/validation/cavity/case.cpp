#include "tests/validation/support/case.h"

#include <cmath>

#include "tests/validation/support/measures.h"
#include "tests/validation/support/reference_data.h"

namespace headrace::validation {

namespace {

constexpr double kRho = 1000.0;           // [kg/m^3]
constexpr double kCheck = 1.0;            // [s] between two looks
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

double mean_square(const std::vector<double>& a, const std::vector<double>& b) {
    double square = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
    return square / static_cast<double>(a.size());
}

// The flow is steady, the particles that carry it are not: what one look finds differs from the next. The errors are
// root mean squares over the looks in the last quarter of the run, each as large as one look would have told.
class Cavity : public RegularObserver {
  public:
    Cavity(double end, std::size_t column)
        : RegularObserver(end, kCheck),
          u_(load_reference("lid_driven_cavity/u_centreline_computed_full.csv")),
          v_(load_reference("lid_driven_cavity/v_centreline_computed_full.csv")),
          column_(column) {}

    void sample(const scene::Run& run) override {
        if (run.time() < 0.75 * end_time() || u_.empty() || v_.empty()) return;
        solver::Particles particles = run.particles();
        const double spacing = run.scene().spacing;
        add_wall_points(particles, spacing);
        std::vector<solver::Vec3> vertical, horizontal;
        for (const double y : u_[0]) vertical.push_back({0.5, y, 0.0});
        for (const double x : v_[0]) horizontal.push_back({x, 0.5, 0.0});
        const double reach = kReachInSpacings * spacing;
        sum_u_ += mean_square(interpolate(particles, particles.v[0], vertical, reach), u_[column_]);
        sum_v_ += mean_square(interpolate(particles, particles.v[1], horizontal, reach), v_[column_]);
        ++looks_;
    }

    std::vector<Measured> measured() const override {
        if (looks_ == 0) return {};
        const double u = std::sqrt(sum_u_ / looks_), v = std::sqrt(sum_v_ / looks_);
        return {{"l2_centreline", std::max(u, v)}, {"l2_u", u}, {"l2_v", v}};
    }

  private:
    Table u_, v_;
    std::size_t column_;  // of the tables
    double sum_u_{}, sum_v_{};
    int looks_{};
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
    return {make(100, 1, 50, 20.0, {{"l2_u", 0.01, 0.003}, {"l2_v", 0.01, 0.003}}), make(400, 2, 100, 40.0, {}),
            make(1000, 3, 100, 60.0, {{"l2_u", 0.03, 0.01}, {"l2_v", 0.03, 0.01}})};
}

}  // namespace headrace::validation
