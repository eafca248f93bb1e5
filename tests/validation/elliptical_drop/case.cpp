#include "tests/validation/support/case.h"

#include <cmath>

#include "tests/validation/exact/drop.h"
#include "tests/validation/support/lattice_drop.h"
#include "tests/validation/support/measures.h"

namespace headrace::validation {

namespace {

constexpr double kS0 = -100.0;   // [1/s]
constexpr double kR = 1.0;       // [m]
constexpr double kEnd = 0.0076;  // [s] b has nearly doubled

class Stretching : public RegularObserver {
  public:
    Stretching() : RegularObserver(kEnd, kEnd) {}

    void sample(const scene::Run& run) override {
        const exact::Ellipse ellipse = exact_.at(run.time());
        a_ = std::abs(semi_axis(run.particles(), 0) / ellipse.a - 1);
        b_ = std::abs(semi_axis(run.particles(), 1) / ellipse.b - 1);
        if (energy_ == 0.0) energy_ = kinetic_energy(run.particles());
        loss_ = std::abs(1 - kinetic_energy(run.particles()) / energy_);
    }

    std::vector<Measured> measured() const override {
        return {{"semi_axes", std::max(a_, b_)}, {"semi_axis_a", a_}, {"semi_axis_b", b_}, {"energy_drift", loss_}};
    }

  private:
    exact::EllipticalDrop exact_{kS0, 0.0, kR};
    double a_{}, b_{}, energy_{}, loss_{};
};

}  // namespace

std::vector<Case> elliptical_drop_cases() {
    Case one;
    one.name = one.folder = "elliptical_drop";
    one.length_name = "R0";
    one.length = kR;
    one.resolution = 40;
    one.ladder = {14, 20, 28, 40, 56};
    one.targets = {{"semi_axis_a", 0.01, 0.003}, {"semi_axis_b", 0.01, 0.003}};
    one.main_metric = "semi_axes";
    one.adapt = [](proto::SceneDesc& scene, double resolution) { fit_drop(scene, kR, resolution); };
    one.observe = [](const scene::Run&, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Stretching>();
    };
    return {one};
}

}  // namespace headrace::validation
