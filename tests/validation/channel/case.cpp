#include "tests/validation/support/case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "tests/validation/exact/flows.h"

namespace headrace::validation {

namespace {

// Morris, Fox, Zhu 1997.
constexpr double kL = 1e-3;      // [m]
constexpr double kNu = 1e-6;     // [m^2/s]
constexpr double kV0 = 1.25e-5;  // [m/s] of the plate, and largest of the steady Poiseuille flow
constexpr double kF = 1e-4;      // [m/s^2]

constexpr std::array kTimes{0.01125, 0.0225, 0.045, 0.1125, 0.225, 0.5, 1.0};  // [s]
constexpr double kBriefEnd = 0.225;                                            // [s]

using Profile = std::function<double(double y, double t)>;

// Root mean square of |v - v_exact| over the particles / V0, the largest of the tabulated times.
class StartUp : public Observer {
  public:
    StartUp(Profile exact, bool brief) : exact_(std::move(exact)), end_(brief ? kBriefEnd : kTimes.back()) {}

    double end_time() const override { return end_; }
    double next_sample(double t) const override {
        const auto next = std::upper_bound(kTimes.begin(), kTimes.end(), t);
        return next == kTimes.end() ? 2 * end_ : *next;
    }

    void sample(const scene::Run& run) override {
        if (run.time() == 0.0) return;
        const solver::Particles& particles = run.particles();
        double square = 0.0;
        for (std::size_t i = 0; i < particles.size(); ++i)
            square +=
                std::pow(particles.v[0][i] - exact_(particles.x[1][i], run.time()), 2) + std::pow(particles.v[1][i], 2);
        last_ = std::sqrt(square / static_cast<double>(particles.size())) / kV0;
        worst_ = std::max(worst_, last_);
    }

    std::vector<Measured> measured() const override { return {{"l2_velocity", worst_}, {"l2_velocity_at_end", last_}}; }

  private:
    Profile exact_;
    double end_;
    double worst_{}, last_{};
};

Case make(const std::string& name, Profile exact) {
    Case one;
    one.name = name;
    one.folder = "channel";
    one.length_name = "L";
    one.length = kL;
    one.resolution = 50;
    one.ladder = {20, 30, 40, 50, 70};
    one.targets = {{"l2_velocity", 5e-3, 1e-3}};
    one.main_metric = "l2_velocity";
    one.observe = [exact](const scene::Run&, const Settings& settings) -> std::unique_ptr<Observer> {
        return std::make_unique<StartUp>(exact, settings.brief);
    };
    return one;
}

}  // namespace

std::vector<Case> channel_cases() {
    const Case couette = make("couette", [](double y, double t) { return exact::couette(y, t, kV0, kL, kNu); });
    Case poiseuille = make("poiseuille", [](double y, double t) { return exact::poiseuille(y, t, kF, kL, kNu); });
    poiseuille.adapt = [](proto::SceneDesc& scene, double) {
        scene.body_force[0] = kF;
        for (proto::ObjectDesc& plate : scene.objects) plate.surface_velocity.reset();
    };
    return {couette, poiseuille};
}

}  // namespace headrace::validation
