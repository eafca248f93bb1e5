// Walls as integrals of the kernel over their solid, in place of dummy particles: no particles, no pairs; a fluid
// particle within the support of a wall adds the solid's share to its sums. Related: the semi-analytical walls of
// Ferrand et al. 2013 (surface integrals of the same kernel); here the solid itself is summed, in layers
// (wall_profile.h), so that sums need no other normalisation than with dummies.
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
    std::array<double, D> grad;    // [1/m] of grad W; what two faces of the room share is divided between them
    std::array<double, D> grad_n;  // [1/m] of grad W, over the face's whole half-space
    std::array<double, D> M_n;     // [1] of y (x) grad W, times n; over the whole half-space
    Symmetric<D> viscous;          // [m^-2] of F y y/r^2 (1 + depth/d): see no_slip_difference() in wall_state.h
    const IntegralSurface* surface;
};

template <int D>
struct WallShare {
    static constexpr int kMost = 2 * D + 6;
    int count{0};
    std::array<WallPart<D>, kMost> part;
    std::array<double, D> grad{};     // [1/m] of grad W
    std::array<double, D> shifted{};  // [1/m] of the shifting's gradient
    Symmetric<D> M;                   // [1] of y (x) grad W
    double gamma{};                   // [1] of W
};

class IntegralWalls {
  public:
    static constexpr std::size_t kMostObstacles = 6;  // boxes and spheres: all are asked about each particle

    IntegralWalls() = default;
    // layer [m]: thickness of the layers, the fluid's spacing.
    IntegralWalls(const SectionKernel& kernel, double layer);

    bool is_empty() const { return !has_faces_ && boxes_.empty() && spheres_.empty(); }
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
        for (auto& sides : room_) {
            for (IntegralFace& face : sides) {
                if (face.exists) visit(face.surface);
            }
        }
        for (IntegralBox& box : boxes_) visit(box.surface);
        for (IntegralSphere& sphere : spheres_) visit(sphere.surface);
    }

    // Is x within the support of a wall?
    template <int D>
    bool is_near(const std::array<double, D>& x) const;

    // The solid's share of the sums of a particle at x. least_distance [m]: see no_slip_difference(); below 0: viscous
    // is left out.
    template <int D>
    void find_share(const std::array<double, D>& x, double least_distance, WallShare<D>& share) const;

  private:
    template <int D>
    friend class ShareSum;

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
    std::vector<IntegralBox> boxes_;
    std::vector<IntegralSphere> spheres_;
    Vec3 period_{};  // [m]; 0: none
};

}  // namespace headrace::solver
