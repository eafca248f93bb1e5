#include "tests/validation/support/case.h"

#include <cmath>
#include <numbers>

#include "tests/validation/exact/flows.h"
#include "tests/validation/support/measures.h"
#include "tests/validation/support/model_values.h"

namespace headrace::validation {

namespace {

constexpr double kG = 9.81;      // [m/s^2]
constexpr double kRho = 1000.0;  // [kg/m^3]
constexpr int kSamples = 100;    // over the last half

// What holds the water: gives the height of its surface above y = 0 [m].
struct Vessel {
    double depth{};  // [m] H of the metrics
    std::function<double(const solver::Particles&, const exact::StillColumn&)> surface;
};

double total(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum;
}

// Straight walls: the load per area tells the height whatever the compression.
Vessel straight(double area) {
    return {1.0, [=](const solver::Particles& particles, const exact::StillColumn& column) {
                return column.depth_of(total(particles.m) / area);
            }};
}

// Sphere about the origin: the volume tells the height of the cap, pi h^2 (3 R - h) / 3.
Vessel sphere(double R) {
    return {R, [=](const solver::Particles& particles, const exact::StillColumn&) {
                double volume = 0.0;
                for (std::size_t i = 0; i < particles.size(); ++i) volume += particles.m[i] / particles.rho[i];
                double low = 0.0, high = 2 * R;
                for (int k = 0; k < 60; ++k) {
                    const double h = (low + high) / 2;
                    (std::numbers::pi * h * h * (3 * R - h) / 3 < volume ? low : high) = h;
                }
                return low - R;
            }};
}

// Over the last half of 20 sqrt(H/g).
class Stillness : public Observer {
  public:
    Stillness(Vessel vessel, const scene::Run& run)
        : vessel_(std::move(vessel)), end_(20 * std::sqrt(vessel_.depth / kG)), tait_(has_tait(run)) {}

    double end_time() const override { return end_; }
    double next_sample(double t) const override {
        const double interval = end_ / 2 / kSamples;
        return end_ / 2 + std::max(0.0, std::floor((t - end_ / 2) / interval * (1 + 1e-12)) + 1) * interval;
    }

    void sample(const scene::Run& run) override {
        if (run.time() < end_ / 2) return;
        const solver::Particles& particles = run.particles();
        const exact::StillColumn column{kRho, find_sound_speed(run), kG, tait_};
        const double surface = vessel_.surface(particles, column);
        double square = 0.0;
        for (std::size_t i = 0; i < particles.size(); ++i)
            square += std::pow(particles.p[i] - column.pressure(surface - particles.x[1][i]), 2);
        square_ += square / static_cast<double>(particles.size());
        energy_ += kinetic_energy(particles) / (total(particles.m) * kG * vessel_.depth);
        ++samples_;
    }

    std::vector<Measured> measured() const override {
        return {{"rms_pressure", std::sqrt(square_ / samples_) / (kRho * kG * vessel_.depth)},
                {"kinetic_energy", energy_ / samples_}};
    }

  private:
    Vessel vessel_;
    double end_;
    bool tait_;
    double square_{}, energy_{};
    int samples_{};
};

Case make(const std::string& name, double length, double resolution, Vessel vessel) {
    Case one;
    one.name = one.folder = name;
    one.length_name = "H";
    one.length = length;
    one.resolution = resolution;
    one.main_metric = "rms_pressure";
    one.observe = [=](const scene::Run& run, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Stillness>(vessel, run);
    };
    return one;
}

}  // namespace

std::vector<Case> hydrostatic_cases() {
    Case flat = make("hydrostatic", 1.0, 50, straight(1.0));
    flat.ladder = {16, 24, 32, 50, 70};
    flat.targets = {{"rms_pressure", 5e-3, 1e-3}, {"kinetic_energy", 1e-5, 1e-6}};
    Case shaft = make("hydrostatic_3d", 1.0, 20, straight(0.25));
    shaft.ladder = {10, 16, 20};
    return {flat, shaft, make("hydrostatic_sphere", 0.5, 10, sphere(0.5))};
}

}  // namespace headrace::validation
