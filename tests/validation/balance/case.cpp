#include "tests/validation/support/case.h"

#include <array>
#include <cmath>

#include "tests/validation/support/measures.h"

namespace headrace::validation {

namespace {

constexpr double kEnd = 0.5;  // [s] the blocks have met and spread

struct Momenta {
    std::array<double, 2> linear{};  // [kg/s]
    double angular{};                // [kg m/s] about the origin
    double linear_scale{};           // sums of the magnitudes
    double angular_scale{};
};

Momenta find_momenta(const solver::Particles& particles) {
    Momenta sum;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double m = particles.m[i], x = particles.x[0][i], y = particles.x[1][i];
        const double u = particles.v[0][i], v = particles.v[1][i];
        sum.linear[0] += m * u;
        sum.linear[1] += m * v;
        sum.angular += m * (x * v - y * u);
        sum.linear_scale += m * std::hypot(u, v);
        sum.angular_scale += m * std::abs(x * v - y * u);
    }
    return sum;
}

// Largest change of the whole run, relative to the start.
class Balance : public RegularObserver {
  public:
    Balance() : RegularObserver(kEnd, 0.01) {}

    void sample(const scene::Run& run) override {
        const Momenta now = find_momenta(run.particles());
        const double energy = kinetic_energy(run.particles());
        if (run.time() == 0.0) {
            start_ = now;
            energy_ = energy;
        }
        linear_ = std::max(linear_, std::hypot(now.linear[0] - start_.linear[0], now.linear[1] - start_.linear[1]) /
                                        start_.linear_scale);
        angular_ = std::max(angular_, std::abs(now.angular - start_.angular) / start_.angular_scale);
        gain_ = std::max(gain_, energy / energy_ - 1);
        if (const auto budget = run.model().energies(run.particles(), run.surroundings()))
            lost_ = std::max(lost_.value_or(0.0), std::abs(budget->balance) / energy_);
    }

    std::vector<Measured> measured() const override {
        std::vector<Measured> metrics{{"momentum", linear_}, {"angular_momentum", angular_}, {"energy_gain", gain_}};
        if (lost_) metrics.push_back({"energy_balance", *lost_});
        return metrics;
    }

  private:
    Momenta start_;
    double energy_{};
    double linear_{}, angular_{}, gain_{};
    std::optional<double> lost_;  // what the model's own budget cannot account for
};

}  // namespace

std::vector<Case> balance_cases() {
    Case one;
    one.name = one.folder = "balance";
    one.length_name = "L";
    one.length = 0.4;
    one.resolution = 20;
    one.main_metric = "momentum";
    one.follows_energies = true;
    one.observe = [](const scene::Run&, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Balance>();
    };
    return {one};
}

}  // namespace headrace::validation
