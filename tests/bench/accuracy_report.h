// What the measurements say: Pareto front, orders, cheapest settings; as text, and as diagrams drawn by gnuplot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/accuracy_row.h"

namespace headrace::bench {

// Indices of the rows no other row beats in both wall time and error, ascending in wall time. Errors that are NaN or
// above 1 never belong: they are no results.
std::vector<std::size_t> find_pareto_front(const std::vector<AccuracyRow>& rows);

// Slope of log error over log dp by least squares; nothing for fewer than two usable rows.
std::optional<double> fit_order(const std::vector<AccuracyRow>& rows);

// The row of least wall time with an error of at most `error`.
std::optional<std::size_t> find_cheapest(const std::vector<AccuracyRow>& rows, double error);

// Rows of one case and metric.
std::vector<AccuracyRow> select(const std::vector<AccuracyRow>& rows, const std::string& case_name,
                                const std::string& metric);

// Per case: order of each option, front, cheapest setting for 1 % and 0.3 %. Markdown.
std::string summarise(const std::vector<AccuracyRow>& rows);

// One PNG per case, and one with five cases side by side, below `folder`. False: gnuplot failed, said on stderr.
bool draw_diagrams(const std::vector<AccuracyRow>& rows, const std::string& folder);

}  // namespace headrace::bench
