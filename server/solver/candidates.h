// The candidates of a cell: the particles of the cells around it, copied side by side once and then read by every
// particle of the cell out of the first-level cache. One array per field, aligned and padded to full SIMD vectors,
// so loops over them need neither gathers nor remainders, and lane order is the same wherever the buffer lies.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <new>

#include "server/solver/neighbours.h"

namespace headrace::solver {

class Candidates {
  public:
    static constexpr std::size_t kAlignment = 64;                       // bytes, a cache line and an AVX-512 vector
    static constexpr std::size_t kLanes = kAlignment / sizeof(double);  // doubles a vector

    // Copies `fields` of the particles in `near`. The first is the x coordinate, where padding stands out of reach;
    // other fields are padded with 0. Returns the padded count.
    template <std::size_t Fields>
    std::size_t gather(const Neighbourhood& near, const std::array<const double*, Fields>& fields) {
        const std::size_t padded = (near.particles + kLanes - 1) / kLanes * kLanes;
        reserve(padded, Fields);
        for (std::size_t f = 0; f < Fields; ++f) {
            double* to = field(f);
            for (int k = 0; k < near.runs; ++k) {
                const std::size_t length = near.run[k].end - near.run[k].begin;
                std::memcpy(to, fields[f] + near.run[k].begin, length * sizeof(double));
                to += length;
            }
            for (std::size_t pad = near.particles; pad < padded; ++pad) *to++ = f == 0 ? kFarAway : 0.0;
        }
        return padded;
    }

    double* field(std::size_t f) { return data_.get() + f * capacity_; }

  private:
    // [m] Beyond the support radius of anything, and its square is finite.
    static constexpr double kFarAway = 1e100;

    struct Free {
        void operator()(double* data) const { ::operator delete[](data, std::align_val_t{kAlignment}); }
    };

    void reserve(std::size_t padded, std::size_t fields) {
        if (padded <= capacity_ && fields <= fields_) return;
        if (padded > capacity_) capacity_ = 2 * padded;
        if (fields > fields_) fields_ = fields;
        data_.reset(
            static_cast<double*>(::operator new[](capacity_* fields_ * sizeof(double), std::align_val_t{kAlignment})));
    }

    std::size_t capacity_{}, fields_{};
    std::unique_ptr<double, Free> data_;
};

}  // namespace headrace::solver
