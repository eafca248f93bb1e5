// A hundred random small scenes: shapes, obstacles, velocities and parameters drawn by a seed.
#include <cmath>
#include <random>

#include "tests/stability/cases/scenes.h"

namespace headrace::stability {

namespace {

constexpr double kDx = 0.01;     // [m]
constexpr double kWidth = 0.4;   // [m] of the tank, two rows of fluids below a row of obstacles
constexpr double kHeight = 0.8;  // [m]

// Uniform numbers of the 32 bits of mt19937: the same with every standard library.
class Dice {
  public:
    explicit Dice(unsigned seed) : bits_(seed) {}
    double number(double low, double high) { return low + (high - low) * static_cast<double>(bits_()) / 4294967296.0; }
    bool coin(double share) { return number(0.0, 1.0) < share; }

  private:
    std::mt19937 bits_;
};

// Inside a square of this half width around the centre.
proto::ShapeDesc random_shape(Dice& dice, const proto::Vec3& c, double half) {
    const double a = dice.number(0.5, 1.0) * half, b = dice.number(0.5, 1.0) * half;
    if (dice.coin(0.4)) return proto::SphereDesc{c, a};
    return proto::BoxDesc{{c[0] - a, c[1] - b, 0.0}, {c[0] + a, c[1] + b, 0.0}};
}

proto::SceneDesc random_scene(unsigned seed) {
    Dice dice(seed);
    proto::SceneDesc scene = make_scene(2, kDx, 2.0);
    scene.objects.push_back(make_container({0.0, 0.0, 0.0}, {kWidth, kHeight, 0.0}));
    const double speed = std::pow(10.0, dice.number(-1.0, 1.0));  // [m/s] 0.1 to 10
    // Four places above one another, two beside: each holds fluid, an obstacle or nothing.
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 2; ++column) {
            const proto::Vec3 c{0.1 + 0.2 * column, 0.1 + 0.2 * row, 0.0};
            const std::string name = "at " + std::to_string(row) + std::to_string(column);
            if (dice.coin(0.5)) {
                proto::FluidDesc fluid;
                fluid.name = name;
                fluid.shape = random_shape(dice, c, 0.09);
                fluid.velocity = to_scalars({dice.number(-speed, speed), dice.number(-speed, speed), 0.0});
                if (dice.coin(0.3)) fluid.start = {false, dice.number(0.0, 0.3), static_cast<std::int64_t>(seed)};
                scene.fluids.push_back(fluid);
            } else if (dice.coin(0.3)) {
                scene.objects.push_back(make_obstacle(name, random_shape(dice, c, 0.08)));
            } else if (dice.coin(0.2)) {
                const double thick = dice.number(0.5, 2.0) * kDx;
                scene.objects.push_back(
                    make_obstacle(name, proto::BoxDesc{{c[0] - 0.08, c[1], 0.0}, {c[0] + 0.08, c[1] + thick, 0.0}}));
            }
        }
    }
    if (scene.fluids.empty()) scene.fluids.push_back(make_block("only", {0.01, 0.31, 0.0}, {0.19, 0.39, 0.0}));
    if (dice.coin(0.3)) scene.parameters["viscosity"] = std::pow(10.0, dice.number(-3.0, 1.0));
    if (dice.coin(0.3)) scene.parameters["wall_slip"] = std::string("no_slip");
    if (dice.coin(0.2)) scene.parameters["surface_tension"] = dice.number(0.01, 1.0);
    if (dice.coin(0.2)) scene.parameters["state_equation"] = std::string("tait");
    if (dice.coin(0.2)) scene.parameters["support_over_spacing"] = dice.number(2.2, 4.0);
    if (dice.coin(0.1))
        scene.parameters["gravity"] = proto::Vec3{dice.number(-10.0, 10.0), dice.number(-10.0, 10.0), 0.0};
    // What a user knows: nothing will be faster than the fluid at the start and its fall through the tank.
    scene.parameters["reference_speed"] = std::hypot(1.5 * speed, std::sqrt(2.0 * kGravity * kHeight));
    return scene;
}

}  // namespace

std::vector<Scenario> random_scenarios() {
    std::vector<Scenario> list;
    for (unsigned seed = 0; seed < 100; ++seed) {
        Scenario one{"random_" + std::to_string(seed / 10) + "x", "seed " + std::to_string(seed), random_scene(seed),
                     0.4};
        one.is_brief = seed % 10 == 1 && seed != 11;  // that one has many pairs at thin panels
        list.push_back(std::move(one));
    }
    return list;
}

}  // namespace headrace::stability
