// Impacts at 1 to 20 m/s: blocks on walls of every shape, drops on pools, thin jets.
#include <cmath>
#include <numbers>
#include <string_view>

#include "tests/stability/cases/scenes.h"

namespace headrace::stability {

namespace {

constexpr double kDx = 0.01;    // [m]
constexpr double kSide = 0.2;   // [m] of the block in 2D
constexpr double kSide3 = 0.1;  // [m] in 3D
constexpr double kGap = 0.02;   // [m] to the wall at the start

// A block of this side that flies down onto y = 0; its middle is at x = z = 0.
proto::SceneDesc falling_block(int dimensions, double speed) {
    // Wide enough for the jet along a floor, which runs at twice the block's speed and more.
    proto::SceneDesc scene = make_scene(dimensions, kDx, dimensions == 2 ? 3.0 : 1.2);
    scene.domain.min[1] = -3.0;
    const double half = 0.5 * (dimensions == 2 ? kSide : kSide3), depth = dimensions == 2 ? 0.0 : half;
    scene.fluids.push_back(
        make_block("block", {-half, kGap, -depth}, {half, kGap + 2 * half, depth}, {0.0, -speed, 0.0}));
    return scene;
}

// The obstacle turned about its own top edge, which points up.
proto::ObjectDesc turned(proto::ObjectDesc object, double angle) {
    proto::MotionDesc motion;
    motion.angle = proto::Scalar{angle};
    object.motion = motion;
    return object;
}

struct Target {
    const char* name;
    int dimensions;
    std::vector<proto::ObjectDesc> objects;
};

std::vector<Target> make_targets() {
    const double wide = 0.3, thick = 0.5 * kDx;
    const auto box = [](const proto::Vec3& min, const proto::Vec3& max) {
        return make_obstacle("box", proto::BoxDesc{min, max});
    };
    const auto recess = [](double depth) {
        return make_container({-0.5 * (depth > 0.0 ? kSide3 : kSide) - kDx, 0.0, -depth}, {1.0, 2.0, depth});
    };
    return {
        {"impact_plane", 2, {make_floor()}},
        {"impact_corner", 2, {box({0.0, -wide, 0.0}, {wide, 0.0, 0.0})}},
        {"impact_wedge", 2, {turned(box({0.0, -wide, 0.0}, {wide, 0.0, 0.0}), -0.25 * std::numbers::pi)}},
        {"impact_recess", 2, {recess(0.0)}},
        {"impact_panel_flat", 2, {box({-0.05, -2 * thick, 0.0}, {0.05, 0.0, 0.0})}},
        {"impact_panel_edge", 2, {box({-thick, -wide, 0.0}, {thick, 0.0, 0.0})}},
        {"impact_plane_3d", 3, {make_floor()}},
        {"impact_edge_3d", 3, {box({0.0, -wide, -wide}, {wide, 0.0, wide})}},
        {"impact_corner_3d", 3, {box({0.0, -wide, 0.0}, {wide, 0.0, wide})}},
        {"impact_panel_3d", 3, {box({-thick, -wide, -wide}, {thick, 0.0, wide})}},
    };
}

void add_blocks(std::vector<Scenario>& list) {
    for (const Target& target : make_targets()) {
        for (const double speed : {1.0, 3.0, 10.0, 20.0}) {
            Scenario one{target.name, short_text(speed) + " m/s", falling_block(target.dimensions, speed)};
            one.scene.objects = target.objects;
            one.duration = 3.0 * (target.dimensions == 2 ? kSide : kSide3) / speed;
            one.is_brief = speed == 20.0 && std::string_view(target.name) != "impact_panel_3d";
            list.push_back(std::move(one));
        }
    }
}

void add_drops(std::vector<Scenario>& list) {
    for (const int dimensions : {2, 3}) {
        for (const double speed : {1.0, 3.0, 10.0, 20.0}) {
            const double radius = dimensions == 2 ? 0.06 : 0.03, half = dimensions == 2 ? 0.25 : 0.08;
            const double deep = dimensions == 2 ? 0.12 : 0.06, depth = dimensions == 2 ? 0.0 : half;
            Scenario one{dimensions == 2 ? "drop_on_pool" : "drop_on_pool_3d", short_text(speed) + " m/s",
                         make_scene(dimensions, kDx, 3.0)};
            one.scene.fluids.push_back(make_pool({-half, 0.0, -depth}, {half, deep, depth}));
            one.scene.fluids.push_back(make_disc({0.0, deep + radius + kGap, 0.0}, radius, {0.0, -speed, 0.0}));
            one.scene.objects.push_back(make_container({-half, 0.0, -depth}, {half, 2.5, depth}));
            one.duration = 0.5 / speed;
            one.is_brief = speed == 10.0 && dimensions == 2;
            list.push_back(std::move(one));
        }
    }
}

// A thin jet of 60 spacings on a wall.
void add_jets(std::vector<Scenario>& list) {
    for (const int width : {1, 2, 3, 4, 6}) {
        for (const double speed : {2.0, 10.0}) {
            Scenario one{"jet_" + short_text(speed) + "_m_s", short_text(width) + " dx", make_scene(2, kDx, 3.0)};
            const double half = 0.5 * kDx * width;
            one.scene.fluids.push_back(
                make_block("jet", {-half, kGap, 0.0}, {half, kGap + 60 * kDx, 0.0}, {0.0, -speed, 0.0}));
            one.scene.objects.push_back(make_floor());
            one.duration = 0.7 / speed;
            one.is_brief = width == 3 && speed == 10.0;
            list.push_back(std::move(one));
        }
    }
}

}  // namespace

std::vector<Scenario> impact_scenarios() {
    std::vector<Scenario> list;
    add_blocks(list);
    add_drops(list);
    add_jets(list);
    return list;
}

}  // namespace headrace::stability
