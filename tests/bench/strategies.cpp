#include "tests/bench/strategies.h"

#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numeric>
#include <random>
#include <thread>

#include "server/solver/eos.h"
#include "server/solver/integrator/leapfrog.h"
#include "server/solver/models/thesis_parameters.h"
#include "server/solver/parallel.h"
#include "tests/bench/foreign_load.h"
#include "tests/bench/neighbour_count.h"
#include "tests/bench/strategies_report.h"
#include "tests/bench/strategy_sums.h"

namespace headrace::bench {

namespace {

using solver::Index;
using solver::Isa;
using solver::Particles;
using solver::ThesisParameters;

const double kSpacing = std::cbrt(0.02 / 998.29);  // [m] at which the thesis's tables hold
constexpr double kJitter = 0.2;                    // displacement to each side in spacings: never two at one place
constexpr double kSpeed = 0.1;                     // of a component of the velocity, to each side, in speeds of sound
constexpr unsigned kSeed = 20100;

constexpr double kLongestAllPairs = 20.0;  // [s] per step
constexpr double kLongStep = 5.0;          // [s] beyond this the first step is the measurement
constexpr double kWindow = 0.1;            // [s] aimed at
constexpr int kMostSteps = 200;            // per window
constexpr int kWindows = 5;                // undisturbed ones of each line
constexpr double kPatience = 30.0;         // [s] spent on a size, then lines without a quiet window are left out
constexpr double kDisturbed = 0.3;         // cores that others took from the team; a tick more than the clock's error

struct Options {
    std::size_t largest{1000000};
    std::vector<int> threads;
    std::vector<int> dimensions{3, 2};
    std::vector<double> supports{0.0, 3.0};
    bool only_draws{false};
    std::string folder{std::string(HEADRACE_SOURCE_DIR) + "/tests/bench/results"};
};

// A cube or square of some 10^3, 10^3.5, 10^4 ... particles to the largest.
std::vector<int> find_edges(int dimensions, std::size_t largest) {
    std::vector<int> edges;
    for (int k = 6;; ++k) {
        const int edge = static_cast<int>(std::lround(std::pow(10.0, 0.5 * k / dimensions)));
        if (std::pow(edge, dimensions) > static_cast<double>(largest) * 1.1) return edges;
        edges.push_back(edge);
    }
}

// A lattice at rest density, each particle displaced at random, with a random velocity. Names are shuffled, and with
// them the order within each cell: long flow has mixed them, and no branch shall profit from the lattice.
Particles make_block(int dimensions, int edge, double sound_speed) {
    Particles particles;
    particles.dimensions = dimensions;
    particles.resize(static_cast<std::size_t>(std::lround(std::pow(edge, dimensions))));
    std::iota(particles.id.begin(), particles.id.end(), Index{0});
    std::mt19937_64 random(kSeed);
    std::shuffle(particles.id.begin(), particles.id.end(), random);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        std::size_t rest = i;
        for (int k = 0; k < dimensions; ++k, rest /= static_cast<std::size_t>(edge)) {
            const auto place = static_cast<double>(rest % static_cast<std::size_t>(edge));
            particles.x[k][i] = (place + 0.5 + kJitter * uniform(random)) * kSpacing;
            particles.v[k][i] = kSpeed * sound_speed * uniform(random);
            particles.v_half[k][i] = particles.v[k][i];
        }
    }
    return particles;
}

// A step of the thesis model without walls and checks, its pair sums by any strategy.
class Stepper {
  public:
    Stepper(int dimensions, int edge, double support_over_dp)
        : parameters_(make_parameters(dimensions, support_over_dp)),
          start_(make_block(dimensions, edge, std::sqrt(parameters_.stiffness))) {
        grid_.sort(start_, parameters_.support_radius);  // as any step leaves them
        restore();
        volume_.resize(start_.size());
    }

    void restore() { particles_ = start_; }

    void step(StrategySums& sums, bool sorts) {
        if (sorts) grid_.sort(particles_, parameters_.support_radius);
        const solver::SumInput in{grid_, parameters_, particles_, volume_.data(), 0};
        sums.compute_density(in, particles_.rho.data());
        compute_pressure();
        sums.compute_acceleration(in, {particles_.a[0].data(), particles_.a[1].data(), particles_.a[2].data()});
        advance();
    }

    std::size_t size() const { return start_.size(); }
    double support_over_dp() const { return parameters_.support_radius / kSpacing; }
    double count_neighbours() const { return compute_mean_neighbours(start_, parameters_.support_radius); }

  private:
    // A hundredth of the model's time step: what is timed is the state as it was made.
    static ThesisParameters make_parameters(int dimensions, double support_over_dp) {
        solver::ParameterMap overrides;
        if (support_over_dp > 0.0) overrides["support_radius"] = support_over_dp * kSpacing;
        ThesisParameters parameters = solver::make_thesis_parameters(dimensions, kSpacing, overrides);
        parameters.time_step *= 0.01;
        return parameters;
    }

    void compute_pressure() {
        solver::parallel_for(size(), solver::kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                particles_.p[i] =
                    solver::linear_pressure(particles_.rho[i], parameters_.rest_density, parameters_.stiffness);
                volume_[i] = parameters_.particle_mass / particles_.rho[i];
            }
        });
    }

    void advance() {
        const double dt = parameters_.time_step;
        solver::parallel_for(size(), solver::kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
            for (int k = 0; k < particles_.dimensions; ++k) {
                for (std::size_t i = begin; i < end; ++i) {
                    const double before = particles_.v_half[k][i];
                    const double after = solver::leap_velocity(before, particles_.a[k][i], dt, dt);
                    particles_.x[k][i] = solver::leap_position(particles_.x[k][i], after, dt);
                    particles_.v_half[k][i] = after;
                    particles_.v[k][i] = solver::mean_velocity(before, after);
                }
            }
        });
    }

    ThesisParameters parameters_;
    Particles start_, particles_;
    solver::CellGrid grid_;
    std::vector<double> volume_;  // [m^3]
};

// One line of the table while it is measured.
struct Contest {
    Strategy strategy{};
    Isa isa{};
    int threads{1};
    std::unique_ptr<StrategySums> sums;
    int steps{1};
    int quiet{};    // windows nobody disturbed
    double best{};  // [s] per step of the quiet ones; 0: none
};

double time_steps(Stepper& stepper, Contest& one, int steps) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < steps; ++i) stepper.step(*one.sums, one.strategy != Strategy::all_pairs);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<Contest> make_contests(int dimensions, const std::vector<int>& threads, bool with_all_pairs) {
    std::vector<Contest> contests;
    const auto add = [&](Strategy strategy, Isa isa, int team) {
        contests.push_back({strategy, isa, team, make_strategy_sums(strategy, dimensions, isa)});
    };
    const Isa best = solver::best_isa();
    if (with_all_pairs) add(Strategy::all_pairs, Isa::baseline, 1);
    add(Strategy::linked_cells, Isa::baseline, 1);
    add(Strategy::symmetry, Isa::baseline, 1);
    if (best != Isa::baseline) add(Strategy::simd, Isa::baseline, 1);
    for (const int team : threads) {
        add(Strategy::coloured_layers, Isa::baseline, team);
        add(Strategy::simd, best, team);
    }
    return contests;
}

// Times a window. Was it quiet? A disturbed one does not count.
bool time_window(Stepper& stepper, Contest& one) {
    omp_set_num_threads(one.threads);
    stepper.restore();
    time_steps(stepper, one, 1);  // wakes the team, warms the caches
    const ForeignLoad others;
    const double seconds = time_steps(stepper, one, one.steps) / one.steps;
    const double spare = std::max(0, omp_get_num_procs() - one.threads);
    const bool is_quiet = others.cores() - spare < kDisturbed;
    if (is_quiet && (one.best == 0.0 || seconds < one.best)) one.best = seconds;
    return is_quiet;
}

// Turns, not blocks: a slow minute of the machine hits every strategy alike. Where others need the cores it waits.
void measure(Stepper& stepper, std::vector<Contest>& contests) {
    for (Contest& one : contests) {
        omp_set_num_threads(one.threads);
        stepper.restore();
        const double first_step = time_steps(stepper, one, 1);  // allocates, too
        if (first_step > kLongStep) {
            one.best = first_step;
            one.quiet = kWindows;
            continue;
        }
        const double next_step = time_steps(stepper, one, 1);
        one.steps = std::clamp(static_cast<int>(std::ceil(kWindow / next_step)), 1, kMostSteps);
    }
    const auto start = std::chrono::steady_clock::now();
    const auto is_measured = [](const Contest& one) { return one.quiet >= kWindows; };
    while (!std::all_of(contests.begin(), contests.end(), is_measured)) {
        bool all_quiet = true;
        for (Contest& one : contests) {
            if (is_measured(one)) continue;
            const bool is_quiet = time_window(stepper, one);
            one.quiet += is_quiet;
            all_quiet = all_quiet && is_quiet;
        }
        if (std::chrono::steady_clock::now() - start > std::chrono::duration<double>(kPatience)) break;
        if (!all_quiet) std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
}

// All sizes of one dimension and support. Prints as it goes.
std::vector<StrategyRow> run_ladder(int dimensions, double support_over_dp, const Options& options) {
    std::vector<StrategyRow> rows;
    double all_pairs = 0.0;  // [s] per step and pair, of the size before
    for (const int edge : find_edges(dimensions, options.largest)) {
        omp_set_num_threads(1);
        Stepper stepper(dimensions, edge, support_over_dp);
        const auto size = static_cast<double>(stepper.size());
        const bool with_all_pairs = all_pairs * size * size < kLongestAllPairs;
        std::vector<Contest> contests = make_contests(dimensions, options.threads, with_all_pairs);
        measure(stepper, contests);
        const double neighbours = stepper.count_neighbours();
        for (const Contest& one : contests) {
            if (one.quiet == 0) {
                std::cout << "   " << strategy_name(one.strategy) << " on " << one.threads << " threads with "
                          << stepper.size() << " particles left out: others were busy\n";
                continue;
            }
            if (one.strategy == Strategy::all_pairs) all_pairs = one.best / (size * size);
            rows.push_back({one.strategy, dimensions, stepper.size(), stepper.support_over_dp(), neighbours,
                            one.threads, one.isa, one.steps, one.best * 1e3});
            std::cout << strategies_table_line(rows.back()) << std::endl;
        }
        if (!with_all_pairs)
            std::cout << "   all_pairs left out: a step would take some " << std::lround(all_pairs * size * size)
                      << " s\n";
    }
    return rows;
}

// Puts the lines of a ladder in the place of those measured before.
void replace_lines(std::vector<StrategyRow>& rows, const std::vector<StrategyRow>& ladder) {
    const auto is_of_ladder = [&](const StrategyRow& row) {
        return row.dimensions == ladder.front().dimensions &&
               std::abs(row.support_over_dp - ladder.front().support_over_dp) < 0.005;  // the file has four digits
    };
    const auto first = std::find_if(rows.begin(), rows.end(), is_of_ladder);
    const auto place = std::distance(rows.begin(), first);
    std::erase_if(rows, is_of_ladder);
    rows.insert(rows.begin() + place, ladder.begin(), ladder.end());
}

void define_options(CLI::App& app, Options& options) {
    app.add_option("--largest", options.largest, "Particles of the largest block")
        ->check(CLI::Range(1000, 100000000))
        ->capture_default_str();
    app.add_option("--threads", options.threads, "Thread counts of the parallel strategies; none: 1 to all")
        ->delimiter(',')
        ->check(CLI::Range(1, 1024));
    app.add_option("--dimensions", options.dimensions, "2, 3 or both")
        ->delimiter(',')
        ->check(CLI::Range(2, 3))
        ->capture_default_str();
    app.add_option("--support", options.supports, "Support radii in spacings; 0: the model's own")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 20.0))
        ->capture_default_str();
    app.add_flag("--draw", options.only_draws, "Only draw what strategies.csv holds");
    app.add_option("--out", options.folder, "Folder of strategies.csv and the diagrams")->capture_default_str();
}

}  // namespace

int run_strategies(int argc, char** argv) {
    CLI::App app{
        "Times a step of the thesis model by the strategies of Staubach 2010: all pairs, linked cells, with symmetry,\n"
        "with SIMD, and the last two over threads (its Figures 4.4 and 4.5). The state is a lattice at rest density,\n"
        "jittered, with random velocities. Writes strategies.csv, strategies_particles.png, strategies_threads.png. "
        "Lines\n"
        "of other dimensions and supports that the table holds stay."};
    Options options;
    define_options(app, options);
    CLI11_PARSE(app, argc, argv);
    if (options.threads.empty()) {
        options.threads.resize(static_cast<std::size_t>(solver::max_threads()));
        std::iota(options.threads.begin(), options.threads.end(), 1);
    }
    std::sort(options.threads.begin(), options.threads.end());

    std::filesystem::create_directories(options.folder);
    const std::string table = options.folder + "/strategies.csv";
    std::vector<StrategyRow> rows = read_strategies_csv(table);
    if (!options.only_draws) std::cout << strategies_table_head() << '\n';
    for (const int dimensions : options.dimensions) {
        for (const double support : options.supports) {
            if (options.only_draws) continue;
            replace_lines(rows, run_ladder(dimensions, support, options));
            if (!(std::ofstream(table) << strategies_csv(rows))) {
                std::cerr << "headrace_bench: cannot write " << table << '\n';
                return 2;
            }
        }
    }
    return draw_strategies(rows, options.folder) ? 0 : 1;
}

}  // namespace headrace::bench
