// headrace_bench: milliseconds per step and stage, and particle-steps per second, over the presets.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <string>

#include "server/solver/process_settings.h"
#include "tests/bench/accuracy.h"
#include "tests/bench/count_steps.h"
#include "tests/bench/report.h"
#include "tests/bench/speed.h"
#include "tests/bench/stability.h"
#include "tests/bench/strategies.h"

namespace bench = headrace::bench;

namespace {

struct Options {
    std::vector<std::string> presets{"dam_break", "dam_break_large"};
    std::vector<double> refine{1.0};
    std::vector<std::string> removed{"panel"};
    bench::Plan plan;
    std::string csv;
};

void define_options(CLI::App& app, Options& options) {
    app.add_option("preset", options.presets, "Presets to time")->capture_default_str();
    app.add_option("--refine", options.refine, "Divide the spacing by this; several: each in turn")
        ->delimiter(',')
        ->check(CLI::Range(0.1, 100.0))
        ->capture_default_str();
    app.add_option("--remove", options.removed, "Objects to leave out, where the scene has them")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--threads", options.plan.threads, "Thread counts, taking turns")
        ->delimiter(',')
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--warmup", options.plan.warmup, "Steps before the clock starts")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("--steps", options.plan.steps, "Steps per window")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--repeat", options.plan.repeat, "Windows per thread count")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--csv", options.csv, "Write the figures to this file too");
}

// Prints a line per thread count; returns false when the case could not be run.
bool run_case(const std::string& preset, double refine, const Options& options, std::ostream& csv) {
    auto one = bench::make_case(preset, refine, options.removed);
    auto timings = one ? bench::measure(*one, options.plan) : one.error();
    if (!timings) {
        std::cerr << "headrace_bench: " << preset << ": " << timings.error().message << '\n';
        return false;
    }
    for (const bench::Timing& timing : *timings) {
        std::cout << bench::table_line(timing) << std::endl;
        csv << bench::csv_row(timing) << '\n';
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    headrace::solver::restart_with_settings(argv);  // as the server does
    if (argc > 1 && std::string(argv[1]) == "accuracy") return bench::run_accuracy(argc - 1, argv + 1);
    if (argc > 1 && std::string(argv[1]) == "stability") return bench::run_stability(argc - 1, argv + 1);
    if (argc > 1 && std::string(argv[1]) == "strategies") return bench::run_strategies(argc - 1, argv + 1);
    if (argc > 1 && std::string(argv[1]) == "speed") return bench::run_speed(argc - 1, argv + 1);
    if (argc > 1 && std::string(argv[1]) == "count-steps") return bench::run_count_steps(argc - 1, argv + 1);
    CLI::App app{
        "Times the solver over the presets. One line per case and thread count.\n"
        "`headrace_bench accuracy` measures run time against error on the validation cases, `headrace_bench\n"
        "stability` runs the scenes that try to break a model, `headrace_bench strategies` compares ways to sum\n"
        "over pairs, `headrace_bench speed` times the pair engine and the models in developed flow, `headrace_bench\n"
        "count-steps` steps a scene for plan_costs.py to count its instructions: see their --help."};
    Options options;
    define_options(app, options);
    CLI11_PARSE(app, argc, argv);

    std::ofstream csv;
    if (!options.csv.empty()) {
        csv.open(options.csv);
        if (!csv) {
            std::cerr << "headrace_bench: cannot write " << options.csv << '\n';
            return 2;
        }
        csv << bench::csv_head() << '\n';
    }
    std::cout << bench::table_head() << '\n';
    bool all_ran = true;
    for (const std::string& preset : options.presets)
        for (const double refine : options.refine) all_ran = run_case(preset, refine, options, csv) && all_ran;
    return all_ran ? 0 : 1;
}
