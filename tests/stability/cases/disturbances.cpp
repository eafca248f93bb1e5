// Parameters and walls changed violently while running.
#include <cmath>
#include <stdexcept>

#include "tests/stability/cases/scenes.h"

namespace headrace::stability {

namespace {

constexpr double kDx = 0.01;  // [m]

// Half a closed box of water at rest.
proto::SceneDesc half_full_box() {
    proto::SceneDesc scene = make_scene(2, kDx, 2.0);
    scene.fluids.push_back(make_pool({0.0, 0.0, 0.0}, {0.3, 0.2, 0.0}));
    scene.objects.push_back(make_container({0.0, 0.0, 0.0}, {0.3, 0.4, 0.0}));
    return scene;
}

void must(const proto::Status& status) {
    if (!status) throw std::logic_error("the stability gate: " + status.error().message + " " + status.error().path);
}

// Applies the settings in turn, one every so many steps, over and over.
std::function<bool(scene::Run&)> cycle(std::vector<proto::Parameters> settings, std::uint64_t every) {
    return [settings = std::move(settings), every](scene::Run& run) {
        const std::uint64_t step = run.step_number();
        if (step == 0 || step % every != 0) return false;
        must(run.set_parameters(settings[(step / every) % settings.size()]));
        return true;
    };
}

struct Change {
    const char* name;
    std::vector<proto::Parameters> settings;
};

std::vector<Change> make_changes() {
    const auto gravity = [](double x, double y) { return proto::Parameters{{"gravity", proto::Vec3{x, y, 0.0}}}; };
    const auto number = [](const char* name, double value) { return proto::Parameters{{name, value}}; };
    const auto word = [](const char* name, const char* value) { return proto::Parameters{{name, std::string(value)}}; };
    return {
        {"change_gravity", {gravity(0, kGravity), gravity(10 * kGravity, 0), gravity(0, 0), gravity(0, -kGravity)}},
        {"change_viscosity", {number("viscosity", 0.0), number("viscosity", 100.0), number("viscosity", 1.0)}},
        {"change_density",
         {number("rest_density", 1000.0), number("rest_density", 5000.0), number("rest_density", 200.0)}},
        {"change_sound", {number("sound_speed", 20.0), number("sound_speed", 80.0), number("sound_speed", 20.0)}},
        {"change_kernel",
         {word("kernel", "wendland_c4"), word("kernel", "cubic_spline"), word("kernel", "quintic_spline"),
          word("kernel", "wendland_c2")}},
        {"change_support",
         {number("support_over_spacing", 4.0), number("support_over_spacing", 2.4),
          number("support_over_spacing", 3.0)}},
        {"change_diffusion",
         {word("density_diffusion", "none"),
          word("density_diffusion", "antuono"),
          word("density_diffusion", "fourtakas"),
          {{"shifting", false}},
          {{"shifting", true}}}},
        {"change_state_eq", {word("state_equation", "tait"), word("state_equation", "linear")}},
        {"change_gradient",
         {word("pressure_gradient", "difference"), word("pressure_gradient", "plain"),
          word("pressure_gradient", "automatic")}},
        {"change_tension", {number("surface_tension", 1.0), number("surface_tension", 0.0)}},
    };
}

void add_changes(std::vector<Scenario>& list) {
    for (const Change& change : make_changes()) {
        for (const std::uint64_t every : {5, 50, 200}) {
            Scenario one{change.name, "every " + std::to_string(every), half_full_box(), 1.0};
            one.most_steps = 1500;
            one.disturb = cycle(change.settings, every);
            // The difference form gains energy at free surfaces; it is for confined flow. A sound speed that goes up
            // and down fourfold within an acoustic period pumps energy into the fluid.
            one.is_beyond_limits = one.name == "change_gradient" || (one.name == "change_sound" && every == 5);
            one.is_brief = every == 50;
            list.push_back(std::move(one));
        }
    }
}

// A piston that jumps into the water and out again.
void add_jumps(std::vector<Scenario>& list) {
    for (const double jump : {0.5, 1.0, 3.0}) {
        Scenario one{"jumping_piston", short_text(jump) + " dx", half_full_box(), 1.0};
        one.scene.objects.push_back(make_obstacle("piston", proto::BoxDesc{{0.12, 0.25, 0.0}, {0.18, 0.35, 0.0}}));
        one.disturb = [jump](scene::Run& run) {
            const std::uint64_t step = run.step_number(), turns = static_cast<std::uint64_t>(0.2 / (jump * kDx));
            if (step == 0 || step % 20 != 0) return false;
            const bool goes_down = (step / 20 - 1) / turns % 2 == 0;
            const double way = (goes_down ? -1.0 : 1.0) * jump * kDx;
            must(run.move_object("piston", {}, proto::Vec3{0.0, way, 0.0}));
            return true;
        };
        one.is_beyond_limits = jump > 1.0;  // fluid in its way is put on its surface, many particles in one place
        one.is_brief = jump == 1.0;
        list.push_back(std::move(one));
    }
}

void add_paddles(std::vector<Scenario>& list) {
    for (const double speed : {0.5, 2.0, 5.0}) {
        Scenario one{"paddle", short_text(speed) + " m/s", half_full_box(), 1.0};
        const double omega = speed / 0.05;
        one.scene.objects.push_back(make_obstacle("paddle", proto::BoxDesc{{0.14, 0.05, 0.0}, {0.16, 0.25, 0.0}}));
        proto::MotionDesc motion;
        motion.displacement = proto::ScalarVec3{"0.05*sin(" + short_text(omega) + "*t)", 0.0, 0.0};
        one.scene.objects.back().motion = motion;
        one.scene.fluids.front().shape = proto::DifferenceDesc{
            {proto::BoxDesc{{0.0, 0.0, 0.0}, {0.3, 0.2, 0.0}}, proto::BoxDesc{{0.13, 0.04, 0.0}, {0.17, 0.26, 0.0}}}};
        one.has_moving_walls = true;
        one.duration = 0.5;
        one.is_beyond_limits = speed > 1.0;  // it throws spray at more than half the speed of sound
        one.is_brief = speed == 0.5;
        list.push_back(std::move(one));
    }
    for (const double turns : {1.0, 5.0}) {  // [1/s]
        Scenario one{"stirrer", short_text(turns) + " /s", half_full_box(), 1.0};
        one.scene.objects.push_back(make_obstacle("blade", proto::BoxDesc{{0.08, 0.095, 0.0}, {0.22, 0.105, 0.0}}));
        proto::MotionDesc motion;
        motion.angle = proto::Scalar{short_text(turns) + "*2*pi*t*t/(t+0.1)"};
        motion.pivot = {0.15, 0.1, 0.0};
        one.scene.objects.back().motion = motion;
        one.scene.fluids.front().shape = proto::DifferenceDesc{
            {proto::BoxDesc{{0.0, 0.0, 0.0}, {0.3, 0.2, 0.0}}, proto::BoxDesc{{0.07, 0.09, 0.0}, {0.23, 0.11, 0.0}}}};
        one.has_moving_walls = true;
        one.duration = 0.3;
        list.push_back(std::move(one));
    }
}

// Objects that come and go in the midst of the fluid.
void add_visitors(std::vector<Scenario>& list) {
    const std::pair<const char*, proto::ShapeDesc> shapes[] = {
        {"sphere", proto::SphereDesc{{0.15, 0.1, 0.0}, 0.04}},
        {"box", proto::BoxDesc{{0.1, 0.05, 0.0}, {0.2, 0.1, 0.0}}},
        {"panel", proto::BoxDesc{{0.145, 0.02, 0.0}, {0.155, 0.3, 0.0}}},
    };
    for (const auto& [name, shape] : shapes) {
        Scenario one{"added_and_removed", name, half_full_box(), 1.0};
        one.disturb = [shape = shape](scene::Run& run) {
            const std::uint64_t step = run.step_number();
            if (step == 0 || step % 100 != 0) return false;
            if ((step / 100) % 2 == 1)
                must(run.add_object(make_obstacle("visitor", shape)));
            else
                must(run.remove_object("visitor"));
            return true;
        };
        one.is_brief = std::string(name) == "sphere";
        list.push_back(std::move(one));
    }
    // The box that holds the water goes; a larger one comes.
    Scenario one{"container_changed", "larger", half_full_box(), 0.6};
    one.scene.objects.push_back(make_container({-0.2, -0.2, 0.0}, {0.6, 0.8, 0.0}));
    one.scene.objects.back().name = "outer";
    one.disturb = [](scene::Run& run) {
        if (run.step_number() != 20) return false;
        must(run.remove_object("tank"));
        return true;
    };
    one.is_brief = true;
    list.push_back(one);
    Scenario smaller{"container_changed", "smaller", half_full_box(), 0.6};
    smaller.disturb = [](scene::Run& run) {
        if (run.step_number() != 20) return false;
        must(run.remove_object("tank"));
        must(run.add_object(make_container({0.02, 0.0, 0.0}, {0.28, 0.6, 0.0})));
        return true;
    };
    list.push_back(smaller);
}

}  // namespace

std::vector<Scenario> disturbance_scenarios() {
    std::vector<Scenario> list;
    add_changes(list);
    add_jumps(list);
    add_paddles(list);
    add_visitors(list);
    return list;
}

}  // namespace headrace::stability
