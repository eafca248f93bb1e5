#include "tests/validation/support/case.h"

#include <cmath>

#include "tests/validation/exact/flows.h"

namespace headrace::validation {

namespace {

constexpr double kRho = 1000.0;  // [kg/m^3]

// ||v - v_exact|| / ||v_exact|| over the particles at the end.
class Decay : public RegularObserver {
  public:
    Decay(double end, double nu) : RegularObserver(end, end), nu_(nu) {}

    void sample(const scene::Run& run) override {
        const solver::Particles& particles = run.particles();
        double square = 0.0, norm = 0.0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const exact::Flow2D flow =
                exact::taylor_green(particles.x[0][i], particles.x[1][i], run.time(), 1.0, 1.0, nu_, kRho);
            square += std::pow(particles.v[0][i] - flow.u, 2) + std::pow(particles.v[1][i] - flow.v, 2);
            norm += flow.u * flow.u + flow.v * flow.v;
        }
        error_ = std::sqrt(square / norm);
    }

    std::vector<Measured> measured() const override { return {{"l2_velocity", error_}}; }

  private:
    double nu_;  // [m^2/s]
    double error_{};
};

Case make(const std::string& name, double reynolds, double jitter, double end, Target target) {
    Case one;
    one.name = name;
    one.folder = "taylor_green";
    one.length_name = "L";
    one.length = 1.0;
    one.resolution = 100;
    one.ladder = {25, 36, 50, 71, 100};
    one.targets = {std::move(target)};
    one.main_metric = "l2_velocity";
    one.adapt = [=](proto::SceneDesc& scene, double) {
        scene.parameters["viscosity"] = kRho / reynolds;
        scene.fluids.front().start.jitter = jitter;
    };
    one.observe = [=](const scene::Run&, const Settings&) -> std::unique_ptr<Observer> {
        return std::make_unique<Decay>(end, 1.0 / reynolds);
    };
    return one;
}

}  // namespace

std::vector<Case> taylor_green_cases() {
    return {make("taylor_green_re100", 100, 0.0, 1.0, {"l2_velocity", 5e-3, 2e-3}),
            make("taylor_green_re100_perturbed", 100, 0.2, 1.0, {"l2_velocity", 5e-3, 2e-3}),
            make("taylor_green_re1000", 1000, 0.0, 2.0, {"l2_velocity", 0.02, 0.01}),
            make("taylor_green_re1000_perturbed", 1000, 0.2, 2.0, {"l2_velocity", 0.02, 0.01})};
}

}  // namespace headrace::validation
