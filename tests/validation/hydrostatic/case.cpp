#include "tests/validation/support/case.h"

#include <cmath>
#include <functional>

#include "tests/validation/exact/flows.h"
#include "tests/validation/support/gauges.h"
#include "tests/validation/support/measures.h"
#include "tests/validation/support/model_values.h"

namespace headrace::validation {

namespace {

constexpr double kG = 9.81;      // [m/s^2]
constexpr double kRho = 1000.0;  // [kg/m^3]
constexpr int kSamples = 100;    // over the last half

// Height of the surface above y = 0 [m].
using Surface = std::function<double(const scene::Run&, const exact::StillColumn&)>;

double total(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum;
}

// Straight walls: the load per area tells the height whatever the compression.
Surface straight(double area) {
    return [=](const scene::Run& run, const exact::StillColumn& column) {
        return column.depth_of(total(run.particles().m) / area);
    };
}

// Sphere about the origin: a lattice leaves gaps along the curved wall, so the volume does not tell; a gauge on the
// axis.
Surface by_gauge(double R) {
    return [=](const scene::Run& run, const exact::StillColumn&) { return Gauge(run, "level").read(run) - R; };
}

// Over the last half of 20 sqrt(H/g).
class Stillness : public Observer {
  public:
    Stillness(double depth, Surface surface, const scene::Run& run)
        : depth_(depth), surface_(std::move(surface)), end_(20 * std::sqrt(depth / kG)), tait_(has_tait(run)) {}

    double end_time() const override { return end_; }
    double next_sample(double t) const override {
        const double interval = end_ / 2 / kSamples;
        return end_ / 2 + std::max(0.0, std::floor((t - end_ / 2) / interval * (1 + 1e-12)) + 1) * interval;
    }

    void sample(const scene::Run& run) override {
        if (run.time() < end_ / 2) return;
        const solver::Particles& particles = run.particles();
        const exact::StillColumn column{kRho, find_sound_speed(run), kG, tait_};
        const double surface = surface_(run, column);
        double square = 0.0;
        for (std::size_t i = 0; i < particles.size(); ++i)
            square += std::pow(particles.p[i] - column.pressure(surface - particles.x[1][i]), 2);
        square_ += square / static_cast<double>(particles.size());
        energy_ += kinetic_energy(particles) / (total(particles.m) * kG * depth_);
        ++samples_;
    }

    std::vector<Measured> measured() const override {
        return {{"rms_pressure", std::sqrt(square_ / samples_) / (kRho * kG * depth_)},
                {"kinetic_energy", energy_ / samples_}};
    }

  private:
    double depth_;  // [m] H of the metrics
    Surface surface_;
    double end_;
    bool tait_;
    double square_{}, energy_{};
    int samples_{};
};

Case make(const std::string& name, double length, double resolution, double depth, Surface surface) {
    Case one;
    one.name = one.folder = name;
    one.length_name = "H";
    one.length = length;
    one.resolution = resolution;
    one.main_metric = "rms_pressure";
    one.observe = [=](const scene::Run& run, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Stillness>(depth, surface, run);
    };
    return one;
}

}  // namespace

std::vector<Case> hydrostatic_cases() {
    Case flat = make("hydrostatic", 1.0, 50, 1.0, straight(1.0));
    flat.ladder = {16, 24, 32, 50, 70};
    flat.targets = {{"rms_pressure", 5e-3, 1e-3}, {"kinetic_energy", 1e-5, 1e-6}};
    Case shaft = make("hydrostatic_3d", 1.0, 20, 1.0, straight(0.25));
    shaft.ladder = {10, 16, 20};
    return {flat, shaft, make("hydrostatic_sphere", 0.5, 10, 0.5, by_gauge(0.5))};
}

}  // namespace headrace::validation
