// Tables of values over time: a cubic spline through the rows.
//
// Natural cubic spline (second derivative 0 at both ends), continuous up to the second derivative between the first and
// the last row; two rows give a straight line. Before the first and after the last row the value stays what it is there
// and the derivatives are 0, so the rate jumps at an end where the table does not level off.
#pragma once

#include <string>
#include <vector>

#include "proto/result.h"
#include "proto/scene_desc.h"

namespace headrace::scene {

// A value, how fast it changes, and how fast that does.
struct CurvePoint {
    double value{}, rate{}, acceleration{};  // [u], [u/s], [u/s^2]
};

class Table {
  public:
    // Rows of [t, value ...] with `columns` values; 2D tables of vectors may have a third one, which is 0. Errors:
    // scene_invalid with the path of the row: times that do not rise, widths that differ, numbers that are not finite.
    static proto::Result<Table> make(const proto::TableDesc& table, int columns, const std::string& path,
                                     bool may_have_zero_column = false);

    CurvePoint at(int column, double t) const;
    double start() const { return t_.front(); }  // [s]
    double end() const { return t_.back(); }     // [s]

  private:
    void fit(int column);

    int columns_{};
    std::vector<double> t_;       // [s]
    std::vector<double> y_, y2_;  // value and second derivative, row by row, `columns_` each
};

}  // namespace headrace::scene
