#include "server/solver/boundaries/wall_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "server/solver/boundaries/rigid_motion.h"

namespace headrace::solver {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-9;  // [supports] round-off of faces given as decimal numbers

struct Bounds {
    Vec3 low{-kInfinity, -kInfinity, -kInfinity}, high{kInfinity, kInfinity, kInfinity};
};

// The axis that a plane's normal lies along, and the side of the room: 0 low, 1 high.
struct PlaneSide {
    int axis{};
    int side{};
};
std::optional<PlaneSide> side_of(const Plane& plane, int dimensions) {
    for (int k = 0; k < dimensions; ++k) {
        if (std::abs(plane.normal[k]) > 1.0 - 1e-12) return PlaneSide{k, plane.normal[k] > 0.0 ? 0 : 1};
    }
    return std::nullopt;
}

class Chooser {
  public:
    Chooser(std::span<const CollisionObject> objects, const Domain& domain, int dimensions, double support)
        : objects_(objects), domain_(domain), dimensions_(dimensions), support_(support) {
        for (const CollisionObject& object : objects) {
            bodies_.push_back(make_body(object, domain, dimensions));
            has_moving_ = has_moving_ || (object.motion && !object.is_belt);
        }
    }

    WallChoice choose() {
        WallChoice choice;
        choice.is_integral.assign(objects_.size(), 0);
        if (has_moving_) {
            choice.remark = "some move";
            return choice;
        }
        std::vector<char>& chosen = choice.is_integral;
        for (std::size_t k = 0; k < objects_.size(); ++k) chosen[k] = is_suitable(k);
        limit_obstacles(chosen);
        while (drop_overlapping(chosen)) {
        }
        if (std::count(chosen.begin(), chosen.end(), 0) > 0)
            choice.remark = "others are not boxes, spheres or planes along the axes, too thin, too many, or overlap";
        return choice;
    }

  private:
    const Plane* plane(std::size_t k) const { return std::get_if<Plane>(&objects_[k].shape); }
    const Box* box(std::size_t k) const { return std::get_if<Box>(&objects_[k].shape); }
    const Sphere* sphere(std::size_t k) const { return std::get_if<Sphere>(&objects_[k].shape); }
    bool bounds_room(std::size_t k) const { return plane(k) || (bodies_[k].is_container && box(k)); }

    bool is_suitable(std::size_t k) const {
        if (const Plane* flat = plane(k)) return side_of(*flat, dimensions_).has_value();
        const Body& body = bodies_[k];
        if (!box(k) && !sphere(k)) return false;
        for (int axis = 0; axis < dimensions_; ++axis) {
            if (body.endless[axis]) continue;
            const double width = 2.0 * (box(k) ? box(k)->half_extent[axis] : sphere(k)->radius);
            if (!body.is_container && width < 2.0 * support_) return false;
            if (!domain_.periodic[axis]) continue;
            if (body.is_container || width + 2.0 * support_ > domain_.max[axis] - domain_.min[axis]) return false;
        }
        return true;
    }

    void limit_obstacles(std::vector<char>& chosen) const {
        std::size_t count = 0;
        for (std::size_t k = 0; k < chosen.size(); ++k) count += chosen[k] && !bounds_room(k) ? 1 : 0;
        if (count <= IntegralWalls::kMostObstacles) return;
        for (std::size_t k = 0; k < chosen.size(); ++k) chosen[k] = chosen[k] && bounds_room(k);
    }

    Bounds bounds_of(std::size_t k) const {
        Bounds bounds;
        const Vec3 center = center_of(objects_[k].shape);
        for (int axis = 0; axis < dimensions_; ++axis) {
            if (bodies_[k].endless[axis]) continue;
            const double half = box(k) ? box(k)->half_extent[axis] : bounding_radius(bodies_[k]);
            bounds.low[axis] = center[axis] - half;
            bounds.high[axis] = center[axis] + half;
        }
        return bounds;
    }

    double slack() const { return kTolerance * support_; }

    // Do the two share solid? Yes, where that is not easily told.
    bool overlap(std::size_t a, std::size_t b) const {
        if (bounds_room(a) && bounds_room(b)) return false;
        if (bounds_room(b)) std::swap(a, b);
        if (bounds_room(a)) return !is_within_room(b, a);
        if (bodies_[a].is_container && bodies_[b].is_container) return true;
        if (bodies_[b].is_container) std::swap(a, b);
        if (bodies_[a].is_container) return !is_within_sphere(b, a);
        return !are_apart(a, b);
    }

    bool is_within_room(std::size_t inner, std::size_t room) const {
        if (bodies_[inner].is_container || plane(inner)) return false;  // its solid has no bounds
        const Bounds in = bounds_of(inner);
        if (const Plane* flat = plane(room)) {
            const auto at = side_of(*flat, dimensions_);
            if (!at) return false;
            const double face = flat->point[at->axis];
            return at->side == 0 ? in.low[at->axis] >= face - slack() : in.high[at->axis] <= face + slack();
        }
        const Bounds out = bounds_of(room);
        for (int axis = 0; axis < dimensions_; ++axis) {
            if (in.low[axis] < out.low[axis] - slack() || in.high[axis] > out.high[axis] + slack()) return false;
        }
        return true;
    }

    bool is_within_sphere(std::size_t inner, std::size_t container) const {
        const Sphere* out = sphere(container);
        if (!out || plane(inner)) return false;
        const double reach = bounding_radius(bodies_[inner]);
        const Vec3 apart = rigid::minus(center_of(objects_[inner].shape), out->center);
        return rigid::length(apart) + reach <= out->radius + slack();
    }

    bool are_apart(std::size_t a, std::size_t b) const {
        if (plane(a) || plane(b)) return false;
        if (sphere(a) && sphere(b)) {
            const Vec3 apart = rigid::minus(sphere(a)->center, sphere(b)->center);
            return !domain_.has_periodic_axis() &&
                   rigid::length(apart) >= sphere(a)->radius + sphere(b)->radius - slack();
        }
        const Bounds one = bounds_of(a), other = bounds_of(b);
        for (int axis = 0; axis < dimensions_; ++axis) {
            if (domain_.periodic[axis]) continue;  // an image might be in the way
            if (one.high[axis] <= other.low[axis] + slack() || other.high[axis] <= one.low[axis] + slack()) return true;
        }
        return false;
    }

    // All that bound the room go together.
    bool drop_overlapping(std::vector<char>& chosen) const {
        std::vector<char> kept = chosen;
        bool keeps_room = true;
        for (std::size_t a = 0; a < objects_.size(); ++a) {
            if (!chosen[a] && bounds_room(a)) keeps_room = false;
            for (std::size_t b = a + 1; b < objects_.size(); ++b) {
                if ((!chosen[a] && !chosen[b]) || !overlap(a, b)) continue;
                for (const std::size_t k : {a, b}) {
                    kept[k] = 0;
                    if (bounds_room(k)) keeps_room = false;
                }
            }
        }
        for (std::size_t k = 0; k < objects_.size(); ++k) {
            if (!keeps_room && bounds_room(k)) kept[k] = 0;
        }
        return std::exchange(chosen, kept) != kept;
    }

    std::span<const CollisionObject> objects_;
    const Domain& domain_;
    int dimensions_;
    double support_;  // [m]
    std::vector<Body> bodies_;
    bool has_moving_{false};
};

}  // namespace

WallChoice choose_integral_walls(std::span<const CollisionObject> objects, const Domain& domain, int dimensions,
                                 double support) {
    return Chooser(objects, domain, dimensions, support).choose();
}

WallChoice choose_walls_by_default(std::span<const CollisionObject> objects, const Domain& domain, int dimensions,
                                   double support, const std::vector<char>& no_slip) {
    WallChoice choice = choose_integral_walls(objects, domain, dimensions, support);
    bool takes_all = dimensions == 3;
    for (std::size_t k = 0; k < objects.size(); ++k)
        takes_all =
            takes_all && choice.is_integral[k] && !no_slip[k] && !std::holds_alternative<Sphere>(objects[k].shape);
    if (!takes_all) choice = {std::vector<char>(objects.size(), 0), {}};
    return choice;
}

void place_integral_walls(std::span<const CollisionObject> objects, const Domain& domain,
                          const std::vector<char>& is_integral, const std::vector<char>& no_slip,
                          IntegralWalls& walls) {
    walls.clear();
    const int D = walls.dimensions();
    for (int axis = 0; axis < D; ++axis) {
        if (domain.periodic[axis]) walls.set_period(axis, domain.max[axis] - domain.min[axis]);
    }
    for (std::size_t k = 0; k < objects.size(); ++k) {
        if (!is_integral[k]) continue;
        const IntegralSurface surface{static_cast<Index>(k), no_slip[k] != 0, {}};
        const Body body = make_body(objects[k], domain, D);
        if (const Plane* plane = std::get_if<Plane>(&objects[k].shape)) {
            const auto at = side_of(*plane, D);
            walls.add_face(at->axis, at->side, plane->point[at->axis], surface);
        } else if (const Sphere* sphere = std::get_if<Sphere>(&objects[k].shape)) {
            walls.add_sphere(sphere->center, sphere->radius, body.is_container, surface);
        } else {
            const Box& box = std::get<Box>(objects[k].shape);
            IntegralBox solid{{}, {}, body.endless, surface};
            for (int axis = 0; axis < D; ++axis) {
                if (body.endless[axis]) continue;
                solid.low[axis] = box.center[axis] - box.half_extent[axis];
                solid.high[axis] = box.center[axis] + box.half_extent[axis];
                if (!body.is_container) continue;
                walls.add_face(axis, 0, solid.low[axis], surface);
                walls.add_face(axis, 1, solid.high[axis], surface);
            }
            if (!body.is_container) walls.add_box(solid);
        }
    }
}

}  // namespace headrace::solver
