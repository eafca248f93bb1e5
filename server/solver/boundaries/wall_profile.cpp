#include "server/solver/boundaries/wall_profile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace headrace::solver {
namespace {

constexpr int kProfileSteps = 512;

// A layer's section at the distance y_n beyond the point.
struct Profiles : WallProfile, ViscousProfile {};
void add_layer(Profiles& sum, const Section& s, int along, double weight, double y_n, double depth) {
    const double k_n = weight * s.F_yy_r2, k_t = weight * s.F_tt_r2(along);
    sum.w -= weight * s.F * y_n;
    sum.m_n -= weight * s.F * y_n * y_n;
    sum.m_t -= weight * s.F_tt;
    sum.w_shifted -= weight * s.F_shifted * y_n;
    sum.gamma += weight * s.W;
    sum.k_n += k_n;
    sum.k_t += k_t;
    sum.l_n += k_n * depth;
    sum.l_t += k_t * depth;
}

template <class Make>
WallProfileTable make_tables(double first, double last, Make&& make) {
    return {{first, last, kProfileSteps, [&](double d) -> WallProfile { return make(d); }},
            {first, last, kProfileSteps, [&](double d) -> ViscousProfile { return make(d); }}};
}

}  // namespace

WallLayers make_wall_layers(double thickness, double support) {
    // One more for points that have sunk in.
    return {thickness, static_cast<int>(std::ceil(support / thickness)) + 1};
}

WallProfileTable make_plane_profile(const SectionKernel& kernel, const WallLayers& layers) {
    const int along = kernel.dimensions - 1;
    const SectionTable sections = make_section_table(kernel, along, layers.thickness);
    return make_tables(-layers.thickness, kernel.support, [&](double d) {
        Profiles sum;
        for (int k = 0; k < layers.count; ++k) {
            const double depth = layers.depth(k), y_n = d + depth;
            add_layer(sum, sections(std::abs(y_n)), along, layers.thickness, y_n, depth);
        }
        return sum;
    });
}

WallProfileTable make_sphere_profile(const SectionKernel& kernel, const WallLayers& layers, double radius,
                                     bool is_container) {
    constexpr int kSlices = 100;  // midpoint rule in the angle, error 1e-5 of the whole
    const int D = kernel.dimensions;
    const double R = kernel.support, out = is_container ? 1.0 : -1.0;  // of the solid, along the radius
    return make_tables(-layers.thickness, R, [&](double d) {
        Profiles sum;
        const double rho = radius - out * d;
        for (int k = 0; k < layers.count; ++k) {
            const double depth = layers.depth(k), q = radius + out * depth;
            if (!(q > 0.0)) break;
            const double cosine = (q * q + rho * rho - R * R) / (2.0 * q * std::max(rho, 1e-12 * R));
            if (cosine >= 1.0) continue;
            const double widest = std::acos(std::max(cosine, -1.0)), step = widest / kSlices;
            // The shell's volume over its middle's area: exact.
            const double thickness = layers.thickness + (D == 3 ? std::pow(layers.thickness, 3) / (12.0 * q * q) : 0.0);
            for (int a = 0; a < kSlices; ++a) {
                const double angle = (a + 0.5) * step;
                const double area = D == 2 ? 2.0 * q * step : 2.0 * std::numbers::pi * q * q * std::sin(angle) * step;
                const double y_n = out * (q * std::cos(angle) - rho), t = q * std::sin(angle);
                const double r2 = y_n * y_n + t * t, r = std::sqrt(r2), F = kernel.F(r);
                const Section s{kernel.W(r), F, F * t * t / (D - 1), kernel.F_shifted(r), F * y_n * y_n / r2};
                add_layer(sum, s, D - 1, thickness * area, y_n, depth);
            }
        }
        return sum;
    });
}

}  // namespace headrace::solver
