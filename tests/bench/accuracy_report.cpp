#include "tests/bench/accuracy_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "tests/validation/support/case.h"

namespace headrace::bench {

namespace {

bool is_usable(const AccuracyRow& row) {
    return std::isfinite(row.error) && row.error > 0.0 && row.wall_s > 0.0;
}

std::string setting_of(const AccuracyRow& row) {
    char text[160];
    std::snprintf(text, sizeof text, "%s %s, dp %.4g m, R/dp %.2g, c0 %.3g m/s: error %.2g in %.2g s",
                  row.model.c_str(), row.option.c_str(), row.dp, row.support_over_dp, row.sound_speed, row.error,
                  row.wall_s);
    return text;
}

// In the order of first appearance.
std::vector<std::string> options_of(const std::vector<AccuracyRow>& rows) {
    std::vector<std::string> names;
    for (const AccuracyRow& row : rows) {
        const std::string name = row.model + " " + row.option;
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    return names;
}

std::string cheapest_line(const std::vector<AccuracyRow>& rows, double error, const char* name) {
    const auto cheapest = find_cheapest(rows, error);
    return std::string("- ") + name + ": " + (cheapest ? setting_of(rows[*cheapest]) : "not reached") + "\n";
}

}  // namespace

std::vector<std::size_t> find_pareto_front(const std::vector<AccuracyRow>& rows) {
    std::vector<std::size_t> order(rows.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t i) { return !is_usable(rows[i]) || rows[i].error > 1.0; });
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return rows[a].wall_s != rows[b].wall_s ? rows[a].wall_s < rows[b].wall_s : rows[a].error < rows[b].error;
    });
    std::vector<std::size_t> front;
    for (const std::size_t i : order)
        if (front.empty() || rows[i].error < rows[front.back()].error) front.push_back(i);
    return front;
}

std::optional<double> fit_order(const std::vector<AccuracyRow>& rows) {
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const AccuracyRow& row : rows) {
        if (!is_usable(row)) continue;
        const double u = std::log(row.dp), v = std::log(row.error);
        n += 1;
        x += u;
        y += v;
        xx += u * u;
        xy += u * v;
    }
    const double spread = n * xx - x * x;
    if (n < 2 || spread <= 0.0) return std::nullopt;
    return (n * xy - x * y) / spread;
}

std::optional<std::size_t> find_cheapest(const std::vector<AccuracyRow>& rows, double error) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!is_usable(rows[i]) || rows[i].error > error) continue;
        if (!best || rows[i].wall_s < rows[*best].wall_s) best = i;
    }
    return best;
}

std::vector<AccuracyRow> select(const std::vector<AccuracyRow>& rows, const std::string& case_name,
                                const std::string& metric) {
    std::vector<AccuracyRow> chosen;
    for (const AccuracyRow& row : rows)
        if (row.case_name == case_name && row.metric == metric) chosen.push_back(row);
    return chosen;
}

std::string summarise(const std::vector<AccuracyRow>& rows) {
    std::string text =
        "# Run time against error\n\nOf each case's main metric. Order: slope of log error over log dp.\n";
    for (const validation::Case& one : validation::cases()) {
        const auto of_case = select(rows, one.name, one.main_metric);
        if (of_case.empty()) continue;
        text += "\n## " + one.name + ": " + one.main_metric + "\n\n";
        text += cheapest_line(of_case, 0.01, "1 %") + cheapest_line(of_case, 0.003, "0.3 %") + "- front:\n";
        for (const std::size_t i : find_pareto_front(of_case)) text += "  - " + setting_of(of_case[i]) + "\n";
        text += "\n| option | order | error at the finest | wall [s] |\n|---|---|---|---|\n";
        for (const std::string& option : options_of(of_case)) {
            std::vector<AccuracyRow> line;
            for (const AccuracyRow& row : of_case)
                if (row.model + " " + row.option == option) line.push_back(row);
            const auto finest =
                std::min_element(line.begin(), line.end(), [](const auto& a, const auto& b) { return a.dp < b.dp; });
            const auto order = fit_order(line);
            char cells[96];
            std::snprintf(cells, sizeof cells, " | %.2g | %.3g |\n", finest->error, finest->wall_s);
            char slope[16] = "-";
            if (order) std::snprintf(slope, sizeof slope, "%.1f", *order);
            text += "| " + option + " | " + slope + cells;
        }
    }
    return text;
}

}  // namespace headrace::bench
