#include "tests/validation/support/case.h"

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/validation/exact/waves.h"
#include "tests/validation/support/measures.h"

namespace headrace::validation {

namespace {

constexpr double kG = 9.81;      // [m/s^2]
constexpr double kDepth = 0.5;   // [m]
constexpr double kLength = 1.0;  // [m] one wave
constexpr double kRho = 1000.0;  // [kg/m^3]
constexpr double kK = 2 * std::numbers::pi / kLength;
constexpr double kAmplitude = 0.05 / kK;  // [m]
constexpr int kSamples = 100;             // a period

// Follows the cosine mode of the surface. nu [m^2/s].
class Wave : public RegularObserver {
  public:
    Wave(double nu, double periods, bool brief)
        : RegularObserver(periods * inviscid_period(), inviscid_period() / kSamples), nu_(nu), is_brief_(brief) {}

    void sample(const scene::Run& run) override { crest_.add(run.time(), surface_mode(run.particles(), kK, kLength)); }

    std::vector<Measured> measured() const override {
        const double omega0 = exact::gravity_wave_frequency(kK, kDepth, kG);
        if (nu_ == 0.0) {
            const DampedWave wave = fit_damped_wave(crest_, 0.0, omega0, 0.0);
            std::vector<Measured> metrics{{"period", std::abs(omega0 / wave.omega - 1)},
                                          {"damping", std::abs(wave.rate) / omega0}};
            const double end = crest_.t.back();
            if (!is_brief_)
                metrics.push_back(
                    {"crest_loss", std::abs(1 - crest_.half_range(end - inviscid_period(), end) / kAmplitude)});
            return metrics;
        }
        const std::complex<double> s = exact::viscous_wave_eigenvalue(kK, kDepth, kG, nu_, false);
        // The first period builds the vorticity below the surface that the eigenmode has and the start has not.
        const DampedWave wave = fit_damped_wave(crest_, inviscid_period(), s.imag(), -s.real());
        return {{"decay_rate", std::abs(wave.rate / -s.real() - 1)}, {"period", std::abs(s.imag() / wave.omega - 1)}};
    }

  private:
    static double inviscid_period() { return 2 * std::numbers::pi / exact::gravity_wave_frequency(kK, kDepth, kG); }

    double nu_;
    bool is_brief_;
    Series crest_;  // [m]
};

Case make(const std::string& name, double nu, double periods, std::vector<Target> targets) {
    Case one;
    one.name = name;
    one.folder = "standing_wave";
    one.length_name = "H";
    one.length = kDepth;
    one.resolution = 50;
    one.ladder = {12, 18, 25, 36, 50};
    one.targets = std::move(targets);
    one.adapt = [=](proto::SceneDesc& scene, double) {
        if (nu > 0.0) scene.parameters["viscosity"] = kRho * nu;
    };
    one.observe = [=](const scene::Run&, const Settings& settings) -> std::unique_ptr<Observer> {
        return std::make_unique<Wave>(nu, settings.brief ? 3 : periods, settings.brief);
    };
    return one;
}

}  // namespace

std::vector<Case> standing_wave_cases() {
    Case inviscid = make("standing_wave", 0.0, 8, {{"period", 0.01, 0.005}, {"crest_loss", 0.1, 0.04}});
    inviscid.main_metric = "period";
    // Re = H sqrt(g H) / nu = 500.
    const double nu = kDepth * std::sqrt(kG * kDepth) / 500;
    Case viscous = make("standing_wave_viscous", nu, 6, {{"decay_rate", 0.05, 0.02}});
    viscous.main_metric = "decay_rate";
    return {inviscid, viscous};
}

}  // namespace headrace::validation
