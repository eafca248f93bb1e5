#include "tests/validation/support/case.h"

#include <cmath>
#include <numbers>

#include "tests/validation/support/measures.h"
#include "tests/validation/support/model_values.h"

namespace headrace::validation {

namespace {

constexpr double kK = 2 * std::numbers::pi;  // [1/m] one wave in 1 m
constexpr int kPeriods = 5;
constexpr int kSamples = 40;  // a period

// Follows the cosine mode of the pressure.
class Sound : public RegularObserver {
  public:
    explicit Sound(double c0) : RegularObserver(kPeriods / c0, 1 / c0 / kSamples), c0_(c0) {}

    void sample(const scene::Run& run) override {
        const solver::Particles& particles = run.particles();
        double sum = 0.0;
        for (std::size_t i = 0; i < particles.size(); ++i) sum += particles.p[i] * std::cos(kK * particles.x[0][i]);
        mode_.add(run.time(), 2 * sum / static_cast<double>(particles.size()));
    }

    std::vector<Measured> measured() const override {
        const DampedWave wave = fit_damped_wave(mode_, 0.0, kK * c0_, 0.0);
        return {{"phase_speed", std::abs(wave.omega / (kK * c0_) - 1)},
                {"damping", std::abs(wave.rate) / wave.omega},
                {"growth", std::max(0.0, -wave.rate / wave.omega)}};
    }

  private:
    double c0_;    // [m/s]
    Series mode_;  // [Pa]
};

}  // namespace

std::vector<Case> acoustic_wave_cases() {
    Case one;
    one.name = one.folder = "acoustic_wave";
    one.length_name = "lambda";
    one.length = 1.0;
    one.resolution = 64;
    one.ladder = {16, 24, 32, 48, 64};
    one.main_metric = "phase_speed";
    one.observe = [](const scene::Run& run, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Sound>(find_sound_speed(run));
    };
    return {one};
}

}  // namespace headrace::validation
