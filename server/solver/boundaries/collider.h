// All collision objects of a scene, applied to one particle after its position update (Staubach 2010, section 3.3.5).
//
// Order: boxes, then spheres, each in the scene's order; among the boxes containers come first, so that an obstacle
// judges the path that stays in the tank. A projection may push a particle into another object, out of the tank say.
// Containers win: when an obstacle has moved the particle, all containers are applied once more, boxes first. What
// still lies inside an obstacle then is caught again in the next step.
#pragma once

#include <span>
#include <vector>

#include "server/solver/boundaries/box.h"
#include "server/solver/boundaries/response.h"
#include "server/solver/boundaries/sphere.h"
#include "server/solver/objects.h"

namespace headrace::solver {

template <int D>
class Collider {
  public:
    Collider(std::span<const CollisionObject> objects, double restitution, double dt)
        : restitution_(restitution), dt_(dt) {
        for (const CollisionObject& object : objects) add(object);
    }

    bool is_empty() const {
        return box_containers_.empty() && box_obstacles_.empty() && sphere_containers_.empty() &&
               sphere_obstacles_.empty();
    }

    // x0: position before the step [m]; x: after it; v: leap velocity [m/s].
    void apply(const Point<D>& x0, Point<D>& x, Point<D>& v) const {
        apply_box_containers(x, v);
        bool moved_by_obstacle = apply_box_obstacles(x0, x, v);
        if (!sphere_containers_.empty() || !sphere_obstacles_.empty()) moved_by_obstacle |= apply_spheres(x, v);
        if (!moved_by_obstacle) return;
        apply_box_containers(x, v);
        for (const OrderedSphere& sphere : sphere_containers_) apply_sphere_container(sphere.boundary, x, v);
    }

  private:
    struct OrderedSphere {
        SphereBoundary<D> boundary;
        int order;  // among the spheres of the scene
    };

    static Point<D> point(const Vec3& v) {
        Point<D> p;
        for (int k = 0; k < D; ++k) p[k] = v[k];
        return p;
    }

    void add(const CollisionObject& object) {
        const bool is_container = object.role == Role::container;
        if (const Box* box = std::get_if<Box>(&object.shape)) {
            (is_container ? box_containers_ : box_obstacles_).push_back({point(box->center), point(box->half_extent)});
        } else if (const Sphere* sphere = std::get_if<Sphere>(&object.shape)) {
            const int order = static_cast<int>(sphere_containers_.size() + sphere_obstacles_.size());
            (is_container ? sphere_containers_ : sphere_obstacles_)
                .push_back({{point(sphere->center), sphere->radius}, order});
        }
    }

    void respond(const Contact<D>& contact, Point<D>& x, Point<D>& v) const {
        apply_response<D>(contact, restitution_, dt_, x, v);
    }

    void apply_box_containers(Point<D>& x, Point<D>& v) const {
        for (const BoxBoundary<D>& box : box_containers_) {
            if (box.F(x) > 0.0) respond(box.container_contact(x), x, v);
        }
    }

    void apply_sphere_container(const SphereBoundary<D>& sphere, Point<D>& x, Point<D>& v) const {
        if (sphere.F(x) > 0.0) respond(sphere.contact(x), x, v);
    }

    bool apply_box_obstacles(const Point<D>& x0, Point<D>& x, Point<D>& v) const {
        bool has_moved = false;
        for (const BoxBoundary<D>& box : box_obstacles_) {
            if (box.is_clear_of(x0, x)) continue;
            if (const auto entry = box.entry_contact(x0, x)) {
                respond(*entry, x, v);
            } else if (box.F(x) < 0.0) {
                respond(box.nearest_face_contact(x, [&](const Point<D>& cp) { return is_contained(cp); }), x, v);
            } else {
                continue;
            }
            has_moved = true;
        }
        return has_moved;
    }

    // Containers and obstacles merged in the scene's order; true when an obstacle has moved the particle.
    bool apply_spheres(Point<D>& x, Point<D>& v) const {
        bool moved_by_obstacle = false;
        auto container = sphere_containers_.begin();
        for (const OrderedSphere& obstacle : sphere_obstacles_) {
            for (; container != sphere_containers_.end() && container->order < obstacle.order; ++container) {
                apply_sphere_container(container->boundary, x, v);
            }
            if (obstacle.boundary.F(x) >= 0.0) continue;
            respond(obstacle.boundary.contact(x), x, v);
            moved_by_obstacle = true;
        }
        for (; container != sphere_containers_.end(); ++container) apply_sphere_container(container->boundary, x, v);
        return moved_by_obstacle;
    }

    bool is_contained(const Point<D>& x) const {
        for (const BoxBoundary<D>& box : box_containers_) {
            if (box.F(x) > 0.0) return false;
        }
        for (const OrderedSphere& sphere : sphere_containers_) {
            if (sphere.boundary.F(x) > 0.0) return false;
        }
        return true;
    }

    double restitution_;  // [1]
    double dt_;           // [s]
    std::vector<BoxBoundary<D>> box_containers_, box_obstacles_;
    std::vector<OrderedSphere> sphere_containers_, sphere_obstacles_;
};

}  // namespace headrace::solver
