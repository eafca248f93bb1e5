// Steps from 0.2 to 2 times the stated limits.
#include "tests/stability/cases/scenes.h"

namespace headrace::stability {

namespace {

constexpr double kDx = 0.01;  // [m]

proto::SceneDesc dam_break() {
    proto::SceneDesc scene = make_scene(2, kDx, 2.0);
    scene.fluids.push_back(make_pool({0.0, 0.0, 0.0}, {0.2, 0.3, 0.0}));
    scene.objects.push_back(make_container({0.0, 0.0, 0.0}, {0.6, 1.5, 0.0}));
    return scene;
}

proto::SceneDesc still_water() {
    proto::SceneDesc scene = make_scene(2, kDx, 2.0);
    scene.fluids.push_back(make_pool({0.0, 0.0, 0.0}, {0.3, 0.2, 0.0}));
    scene.objects.push_back(make_container({0.0, 0.0, 0.0}, {0.3, 0.6, 0.0}));
    return scene;
}

// The viscous criterion limits it: Re = V L/nu = 0.1 * 0.2/0.02 = 1.
proto::SceneDesc syrup() {
    proto::SceneDesc scene = make_scene(2, kDx, 2.0);
    proto::FluidDesc fluid = make_block("syrup", {0.0, 0.0, 0.0}, {0.2, 0.2, 0.0});
    fluid.velocity = {std::string("0.1*sin(pi*x/0.1)*cos(pi*y/0.1)"), std::string("-0.1*cos(pi*x/0.1)*sin(pi*y/0.1)"),
                      0.0};
    scene.fluids.push_back(fluid);
    scene.domain.min = {0.0, 0.0, 0.0};
    scene.domain.max = {0.2, 0.2, 0.0};
    scene.domain.periodic = {true, true, false};
    scene.parameters["gravity"] = proto::Vec3{};
    scene.parameters["viscosity"] = 20.0;
    scene.parameters["free_surface"] = false;
    return scene;
}

// The same criterion with the form of viscosity for free surfaces.
proto::SceneDesc still_syrup() {
    proto::SceneDesc scene = still_water();
    scene.parameters["viscosity"] = 100.0;
    return scene;
}

// Vortices of high Reynolds number: the advective criterion and shifting.
proto::SceneDesc vortices() {
    proto::SceneDesc scene = syrup();
    scene.parameters["viscosity"] = 0.02;
    return scene;
}

proto::SceneDesc drop_in_capillary_waves() {
    proto::SceneDesc scene = make_scene(2, 1e-4, 0.02);
    proto::FluidDesc fluid = make_block("drop", {-1e-3, -1e-3, 0.0}, {1e-3, 1e-3, 0.0});
    scene.fluids.push_back(fluid);
    scene.parameters["gravity"] = proto::Vec3{};
    scene.parameters["surface_tension"] = 0.07;
    scene.parameters["reference_speed"] = 0.5;
    return scene;
}

struct Base {
    const char* name;
    proto::SceneDesc scene;
    double duration;  // [s]
    bool conserves_momentum;
    bool dual;
};

}  // namespace

std::vector<Scenario> step_scenarios() {
    const Base bases[] = {
        {"step_dam_break", dam_break(), 0.8, false, true},
        {"step_single", dam_break(), 0.8, false, false},
        {"step_still", still_water(), 1.5, false, true},
        {"step_viscous", syrup(), 0.5, true, true},
        {"step_viscous_free", still_syrup(), 0.2, false, true},
        {"step_vortices", vortices(), 2.0, true, true},
        {"step_tension", drop_in_capillary_waves(), 0.02, true, true},
    };
    std::vector<Scenario> list;
    for (const Base& base : bases) {
        for (const double factor : {0.2, 0.5, 1.0, 1.5, 2.0}) {
            Scenario one{base.name, "x" + short_text(factor), base.scene, base.duration};
            one.scene.parameters["cfl"] = 0.6 * factor;  // the defaults times the factor
            one.scene.parameters["advective_cfl"] = 0.25 * factor;
            one.scene.parameters["dual_time_step"] = base.dual;
            one.is_beyond_limits = factor > 1.0;
            one.conserves_momentum = base.conserves_momentum;
            one.is_brief =
                !base.scene.parameters.contains("surface_tension") && base.dual && (factor == 1.0 || factor == 2.0);
            list.push_back(std::move(one));
        }
    }
    return list;
}

}  // namespace headrace::stability
