#include "tests/bench/accuracy_costs.h"

#include <time.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>
#include <vector>

#include "tests/validation/support/case.h"
#include "tests/validation/support/model_values.h"

namespace headrace::bench {

namespace {

constexpr int kRounds = 15;
constexpr double kRoundParticleSteps = 60'000;  // about 0.1 s a turn
constexpr double kRoom = 4.0;                   // [m] to fall into without walls

struct Flow {
    const char* title;
    const char* case_name;
    double resolution{};
    double developed{};  // [s] from when it is measured
    bool has_free_surface{};
};
constexpr Flow kFlows[] = {
    {"dam break after its impact (2D, free surface, walls)", "dam_break_pressure", 40, 0.8, true},
    {"Taylor-Green vortices (2D, confined, viscous, no walls)", "taylor_green_re100_perturbed", 56, 0.3, false},
};

struct Option {
    std::string name;
    proto::Parameters parameters{};
    double support{0.0};  // [spacings]; 0: the default
    double sound_speed_factor{1.0};
    bool has_walls{true};
    bool follows_energies{false};
};

std::vector<Option> options_of(const Flow& flow) {
    using Text = std::string;
    std::vector<Option> options{
        {"default against itself"},
        {"density_diffusion none", {{"density_diffusion", Text("none")}}},
        {"density_diffusion molteni_colagrossi", {{"density_diffusion", Text("molteni_colagrossi")}}},
        {flow.has_free_surface ? "density_diffusion fourtakas" : "density_diffusion antuono",
         {{"density_diffusion", Text(flow.has_free_surface ? "fourtakas" : "antuono")}}},
        {"pressure_gradient plain", {{"pressure_gradient", Text("plain")}}},
        {flow.has_free_surface ? "pressure_gradient difference" : "pressure_gradient adjoint",
         {{"pressure_gradient", Text(flow.has_free_surface ? "difference" : "adjoint")}}},
        {"shifting off", {{"shifting", false}}},
        {"artificial_viscosity 0", {{"artificial_viscosity", 0.0}}},
        {"artificial_viscosity_form monaghan", {{"artificial_viscosity_form", Text("monaghan")}}},
        {"state_equation tait", {{"state_equation", Text("tait")}}},
        {"dual_time_step off", {{"dual_time_step", false}}},
        {"sound speed x 2", {}, 0.0, 2.0},
        {"R/dp 2.4", {}, 2.4},
        {"R/dp 2.6", {}, 2.6},
        {"R/dp 4", {}, 4.0},
        {"kernel wendland_c4", {{"kernel", Text("wendland_c4")}}},
        {"kernel quintic_spline", {{"kernel", Text("quintic_spline")}}},
        {"kernel cubic_spline", {{"kernel", Text("cubic_spline")}}},
        {"energy budget followed", {}, 0.0, 1.0, true, true},
    };
    // Too little of either to change the flow or the step within the measurement.
    const proto::Parameters viscous{{"viscosity", 1.0}}, tense{{"surface_tension", 0.07}};
    const auto with = [](proto::Parameters parameters, const char* name, const char* value) {
        parameters[name] = Text(value);
        return parameters;
    };
    if (flow.has_free_surface) {
        options.push_back({"viscosity on (monaghan_gingold)", with(viscous, "viscosity_form", "monaghan_gingold")});
        options.push_back({"viscosity on (morris)", with(viscous, "viscosity_form", "morris")});
        options.push_back({"surface tension on (continuum)", with(tense, "tension_form", "continuum")});
        options.push_back({"surface tension on (thesis)", with(tense, "tension_form", "thesis")});
        options.push_back({"tension_control off", {{"tension_control", false}}});
        options.push_back({"walls taken away", {}, 0.0, 1.0, false});
    } else {
        options.push_back({"viscosity 0", {{"viscosity", 0.0}}});
        options.push_back({"viscosity_form monaghan_gingold", with({}, "viscosity_form", "monaghan_gingold")});
    }
    return options;
}

double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

bool complain(const Option& option, const std::string& what) {
    std::cerr << "headrace_bench: " << option.name << ": " << what << '\n';
    return false;
}

// Changes what the option is about in a developed run. The sound speed is another from the start; the rule, asked anew,
// would answer to the speeds of now.
bool apply(const Option& option, scene::Run& run) {
    proto::Parameters parameters = option.parameters;
    if (option.support > 0.0) parameters["support_over_spacing"] = option.support;
    if (!parameters.empty()) {
        parameters["sound_speed"] = validation::find_sound_speed(run);
        if (const auto status = run.set_parameters(parameters); !status)
            return complain(option, status.error().message);
    }
    if (!option.has_walls)
        while (!run.objects().empty()) {
            const std::string name = run.objects().front().name;
            if (const auto status = run.remove_object(name); !status) return complain(option, status.error().message);
        }
    run.follow_energies(option.follows_energies);
    return true;
}

// The flow as the defaults develop it, then with the option: all have the same particles to deal with. room [m]: by
// which the domain is larger on each side.
std::unique_ptr<scene::Run> develop(const Flow& flow, const Option& option, double room) {
    validation::Settings settings;
    settings.resolution = flow.resolution;
    settings.sound_speed_factor = option.sound_speed_factor;
    auto scene = validation::make_scene(*validation::find_case(flow.case_name), settings);
    if (scene) {
        for (double& low : scene->domain.min) low -= room;
        for (double& high : scene->domain.max) high += room;
    }
    auto built = scene ? scene::Run::build(*scene) : scene.error();
    if (!built) {
        complain(option, built.error().message);
        return nullptr;
    }
    std::unique_ptr<scene::Run> run = std::move(*built);
    while (run->time() < flow.developed) {
        if (const solver::StepReport& report = run->step(); report.fault) {
            complain(option, report.fault->remedy);
            return nullptr;
        }
    }
    return apply(option, *run) ? std::move(run) : nullptr;
}

struct Turn {
    double per_step{};    // [s] of processor time per particle and step
    double per_second{};  // [s] of processor time per simulated second
};

// Nothing: the run broke.
std::optional<Turn> take_turn(const Option& option, scene::Run& run) {
    const auto particles = static_cast<double>(run.particles().size());
    const int steps = std::max(1, static_cast<int>(kRoundParticleSteps / particles));
    double start = 0.0, from = 0.0;
    for (int k = -1; k < steps; ++k) {
        if (k == 0) {  // the step before warmed the caches
            start = processor_seconds();
            from = run.time();
        }
        if (const solver::StepReport& report = run.step(); report.fault) {
            complain(option, report.fault->remedy);
            return std::nullopt;
        }
    }
    const double spent = processor_seconds() - start;
    return Turn{spent / steps / particles, spent / (run.time() - from)};
}

// Median and quartiles.
struct Spread {
    double low{}, median{}, high{};
};
Spread spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto at = [&](std::size_t quarters) { return values[quarters * (values.size() - 1) / 4]; };
    return {at(1), at(2), at(3)};
}

struct Cost {
    std::string flow, option;
    std::size_t particles{};
    Spread step, second;  // over the default's
    double seconds{};     // [s] per particle and step, median
};

// The option's turns, each next to one of the default's.
std::optional<Cost> compare(const Flow& flow, const Option& option) {
    const double room = option.has_walls ? 0.0 : kRoom;
    const auto standard = develop(flow, {"default"}, room);  // afresh, so that it has the same age
    const auto run = develop(flow, option, room);
    if (!standard || !run) return std::nullopt;
    std::vector<double> step, second, seconds;
    for (int round = 0; round < kRounds; ++round) {
        const auto a = take_turn({"default"}, *standard), b = take_turn(option, *run);
        if (!a || !b) return std::nullopt;
        step.push_back(b->per_step / a->per_step);
        second.push_back(b->per_second / a->per_second);
        seconds.push_back(b->per_step);
    }
    return Cost{flow.case_name,  option.name,       standard->particles().size(),
                spread_of(step), spread_of(second), spread_of(seconds).median};
}

std::string row_of(const Cost& cost) {
    char text[256];
    std::snprintf(text, sizeof text, "| %s | %.2f (%.2f-%.2f) | %.2f (%.2f-%.2f) |\n", cost.option.c_str(),
                  cost.step.median, cost.step.low, cost.step.high, cost.second.median, cost.second.low,
                  cost.second.high);
    return text;
}

std::string csv_row_of(const Cost& cost) {
    char text[256];
    std::snprintf(text, sizeof text, "%s,%s,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g\n", cost.flow.c_str(),
                  cost.option.c_str(), 1e6 * cost.seconds, cost.step.median, cost.step.low, cost.step.high,
                  cost.second.median, cost.second.low, cost.second.high);
    return text;
}

std::string head_of(const Flow& flow, const Cost& first) {
    char text[320];
    std::snprintf(text, sizeof text,
                  "\n## %s\n\n`%s`, %zu particles, after %g s. Default: %.2f us per particle and step.\n\n"
                  "| option | per particle and step | per simulated second |\n|---|---|---|\n",
                  flow.title, flow.case_name, first.particles, flow.developed, 1e6 * first.seconds);
    return text;
}

const char* kHead =
    "# Cost of each option of wcsph\n\n"
    "Processor time over that of the default, one thread, written by `headrace_bench accuracy --costs`. The default\n"
    "develops the flow; then the option is set and takes turns with the default. Median of the ratios of 15 pairs of\n"
    "turns, quartiles in brackets. The first row, the default against itself, tells what a table is worth. A step\n"
    "holds up to 5 acoustic steps: what changes their number (sound speed, length of the step) changes both columns.\n"
    "So does a flow that turns noisy, and thus faster, within the measurement (density_diffusion none, shifting "
    "off).\n";

}  // namespace

bool measure_costs(const std::string& folder) {
    std::string table = kHead;
    std::string csv =
        "flow,option,us_per_particle_step,step_ratio,step_low,step_high,second_ratio,second_low,"
        "second_high\n";
    bool is_complete = true;
    for (const Flow& flow : kFlows) {
        bool is_first = true;
        for (const Option& option : options_of(flow)) {
            const auto cost = compare(flow, option);
            if (is_first && cost) table += head_of(flow, *cost);
            is_first = false;
            is_complete = is_complete && cost;
            table += cost ? row_of(*cost) : "| " + option.name + " | broke | broke |\n";
            if (cost) csv += csv_row_of(*cost);
            std::cerr << (cost ? row_of(*cost) : option.name + " broke\n");
        }
    }
    std::ofstream(folder + "/costs.csv") << csv;
    std::ofstream(folder + "/costs.md") << table;
    std::cout << table;
    return is_complete;
}

}  // namespace headrace::bench
