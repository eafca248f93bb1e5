// Walls as integrals of the kernel over their solid, in place of dummy particles: no particles, no pairs; a fluid
// particle within the support of a wall adds the solid's share to its sums. Related to the renormalising walls of
// Kulasegaram et al. 2004 and Ferrand et al. 2013; here the solid itself is summed, in layers (wall_profile.h), so that
// the sums need no other normalisation than with dummies.
//
// Which objects: boxes and planes along the axes, spheres, at rest (wall_choice.h). Containers and planes together
// leave a room, the product of one interval per axis. Its solid is a sum over half-spaces, less what two share, plus
// what three share; a box obstacle likewise. Half-spaces are tabulated; edges and corners are summed over their rows
// of layers, each row a line (in 3D edges) or a point: only where a particle is within reach of two or three faces.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "server/solver/boundaries/kernel_sections.h"
#include "server/solver/boundaries/wall_profile.h"
#include "server/solver/pair.h"
#include "server/solver/particles.h"
#include "server/solver/symmetric.h"

namespace headrace::solver {

// What all of an object's solid has in common.
struct IntegralSurface {
    Index object{};  // index in Surroundings::objects
    bool no_slip{};
    Vec3 v{};  // [m/s] of its material; along the surface
};

// One side of the room.
struct IntegralFace {
    bool exists{false};
    double at{};  // [m]
    IntegralSurface surface;
};

struct IntegralBox {
    Vec3 low{}, high{};             // [m]
    std::array<bool, 3> endless{};  // axes along which it has no ends
    IntegralSurface surface;
};

struct IntegralSphere {
    Vec3 center{};    // [m]
    double radius{};  // [m]
    bool is_container{};
    WallProfileTable profile;
    IntegralSurface surface;
};

// One face of the room or one obstacle, as a fluid particle sees it. Integrals over the solid, y = x' - x.
template <int D>
struct WallPart {
    std::array<double, D> n;       // [1] into the fluid
    double distance;               // [m] of the surface, negative inside
    std::array<double, D> grad;    // [1/m] of grad W; what two faces of the room share is divided between them
    std::array<double, D> grad_n;  // [1/m] of grad W, over the face's whole half-space
    double m_n;                    // [1] of n . y (n . grad W), over the whole half-space
    const IntegralSurface* surface;
    // Only where the viscous part is wanted:
    double gamma;                                     // [1] of W; divided as grad
    std::array<double, Symmetric<D>::kSize> viscous;  // [m^-2] of F y y/r^2 (1 + depth/d), as in no_slip_difference()
};

template <int D>
struct WallShare {
    static constexpr int kMost = 2 * D + 6;
    int count;
    std::array<WallPart<D>, kMost> part;
    std::array<double, D> grad;                 // [1/m] of grad W
    std::array<double, D> shifted;              // [1/m] of the shifting's gradient
    std::array<double, Symmetric<D>::kSize> M;  // [1] of y (x) grad W, as Symmetric stores it
};

// The room's only face within reach, with no obstacle near.
struct LonelyFace {
    int axis{};
    double sign{};  // of the normal into the fluid
    double distance{};
    const IntegralSurface* surface{};
};

class IntegralWalls {
  public:
    static constexpr std::size_t kMostObstacles = 6;  // boxes and spheres: all are asked about each particle

    IntegralWalls() = default;
    // layer [m]: thickness of the layers, the fluid's spacing.
    IntegralWalls(const SectionKernel& kernel, double layer);

    bool is_empty() const { return !has_faces_ && boxes_.empty() && spheres_.empty(); }
    bool has_obstacles() const { return !boxes_.empty() || !spheres_.empty(); }
    int dimensions() const { return dimensions_; }
    double support() const { return support_; }

    void clear();
    // Sets a side (0 low, 1 high) of the room; where there is one already, the narrower room counts.
    void add_face(int axis, int side, double at, const IntegralSurface& surface);
    void add_box(const IntegralBox& box) { boxes_.push_back(box); }
    void add_sphere(const Vec3& center, double radius, bool is_container, const IntegralSurface& surface);
    // Along an axis that is periodic by this length [m], obstacles are seen under their nearest image.
    void set_period(int axis, double period) { period_[static_cast<std::size_t>(axis)] = period; }
    // visit(surface) for each.
    template <class Visit>
    void for_each_surface(Visit&& visit) {
        visit_surfaces(*this, visit);
    }
    template <class Visit>
    void for_each_surface(Visit&& visit) const {
        visit_surfaces(*this, visit);
    }

    // Between these bounds no face is within reach [m].
    const Vec3& inner_low() const { return inner_low_; }
    const Vec3& inner_high() const { return inner_high_; }

    // Is x within the support of a wall? Of an obstacle?
    template <int D>
    bool is_near(const std::array<double, D>& x) const;
    // Could x be in a solid?
    template <int D>
    bool may_hold(const std::array<double, D>& x) const {
        const double reach = support_ * (1.0 - 1e-9);  // round-off: rather too often
        for (int k = 0; k < D; ++k) {
            if (x[k] < inner_low_[k] - reach || x[k] > inner_high_[k] + reach) return true;
        }
        return has_obstacles() && is_near_obstacle<D>(x);
    }
    template <int D>
    bool is_near_obstacle(const std::array<double, D>& x) const;

    // The solid's share of the sums of a particle at x. least_distance [m]: see no_slip_difference(); below 0: viscous
    // and gamma are left out.
    template <int D>
    void find_share(const std::array<double, D>& x, double least_distance, WallShare<D>& share) const;

    // By far the most frequent case, for which profile() is all there is to know.
    template <int D>
    bool find_lonely_face(const std::array<double, D>& x, LonelyFace& face) const;
    WallProfile profile(double distance) const { return plane_.plain(distance); }

  private:
    template <int D>
    friend class ShareSum;

    template <class Self, class Visit>
    static void visit_surfaces(Self& self, Visit&& visit) {
        for (auto& sides : self.room_) {
            for (auto& face : sides) {
                if (face.exists) visit(face.surface);
            }
        }
        for (auto& box : self.boxes_) visit(box.surface);
        for (auto& sphere : self.spheres_) visit(sphere.surface);
    }
    Vec3 nearest_image(Vec3 x, const Vec3& center) const;

    int dimensions_{3};
    double support_{};  // R [m]
    SectionKernel kernel_;
    WallLayers layers_;
    WallProfileTable plane_;
    SectionTable edge_;    // in 2D points, in 3D lines
    SectionTable corner_;  // points
    bool has_faces_{false};
    std::array<std::array<IntegralFace, 2>, 3> room_;
    Vec3 inner_low_{kNowhere, kNowhere, kNowhere}, inner_high_{-kNowhere, -kNowhere, -kNowhere};
    std::vector<IntegralBox> boxes_;
    std::vector<IntegralSphere> spheres_;
    Vec3 period_{};  // [m]; 0: none

    static constexpr double kNowhere = -std::numeric_limits<double>::infinity();
};

}  // namespace headrace::solver
