#include "tests/validation/support/case.h"

#include <cmath>
#include <numbers>

#include "tests/validation/exact/waves.h"
#include "tests/validation/support/lattice_drop.h"
#include "tests/validation/support/measures.h"

namespace headrace::validation {

namespace {

constexpr double kR = 0.01;        // [m]
constexpr double kRho = 1000.0;    // [kg/m^3]
constexpr double kSigma = 0.0728;  // [N/m]

// The pressure inside r < R/2 at rest against sigma/R; the speed that remains.
class Laplace : public RegularObserver {
  public:
    Laplace(double mu, double end) : RegularObserver(end, end / 100), mu_(mu), from_(0.75 * end) {}

    void sample(const scene::Run& run) override {
        if (run.time() < from_) return;
        const solver::Particles& particles = run.particles();
        double sum = 0.0;
        int inside = 0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            speed_ = std::max(speed_, std::hypot(particles.v[0][i], particles.v[1][i]));
            if (std::hypot(particles.x[0][i], particles.x[1][i]) > kR / 2) continue;
            sum += particles.p[i];
            ++inside;
        }
        pressure_ += sum / inside;
        ++samples_;
    }

    std::vector<Measured> measured() const override {
        return {{"pressure_jump", std::abs(pressure_ / samples_ / (kSigma / kR) - 1)},
                {"capillary_number", mu_ * speed_ / kSigma}};
    }

  private:
    double mu_;    // [Pa s]
    double from_;  // [s] the drop is at rest
    double pressure_{}, speed_{};
    int samples_{};
};

// The mode n = 2: <x^2> - <y^2>.
class Swing : public RegularObserver {
  public:
    explicit Swing(double periods) : RegularObserver(periods * period(), period() / 100) {}

    void sample(const scene::Run& run) override {
        const double a = semi_axis(run.particles(), 0), b = semi_axis(run.particles(), 1);
        mode_.add(run.time(), (a * a - b * b) / 4);
    }

    std::vector<Measured> measured() const override {
        const double omega = exact::drop_frequency_2d(2, kSigma, kRho, kR);
        const DampedWave wave = fit_damped_wave(mode_, 0.0, omega, 0.0);
        return {{"period", std::abs(omega / wave.omega - 1)}, {"damping", std::abs(wave.rate) / omega}};
    }

  private:
    static double period() { return 2 * std::numbers::pi / exact::drop_frequency_2d(2, kSigma, kRho, kR); }

    Series mode_;  // [m^2]
};

Case make(const std::string& name, std::vector<Target> targets) {
    Case one;
    one.name = one.folder = name;
    one.length_name = "R";
    one.length = kR;
    one.resolution = 20;
    one.ladder = {10, 14, 20, 28};
    one.main_metric = targets.front().metric;
    one.targets = std::move(targets);
    one.adapt = [](proto::SceneDesc& scene, double resolution) { fit_drop(scene, kR, resolution); };
    return one;
}

}  // namespace

std::vector<Case> capillary_drop_cases() {
    Case still = make("laplace", {{"pressure_jump", 0.03, 0.01}});
    still.observe = [](const scene::Run& run, const Settings& settings) -> std::unique_ptr<Observer> {
        const double mu = std::get<double>(run.scene().parameters.at("viscosity"));
        // R^2/nu = 0.6 s is the time in which viscosity stops the drop.
        return std::make_unique<Laplace>(mu, (settings.brief ? 1.5 : 5) * kR * kR * kRho / mu);
    };
    Case swinging = make("capillary_drop", {{"period", 0.03, 0.01}});
    swinging.observe = [](const scene::Run&, const Settings& settings) -> std::unique_ptr<Observer> {
        return std::make_unique<Swing>(settings.brief ? 1.25 : 3);
    };
    return {still, swinging};
}

}  // namespace headrace::validation
