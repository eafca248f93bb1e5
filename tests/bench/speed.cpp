#include "tests/bench/speed.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/bench/assignments.h"
#include "tests/bench/speed_cases.h"
#include "tests/bench/speed_compare.h"

namespace headrace::bench {

namespace {

const std::vector<std::string> kCases{
    "plain_3d", "plain_2d", "wcsph_dam_break_3d", "wcsph_dam_break_2d", "thesis_dam_break_3d", "thesis_dam_break_2d"};
constexpr std::size_t kLarge = 300000;  // from here on only the clusters, and fewer steps

struct Options {
    std::vector<std::string> cases{kCases};
    std::vector<std::size_t> particles{10000, 64000, 1000000};
    std::vector<double> supports{2.4, 3.0, 4.0};
    std::vector<std::string> strategies{"clusters", "buffer", "broadcast"};
    SpeedPlan plan;
    bool keep_faster{false};
    bool all_sets{false};
    std::string folder{std::string(HEADRACE_SOURCE_DIR) + "/tests/bench/results"};
    std::string other;  // binary to compare with
    std::vector<std::string> assignments;
};

void define_options(CLI::App& app, Options& options) {
    app.add_option("--case", options.cases, "Cases")
        ->delimiter(',')
        ->check(CLI::IsMember(kCases))
        ->capture_default_str();
    app.add_option("--particles", options.particles, "Particles of the plain cases, about")
        ->delimiter(',')
        ->check(CLI::Range(4000, 100000000))
        ->capture_default_str();
    app.add_option("--support", options.supports, "Support radii of the plain cases in spacings")
        ->delimiter(',')
        ->check(CLI::Range(1.5, 6.0))
        ->capture_default_str();
    app.add_option("--strategy", options.strategies, "Strategies of the plain cases")
        ->delimiter(',')
        ->check(CLI::IsMember({"clusters", "buffer", "broadcast"}))
        ->capture_default_str();
    app.add_option("--threads", options.plan.threads, "Thread counts, taking turns")
        ->delimiter(',')
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_option("--warmup", options.plan.warmup, "Steps of flow before the clock starts (plain cases)")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("--steps", options.plan.steps, "Steps per window")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--repeat", options.plan.repeat, "Windows; the fastest counts")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_flag("--quick", options.plan.is_quick, "200 steps of flow; dam breaks for 0.02 s");
    app.add_flag("--all-sets", options.all_sets, "Clusters in every instruction set, in all plain cases");
    app.add_flag("--keep-faster", options.keep_faster, "Keep the table's line where it is faster");
    app.add_option("--set", options.assignments,
                   "Dam breaks: parameter of the model, name=value; repeatable; the table is only printed");
    app.add_option("--out", options.folder, "Folder of speed.csv")->capture_default_str();
    app.add_option("--compare", options.other, "Another build's headrace_bench: both by turns, ratios")
        ->check(CLI::ExistingFile);
}

bool has(const Options& options, PairStrategy strategy) {
    return std::count(options.strategies.begin(), options.strategies.end(), pair_strategy_name(strategy)) > 0;
}

proto::Status run_plain(int dimensions, const Options& options, const SpeedSink& sink) {
    for (const std::size_t particles : options.particles) {
        for (const double support : options.supports) {
            PlainCase one{dimensions, support, particles, {}, false};
            const bool is_large = particles >= kLarge;
            for (const PairStrategy strategy :
                 {PairStrategy::clusters, PairStrategy::buffer, PairStrategy::broadcast}) {
                if (has(options, strategy) && (strategy == PairStrategy::clusters || !is_large))
                    one.strategies.push_back(strategy);
            }
            one.all_instruction_sets =
                options.all_sets || (dimensions == 3 && support == 3.0 && particles == options.particles.front());
            SpeedPlan plan = options.plan;
            if (plan.is_quick || is_large) plan.warmup = std::min(plan.warmup, 200);
            if (auto status = time_plain(one, plan, sink); !status) return status;
        }
    }
    return proto::Done{};
}

proto::Status run_case(const std::string& name, const Options& options, const SpeedSink& sink) {
    const int dimensions = name.ends_with("2d") ? 2 : 3;
    if (name.starts_with("plain")) return run_plain(dimensions, options, sink);
    return time_dam_break(name.substr(0, name.find('_')), dimensions, options.plan, sink);
}

}  // namespace

int run_speed(int argc, char** argv) {
    CLI::App app{
        "Times the pair engine and whole models in developed flow. plain_*: continuity, pressure, artificial\n"
        "viscosity and density diffusion in one loop, a periodic vortex, by several strategies; *_dam_break_*: a\n"
        "model at its defaults, t = 0.2 to 0.4 s. Beside each figure stands what fused multiply-adds the machine "
        "gave.\n"
        "Writes speed.csv; lines of other cases stay."};
    Options options;
    define_options(app, options);
    CLI11_PARSE(app, argc, argv);
    if (!options.other.empty()) return compare_builds(options.other, {argv + 1, argv + argc});

    if (const auto wrong = take_assignments(options.assignments, options.plan.parameters)) {
        std::cerr << "headrace_bench: " << *wrong << '\n';
        return 2;
    }
    std::filesystem::create_directories(options.folder);
    const std::string table = options.folder + "/speed.csv";
    std::vector<SpeedRow> rows = read_speed_csv(table);
    std::cout << speed_table_head() << '\n';
    bool is_written = true;
    const auto sink = [&](const SpeedRow& row) {
        std::cout << speed_table_line(row) << std::endl;
        if (!options.assignments.empty()) return;  // another model than the table's
        put_row(rows, row, options.keep_faster);
        is_written = static_cast<bool>(std::ofstream(table) << speed_csv(rows));
    };
    bool all_ran = true;
    for (const std::string& name : options.cases) {
        if (auto status = run_case(name, options, sink); !status) {
            std::cerr << "headrace_bench: " << name << ": " << status.error().message << '\n';
            all_ran = false;
        }
        if (!is_written) {
            std::cerr << "headrace_bench: cannot write " << table << '\n';
            return 2;
        }
    }
    return all_ran ? 0 : 1;
}

}  // namespace headrace::bench
