#include "tests/bench/accuracy.h"

#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/bench/accuracy_costs.h"
#include "tests/bench/accuracy_ladder.h"
#include "tests/bench/accuracy_report.h"
#include "tests/bench/accuracy_targets.h"
#include "tests/bench/assignments.h"
#include "tests/validation/support/case.h"

namespace headrace::bench {

namespace {

struct Options {
    std::vector<std::string> cases;
    std::vector<std::string> assignments;
    validation::Settings settings;
    std::string model;
    double resolution{0.0}, support{0.0};
    int threads{1};
    bool lists{false}, draws{false}, judges{false}, climbs{false}, weighs{false};
    LadderPlan ladders;
    std::string folder{std::string(HEADRACE_SOURCE_DIR) + "/tests/bench/results"};
};

std::string describe_run(const validation::Case& one, const validation::Outcome& outcome) {
    char text[256];
    std::snprintf(text, sizeof text, "%-28s dp=%-9.4g R/dp=%-4.3g c0=%-8.4g N=%-7zu steps=%-7zu wall=%.2fs",
                  one.name.c_str(), outcome.spacing, outcome.support / outcome.spacing, outcome.sound_speed,
                  outcome.particles, outcome.steps, outcome.wall);
    std::string line = text;
    for (const validation::Measured& measured : outcome.metrics) {
        std::snprintf(text, sizeof text, " %s=%.4g", measured.metric.c_str(), measured.value);
        line += text;
    }
    return outcome.fault.empty() ? line : line + " FAULT " + outcome.fault;
}

bool run_one(const validation::Case& one, const validation::Settings& settings) {
    const auto outcome = validation::run_case(one, settings);
    if (!outcome) {
        std::cerr << "headrace_bench: " << one.name << ": " << outcome.error().message << ' ' << outcome.error().path
                  << ' ' << outcome.error().hint << '\n';
        return false;
    }
    std::cout << describe_run(one, *outcome) << std::endl;
    return outcome->fault.empty();
}

void define_options(CLI::App& app, Options& options) {
    app.add_option("--case", options.cases, "Cases; none: all")->delimiter(',');
    app.add_flag("--list", options.lists, "Names the cases");
    app.add_option("--threads", options.threads, "Threads of the solver")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--out", options.folder, "Folder of accuracy.csv, its summary and the diagrams")
        ->capture_default_str();

    app.add_flag("--ladders", options.climbs, "Measures each case over dp, R/dp, c0 and options; the default");
    app.add_flag("--quick", options.ladders.quick, "Ladders: only the three coarsest dp, over dp and R/dp");
    app.add_option("--budget", options.ladders.budget,
                   "Ladders: seconds after which no run is begun; call again to go on");
    app.add_option("--longest", options.ladders.longest, "Ladders: seconds a run may take")->capture_default_str();
    app.add_flag("--draw", options.draws, "Only summary and diagrams from the accuracy.csv there is");
    app.add_flag("--costs", options.weighs, "Measures what each option costs in processor time, on one thread");
    app.add_flag("--targets", options.judges, "Runs the cases at the resolution of their targets and judges them");

    app.add_option("--model", options.model, "Model; ladders: only this one");
    app.add_option("--resolution", options.resolution, "One run a case at this many spacings per its length");
    app.add_option("--support", options.support, "One run: support radius over spacing");
    app.add_option("--sound-speed-factor", options.settings.sound_speed_factor,
                   "One run: times the rule's sound speed");
    app.add_option("--set", options.assignments, "One run: parameter of the model, name=value; repeatable");
    app.add_flag("--brief", options.settings.brief, "One run: only the metrics that need the shortest time");
}

bool run_each(const Options& options) {
    bool all_ran = true;
    for (const validation::Case& one : validation::cases()) {
        const bool is_named = std::find(options.cases.begin(), options.cases.end(), one.name) != options.cases.end();
        if (options.cases.empty() || is_named) all_ran = run_one(one, options.settings) && all_ran;
    }
    return all_ran;
}

// Summary and diagrams of what was measured so far.
bool report(const std::string& folder, const std::string& csv) {
    const auto rows = load_rows(csv);
    std::ofstream(folder + "/accuracy.md") << summarise(rows);
    return draw_diagrams(rows, folder);
}

}  // namespace

int run_accuracy(int argc, char** argv) {
    CLI::App app{
        "Run time against error on the validation cases. With --resolution, --support, --set, --brief or\n"
        "--sound-speed-factor: one run of each case, one line each. Else the ladders, appended to accuracy.csv."};
    Options options;
    define_options(app, options);
    CLI11_PARSE(app, argc, argv);
    for (const std::string& name : options.cases) {
        if (validation::find_case(name)) continue;
        std::cerr << "headrace_bench: no case '" << name << "'; --list names them\n";
        return 2;
    }
    if (options.lists) {
        for (const validation::Case& one : validation::cases()) std::cout << one.name << '\n';
        return 0;
    }
    if (const auto wrong = take_assignments(options.assignments, options.settings.parameters)) {
        std::cerr << "headrace_bench: " << *wrong << '\n';
        return 2;
    }
    omp_set_num_threads(options.threads);
    validation::Settings& settings = options.settings;
    if (!options.model.empty()) settings.model = options.model;
    if (options.resolution > 0) settings.resolution = options.resolution;
    if (options.support > 0) settings.support_over_spacing = options.support;

    if (options.judges) return run_targets(options.cases, settings, options.folder + "/targets.md") ? 0 : 1;
    if (options.weighs) {
        omp_set_num_threads(1);
        std::filesystem::create_directories(options.folder);
        return measure_costs(options.folder) ? 0 : 1;
    }
    const bool is_single = settings.resolution || settings.support_over_spacing || !settings.parameters.empty() ||
                           settings.brief || settings.sound_speed_factor != 1.0;
    if (is_single && !options.climbs) return run_each(options) ? 0 : 1;

    options.ladders.cases = options.cases;
    options.ladders.model = options.model;
    options.ladders.csv = options.folder + "/accuracy.csv";
    std::filesystem::create_directories(options.folder);
    const bool is_done = options.draws || run_ladders(options.ladders);
    if (!is_done) std::cout << "The budget is spent: call again to go on.\n";
    return report(options.folder, options.ladders.csv) && is_done ? 0 : 1;
}

}  // namespace headrace::bench
