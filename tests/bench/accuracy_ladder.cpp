#include "tests/bench/accuracy_ladder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "server/solver/models/registry.h"
#include "tests/validation/support/model_values.h"

namespace headrace::bench {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string text_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

bool is_named(const std::vector<std::string>& names, const std::string& name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

// The thesis's model with the sound speed that wcsph would have, and the step that this allows: as close to an
// incompressible fluid as it comes. Its own stiffness lets water give way several times over.
proto::Result<validation::Settings> stiffened(const validation::Case& one, validation::Settings settings) {
    validation::Settings other = settings;
    other.model = "wcsph";
    other.parameters.clear();
    auto scene = validation::make_scene(one, other);
    if (!scene) return scene.error();
    auto run = scene::Run::build(*scene);
    if (!run) return run.error();
    const double c0 = validation::find_sound_speed(**run);
    if (c0 == 0.0) {
        proto::Error error;
        error.code = proto::ErrorCode::scene_invalid;
        error.message = "nothing under pressure at the start tells the sound speed";
        return error;
    }
    auto own = validation::make_scene(one, settings);
    if (!own) return own.error();
    auto own_run = scene::Run::build(*own);
    if (!own_run) return own_run.error();
    settings.parameters["stiffness"] = c0 * c0;
    settings.parameters["time_step"] = 0.2 * (*own_run)->model().support_radius() / c0;  // acoustic limit, with margin
    return settings;
}

proto::Result<validation::Settings> make_settings(const validation::Case& one, const LadderOption& option,
                                                  double resolution) {
    validation::Settings settings;
    settings.resolution = resolution;
    settings.model = option.model;
    settings.brief = true;
    settings.sound_speed_factor = option.sound_speed_factor;
    settings.parameters = option.parameters;
    if (option.support_over_spacing > 0.0) settings.support_over_spacing = option.support_over_spacing;
    return option.name == "stiff" ? stiffened(one, settings) : settings;
}

double default_support() {
    for (const solver::ParameterInfo& info : solver::model_parameter_table("wcsph", 2, 1.0))
        if (info.name == "support_over_spacing") return std::get<double>(info.default_value);
    return 0.0;
}

class Ladders {
  public:
    explicit Ladders(const LadderPlan& plan) : plan_(plan), done_(load_rows(plan.csv)) {
        const bool is_new = done_.empty();
        csv_.open(plan.csv, is_new ? std::ios::out : std::ios::app);
        if (is_new) csv_ << accuracy_head() << std::endl;
    }

    bool run() {
        for (const validation::Case& one : validation::cases()) {
            if (one.ladder.empty() || !is_named(plan_.cases, one.name)) continue;
            for (const LadderOption& option : ladder_options(plan_.quick)) {
                if (!plan_.model.empty() && option.model != plan_.model) continue;
                if (repeats_default(one, option)) continue;
                if (!climb(one, option)) return false;
            }
        }
        return true;
    }

  private:
    // The default has one of the two forms of density diffusion, by the flow, and one of the two kinds of walls, by the
    // scene, if it has any.
    static bool repeats_default(const validation::Case& one, const LadderOption& option) {
        const auto form = option.parameters.find("density_diffusion"), walls = option.parameters.find("walls");
        const bool is_form = form != option.parameters.end(), is_walls = walls != option.parameters.end();
        if (!is_form && !is_walls) return false;
        validation::Settings coarse;
        coarse.resolution = one.ladder.front();
        const auto scene = validation::make_scene(one, coarse);
        if (!scene) return false;
        if (is_walls) return scene->objects.empty() || wall_kind(*scene) == std::get<std::string>(walls->second);
        const auto free_surface = scene->parameters.find("free_surface");
        const bool is_confined = free_surface != scene->parameters.end() && !std::get<bool>(free_surface->second);
        return std::get<std::string>(form->second) == (is_confined ? "fourtakas" : "antuono");
    }

    // What the parameter `walls` is by default; empty: unknown.
    static std::string wall_kind(const proto::SceneDesc& scene) {
        const auto run = scene::Run::build(scene);
        if (!run) return {};
        for (const solver::Stage& stage : (*run)->plan())
            if (stage.name == "walls" && stage.reason.find("integrals") != std::string::npos) return "integrals";
        return "particles";
    }

    // One case and option, coarse to fine. False: out of budget.
    bool climb(const validation::Case& one, const LadderOption& option) {
        double last_wall = 0.0, last_resolution = 0.0;
        std::size_t rungs = 0;
        for (const double resolution : one.ladder) {
            if (plan_.quick && ++rungs > 3) break;
            auto settings = make_settings(one, option, resolution);
            auto scene = settings ? validation::make_scene(one, *settings) : settings.error();
            if (!scene) return refuse(one, option, scene.error());
            const AccuracyRow* done = find(one, option, scene->spacing);
            double wall = done ? done->wall_s : 0.0;
            if (!done) {
                const double expected =
                    last_wall * std::pow(resolution / last_resolution, scene->dimensions + 1);  // steps grow with 1/dp
                if (last_resolution > 0.0 && expected > plan_.longest) break;
                if (seconds_since(start_) + expected > plan_.budget) return false;
                auto outcome = validation::run_case(one, *settings);
                if (!outcome) return refuse(one, option, outcome.error());
                wall = outcome->wall;
                write(one, option, scene->dimensions, *outcome);
            }
            last_wall = wall;
            last_resolution = resolution;
        }
        return true;
    }

    bool refuse(const validation::Case& one, const LadderOption& option, const proto::Error& error) {
        std::cerr << one.name << ", " << option.model << " " << option.name << ": " << error.message << '\n';
        return true;
    }

    const AccuracyRow* find(const validation::Case& one, const LadderOption& option, double spacing) const {
        for (const AccuracyRow& row : done_)
            if (row.case_name == one.name && row.option == option.name && row.model == option.model &&
                text_of(row.dp) == text_of(spacing))
                return &row;
        return nullptr;
    }

    void write(const validation::Case& one, const LadderOption& option, int dimensions,
               const validation::Outcome& outcome) {
        for (const AccuracyRow& row : make_rows(one, option.model, option.name, dimensions, outcome))
            csv_ << to_csv(row) << '\n';
        csv_.flush();
        std::printf("%-28s %-6s %-26s dp=%-9.4g N=%-7zu %8.2f s  %s=%.3g %s\n", one.name.c_str(), option.model.c_str(),
                    option.name.c_str(), outcome.spacing, outcome.particles, outcome.wall, one.main_metric.c_str(),
                    outcome.value(one.main_metric), outcome.fault.c_str());
        std::fflush(stdout);
    }

    LadderPlan plan_;
    std::vector<AccuracyRow> done_;
    std::ofstream csv_;
    Clock::time_point start_{Clock::now()};
};

}  // namespace

std::vector<LadderOption> ladder_options(bool quick) {
    std::vector<LadderOption> options{{"default"}};
    for (const double support : {2.4, 2.6, 3.0, 4.0})
        if (support != default_support()) options.push_back({"R/dp=" + text_of(support), "wcsph", support});
    if (quick) return options;
    for (const double factor : {0.5, 2.0}) options.push_back({"c0 x " + text_of(factor), "wcsph", 0.0, factor});
    const auto add = [&](const std::string& name, const proto::ParameterValue& value, const std::string& shown) {
        options.push_back({name + "=" + shown, "wcsph", 0.0, 1.0, {{name, value}}});
    };
    add("pressure_gradient", std::string("plain"), "plain");
    add("shifting", false, "false");
    add("dual_time_step", false, "false");
    add("density_diffusion", std::string("none"), "none");
    for (const char* form : {"fourtakas", "antuono"}) add("density_diffusion", std::string(form), form);
    add("state_equation", std::string("tait"), "tait");
    add("artificial_viscosity", 0.02, "0.02");
    for (const char* kind : {"particles", "integrals"}) add("walls", std::string(kind), kind);
    options.push_back({"default", "thesis"});
    options.push_back({"stiff", "thesis"});
    return options;
}

bool run_ladders(const LadderPlan& plan) {
    return Ladders(plan).run();
}

}  // namespace headrace::bench
