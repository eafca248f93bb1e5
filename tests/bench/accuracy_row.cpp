#include "tests/bench/accuracy_row.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace headrace::bench {

std::string accuracy_head() {
    return "case,metric,model,option,dimensions,dp,support_over_dp,sound_speed,particles,steps,wall_s,error";
}

std::string to_csv(const AccuracyRow& row) {
    char numbers[256];
    std::snprintf(numbers, sizeof numbers, "%d,%.6g,%.4g,%.6g,%zu,%zu,%.4g,%.5g", row.dimensions, row.dp,
                  row.support_over_dp, row.sound_speed, row.particles, row.steps, row.wall_s, row.error);
    return row.case_name + "," + row.metric + "," + row.model + "," + row.option + "," + numbers;
}

std::vector<AccuracyRow> load_rows(const std::string& path) {
    std::ifstream file(path);
    std::vector<AccuracyRow> rows;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream cells(line);
        std::vector<std::string> cell(12);
        for (std::string& one : cell) std::getline(cells, one, ',');
        const auto number = [&](std::size_t k) { return std::strtod(cell[k].c_str(), nullptr); };
        rows.push_back({cell[0], cell[1], cell[2], cell[3], static_cast<int>(number(4)), number(5), number(6),
                        number(7), static_cast<std::size_t>(number(8)), static_cast<std::size_t>(number(9)), number(10),
                        number(11)});
    }
    return rows;
}

std::vector<AccuracyRow> make_rows(const validation::Case& one, const std::string& model, const std::string& option,
                                   int dimensions, const validation::Outcome& outcome) {
    std::vector<AccuracyRow> rows;
    for (const validation::Measured& measured : outcome.metrics)
        rows.push_back({one.name, measured.metric, model, option, dimensions, outcome.spacing,
                        outcome.support / outcome.spacing, outcome.sound_speed, outcome.particles, outcome.steps,
                        outcome.wall, measured.value});
    return rows;
}

}  // namespace headrace::bench
