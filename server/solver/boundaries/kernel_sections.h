// A kernel summed over points, lines and planes: what a wall's solid is put together from (wall_profile.h,
// integral_walls.h). Made once, of any kernel; then tables in the distance.
//
// Lines and planes are sums over a lattice as wide as the fluid's, one of whose points is nearest to the centre: a
// particle on a lattice sees that lattice go on in the solid. A finer lattice comes to the integral.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace headrace::solver {

// As functions of the distance [m].
struct SectionKernel {
    int dimensions{3};
    double support{};                         // R [m]
    std::function<double(double)> W;          // [m^-D]
    std::function<double(double)> F;          // W'(r)/r [m^-(D+2)]
    std::function<double(double)> F_shifted;  // F with the weight of the shifting (forces/shifting.h)
};

// Sums over one point, or times the lattice's cell over a line or plane, at the distance s; t is a coordinate along it.
struct Section {
    double W{};          // W
    double F{};          // F
    double F_tt{};       // F t^2
    double F_shifted{};  // F_shifted
    double F_yy_r2{};    // F s^2/r^2

    // F t^2/r^2 along one of the section's `extent` axes.
    double F_tt_r2(int extent) const { return extent == 0 ? 0.0 : (F - F_yy_r2) / extent; }
};

// value(x) between equally spaced entries, linear: error at most step^2/8 of the second derivative.
template <class Entry>
class LinearTable {
  public:
    LinearTable() = default;
    template <class Make>
    LinearTable(double first, double last, int steps, Make&& make)
        : first_(first), inv_step_(steps / (last - first)), entries_(static_cast<std::size_t>(steps) + 1) {
        for (int k = 0; k <= steps; ++k)
            entries_[static_cast<std::size_t>(k)] = make(first + (last - first) * k / steps);
    }

    // Beyond the ends: the value there.
    Entry operator()(double x) const {
        const double last = static_cast<double>(entries_.size() - 1);
        const double at = (x - first_) * inv_step_;
        const double within = at > 0.0 ? (at < last ? at : last) : 0.0;
        const auto k = static_cast<std::size_t>(within < last ? within : last - 1.0);
        const double share = within - static_cast<double>(k);
        Entry value;
        constexpr std::size_t kNumbers = sizeof(Entry) / sizeof(double);
        const auto *a = reinterpret_cast<const double*>(&entries_[k]), *b = a + kNumbers;
        auto* to = reinterpret_cast<double*>(&value);
        for (std::size_t n = 0; n < kNumbers; ++n) to[n] = a[n] + share * (b[n] - a[n]);
        return value;
    }

  private:
    double first_{}, inv_step_{};
    std::vector<Entry> entries_;
};

// extent: 0 a point, 1 a line, 2 a plane. cell [m]: of the lattice.
Section sum_section(const SectionKernel& kernel, int extent, double cell, double s);

inline constexpr int kSectionSteps = 512;  // of the tables, over the support

using SectionTable = LinearTable<Section>;
SectionTable make_section_table(const SectionKernel& kernel, int extent, double cell);

}  // namespace headrace::solver
