// Bad starts: coincident particles, random places; and fluid under tension.
#include "tests/stability/cases/scenes.h"

namespace headrace::stability {

namespace {

constexpr double kDx = 0.01;  // [m]

proto::SceneDesc open_box() {
    proto::SceneDesc scene = make_scene(2, kDx, 2.0);
    scene.objects.push_back(make_container({0.0, 0.0, 0.0}, {0.3, 1.0, 0.0}));
    return scene;
}

// Twice the fluid in the same place, the second shifted by so many spacings.
void add_coincident(std::vector<Scenario>& list) {
    for (const double shift : {0.0, 0.001, 0.25, 0.5}) {
        Scenario one{"coincident", short_text(shift) + " dx", open_box(), 0.5};
        one.scene.fluids.push_back(make_block("one", {0.1, 0.0, 0.0}, {0.2, 0.1, 0.0}));
        one.scene.fluids.push_back(
            make_block("other", {0.1 + shift * kDx, shift * kDx, 0.0}, {0.2 + shift * kDx, 0.1 + shift * kDx, 0.0}));
        one.judged_from = 0.3;
        one.is_beyond_limits = true;  // twice the mass in one place is no fluid at rest density
        one.is_brief = shift == 0.0;
        list.push_back(std::move(one));
    }
}

void add_random_starts(std::vector<Scenario>& list) {
    for (const double jitter : {0.1, 0.25, 0.5}) {
        Scenario one{"random_start", short_text(jitter) + " dx", open_box(), 0.5};
        one.scene.fluids.push_back(make_pool({0.0, 0.0, 0.0}, {0.3, 0.2, 0.0}));
        one.scene.fluids.back().start = {false, jitter, 7};
        one.judged_from = 0.25;
        one.is_brief = jitter == 0.5;
        list.push_back(std::move(one));
        Scenario confined{"random_start_vortex", short_text(jitter) + " dx", make_scene(2, kDx, 1.0), 2.0};
        proto::FluidDesc fluid = make_block("all", {0.0, 0.0, 0.0}, {0.3, 0.3, 0.0});
        fluid.velocity = {std::string("0.1*sin(pi*x/0.15)*cos(pi*y/0.15)"),
                          std::string("-0.1*cos(pi*x/0.15)*sin(pi*y/0.15)"), 0.0};
        fluid.start = {false, jitter, 7};
        confined.scene.fluids.push_back(fluid);
        confined.scene.domain = {{0.0, 0.0, 0.0}, {0.3, 0.3, 0.0}, {true, true, false}};
        confined.scene.parameters["gravity"] = proto::Vec3{};
        confined.scene.parameters["free_surface"] = false;
        confined.judged_from = 0.5;
        confined.conserves_momentum = true;
        list.push_back(std::move(confined));
    }
}

// Patches that are pulled apart: stretched, and spun.
void add_patches(std::vector<Scenario>& list) {
    for (const bool spins : {false, true}) {
        for (const double rate : {1.0, 10.0}) {  // [1/s]
            Scenario one{spins ? "spinning_patch" : "stretching_patch", short_text(rate) + " /s",
                         make_scene(2, kDx, 3.0), (spins ? 4.0 : 2.0) / rate};
            proto::FluidDesc fluid = make_block("patch", {-0.15, -0.15, 0.0}, {0.15, 0.15, 0.0});
            const std::string s = short_text(rate);
            if (spins)
                fluid.velocity = {"-" + s + "*y", s + "*x", 0.0};
            else
                fluid.velocity = {s + "*x", "-" + s + "*y", 0.0};
            one.scene.fluids.push_back(fluid);
            one.scene.parameters["gravity"] = proto::Vec3{};
            one.conserves_momentum = true;
            one.is_brief = rate == 1.0;
            list.push_back(std::move(one));
        }
    }
}

// Confined fluid under a tension of this share of rho0 c0^2.
void add_tension(std::vector<Scenario>& list) {
    for (const double share : {0.01, 0.05, 0.2}) {
        for (const bool periodic : {true, false}) {
            Scenario one{periodic ? "tension_periodic" : "tension_in_box", short_text(-share) + " rho c2",
                         make_scene(2, kDx, 1.0), 1.0};
            proto::FluidDesc fluid = make_block("all", {0.0, 0.0, 0.0}, {0.3, 0.3, 0.0});
            fluid.velocity = {std::string("0.1*sin(pi*x/0.15)*cos(pi*y/0.15)"),
                              std::string("-0.1*cos(pi*x/0.15)*sin(pi*y/0.15)"), 0.0};
            fluid.pressure = proto::Scalar{-share * 1000.0};  // c0 = 1 m/s
            fluid.start = {false, 0.05, 3};
            one.scene.fluids.push_back(fluid);
            if (periodic)
                one.scene.domain = {{0.0, 0.0, 0.0}, {0.3, 0.3, 0.0}, {true, true, false}};
            else
                one.scene.objects.push_back(make_container({0.0, 0.0, 0.0}, {0.3, 0.3, 0.0}));
            one.scene.parameters["gravity"] = proto::Vec3{};
            one.scene.parameters["free_surface"] = false;
            one.scene.parameters["sound_speed"] = 1.0;
            one.conserves_momentum = periodic;
            one.is_brief = share == 0.05;
            list.push_back(std::move(one));
        }
    }
}

}  // namespace

std::vector<Scenario> start_scenarios() {
    std::vector<Scenario> list;
    add_coincident(list);
    add_random_starts(list);
    add_patches(list);
    add_tension(list);
    return list;
}

}  // namespace headrace::stability
