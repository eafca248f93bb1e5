// Values over time from a scene's expressions and tables, with their first two derivatives.
//
// Of tables the derivatives are those of the spline. Of expressions they are central differences of fourth order:
//   f'  = (f(t-2h) - 8 f(t-h) + 8 f(t+h) - f(t+2h)) / 12h                      error h^4 f(5) / 30
//   f'' = (-f(t-2h) + 16 f(t-h) - 30 f(t) + 16 f(t+h) - f(t+2h)) / 12h^2       error h^4 f(6) / 90
// with that h of 10^-2, 10^-3, .. 10^-6 s at which two neighbouring steps agree best, since truncation falls and
// rounding grows with smaller h. For a sine of 1 .. 10^4 rad/s that leaves errors below 10^-8 (f') and 10^-6 (f'') of
// the amplitudes. An expression must be finite within 2 * 10^-6 s about the time asked for, t = 0 included.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>

#include "proto/result.h"
#include "proto/scene_desc.h"
#include "proto/values/expressions.h"
#include "proto/values/tables.h"

namespace headrace::scene {

// Safe from any thread.
class Curve {
  public:
    Curve() = default;  // 0
    explicit Curve(Formula formula) : formula_(std::move(formula)) {}
    Curve(std::shared_ptr<const Table> table, int column) : table_(std::move(table)), column_(column) {}

    bool is_zero() const { return !table_ && formula_.is_zero(); }
    double value(double t) const;
    CurvePoint at(double t) const;

  private:
    Formula formula_;
    std::shared_ptr<const Table> table_;  // null: the formula
    int column_{};
};

using ScalarOverTime = std::variant<proto::Scalar, proto::TableDesc>;
using VectorOverTime = std::variant<proto::ScalarVec3, proto::TableDesc>;

proto::Result<Curve> make_curve(const ScalarOverTime& desc, double spacing, const std::string& path);
proto::Result<std::array<Curve, 3>> make_curves(const VectorOverTime& desc, int dimensions, double spacing,
                                                const std::string& path);

}  // namespace headrace::scene
