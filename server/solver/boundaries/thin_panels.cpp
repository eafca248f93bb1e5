#include "server/solver/boundaries/thin_panels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/solver/boundaries/rigid_motion.h"
#include "server/solver/boundaries/sampling_lattice.h"

namespace headrace::solver {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Lattice points often lie so that lines between them hit edges exactly; they must all decide alike whatever the
// round-off (about 1e-13 of a line). So lines pass by a rim of this share of the depth, and faces entered within
// this share of a line count as entered at once: the lower axis has it.
constexpr double kRim = 1e-9;
constexpr double kAtOnce = 1e-11;

// Cells along an axis in the face: as many as fit between its edges, going on beyond them as far as the depth.
std::vector<Slot> slots_in_face(double min, double max, const SamplingSpace& space, int axis) {
    const double count = whole_number(max - min, space.dx);
    const double width = (max - min) / count;
    // Of a face much narrower than the spacing little is seen; it needs no cells beyond its edges.
    const double beyond = width >= 0.5 * space.dx ? std::ceil(space.depth / width) : 0.0;
    std::vector<Slot> slots;
    append_slots(min - beyond * width, width, count + 2.0 * beyond, {space.low(axis), space.high(axis)}, false, slots);
    return slots;
}

// [m] from X to the face's rectangle, and the unit vector from X to its nearest point.
SurfacePoint nearest_in_face(const ThinPanel& panel, int face, const Vec3& X) {
    Vec3 to_face{};
    for (int k = 0; k < panel.dimensions; ++k) to_face[k] = std::clamp(X[k], panel.low[k], panel.high[k]) - X[k];
    const int axis = face / 2;
    to_face[axis] = (face % 2 ? panel.high[axis] : panel.low[axis]) - X[axis];
    const double distance = rigid::length(to_face);
    return {distance, rigid::times(1.0 / distance, to_face)};
}

}  // namespace

std::optional<ThinPanel> make_thin_panel(const Body& body, double depth) {
    const Box* box = std::get_if<Box>(&body.shape);
    if (!box || body.is_container) return std::nullopt;
    ThinPanel panel{body.dimensions, {}, {}, kRim * depth};
    double smallest = kInfinity;
    for (int k = 0; k < body.dimensions; ++k) {
        const double half = body.endless[k] ? kInfinity : box->half_extent[k];
        panel.low[k] = box->center[k] - half;
        panel.high[k] = box->center[k] + half;
        smallest = std::min(smallest, 2.0 * half);
    }
    if (!(smallest < 2.0 * depth * (1.0 - 1e-9))) return std::nullopt;
    return panel;
}

Vec3 ThinPanel::push_out(const Vec3& X) const {
    double nearest = kInfinity;
    Vec3 out = X;
    for (int k = 0; k < dimensions; ++k) {
        if (!(X[k] > low[k] && X[k] < high[k])) return X;
        for (const double face : {low[k], high[k]}) {
            if (std::abs(X[k] - face) >= nearest) continue;
            nearest = std::abs(X[k] - face);
            out = X;
            out[k] = face;
        }
    }
    return out;
}

std::optional<ThinPanel::Entry> ThinPanel::enter(const Vec3& start, const Vec3& to) const {
    const Vec3 from = push_out(start);
    Entry entry{-kInfinity, 0};
    double t_leave = kInfinity;
    for (int k = 0; k < dimensions; ++k) {
        if (low[k] == -kInfinity) continue;
        const double rim = std::min(edge, 0.25 * (high[k] - low[k])), step = to[k] - from[k];
        const double near_low = low[k] + rim, near_high = high[k] - rim;
        if (step == 0.0) {
            if (from[k] <= near_low || from[k] >= near_high) return std::nullopt;
            continue;
        }
        const double t_low = (near_low - from[k]) / step, t_high = (near_high - from[k]) / step;
        const double t_in = std::min(t_low, t_high);
        if (t_in > entry.t + kAtOnce || entry.t == -kInfinity) entry = {t_in, 2 * k + (step < 0.0 ? 1 : 0)};
        t_leave = std::min(t_leave, std::max(t_low, t_high));
    }
    const bool is_hit = entry.t <= t_leave && entry.t < 1.0 && t_leave > 0.0;
    return is_hit ? std::optional(entry) : std::nullopt;
}

double ThinPanel::distance(const Vec3& X) const {
    double square = 0.0;
    for (int k = 0; k < dimensions; ++k) {
        const double excess = std::max({low[k] - X[k], X[k] - high[k], 0.0});
        square += excess * excess;
    }
    return std::sqrt(square);
}

void sample_thin_panel(const Body& body, const SamplingSpace& space, Index object, std::vector<Dummy>& dummies) {
    const std::optional<ThinPanel> panel = make_thin_panel(body, space.depth);
    for (int face = 0; panel && face < 2 * body.dimensions; ++face) {
        const int axis = face / 2;
        if (body.endless[axis]) continue;
        std::array<std::vector<Slot>, 3> axes;
        axes[2] = {{0.0, 1.0, false}};
        for (int k = 0; k < body.dimensions; ++k) {
            if (k == axis) {
                append_slots(face % 2 ? panel->high[k] : panel->low[k], face % 2 ? -space.dx : space.dx, space.layers,
                             {space.low(k), space.high(k)}, true, axes[k]);
            } else {
                axes[k] = body.endless[k] ? slots_along_period(space, k)
                                          : slots_in_face(panel->low[k], panel->high[k], space, k);
            }
        }
        for_each_solid(axes, [&](const Slot& a, const Slot& b, const Slot& c) {
            const Vec3 X{a.x, b.x, c.x};
            const SurfacePoint window = nearest_in_face(*panel, face, X);
            // Out of reach of any line through the window: seen by nobody.
            if (window.distance > space.depth * (1.0 + 1e-9)) return;
            const double V = a.width * b.width * c.width;
            append_dummy(space, {X, window.normal, V, window.distance, object, static_cast<Index>(face + 1)}, dummies);
        });
    }
}

}  // namespace headrace::solver
