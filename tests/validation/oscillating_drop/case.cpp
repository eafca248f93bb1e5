#include "tests/validation/support/case.h"

#include <cmath>

#include "tests/validation/exact/drop.h"
#include "tests/validation/support/lattice_drop.h"
#include "tests/validation/support/measures.h"

namespace headrace::validation {

namespace {

constexpr double kB = 1.0;   // [1/s] of the body force
constexpr double kS0 = 1.0;  // [1/s] initial stretching
constexpr double kR = 1.0;   // [m]
constexpr int kPeriods = 10;
constexpr int kSamples = 200;  // a period

double find_energy(const solver::Particles& particles) {  // [J/m] kinetic and of the body force
    double potential = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        potential += particles.m[i] * kB * kB / 2 *
                     (particles.x[0][i] * particles.x[0][i] + particles.x[1][i] * particles.x[1][i]);
    return kinetic_energy(particles) + potential;
}

class Oscillation : public RegularObserver {
  public:
    Oscillation(double period, bool brief)
        : RegularObserver(brief ? period : kPeriods * period, period / kSamples), period_(period), is_brief_(brief) {}

    void sample(const scene::Run& run) override {
        a_.add(run.time(), semi_axis(run.particles(), 0));
        energy_.add(run.time(), find_energy(run.particles()));
        if (a_.t.size() == 1 || run.time() > 1.001 * period_) return;
        square_ += std::pow(a_.value.back() - exact_.at(run.time()).a, 2);
        ++count_;
    }

    std::vector<Measured> measured() const override {
        const double loss = 1 - energy_.value.back() / energy_.value.front();
        std::vector<Measured> metrics{{"rms_a", std::sqrt(square_ / count_) / kR}};
        if (is_brief_) {
            metrics.push_back({"energy_loss_one_period", std::abs(loss)});
            return metrics;
        }
        const double ideal = (find_largest() - kR * kR / find_largest()) / 2;
        const double end = a_.t.back();
        metrics.push_back({"amplitude_loss", std::abs(1 - a_.half_range(end - period_, end) / ideal)});
        metrics.push_back({"energy_loss", std::abs(loss)});
        return metrics;
    }

  private:
    // Largest semi-axis of the exact motion: a quarter period from the start; the smallest is R^2 / a.
    double find_largest() const { return exact::EllipticalDrop(kS0, kB, kR).at(period_ / 4).a; }

    double period_;
    bool is_brief_;
    mutable exact::EllipticalDrop exact_{kS0, kB, kR};
    Series a_, energy_;
    double square_{0.0};
    int count_{0};
};

}  // namespace

std::vector<Case> oscillating_drop_cases() {
    Case one;
    one.name = one.folder = "oscillating_drop";
    one.length_name = "R0";
    one.length = kR;
    one.resolution = 20;
    one.ladder = {10, 14, 20, 28, 40};
    one.targets = {{"rms_a", 2e-3, 5e-4}, {"amplitude_loss", 0.08, 0.03}, {"energy_loss", 0.04, 0.02}};
    one.main_metric = "rms_a";
    one.adapt = [](proto::SceneDesc& scene, double resolution) { fit_drop(scene, kR, resolution); };
    one.observe = [](const scene::Run&, const Settings& settings) -> std::unique_ptr<Observer> {
        return std::make_unique<Oscillation>(exact::EllipticalDrop(kS0, kB, kR).period(), settings.brief);
    };
    return {one};
}

}  // namespace headrace::validation
