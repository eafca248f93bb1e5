#include "server/solver/boundaries/sampling_lattice.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace headrace::solver {

double whole_number(double length, double step) {
    return step > 0.0 ? std::max(1.0, std::round(length / step)) : 1.0;
}

void check_wall_count(double count) {
    // Written so that NaN is refused too.
    if (!(count <= static_cast<double>(kMaxWallParticles))) {
        throw std::length_error(
            "walls need more than 20 million dummy particles: the objects are too large for the spacing");
    }
}

void append_slots(double origin, double step, double count, const Bounds& bounds, bool is_solid,
                  std::vector<Slot>& slots) {
    double first = 0.0, end = count;
    if (step != 0.0) {
        const double i_low = (bounds.low - origin) / step - 0.5, i_high = (bounds.high - origin) / step - 0.5;
        first = std::max(first, std::ceil(std::min(i_low, i_high)));
        end = std::min(end, std::floor(std::max(i_low, i_high)) + 1.0);
    }
    if (end <= first) return;
    check_wall_count(end - first);
    for (double i = first; i < end; i += 1.0) slots.push_back({origin + (i + 0.5) * step, std::abs(step), is_solid});
}

std::vector<Slot> slots_across(double min, double max, bool is_container, const SamplingSpace& space,
                               const Bounds& bounds) {
    const double count = whole_number(max - min, space.dx);
    const double width = (max - min) / count;
    std::vector<Slot> slots;
    if (is_container) append_slots(min, -space.dx, space.layers, bounds, true, slots);
    const std::size_t inside = slots.size();
    append_slots(min, width, count, bounds, false, slots);
    if (is_container) {
        append_slots(max, space.dx, space.layers, bounds, true, slots);
    } else {
        const double depth = space.depth * (1.0 + 1e-9);  // round-off must not drop a layer
        for (std::size_t k = inside; k < slots.size(); ++k) {
            slots[k].is_solid = std::min(slots[k].x - min, max - slots[k].x) <= depth;
        }
    }
    return slots;
}

double count_solid(const std::array<std::vector<Slot>, 3>& axes) {
    double all = 1.0, open = 1.0;
    for (const std::vector<Slot>& axis : axes) {
        all *= static_cast<double>(axis.size());
        open *= static_cast<double>(
            std::count_if(axis.begin(), axis.end(), [](const Slot& slot) { return !slot.is_solid; }));
    }
    return all - open;
}

std::vector<Slot> slots_along_period(const SamplingSpace& space, int axis) {
    const double min = space.domain.min[axis], period = space.domain.max[axis] - min;
    const double count = whole_number(period, space.dx);
    std::vector<Slot> slots;
    append_slots(min, period / count, count, {min, space.domain.max[axis]}, false, slots);
    return slots;
}

void append_dummy(const SamplingSpace& space, const Dummy& dummy, std::vector<Dummy>& dummies) {
    if (!(dummy.V > 0.0) || !space.holds(dummy.X)) return;
    check_wall_count(static_cast<double>(dummies.size() + 1));
    dummies.push_back(dummy);
}

void append_dummy(const Body& body, const SamplingSpace& space, const Vec3& X, double V, Index object,
                  std::vector<Dummy>& dummies) {
    const SurfacePoint surface = nearest_surface(body, X);
    append_dummy(space, {X, surface.normal, V, -surface.distance, object, 0}, dummies);
}

}  // namespace headrace::solver
