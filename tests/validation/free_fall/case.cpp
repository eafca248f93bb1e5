#include "tests/validation/support/case.h"

#include <algorithm>
#include <cmath>

#include "tests/validation/support/measures.h"

namespace headrace::validation {

namespace {

constexpr double kG = 9.81;      // [m/s^2]
constexpr double kSide = 1.0;    // [m] of the block, and the way it falls
constexpr double kRho = 1000.0;  // [kg/m^3]

double centre_height(const solver::Particles& particles) {
    double sum = 0.0;
    for (const double y : particles.x[1]) sum += y;
    return sum / static_cast<double>(particles.size());
}

// Largest of the whole fall: way and energy against the exact ones, pressure, change of width.
class Fall : public RegularObserver {
  public:
    Fall() : RegularObserver(std::sqrt(2 * kSide / kG), 0.01) {}

    void sample(const scene::Run& run) override {
        const solver::Particles& particles = run.particles();
        const double height = centre_height(particles), t = run.time();
        const auto [left, right] = std::minmax_element(particles.x[0].begin(), particles.x[0].end());
        const double energy = kinetic_energy(particles) / (particles.m[0] * static_cast<double>(particles.size())) +
                              kG * height;  // [J/kg]
        if (t == 0.0) {
            height_ = height;
            energy_ = energy;
            width_ = *right - *left;
            return;
        }
        way_ = std::max(way_, std::abs(height_ - height - kG * t * t / 2) / kSide);
        drift_ = std::max(drift_, std::abs(energy - energy_) / (kG * kSide));
        change_ = std::max(change_, std::abs(*right - *left - width_) / kSide);
        for (const double p : particles.p) pressure_ = std::max(pressure_, std::abs(p) / (kRho * kG * kSide));
    }

    std::vector<Measured> measured() const override {
        return {{"way", way_}, {"energy", drift_}, {"pressure", pressure_}, {"width", change_}};
    }

  private:
    double height_{}, energy_{}, width_{};
    double way_{}, drift_{}, change_{}, pressure_{};
};

}  // namespace

std::vector<Case> free_fall_cases() {
    Case one;
    one.name = one.folder = "free_fall";
    one.length_name = "L";
    one.length = kSide;
    one.resolution = 20;
    one.ladder = {10, 14, 20, 28};
    one.main_metric = "energy";
    one.observe = [](const scene::Run&, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Fall>();
    };
    return {one};
}

}  // namespace headrace::validation
