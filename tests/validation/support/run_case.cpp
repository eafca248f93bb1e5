#include <omp.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "proto/messages_json.h"
#include "server/solver/models/registry.h"
#include "tests/validation/support/case.h"
#include "tests/validation/support/leaks.h"
#include "tests/validation/support/model_values.h"

namespace headrace::validation {

namespace {

// With one thread its processor time: the wall time of a machine that does nothing else. With more the wall time.
double seconds_now() {
    if (omp_get_max_threads() > 1)
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

proto::Error error_of(proto::ErrorCode code, const std::string& message) {
    proto::Error error;
    error.code = code;
    error.message = message;
    return error;
}

bool is_known(const std::vector<solver::ParameterInfo>& table, const std::string& name) {
    for (const solver::ParameterInfo& info : table)
        if (info.name == name) return true;
    return false;
}

// The scenes are written for wcsph: another model takes of their parameters what it has, its own numerics otherwise.
void keep_known_parameters(proto::SceneDesc& scene) {
    const auto table = solver::model_parameter_table(scene.model, scene.dimensions, scene.spacing);
    std::erase_if(scene.parameters, [&](const auto& entry) { return !is_known(table, entry.first); });
}

void set_support(proto::SceneDesc& scene, double support_over_spacing) {
    const auto table = solver::model_parameter_table(scene.model, scene.dimensions, scene.spacing);
    if (is_known(table, "support_radius"))
        scene.parameters["support_radius"] = support_over_spacing * scene.spacing;
    else
        scene.parameters["support_over_spacing"] = support_over_spacing;
}

// The sound speed a model chooses is known once the scene is built.
proto::Status scale_sound_speed(proto::SceneDesc& scene, double factor) {
    auto probe = scene::Run::build(scene);
    if (!probe) return probe.error();
    const double sound_speed = find_sound_speed(**probe);
    if (sound_speed == 0.0)
        return error_of(proto::ErrorCode::parameter_not_found, scene.model + " has no sound speed to scale");
    if (scene.model == "thesis")
        scene.parameters["stiffness"] = std::pow(factor * sound_speed, 2);
    else
        scene.parameters["sound_speed"] = factor * sound_speed;
    return proto::Done{};
}

}  // namespace

double RegularObserver::next_sample(double t) const {
    return (std::floor(t / interval_ * (1 + 1e-12)) + 1) * interval_;
}

const std::vector<Case>& cases() {
    static const std::vector<Case> all = [] {
        std::vector<Case> list;
        for (const auto make :
             {oscillating_drop_cases, elliptical_drop_cases, taylor_green_cases, channel_cases, cavity_cases,
              hydrostatic_cases, standing_wave_cases, acoustic_wave_cases, capillary_drop_cases, dam_break_front_cases,
              dam_break_pressure_cases, lobovsky_cases, kleefsman_cases, free_fall_cases, balance_cases})
            for (Case& one : make()) list.push_back(std::move(one));
        return list;
    }();
    return all;
}

const Case* find_case(const std::string& name) {
    for (const Case& one : cases())
        if (one.name == name) return &one;
    return nullptr;
}

proto::Result<proto::SceneDesc> load_scene(const Case& one) {
    const std::string path = std::string(HEADRACE_SOURCE_DIR) + "/tests/validation/" + one.folder + "/scene.json";
    std::ifstream file(path);
    if (!file) return error_of(proto::ErrorCode::scene_not_found, "cannot read " + path);
    std::ostringstream text;
    text << file.rdbuf();
    return proto::parse_scene(text.str());
}

proto::Result<proto::SceneDesc> make_scene(const Case& one, const Settings& settings) {
    auto loaded = load_scene(one);
    if (!loaded) return loaded.error();
    proto::SceneDesc scene = std::move(*loaded);
    const double resolution = settings.resolution.value_or(one.resolution);
    scene.spacing = one.length / resolution;
    if (one.adapt) one.adapt(scene, resolution);
    if (settings.model != scene.model) {
        const auto names = solver::model_names();
        if (std::find(names.begin(), names.end(), settings.model) == names.end())
            return error_of(proto::ErrorCode::scene_invalid, "there is no model '" + settings.model + "'");
        scene.model = settings.model;
        keep_known_parameters(scene);
    }
    if (settings.support_over_spacing) set_support(scene, *settings.support_over_spacing);
    for (const auto& [name, value] : settings.parameters) scene.parameters[name] = value;
    if (settings.sound_speed_factor != 1.0)
        if (auto status = scale_sound_speed(scene, settings.sound_speed_factor); !status) return status.error();
    return scene;
}

double Outcome::value(const std::string& metric) const {
    for (const Measured& one : metrics)
        if (one.metric == metric) return one.value;
    return std::numeric_limits<double>::quiet_NaN();
}

proto::Result<Outcome> run_case(const Case& one, const Settings& settings) {
    auto scene = make_scene(one, settings);
    if (!scene) return scene.error();
    auto built = scene::Run::build(*scene);
    if (!built) return built.error();
    scene::Run& run = **built;

    Outcome outcome;
    outcome.spacing = scene->spacing;
    outcome.support = run.model().support_radius();
    outcome.particles = run.particles().size();
    if (one.follows_energies) run.follow_energies(true);
    const auto observer = one.observe(run, settings);
    LeakCount leaks(run);
    observer->sample(run);
    leaks.sample(run);

    double next = observer->next_sample(0.0);
    while (run.time() < observer->end_time() && !observer->is_finished()) {
        const double start = seconds_now();
        const solver::StepReport& report = run.step();
        outcome.wall += seconds_now() - start;
        if (report.fault) {
            outcome.fault = "step " + std::to_string(run.step_number()) + ", t = " + std::to_string(run.time()) +
                            " s: " + report.fault->remedy;
            break;
        }
        if (run.time() < next && run.time() < observer->end_time()) continue;
        observer->sample(run);
        leaks.sample(run);
        next = observer->next_sample(run.time());
    }
    outcome.sound_speed = find_sound_speed(run);
    outcome.steps = run.step_number();
    outcome.simulated = run.time();
    outcome.metrics = observer->measured();
    outcome.metrics.push_back({"leaked", static_cast<double>(leaks.most())});
    if (!outcome.fault.empty())
        for (Measured& measured : outcome.metrics) measured.value = std::numeric_limits<double>::quiet_NaN();
    return outcome;
}

}  // namespace headrace::validation
