#include "tests/bench/stability.h"

#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/bench/stability_report.h"

namespace headrace::bench {

namespace {

struct Options {
    std::vector<std::string> cases;
    std::string variant;
    std::string folder{std::string(HEADRACE_SOURCE_DIR) + "/tests/bench/results"};
    int threads{1};
    bool lists{false}, brief{false};
};

// "random_0x" names a case, "random" all whose names begin so.
bool is_chosen(const stability::Scenario& one, const Options& options) {
    if (options.brief && !one.is_brief) return false;
    if (!options.variant.empty() && one.variant != options.variant) return false;
    return options.cases.empty() || std::any_of(options.cases.begin(), options.cases.end(),
                                                [&](const auto& name) { return one.name.starts_with(name); });
}

}  // namespace

int run_stability(int argc, char** argv) {
    CLI::App app{
        "Runs the scenes that try to break the model and judges them by written criteria: see\n"
        "tests/stability/README.md. Writes stability.csv and stability.png when all cases are run, or to --out."};
    Options options;
    app.add_option("--case", options.cases, "Cases, by the beginning of their names; none: all")->delimiter(',');
    app.add_option("--variant", options.variant, "Only this variant of each case");
    app.add_option("--out", options.folder, "Folder of the table and the heat map")->capture_default_str();
    app.add_option("--threads", options.threads, "Threads of the solver")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    app.add_flag("--brief", options.brief, "Only what the tests run");
    app.add_flag("--list", options.lists, "Names cases and variants");
    CLI11_PARSE(app, argc, argv);
    omp_set_num_threads(options.threads);

    std::vector<stability::Outcome> outcomes;
    bool all_ran = true;
    std::size_t known = 0;
    for (const stability::Scenario& one : stability::scenarios()) {
        if (!is_chosen(one, options)) continue;
        ++known;
        if (options.lists) {
            std::cout << one.name << '\t' << one.variant << '\n';
            continue;
        }
        auto outcome = stability::run_scenario(one);
        if (!outcome) {
            std::cerr << "headrace_bench: " << one.name << ", " << one.variant << ": " << outcome.error().message << ' '
                      << outcome.error().path << '\n';
            all_ran = false;
            continue;
        }
        std::cout << stability::describe(*outcome) << std::endl;
        outcomes.push_back(std::move(*outcome));
    }
    if (known == 0) {
        std::cerr << "headrace_bench: no such case; --list names them\n";
        return 2;
    }
    if (options.lists) return 0;

    std::cout << stability_summary(outcomes);
    const bool is_whole = options.cases.empty() && options.variant.empty() && !options.brief;
    if (is_whole || app.count("--out") > 0) {
        std::filesystem::create_directories(options.folder);
        std::ofstream(options.folder + "/stability.csv") << stability_csv(outcomes);
        all_ran = draw_stability(outcomes, options.folder + "/stability.png") && all_ran;
    }
    const bool has_failure = std::any_of(outcomes.begin(), outcomes.end(), [](const stability::Outcome& one) {
        return one.verdict == stability::Verdict::failed;
    });
    return all_ran && !has_failure ? 0 : 1;
}

}  // namespace headrace::bench
