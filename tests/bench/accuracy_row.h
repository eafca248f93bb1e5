// One measurement: a metric of one run of a case, with what it cost. A line of accuracy.csv.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/validation/support/case.h"

namespace headrace::bench {

struct AccuracyRow {
    std::string case_name;
    std::string metric;
    std::string model;
    std::string option;  // what differs from the model's defaults, "default": nothing
    int dimensions{};
    double dp{};               // [m]
    double support_over_dp{};  // R/dp
    double sound_speed{};      // [m/s]
    std::size_t particles{};
    std::size_t steps{};
    double wall_s{};  // [s] in the steps
    double error{};   // NaN: the run broke
};

std::string accuracy_head();
std::string to_csv(const AccuracyRow& row);
std::vector<AccuracyRow> load_rows(const std::string& path);  // empty: no such file

std::vector<AccuracyRow> make_rows(const validation::Case& one, const std::string& model, const std::string& option,
                                   int dimensions, const validation::Outcome& outcome);

}  // namespace headrace::bench
