#include "proto/values/tables.h"

#include <algorithm>
#include <cmath>

namespace headrace::scene {

using proto::Error;
using proto::ErrorCode;
using proto::Result;

Result<Table> Table::make(const proto::TableDesc& desc, int columns, const std::string& path,
                          bool may_have_zero_column) {
    const auto refused = [&](const std::string& where, const std::string& message, const std::string& hint) {
        return Error{ErrorCode::scene_invalid, message, path + ".table" + where, hint};
    };
    const auto wanted = static_cast<std::size_t>(columns) + 1;
    if (desc.rows.size() < 2) return refused("", "must have at least 2 rows", "a constant needs no table");
    Table table;
    table.columns_ = columns;
    for (std::size_t k = 0; k < desc.rows.size(); ++k) {
        const std::vector<double>& row = desc.rows[k];
        const std::string where = "[" + std::to_string(k) + "]";
        const bool has_zero_column = may_have_zero_column && row.size() == wanted + 1 && row.back() == 0.0;
        if (row.size() != wanted && !has_zero_column)
            return refused(where, "must have " + std::to_string(wanted) + " numbers, has " + std::to_string(row.size()),
                           columns == 1   ? "write [t, value]"
                           : columns == 2 ? "write [t, x, y]"
                                          : "write [t, x, y, z]");
        for (std::size_t column = 0; column < wanted; ++column)
            if (!std::isfinite(row[column]))
                return refused(where + "[" + std::to_string(column) + "]", "must be finite", "give numbers");
        if (k > 0 && !(row[0] > table.t_.back()))
            return refused(where + "[0]", "times must rise from row to row", "sort the rows by time [s]");
        table.t_.push_back(row[0]);
        table.y_.insert(table.y_.end(), row.begin() + 1, row.begin() + columns + 1);
    }
    table.y2_.resize(table.y_.size());
    for (int column = 0; column < columns; ++column) table.fit(column);
    for (std::size_t k = 0; k < table.y2_.size(); ++k)
        if (!std::isfinite(table.y2_[k]))
            return refused("[" + std::to_string(k / static_cast<std::size_t>(columns)) + "]",
                           "is too far from its neighbours for a curve through them",
                           "give values and times of ordinary size, in SI units");
    return table;
}

// Second derivatives from the continuity of the first: a tridiagonal system, solved by elimination.
void Table::fit(int column) {
    const std::size_t n = t_.size();
    const auto y = [&](std::size_t k) { return y_[k * columns_ + column]; };
    const auto y2 = [&](std::size_t k) -> double& { return y2_[k * columns_ + column]; };
    std::vector<double> above(n, 0.0);  // what is left of the upper diagonal
    for (std::size_t k = 1; k + 1 < n; ++k) {
        const double before = t_[k] - t_[k - 1], after = t_[k + 1] - t_[k];
        const double pivot = 2.0 * (before + after) - before * above[k - 1];
        const double jump = (y(k + 1) - y(k)) / after - (y(k) - y(k - 1)) / before;
        above[k] = after / pivot;
        y2(k) = (6.0 * jump - before * y2(k - 1)) / pivot;
    }
    for (std::size_t k = n - 1; k-- > 1;) y2(k) -= above[k] * y2(k + 1);
}

CurvePoint Table::at(int column, double t) const {
    const auto y = [&](std::size_t k) { return y_[k * columns_ + column]; };
    if (t < t_.front()) return {y(0)};
    if (t > t_.back()) return {y(t_.size() - 1)};
    const auto next = std::upper_bound(t_.begin(), t_.end() - 1, t);
    const auto k = static_cast<std::size_t>(next - t_.begin());  // row k - 1 <= t <= row k
    const double width = t_[k] - t_[k - 1];
    const double a = (t_[k] - t) / width, b = (t - t_[k - 1]) / width;  // weights of the two rows
    const double low = y2_[(k - 1) * columns_ + column], high = y2_[k * columns_ + column];
    return {a * y(k - 1) + b * y(k) + ((a * a * a - a) * low + (b * b * b - b) * high) * width * width / 6.0,
            (y(k) - y(k - 1)) / width + ((3.0 * b * b - 1.0) * high - (3.0 * a * a - 1.0) * low) * width / 6.0,
            a * low + b * high};
}

}  // namespace headrace::scene
