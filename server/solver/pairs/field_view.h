// One number per point, to read: stored in double or single precision, or made of what is stored, so that no array has
// to hold what a product tells. Pair loops read fields so (packed_fields-inl.h).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace headrace::solver {

class FieldView {
  public:
    enum class Kind { zero, wide, narrow, product, quotient, scaled, extrapolated };

    FieldView() = default;                                                      // 0 everywhere
    FieldView(const double* values) : kind_(Kind::wide), wide_(values) {}       // NOLINT: values
    FieldView(const std::vector<double>& values) : FieldView(values.data()) {}  // NOLINT: values
    FieldView(const float* values) : kind_(Kind::narrow), narrow_(values) {}    // NOLINT: values
    FieldView(const std::vector<float>& values) : FieldView(values.data()) {}   // NOLINT: values
    // a b, in double precision.
    FieldView(const std::vector<double>& a, const std::vector<float>& b)
        : kind_(Kind::product), wide_(a.data()), narrow_(b.data()) {}
    FieldView(double factor, const std::vector<float>& values)
        : kind_(Kind::scaled), narrow_(values.data()), factor_(factor) {}
    static FieldView quotient(const std::vector<double>& a, const std::vector<double>& b) {
        FieldView view(a);
        view.kind_ = Kind::quotient;
        view.divisor_ = b.data();
        return view;
    }

    // values + dt rates
    static FieldView extrapolated(const std::vector<double>& values, double dt, const std::vector<float>& rates) {
        FieldView view(values);
        view.kind_ = Kind::extrapolated;
        view.narrow_ = rates.data();
        view.factor_ = dt;
        return view;
    }

    Kind kind() const { return kind_; }
    const double* wide() const { return wide_; }
    const double* divisor() const { return divisor_; }
    const float* narrow() const { return narrow_; }
    double factor() const { return factor_; }

    // Those of points [begin, begin + count).
    void read(std::size_t begin, std::size_t count, double* to) const {
        switch (kind_) {
            case Kind::zero:
                return write(begin, count, to, [](std::size_t) { return 0.0; });
            case Kind::wide:
                return write(begin, count, to, [this](std::size_t i) { return wide_[i]; });
            case Kind::narrow:
                return write(begin, count, to, [this](std::size_t i) { return static_cast<double>(narrow_[i]); });
            case Kind::product:
                return write(begin, count, to,
                             [this](std::size_t i) { return wide_[i] * static_cast<double>(narrow_[i]); });
            case Kind::quotient:
                return write(begin, count, to, [this](std::size_t i) { return wide_[i] / divisor_[i]; });
            case Kind::scaled:
                return write(begin, count, to,
                             [this](std::size_t i) { return factor_ * static_cast<double>(narrow_[i]); });
            case Kind::extrapolated:
                return write(begin, count, to,
                             [this](std::size_t i) { return wide_[i] + factor_ * static_cast<double>(narrow_[i]); });
        }
    }
    double operator[](std::size_t i) const {
        double value = 0.0;
        read(i, 1, &value);
        return value;
    }

  private:
    template <class Value>
    static void write(std::size_t begin, std::size_t count, double* to, Value&& value) {
        for (std::size_t k = 0; k < count; ++k) to[k] = value(begin + k);
    }

    Kind kind_{Kind::zero};
    const double *wide_{}, *divisor_{};
    const float* narrow_{};
    double factor_{};
};

// 0 everywhere where nothing is stored.
template <class T>
FieldView view_or_zero(const std::vector<T>& values) {
    return values.empty() ? FieldView() : FieldView(values);
}

}  // namespace headrace::solver
