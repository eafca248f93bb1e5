// Walls as dummy particles (Adami, Hu, Adams 2012, J. Comput. Phys. 231, 7057): sampled inside the solid side of the
// scene's primitives, down to the kernel's support, so that a fluid particle at a wall has full support. The user sees
// primitives, never these.
//
// Corners are right: a box's dummies form one lattice that fills edges and corners. Where two solids overlap, a dummy
// belongs to the first object of the scene whose solid holds it; the others' are inactive there (`V` = 0 is never
// stored: inactive ones are left out).
//
// Thin panels: box obstacles thinner than twice the depth have one sheet of dummies per face, each as deep as the
// support even where it reaches beyond the opposite face. A fluid particle sees a sheet only through the sheet's own
// face (thin_panels.h). Spheres and cylinders are never thin: fluid is seen through those thinner than the depth.
//
// Periodic axes: a box or cylinder as long as the period or longer along such an axis has no ends there
// (primitives.h). An object that is endless or a plane must not turn its endless direction out of that axis.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/solver/boundaries/thin_panels.h"
#include "server/solver/boundaries/wall_object.h"
#include "server/solver/boundaries/wall_sampling.h"
#include "server/solver/objects.h"
#include "server/solver/particles.h"
#include "server/solver/visibility.h"

namespace headrace::solver {

struct WallParticles {
    int dimensions{3};
    std::vector<Index> id;      // position in the order they were made; stable while objects_version stays
    std::vector<Index> object;  // index in Surroundings::objects
    std::vector<Index>
        sheet;              // 0: seen from everywhere; else a thin panel's side, see Walls::sees. Empty without panels
    VectorField x;          // [m] now
    VectorField v;          // [m/s] of the wall there, surface velocity included; empty while no object moves
    VectorField a;          // [m/s^2] of the wall there; likewise
    NarrowField n;          // [1] unit normal of the nearest surface, into the fluid
    std::vector<double> V;  // [m^3] volume (2D: m^2)
    std::vector<float> depth;  // [m] below the object's nearest surface; in a sheet: behind its own face

    std::size_t size() const { return id.size(); }
};

class Walls final : public Visibility {
  public:
    // spacing: of the fluid [m]; depth: how deep dummies must reach, the kernel's support radius [m].
    Walls(int dimensions, double spacing, double depth);

    // Samples all objects anew, placed as they are at time t [s]. All are cut to the domain grown by the depth; along
    // periodic axes dummies stay inside the domain: the neighbour search continues them.
    // without_dummies: of each object, is it a wall in another way (wall_choice.h)? Empty: none.
    // Throws std::length_error where more than kMaxWallParticles are needed.
    void rebuild(std::span<const CollisionObject> objects, const Domain& domain, double t,
                 std::span<const char> without_dummies = {});

    // Moves what moves to time t. Returns true when any particle's place changed (order may change then too).
    bool move_to(double t);

    const WallParticles& particles() const { return particles_; }
    WallParticles& particles() { return particles_; }  // for sorting: any order is fine
    // Another number when there are others, in the order in which they were made.
    std::uint64_t version() const { return version_; }

    bool has_moving() const;
    bool has_thin() const;
    std::size_t objects() const { return objects_.size(); }

    // Signed distance to the object's surface [m], positive on the fluid's side; outward: unit normal into the fluid.
    double distance(std::size_t object, const Vec3& x, Vec3* normal = nullptr) const;
    // Smallest over all objects; +infinity without any. `object` gets its index.
    double distance_to_any(const Vec3& x, std::size_t* object = nullptr, Vec3* normal = nullptr) const;

    // Velocity of the object's material at x [m/s], surface velocity included.
    Vec3 velocity(std::size_t object, const Vec3& x) const;

    // For pairs near thin panels. May a fluid particle at x interact with wall particle k (of particles())?
    bool sees(const Vec3& x, std::size_t k) const override;
    // Does the straight line between two fluid particles pass through a thin solid?
    bool is_blocked(const Vec3& x_i, const Vec3& x_j) const override;
    // Could any pair with a member within `reach` of x need these two tests?
    bool is_near_thin(const Vec3& x, double reach) const override;

  private:
    static constexpr std::size_t kNoPanel = static_cast<std::size_t>(-1);
    struct Panel {
        std::size_t object{};
        ThinPanel shape;
    };

    bool is_active(const Dummy& dummy, const Vec3& x, bool among_moving) const;
    void drop_hidden_for_good();
    void list_changeable();
    bool update_places();
    void collect();
    void refresh_moving();
    void place(std::size_t slot, const Dummy& dummy);
    void forget_sampling();
    const ThinPanel* find_panel(std::size_t object) const;

    int dimensions_;
    double spacing_;  // [m]
    double depth_;    // [m]
    SamplingSpace space_;
    std::vector<WallObject> objects_;
    std::vector<Panel> panels_;          // in the objects' order
    std::vector<std::size_t> panel_of_;  // of each object: index of its panel, or kNoPanel
    // By id, unless nothing can change: then particles_ tell all.
    std::vector<Dummy> dummies_;     // all
    std::vector<Vec3> place_;        // [m] of each dummy in the domain
    std::vector<char> active_;       // of each dummy
    std::vector<Index> changeable_;  // ids
    WallParticles particles_;        // the active ones
    std::uint64_t version_{};
};

}  // namespace headrace::solver
