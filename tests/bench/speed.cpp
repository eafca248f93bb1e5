#include "tests/bench/speed.h"

#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <utility>

#include "tests/bench/speed_compare.h"
#include "tests/bench/speed_dam_break.h"
#include "tests/bench/speed_growth.h"
#include "tests/bench/speed_plain_case.h"
#include "tests/bench/speed_tables.h"

namespace headrace::bench {

namespace {

const std::vector<std::string> kCases{
    "plain_3d",           "plain_3d_jittered",   "plain_2d",           "plain_2d_jittered", "wcsph_dam_break_3d",
    "wcsph_dam_break_2d", "thesis_dam_break_3d", "thesis_dam_break_2d"};
const std::vector<std::string> kOnRequest{"growth_plain_3d", "growth_wcsph_3d"};  // gigabytes, minutes
constexpr std::size_t kForAllCores = 64000;
constexpr std::size_t kLarge = 300000;  // from here on fewer steps of flow and, unless asked for, only the clusters
const std::string kResults = std::string(HEADRACE_SOURCE_DIR) + "/tests/bench/results";

struct Options {
    std::vector<std::string> cases{kCases};
    std::vector<std::size_t> particles{10000, 64000, 1000000};
    std::vector<std::size_t> growth{100000, 1000000, 10000000};
    std::vector<double> supports{2.4, 2.6, 3.0, 4.0};
    std::vector<std::string> strategies;  // none: all
    SpeedPlan plan;
    std::vector<int> threads;  // none: one, and all where a case is large
    bool keep_faster{false};
    bool all_sets{false};
    bool only_tables{false};
    std::string folder{kResults};
    std::string name{"speed.csv"};
    std::string other;  // binary to compare with
    int rounds{3};
};

void define_options(CLI::App& app, Options& options) {
    std::vector<std::string> all = kCases;
    all.insert(all.end(), kOnRequest.begin(), kOnRequest.end());
    app.add_option("--case", options.cases, "Cases")->delimiter(',')->check(CLI::IsMember(all))->capture_default_str();
    app.add_option("--growth", options.growth, "Particles of the growth cases, about")
        ->delimiter(',')
        ->check(CLI::Range(4000, 100000000))
        ->capture_default_str();
    app.add_option("--particles", options.particles, "Particles of the plain cases, about")
        ->delimiter(',')
        ->check(CLI::Range(4000, 100000000))
        ->capture_default_str();
    app.add_option("--support", options.supports, "Support radii of the plain cases in spacings")
        ->delimiter(',')
        ->check(CLI::Range(1.5, 6.0))
        ->capture_default_str();
    app.add_option("--strategy", options.strategies,
                   "Strategies of the plain cases; none: clusters and half, and below 300,000 particles buffer and "
                   "broadcast. Memory is that of clusters, or of half where clusters are left out; sound of what a "
                   "process measures first")
        ->delimiter(',')
        ->check(CLI::IsMember({"clusters", "half", "buffer", "broadcast"}));
    app.add_option(
           "--threads", options.threads,
           "Thread counts, taking turns; none: 1, and as many as there are cores in the 3D dam breaks and from\n"
           "64,000 particles on at R/dp = 3")
        ->delimiter(',')
        ->check(CLI::Range(1, 1024));
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
    app.add_option("--set", options.plan.settings, "Parameter of the models in the dam breaks, name=value; several")
        ->allow_extra_args(false);
    app.add_option("--out", options.folder, "Folder of the measurements")->capture_default_str();
    app.add_option("--name", options.name, "File of the measurements, speed*.csv: one for each machine and build")
        ->check([](const std::string& name) {
            const bool is_plain = name.find('/') == std::string::npos;
            return is_plain && name.starts_with("speed") && name.ends_with(".csv") ? "" : "must be speed*.csv: " + name;
        })
        ->capture_default_str();
    app.add_flag("--readme", options.only_tables, "Only make the tables of README.md and speed*.md from speed*.csv");
    app.add_option("--compare", options.other,
                   "Another build's headrace_bench: both by turns, smallest, median and largest ratio of this to it")
        ->check(CLI::ExistingFile);
    app.add_option("--rounds", options.rounds, "Turns of each build in a comparison")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
}

std::vector<PairStrategy> choose_strategies(const Options& options, bool is_large) {
    std::vector<PairStrategy> chosen;
    for (const PairStrategy strategy :
         {PairStrategy::clusters, PairStrategy::half, PairStrategy::buffer, PairStrategy::broadcast}) {
        const bool is_list = strategy == PairStrategy::clusters || strategy == PairStrategy::half;
        const bool is_named =
            std::count(options.strategies.begin(), options.strategies.end(), pair_strategy_name(strategy)) > 0;
        if (options.strategies.empty() ? is_list || !is_large : is_named) chosen.push_back(strategy);
    }
    return chosen;
}

std::vector<int> choose_threads(const Options& options, bool is_for_all_cores) {
    if (!options.threads.empty()) return options.threads;
    const int cores = omp_get_num_procs();
    return is_for_all_cores && cores > 1 ? std::vector<int>{1, cores} : std::vector<int>{1};
}

proto::Status run_plain(int dimensions, bool is_jittered, const Options& options, const SpeedSink& sink) {
    for (const std::size_t particles : options.particles) {
        for (const double support : options.supports) {
            const bool is_large = particles >= kLarge;
            PlainCase one{dimensions, support, particles, choose_strategies(options, is_large), false, is_jittered};
            const bool is_usual = support == 3.0 && !is_jittered;
            one.all_instruction_sets = options.all_sets || (is_usual && !is_large);
            SpeedPlan plan = options.plan;
            plan.threads = choose_threads(options, is_usual && particles >= kForAllCores);
            if (plan.is_quick || is_large) plan.warmup = std::min(plan.warmup, 200);
            if (is_large) plan.steps = std::min(plan.steps, 20);
            if (auto status = time_plain(one, plan, sink); !status) return status;
        }
    }
    return proto::Done{};
}

proto::Status run_case(const std::string& name, const Options& options, const SpeedSink& sink) {
    const int dimensions = name.find("2d") != std::string::npos ? 2 : 3;
    if (name.starts_with("plain")) return run_plain(dimensions, name.ends_with("jittered"), options, sink);
    SpeedPlan plan = options.plan;
    plan.threads = choose_threads(options, dimensions == 3 && !name.starts_with("growth"));
    if (name == "growth_plain_3d")
        return time_plain_growth(options.growth, choose_strategies(options, true), plan, sink);
    if (name == "growth_wcsph_3d") return time_wcsph_growth(options.growth, plan, sink);
    return time_dam_break(name.substr(0, name.find('_')), dimensions, plan, sink);
}

// README.md and speed*.md as the measurements say. The README is that of the repository whose results they are.
bool write_tables() {
    const std::string readme = std::string(HEADRACE_SOURCE_DIR) + "/README.md";
    std::ifstream file(readme);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    bool is_written = true;
    for (const std::string& name : find_speed_files(kResults)) {
        const std::vector<SpeedRow> rows = read_speed_csv(kResults + "/" + name);
        const std::string document = kResults + "/" + std::filesystem::path(name).stem().string() + ".md";
        if (!(std::ofstream(document) << speed_document(name, rows))) is_written = false;
        if (auto fresh = with_speed_tables(text, name, rows); fresh) {
            text = std::move(*fresh);
        } else {
            std::cerr << "headrace_bench: " << readme << " has no place for the tables of " << name
                      << ": put these lines where they belong\n"
                      << speed_begin(name) << speed_end(name);
            is_written = false;
        }
    }
    return std::ofstream(readme) << text && is_written;
}

}  // namespace

int run_speed(int argc, char** argv) {
    CLI::App app{
        "Times the pair engine and whole models in developed flow. plain_*: continuity, pressure, artificial\n"
        "viscosity and density diffusion in one loop, a periodic vortex, by several strategies; *_dam_break_*: a\n"
        "model at its defaults, t = 0.2 to 0.4 s; growth_* (on request): time and peak memory\n"
        "per particle from 10^5 to 10^7. Beside each figure stands what fused multiply-adds the machine "
        "gave.\n"
        "Writes speed.csv (or --name), in which lines of other cases stay, and from it and its like speed*.md and the\n"
        "tables of README.md."};
    Options options;
    define_options(app, options);
    CLI11_PARSE(app, argc, argv);
    if (!options.other.empty()) return compare_builds(options.other, options.rounds, {argv + 1, argv + argc});

    std::filesystem::create_directories(options.folder);
    const std::string table = options.folder + "/" + options.name;
    if (options.only_tables) return write_tables() ? 0 : 2;
    std::vector<SpeedRow> rows = read_speed_csv(table);
    std::cout << speed_table_head() << '\n';
    bool is_written = true;
    const auto sink = [&](const SpeedRow& row) {
        std::cout << speed_table_line(row) << std::endl;
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
    if (options.folder == kResults && !write_tables()) return 2;
    return all_ran ? 0 : 1;
}

}  // namespace headrace::bench
