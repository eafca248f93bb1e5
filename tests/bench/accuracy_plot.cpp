// The diagrams: data blocks and commands piped to gnuplot.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "tests/bench/accuracy_report.h"
#include "tests/validation/support/case.h"

namespace headrace::bench {

namespace {

// Side by side in the overview: a free surface without walls, confined flow, still water, a gravity wave.
const std::vector<std::string> kOverview{"oscillating_drop", "taylor_green_re100", "hydrostatic", "standing_wave"};

// The same look in every diagram: colours by what is varied, points within that.
struct Look {
    const char* title;
    const char* colour;
    int point;
    int width;
    bool in_overview;
};
constexpr Look kLooks[] = {
    {"default", "#000000", 5, 4, true},
    {"R/dp=2.4", "#9ecae1", 4, 1, true},
    {"R/dp=2.6", "#6baed6", 8, 1, false},
    {"R/dp=3", "#3182bd", 6, 1, true},
    {"R/dp=4", "#08519c", 10, 1, true},
    {"c0 x 0.5", "#74c476", 9, 1, true},
    {"c0 x 2", "#006d2c", 11, 1, true},
    {"pressure_gradient=plain", "#d94801", 7, 1, true},
    {"shifting=false", "#fd8d3c", 13, 1, true},
    {"dual_time_step=false", "#8c6d31", 12, 1, true},
    {"density_diffusion=none", "#c994c7", 4, 1, false},
    {"density_diffusion=fourtakas", "#dd1c77", 8, 1, false},
    {"state_equation=tait", "#756bb1", 6, 1, false},
    {"artificial_viscosity=0.02", "#54278f", 10, 1, false},
    {"thesis, default", "#de2d26", 15, 2, true},
    {"thesis, stiff", "#a50f15", 14, 2, true},
};
constexpr Look kOtherLook{"", "#808080", 3, 1, false};

const Look& look_of(const std::string& title) {
    for (const Look& look : kLooks)
        if (title == look.title) return look;
    return kOtherLook;
}

std::string title_of(const AccuracyRow& row) {
    return row.model == "wcsph" ? row.option : row.model + ", " + row.option;
}

struct Line {
    std::string title;
    std::vector<AccuracyRow> rows;  // coarse to fine
};

std::vector<Line> find_lines(const std::vector<AccuracyRow>& rows) {
    std::vector<Line> lines;
    for (const AccuracyRow& row : rows) {
        if (!std::isfinite(row.error) || row.error <= 0.0) continue;
        const std::string title = title_of(row);
        auto line = std::find_if(lines.begin(), lines.end(), [&](const Line& one) { return one.title == title; });
        if (line == lines.end()) line = lines.insert(lines.end(), {title, {}});
        line->rows.push_back(row);
    }
    for (Line& line : lines)
        std::sort(line.rows.begin(), line.rows.end(), [](const auto& a, const auto& b) { return a.dp > b.dp; });
    return lines;
}

std::string escaped(std::string text) {  // gnuplot's enhanced text takes _ as a subscript
    for (std::size_t k = text.find('_'); k != std::string::npos; k = text.find('_', k + 1)) text[k] = ' ';
    return text;
}

std::string block(const std::string& name, const std::vector<AccuracyRow>& rows) {
    std::string text = "$" + name + " << EOD\n";
    for (const AccuracyRow& row : rows) {
        char numbers[64];
        std::snprintf(numbers, sizeof numbers, "%.6g %.6g\n", row.wall_s, row.error);
        text += numbers;
    }
    return text + "EOD\n";
}

// Commands for the diagram of one case; names of data blocks begin with `prefix`.
std::string diagram(const std::string& prefix, const validation::Case& one, const std::vector<AccuracyRow>& rows,
                    bool is_overview) {
    std::vector<AccuracyRow> shown;
    for (const AccuracyRow& row : rows)
        if (!is_overview || look_of(title_of(row)).in_overview) shown.push_back(row);
    std::vector<AccuracyRow> front;
    for (const std::size_t i : find_pareto_front(shown)) front.push_back(shown[i]);
    std::string blocks = block(prefix + "front", front);
    std::string plot = "plot $" + prefix + "front with points pt 6 ps 3 lw 2 lc rgb 'black' title 'Pareto front'";
    std::size_t count = 0;
    for (const Line& line : find_lines(shown)) {
        const Look& look = look_of(line.title);
        const std::string name = prefix + std::to_string(count++);
        blocks += block(name, line.rows);
        char style[128];
        std::snprintf(style, sizeof style, " with linespoints lc rgb '%s' pt %d ps 1.2 lw %d", look.colour, look.point,
                      look.width);
        plot += ", $" + name + style + " title '" + escaped(line.title) + "'";
    }
    return blocks + "set title '" + escaped(one.name) + ", " + one.length_name + "/dp " +
           std::to_string(static_cast<int>(one.ladder.front())) + " to " +
           std::to_string(static_cast<int>(one.ladder.back())) + "'\nset ylabel 'error: " + escaped(one.main_metric) +
           "'\n" + "set key " + (is_overview ? "outside right top font ',8' samplen 1\n" : "outside right top\n") +
           plot + "\n";
}

// An error above 1 is no result: what lies there is cut off.
const char* kHead =
    "set logscale xy\nset yrange [*:*<2]\nset format x '10^{%T}'\nset format y '10^{%T}'\n"
    "set grid xtics ytics mxtics mytics lc rgb '#b0b0b0' lw 1, lc rgb '#e0e0e0' lw 1\n"
    "set xlabel 'wall time [s], one thread'\n";

bool run_gnuplot(const std::string& commands) {
    std::FILE* pipe = popen("gnuplot", "w");
    if (!pipe) return false;
    std::fputs(commands.c_str(), pipe);
    return pclose(pipe) == 0;
}

}  // namespace

bool draw_diagrams(const std::vector<AccuracyRow>& rows, const std::string& folder) {
    bool all_drawn = true;
    std::string overview;
    int panels = 0;
    for (const validation::Case& one : validation::cases()) {
        const auto of_case = select(rows, one.name, one.main_metric);
        if (of_case.empty() || find_pareto_front(of_case).empty()) continue;
        const std::string commands = "set terminal pngcairo size 1100,700 font 'sans,11'\nset output '" + folder + "/" +
                                     one.name + ".png'\n" + kHead + diagram("d", one, of_case, false);
        if (!run_gnuplot(commands)) {
            std::cerr << "headrace_bench: gnuplot could not draw " << one.name << '\n';
            all_drawn = false;
        }
        if (std::find(kOverview.begin(), kOverview.end(), one.name) != kOverview.end())
            overview += diagram("p" + std::to_string(panels++), one, of_case, true);
    }
    if (panels > 0)
        all_drawn =
            run_gnuplot("set terminal pngcairo size 1500,1000 font 'sans,10'\nset output '" + folder +
                        "/overview.png'\n" + kHead + "set multiplot layout 2,2\n" + overview + "unset multiplot\n") &&
            all_drawn;
    return all_drawn;
}

}  // namespace headrace::bench
