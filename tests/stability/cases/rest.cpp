// Columns in narrow gaps, and long rest.
#include "tests/stability/cases/scenes.h"

namespace headrace::stability {

namespace {

constexpr double kDx = 0.01;  // [m]

}  // namespace

std::vector<Scenario> gap_scenarios() {
    std::vector<Scenario> list;
    for (const char* slip : {"free_slip", "no_slip"}) {
        for (const int width : {1, 2, 3}) {
            for (const bool falls : {false, true}) {
                Scenario one{std::string("gap_") + slip, short_text(width) + (falls ? " dx fall" : " dx still"),
                             make_scene(2, kDx, 2.0)};
                const double low = falls ? 0.2 : 0.0;
                one.scene.fluids.push_back(make_pool({0.0, low, 0.0}, {kDx * width, low + 0.3, 0.0}));
                one.scene.fluids.back().hydrostatic = !falls;
                one.scene.objects.push_back(make_container({0.0, 0.0, 0.0}, {kDx * width, 1.0, 0.0}));
                one.scene.parameters["wall_slip"] = std::string(slip);
                one.scene.parameters["viscosity"] = std::string(slip) == "no_slip" ? 0.1 : 0.0;
                one.duration = 1.0;
                one.is_beyond_limits = width < 3;  // the walls' pressure is that of two layers of fluid
                one.is_brief = width != 3 && !falls;
                list.push_back(std::move(one));
            }
        }
    }
    return list;
}

std::vector<Scenario> rest_scenarios() {
    std::vector<Scenario> list;
    for (const int dimensions : {2, 3}) {
        for (const bool no_slip : {false, true}) {
            if (dimensions == 3 && no_slip) continue;
            Scenario one{"rest", std::string(dimensions == 2 ? "2D" : "3D") + (no_slip ? " no slip" : " free slip"),
                         make_scene(dimensions, kDx, 1.0)};
            const double side = dimensions == 2 ? 12 * kDx : 4 * kDx, depth = dimensions == 2 ? 0.0 : side;
            one.scene.fluids.push_back(make_pool({0.0, 0.0, 0.0}, {side, side, depth}));
            one.scene.objects.push_back(make_container({0.0, 0.0, 0.0}, {side, 0.5, depth}));
            one.scene.parameters["wall_slip"] = std::string(no_slip ? "no_slip" : "free_slip");
            one.scene.parameters["viscosity"] = no_slip ? 0.01 : 0.0;
            one.duration = 1e9;
            one.most_steps = 100'000;
            list.push_back(std::move(one));
        }
    }
    // The same for the tests, with the steps that they can afford.
    Scenario brief = list.front();
    brief.variant = "2D brief";
    brief.most_steps = 4'000;
    brief.is_brief = true;
    list.push_back(std::move(brief));
    return list;
}

}  // namespace headrace::stability
