#include "tests/bench/strategies_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <set>
#include <utility>

#include "tests/bench/gnuplot.h"
#include "tests/bench/text.h"

namespace headrace::bench {

namespace {

const char* const kCase = "jittered_block";

// What a panel shows.
struct Panel {
    int dimensions{};
    double support_over_dp{};
    std::vector<StrategyRow> rows;

    std::string title() const {
        double neighbours = 0.0;  // of the largest: the least surface
        for (const StrategyRow& row : rows) neighbours = std::max(neighbours, row.neighbours);
        return text_of("%dD, R/dp = %.3g, %.0f neighbours", dimensions, support_over_dp, neighbours);
    }
};

std::vector<Panel> find_panels(const std::vector<StrategyRow>& rows) {
    std::vector<Panel> panels;
    for (const StrategyRow& row : rows) {
        auto panel = std::find_if(panels.begin(), panels.end(), [&](const Panel& one) {
            return one.dimensions == row.dimensions && std::abs(one.support_over_dp - row.support_over_dp) < 0.005;
        });
        if (panel == panels.end()) panel = panels.insert(panels.end(), {row.dimensions, row.support_over_dp, {}});
        panel->rows.push_back(row);
    }
    return panels;
}

// A figure under construction: data blocks first, then the plots that read them.
class Figure {
  public:
    void begin_panel(const std::string& title) {
        plots_ += plot_.empty() ? "" : plot_ + "\n";
        plots_ += "set title '" + title + "'\n";
        plot_.clear();
    }
    void add_line(const std::vector<std::pair<double, double>>& points, const std::string& style) {
        if (points.empty()) return;
        const std::string name = "$d" + std::to_string(count_++);
        data_ += name + " << EOD\n";
        for (const auto& [x, y] : points) data_ += text_of("%.6g %.6g\n", x, y);
        data_ += "EOD\n";
        plot_ += (plot_.empty() ? "plot " : ", ") + name + " " + style;
    }
    std::string commands(const std::string& file, const std::string& title, const std::string& axes,
                         std::size_t panels) const {
        const int columns = panels > 1 ? 2 : 1, lines = static_cast<int>(panels + 1) / 2;
        return text_of("set terminal pngcairo size %d,%d font 'sans,11'\n", columns * 800, lines * 620) +
               "set output '" + file + "'\n" + data_ +
               "set grid xtics ytics mxtics mytics lc rgb '#b0b0b0' lw 1, lc rgb '#e0e0e0' lw 1\n" + axes +
               text_of("set multiplot layout %d,%d title \"", lines, columns) + title + "\" font ',13'\n" + plots_ +
               plot_ + "\nunset multiplot\n";
    }

  private:
    std::string data_, plots_, plot_;
    int count_{};
};

// One line of the diagram over particles.
struct Look {
    Strategy strategy;
    bool is_on_all_threads;
    const char* title;
    const char* colour;
    int point;
};
constexpr Look kLooks[] = {
    {Strategy::all_pairs, false, "all pairs", "#000000", 4},
    {Strategy::linked_cells, false, "linked cells", "#de2d26", 6},
    {Strategy::symmetry, false, "linked cells, symmetry", "#fd8d3c", 8},
    {Strategy::coloured_layers, true, "linked cells, symmetry, coloured layers", "#fd8d3c", 9},
    {Strategy::simd, false, "linked cells, SIMD", "#3182bd", 10},
    {Strategy::simd, true, "linked cells, SIMD", "#08519c", 11},
};

bool draw_over_particles(const std::vector<Panel>& panels, const std::string& file, int most_threads,
                         solver::Isa best) {
    Figure figure;
    for (const Panel& panel : panels) {
        figure.begin_panel(panel.title());
        for (const Look& look : kLooks) {
            if (look.is_on_all_threads && most_threads == 1) continue;
            std::vector<std::pair<double, double>> points;
            for (const StrategyRow& row : panel.rows) {
                if (row.strategy != look.strategy || row.threads != (look.is_on_all_threads ? most_threads : 1))
                    continue;
                if (row.strategy != Strategy::simd || row.isa == best)
                    points.emplace_back(static_cast<double>(row.particles), row.ms_per_step * 1e-3);
            }
            const std::string threads = look.is_on_all_threads ? text_of(", %d threads", most_threads) : "";
            figure.add_line(points,
                            text_of("with linespoints lc rgb '%s' pt %d ps 1.2 lw %d%s title '%s%s'", look.colour,
                                    look.point, 2, look.is_on_all_threads ? " dt 2" : "", look.title, threads.c_str()));
        }
    }
    const std::string axes =
        "set logscale xy\nset xrange [800:*]\nset format x '10^{%T}'\nset format y '10^{%T}'\nset xlabel 'particles'\n"
        "set ylabel 'run time of a step [s]'\nset key top left Left reverse font ',9'\n";
    return run_gnuplot(
        figure.commands(file, "Run time of a step of the thesis model, jittered block", axes, panels.size()), file);
}

// (threads, speed-up over one thread) of one strategy at one size.
std::vector<std::pair<double, double>> find_speed_ups(const Panel& panel, Strategy strategy, std::size_t particles,
                                                      solver::Isa isa) {
    std::vector<std::pair<double, double>> points;
    double one_thread = 0.0;                     // [ms]
    for (const StrategyRow& row : panel.rows) {  // thread counts ascend
        if (row.strategy != strategy || row.particles != particles || row.isa != isa) continue;
        if (row.threads == 1) one_thread = row.ms_per_step;
        if (one_thread > 0.0) points.emplace_back(row.threads, one_thread / row.ms_per_step);
    }
    return points;
}

bool draw_over_threads(const std::vector<Panel>& panels, const std::string& file, int most_threads, solver::Isa best) {
    constexpr std::size_t kSizes = 3;  // the largest, a tenth, a hundredth
    const char* const layer_colours[kSizes] = {"#d94801", "#fd8d3c", "#fdbe85"};
    const char* const simd_colours[kSizes] = {"#08519c", "#3182bd", "#9ecae1"};
    const auto style = [](const char* colour, int point, const char* title, std::size_t particles) {
        return text_of("with linespoints lc rgb '%s' pt %d ps 1.2 lw 2 title '%s, N = %zu'", colour, point, title,
                       particles);
    };
    Figure figure;
    for (const Panel& panel : panels) {
        figure.begin_panel(panel.title());
        figure.add_line({{1.0, 1.0}, {most_threads, most_threads}}, "with lines lc rgb 'black' dt 2 title 'ideal'");
        std::set<std::size_t, std::greater<>> sizes;
        for (const StrategyRow& row : panel.rows) sizes.insert(row.particles);
        std::size_t rank = 0;
        for (const std::size_t size : sizes) {
            const std::size_t shade = rank++ / 2;
            if (rank % 2 == 0 || shade >= kSizes) continue;
            figure.add_line(find_speed_ups(panel, Strategy::coloured_layers, size, solver::Isa::baseline),
                            style(layer_colours[shade], 9, "symmetry, coloured layers", size));
            figure.add_line(find_speed_ups(panel, Strategy::simd, size, best),
                            style(simd_colours[shade], 11, "SIMD", size));
        }
    }
    const std::string axes =
        text_of("set xrange [0.8:%g]\nset yrange [0:%g]\nset xtics 1\n", most_threads + 0.2, most_threads + 0.3) +
        "set xlabel 'threads'\nset ylabel 'speed-up of a step over one thread'\n"
        "set key top left Left reverse font ',9'\n";
    return run_gnuplot(
        figure.commands(file, "Speed-up by threads of the thesis model, jittered block", axes, panels.size()), file);
}

}  // namespace

std::string strategies_table_head() {
    return text_of("%2s %6s %9s %10s  %-16s %-9s %7s %6s %12s %15s", "D", "R/dp", "N", "neighbours", "strategy", "isa",
                   "threads", "steps", "ms per step", "M p-s/s per core");
}

std::string strategies_table_line(const StrategyRow& row) {
    return text_of("%2d %6.3g %9zu %10.1f  %-16s %-9s %7d %6d %12.3f %15.4f", row.dimensions, row.support_over_dp,
                   row.particles, row.neighbours, std::string(strategy_name(row.strategy)).c_str(),
                   std::string(solver::isa_name(row.isa)).c_str(), row.threads, row.steps, row.ms_per_step,
                   row.Mpsps_per_core());
}

std::string strategies_csv(const std::vector<StrategyRow>& rows) {
    std::string text =
        "case,model,strategy,dimensions,particles,support_over_dp,neighbours,threads,isa,steps,ms_per_step,"
        "Mpsps_per_core\n";
    for (const StrategyRow& row : rows)
        text +=
            text_of("%s,thesis,%s,%d,%zu,%.4g,%.1f,%d,%s,%d,%.5g,%.5g\n", kCase,
                    std::string(strategy_name(row.strategy)).c_str(), row.dimensions, row.particles,
                    row.support_over_dp, row.neighbours, row.threads, std::string(solver::isa_name(row.isa)).c_str(),
                    row.steps, row.ms_per_step, row.Mpsps_per_core());
    return text;
}

std::vector<StrategyRow> read_strategies_csv(const std::string& path) {
    std::vector<StrategyRow> rows;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        StrategyRow row;
        char strategy[32], isa[32];
        if (std::sscanf(line.c_str(), "%*[^,],thesis,%31[^,],%d,%zu,%lf,%lf,%d,%31[^,],%d,%lf", strategy,
                        &row.dimensions, &row.particles, &row.support_over_dp, &row.neighbours, &row.threads, isa,
                        &row.steps, &row.ms_per_step) != 9)
            continue;
        for (const Strategy one : {Strategy::all_pairs, Strategy::linked_cells, Strategy::symmetry,
                                   Strategy::coloured_layers, Strategy::simd})
            if (strategy_name(one) == strategy) row.strategy = one;
        for (const solver::Isa one : {solver::Isa::baseline, solver::Isa::avx2, solver::Isa::avx512})
            if (solver::isa_name(one) == isa) row.isa = one;
        rows.push_back(row);
    }
    return rows;
}

bool draw_strategies(const std::vector<StrategyRow>& rows, const std::string& folder) {
    if (rows.empty()) return true;
    if (!has_gnuplot()) return true;
    const std::vector<Panel> panels = find_panels(rows);
    int most_threads = 1;
    solver::Isa best{};
    for (const StrategyRow& row : rows) {
        most_threads = std::max(most_threads, row.threads);
        best = std::max(best, row.isa);
    }
    const bool is_drawn = draw_over_particles(panels, folder + "/strategies_particles.png", most_threads, best);
    if (most_threads == 1) {
        std::cout << "one thread only: no diagram over threads\n";
        return is_drawn;
    }
    return draw_over_threads(panels, folder + "/strategies_threads.png", most_threads, best) && is_drawn;
}

}  // namespace headrace::bench
