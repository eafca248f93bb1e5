#include "tests/bench/stability_report.h"

#include <algorithm>
#include <array>

#include "tests/bench/gnuplot.h"
#include "tests/bench/text.h"

namespace headrace::bench {

namespace {

using stability::Criterion;
using stability::Outcome;
using stability::Verdict;

struct Row {
    std::string name;
    std::vector<const Outcome*> cells;
};

std::vector<Row> find_rows(const std::vector<Outcome>& outcomes) {
    std::vector<Row> rows;
    for (const Outcome& one : outcomes) {
        auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& other) { return other.name == one.name; });
        if (row == rows.end()) row = rows.insert(rows.end(), {one.name, {}});
        row->cells.push_back(&one);
    }
    return rows;
}

std::string plain(std::string text) {  // gnuplot's enhanced text takes _ as a subscript
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

// Fill of a cell: the verdict; lighter the further the worst criterion is from its bound.
const char* colour_of(const Outcome& one) {
    if (one.verdict == Verdict::failed) return "#e34a33";
    if (one.verdict == Verdict::bounded) return "#fdbb63";
    return one.worst().margin() > 0.5 ? "#b8e0a0" : "#78c679";
}

}  // namespace

std::string stability_csv(const std::vector<Outcome>& outcomes) {
    std::string csv = "case,variant,verdict,particles,steps,simulated_s,wall_s,worst";
    if (!outcomes.empty())
        for (const Criterion& one : outcomes.front().criteria) csv += std::string(",") + one.name;
    csv += ",fault\n";
    for (const Outcome& one : outcomes) {
        csv += one.name + ',' + one.variant + ',' + name_of(one.verdict) + ',' + std::to_string(one.particles) + ',' +
               std::to_string(one.steps) + text_of(",%.6g", one.simulated) + text_of(",%.3g,", one.wall) +
               one.worst().name;
        for (const Criterion& criterion : one.criteria) csv += text_of(",%.4g", criterion.value);
        csv += ",\"" + one.fault + "\"\n";
    }
    return csv;
}

std::string stability_summary(const std::vector<Outcome>& outcomes) {
    std::array<std::size_t, 3> counts{};
    std::string rest;
    for (const Outcome& one : outcomes) {
        ++counts[static_cast<std::size_t>(one.verdict)];
        if (one.verdict != Verdict::passed) rest += stability::describe(one) + '\n';
    }
    std::string text = "\n" + std::to_string(outcomes.size()) + " scenes: " + std::to_string(counts[0]) + " passed, " +
                       std::to_string(counts[1]) + " bounded, " + std::to_string(counts[2]) + " failed\n";
    return rest.empty() ? text : text + rest;
}

bool draw_stability(const std::vector<Outcome>& outcomes, const std::string& file) {
    const std::vector<Row> rows = find_rows(outcomes);
    std::size_t columns = 1;
    for (const Row& row : rows) columns = std::max(columns, row.cells.size());
    const std::size_t height = rows.size();
    std::string commands = "set terminal pngcairo size 1400," + std::to_string(90 + 34 * height) +
                           " font 'sans,9'\nset output '" + file + "'\nset xrange [0:" + std::to_string(columns) +
                           "]\nset yrange [0:" + std::to_string(height) +
                           "]\nunset xtics\nunset border\nset lmargin 24\nset rmargin 2\n"
                           "set title 'Stability: green passed (light: worst criterion above half its bound), orange "
                           "bounded, red failed; worst criterion over its bound'\nset ytics nomirror out (";
    for (std::size_t r = 0; r < height; ++r)
        commands += (r > 0 ? ", '" : "'") + plain(rows[r].name) + "' " + text_of("%.1f", double(height - r) - 0.5);
    commands += ")\n";
    int number = 0;
    for (std::size_t r = 0; r < height; ++r) {
        for (std::size_t c = 0; c < rows[r].cells.size(); ++c) {
            const Outcome& one = *rows[r].cells[c];
            ++number;
            const double y = static_cast<double>(height - r), x = static_cast<double>(c);
            const std::string label =
                plain(one.variant) + "\\n" +
                (one.fault.empty() ? plain(one.worst().name) + text_of(" %.2g", one.worst().margin())
                                   : "stopped: " + plain(one.fault.substr(0, one.fault.find(':'))));
            commands += "set object " + std::to_string(number) + " rect from " + text_of("%.2f,", x + 0.02) +
                        text_of("%.2f to ", y - 0.96) + text_of("%.2f,", x + 0.98) + text_of("%.2f", y - 0.04) +
                        " fc rgb '" + colour_of(one) + "' fs solid noborder\nset label " + std::to_string(number) +
                        " \"" + label + "\" at " + text_of("%.2f,", x + 0.5) + text_of("%.2f", y - 0.36) +
                        " center font 'sans,8'\n";
        }
    }
    commands += "plot NaN notitle\n";
    return run_gnuplot(commands, file);
}

}  // namespace headrace::bench
