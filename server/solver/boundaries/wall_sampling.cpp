#include "server/solver/boundaries/wall_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/solver/boundaries/rigid_motion.h"
#include "server/solver/boundaries/sampling_lattice.h"
#include "server/solver/boundaries/sampling_round.h"

namespace headrace::solver {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Components of a unit vector below this are 0: round-off of a normal given in decimals.
constexpr double kParallel = 1e-12;

void sample_box(const Body& body, const Box& box, const SamplingSpace& space, Index object,
                std::vector<Dummy>& dummies) {
    std::array<std::vector<Slot>, 3> axes;
    axes[2] = {{0.0, 1.0, false}};
    for (int k = 0; k < space.dimensions; ++k) {
        const double min = box.center[k] - box.half_extent[k], max = box.center[k] + box.half_extent[k];
        axes[k] = body.endless[k] ? slots_along_period(space, k)
                                  : slots_across(min, max, body.is_container, space, {space.low(k), space.high(k)});
    }
    for_each_solid(axes, [&](const Slot& a, const Slot& b, const Slot& c) {
        append_dummy(body, space, {a.x, b.x, c.x}, a.width * b.width * c.width, object, dummies);
    });
}

// Directions in the plane: the domain's axes where they lie in it, the others at right angles.
std::vector<Repetition> plane_tangents(const Plane& plane, int dimensions) {
    std::vector<Repetition> tangents;
    for (int k = 0; k < dimensions; ++k) {
        if (std::abs(plane.normal[k]) >= kParallel) continue;
        Repetition along;
        along.direction[k] = 1.0;
        along.periodic_axis = k;
        tangents.push_back(along);
    }
    const auto needed = static_cast<std::size_t>(dimensions - 1);
    if (tangents.size() > needed) tangents.resize(needed);
    while (tangents.size() < needed) {
        Vec3 other{0.0, 0.0, 1.0};
        if (!tangents.empty()) other = tangents.front().direction;
        Vec3 t = rigid::cross(other, plane.normal);
        t = rigid::times(1.0 / rigid::length(t), t);
        tangents.push_back({t, 0.0, -1});
    }
    return tangents;
}

// Cells along one tangent: a period, or as many as the grown domain needs wherever the plane stands.
std::vector<Slot> slots_along(const Repetition& tangent, const Plane& plane, const SamplingSpace& space) {
    if (tangent.periodic_axis >= 0) return slots_along_period(space, tangent.periodic_axis);
    double origin = rigid::dot(tangent.direction, plane.point), low = 0.0, high = 0.0;
    for (int k = 0; k < space.dimensions; ++k) {
        const double a = tangent.direction[k] * (space.domain.min[k] - space.depth);
        const double b = tangent.direction[k] * (space.domain.max[k] + space.depth);
        low += std::min(a, b);
        high += std::max(a, b);
        if (tangent.direction[k] == 1.0) origin = space.domain.min[k];
    }
    if (!space.is_bounded) {
        const double middle = 0.5 * (low + high);
        low = middle - 0.5 * tangent.period;
        high = middle + 0.5 * tangent.period;
    }
    const double first = std::ceil((low - origin) / space.dx - 0.5);
    const double count =
        space.is_bounded ? std::floor((high - low) / space.dx) + 2.0 : std::round(tangent.period / space.dx);
    std::vector<Slot> slots;
    append_slots(origin + first * space.dx, space.dx, count, {-kInfinity, kInfinity}, false, slots);
    return slots;
}

void sample_plane(const Body& body, const Plane& plane, const SamplingSpace& space, Index object,
                  std::vector<Dummy>& dummies) {
    const std::vector<Repetition> tangents = plane_repetitions(plane, space);
    std::array<std::vector<Slot>, 3> axes;
    append_slots(rigid::dot(plane.normal, plane.point), -space.dx, space.layers, {-kInfinity, kInfinity}, true,
                 axes[0]);
    axes[1] = slots_along(tangents[0], plane, space);
    axes[2] = {{0.0, 1.0, false}};
    if (tangents.size() > 1) axes[2] = slots_along(tangents[1], plane, space);
    for_each_solid(axes, [&](const Slot& below, const Slot& first, const Slot& second) {
        Vec3 X = rigid::plus(rigid::times(below.x, plane.normal), rigid::times(first.x, tangents[0].direction));
        if (tangents.size() > 1) X = rigid::plus(X, rigid::times(second.x, tangents[1].direction));
        append_dummy(body, space, X, below.width * first.width * second.width, object, dummies);
    });
}

}  // namespace

double SamplingSpace::low(int axis) const {
    return is_bounded && !domain.periodic[axis] ? domain.min[axis] - depth : -kInfinity;
}

double SamplingSpace::high(int axis) const {
    return is_bounded && !domain.periodic[axis] ? domain.max[axis] + depth : kInfinity;
}

bool SamplingSpace::holds(const Vec3& X) const {
    for (int k = 0; k < dimensions; ++k) {
        if (!(X[k] >= low(k) && X[k] <= high(k))) return false;
    }
    return true;
}

SamplingSpace make_sampling_space(int dimensions, double dx, double depth, const Domain& domain) {
    // The largest k with (k + 1/2) dx < depth, and one more; 1e-9: a depth given as 2.5 dx ends before its layer.
    const int layers = std::max(1, static_cast<int>(std::ceil(depth / dx - 0.5 - 1e-9)));
    return {dimensions, dx, depth, layers, domain, true};
}

std::vector<Repetition> plane_repetitions(const Plane& plane, const SamplingSpace& space) {
    std::vector<Repetition> repetitions = plane_tangents(plane, space.dimensions);
    Vec3 diagonal{};
    for (int k = 0; k < space.dimensions; ++k) diagonal[k] = space.domain.max[k] - space.domain.min[k];
    for (Repetition& repetition : repetitions) {
        const int axis = repetition.periodic_axis;
        if (axis >= 0 && space.domain.periodic[axis]) {
            repetition.period = diagonal[axis];
        } else {
            // Long enough to span the grown domain at any angle.
            repetition.periodic_axis = -1;
            repetition.period = std::ceil((rigid::length(diagonal) + 4.0 * space.depth) / space.dx) * space.dx;
        }
    }
    return repetitions;
}

void sample_walls(const Body& body, const SamplingSpace& space, Index object, std::vector<Dummy>& dummies) {
    if (const Box* box = std::get_if<Box>(&body.shape)) {
        sample_box(body, *box, space, object, dummies);
    } else if (const Sphere* sphere = std::get_if<Sphere>(&body.shape)) {
        sample_sphere(body, *sphere, space, object, dummies);
    } else if (const Cylinder* cylinder = std::get_if<Cylinder>(&body.shape)) {
        if (space.dimensions == 3) sample_cylinder(body, *cylinder, space, object, dummies);
    } else {
        sample_plane(body, std::get<Plane>(body.shape), space, object, dummies);
    }
}

}  // namespace headrace::solver
