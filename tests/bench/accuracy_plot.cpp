// The diagrams: data blocks and commands piped to gnuplot.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/bench/accuracy_report.h"
#include "tests/bench/gnuplot.h"
#include "tests/validation/support/case.h"

namespace headrace::bench {

namespace {

// Side by side in the overview, with the legend in the place of a sixth: free surfaces without walls, confined flow,
// still water, a gravity wave. The thesis's model takes part in the second and the fourth.
const std::vector<std::string> kOverview{"oscillating_drop", "elliptical_drop", "taylor_green_re100", "hydrostatic",
                                         "standing_wave"};

constexpr double kMostDrawn = 10.0;  // an error above 1 is no result; what lies far above is only told

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
    {"R/dp=3", "#3182bd", 6, 1, false},
    {"R/dp=4", "#08519c", 10, 1, true},
    {"c0 x 0.5", "#74c476", 9, 1, true},
    {"c0 x 2", "#006d2c", 11, 1, true},
    {"pressure_gradient=plain", "#d94801", 7, 1, true},
    {"shifting=false", "#fd8d3c", 13, 1, true},
    {"dual_time_step=false", "#8c6d31", 12, 1, true},
    {"density_diffusion=none", "#c994c7", 4, 1, false},
    {"density_diffusion=fourtakas", "#dd1c77", 8, 1, false},
    {"density_diffusion=antuono", "#e7298a", 10, 1, false},
    {"walls=integrals", "#1b9e77", 2, 1, false},
    {"walls=particles", "#1b9e77", 1, 1, false},
    {"state_equation=tait", "#756bb1", 6, 1, false},
    {"artificial_viscosity=0.02", "#54278f", 10, 1, false},
    {"thesis, default", "#de2d26", 15, 2, true},
    {"thesis, stiff", "#a50f15", 14, 2, true},
    {"", "#808080", 3, 1, false},  // any other
};

const Look& look_of(const std::string& title) {
    return *std::find_if(std::begin(kLooks), std::end(kLooks) - 1,
                         [&](const Look& look) { return title == look.title; });
}

std::string title_of(const AccuracyRow& row) {
    return row.model == "wcsph" ? row.option : row.model + ", " + row.option;
}

bool is_drawn(const AccuracyRow& row) {
    return std::isfinite(row.error) && row.error > 0.0 && row.error <= kMostDrawn && row.wall_s > 0.0;
}

struct Line {
    std::string title;
    std::vector<AccuracyRow> rows;  // coarse to fine
};

std::vector<Line> find_lines(const std::vector<AccuracyRow>& rows) {
    std::vector<Line> lines;
    for (const AccuracyRow& row : rows) {
        if (!is_drawn(row)) continue;
        const std::string title = title_of(row);
        auto line = std::find_if(lines.begin(), lines.end(), [&](const Line& one) { return one.title == title; });
        if (line == lines.end()) line = lines.insert(lines.end(), {title, {}});
        line->rows.push_back(row);
    }
    std::stable_sort(lines.begin(), lines.end(),
                     [](const Line& a, const Line& b) { return &look_of(a.title) < &look_of(b.title); });
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

// " title" of a line and how it is drawn.
std::string style_of(const std::string& title) {
    const Look& look = look_of(title);
    char style[128];
    std::snprintf(style, sizeof style, " with linespoints lc rgb '%s' pt %d ps 1.2 lw %d", look.colour, look.point,
                  look.width);
    return style + (" title '" + escaped(title) + "'");
}
const char* kFrontStyle = " with points pt 6 ps 2.6 lw 2 lc rgb 'black' title 'Pareto front'";

// What the diagram cannot show: options with runs that broke or whose error is off the scale, two to a line.
std::string describe_missing(const std::vector<AccuracyRow>& rows) {
    std::vector<std::string> titles;
    for (const AccuracyRow& row : rows)
        if (std::find(titles.begin(), titles.end(), title_of(row)) == titles.end()) titles.push_back(title_of(row));
    std::string text;
    int told = 0;
    for (const std::string& title : titles) {
        std::size_t runs = 0, broken = 0, large = 0;
        for (const AccuracyRow& row : rows) {
            if (title_of(row) != title) continue;
            ++runs;
            if (!std::isfinite(row.error)) ++broken;
            if (std::isfinite(row.error) && row.error > kMostDrawn) ++large;
        }
        const auto tell = [&](const char* what, std::size_t count) {
            if (count == 0) return;
            text += (told++ % 2 == 0 ? "\\n" : "; ") + escaped(title) + ": " + std::to_string(count) + " of " +
                    std::to_string(runs) + what;
        };
        tell(" broke", broken);
        tell(" with error above 10", large);
    }
    return text;
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
    std::string plot = "plot $" + prefix + "front" + kFrontStyle;
    std::size_t count = 0;
    for (const Line& line : find_lines(shown)) {
        const std::string name = prefix + std::to_string(count++);
        blocks += block(name, line.rows);
        plot += ", $" + name + style_of(line.title);
    }
    return blocks + "set title \"{/:Bold " + escaped(one.name) + "}, " + one.length_name + "/dp " +
           std::to_string(static_cast<int>(one.ladder.front())) + " to " +
           std::to_string(static_cast<int>(one.ladder.back())) + describe_missing(shown) +
           "\"\nset ylabel 'error: " + escaped(one.main_metric) + "'\n" +
           (is_overview ? "unset key\n" : "set key outside right top Left reverse\n") + plot + "\n";
}

// An empty panel with the legend of all the others.
std::string legend() {
    std::string plot = std::string("plot NaN") + kFrontStyle;
    for (const Look& look : kLooks)
        if (look.in_overview) plot += ", NaN" + style_of(look.title);
    return "unset title\nunset xlabel\nunset ylabel\nunset border\nunset tics\nunset grid\nunset logscale\n"
           "set xrange [0:1]\nset yrange [0:1]\nset key inside center center Left reverse font ',12' samplen 3 "
           "spacing 1.3\n" +
           plot + "\n";
}

const char* kHead =
    "set logscale xy\nset xrange [*:*]\nset yrange [*:*]\nset format x '10^{%T}'\nset format y '10^{%T}'\n"
    "set grid xtics ytics mxtics mytics lc rgb '#b0b0b0' lw 1, lc rgb '#e0e0e0' lw 1\n"
    "set xlabel 'wall time [s], one thread'\n";

}  // namespace

bool draw_diagrams(const std::vector<AccuracyRow>& rows, const std::string& folder) {
    bool all_drawn = true;
    for (const validation::Case& one : validation::cases()) {
        const auto of_case = select(rows, one.name, one.main_metric);
        if (one.ladder.empty() || find_lines(of_case).empty()) continue;
        const std::string commands = "set terminal pngcairo size 1100,700 font 'sans,11'\nset output '" + folder + "/" +
                                     one.name + ".png'\n" + kHead + diagram("d", one, of_case, false);
        all_drawn = run_gnuplot(commands, one.name) && all_drawn;
    }
    std::string overview;
    int panels = 0;
    for (const std::string& name : kOverview) {
        const validation::Case& one = *validation::find_case(name);
        const auto of_case = select(rows, one.name, one.main_metric);
        if (!find_lines(of_case).empty()) overview += diagram("p" + std::to_string(panels++) + "_", one, of_case, true);
    }
    if (panels > 0)
        all_drawn = run_gnuplot("set terminal pngcairo size 1650,1000 font 'sans,11'\nset output '" + folder +
                                    "/overview.png'\n" + kHead + "set multiplot layout 2,3\n" + overview + legend() +
                                    "unset multiplot\n",
                                "the overview") &&
                    all_drawn;
    return all_drawn;
}

}  // namespace headrace::bench
