// The walls as the wcsph model sees them: dummy particles in the order of the pair engine, what each stands for, and
// the surface that no fluid passes.
#pragma once

#include <cstdint>

#include "server/solver/boundaries/integral_walls.h"
#include "server/solver/boundaries/wall_choice.h"
#include "server/solver/boundaries/wall_particles.h"
#include "server/solver/model.h"
#include "server/solver/models/wcsph/state.h"
#include "server/solver/pairs/pair_neighbours.h"

namespace headrace::solver {

struct WallOptions {
    Vec3 gravity{};              // [m/s^2]
    Slip slip{Slip::free_slip};  // of objects that do not say
    // Integrals in place of dummy particles: where an object allows it; only where the scene as a whole does.
    bool integrals{false}, by_default{false};
};

class WallField {
  public:
    WallField(int dimensions, double spacing, double support);

    enum class Change { none, moved, others };  // others: other wall particles than before
    // Puts the walls where they are at time t: `anew` when objects have changed, else only what moves.
    Change place(const Surroundings& surroundings, double t, bool anew, const WallOptions& options);
    // Sorts them as they are now, for the lists. Returns whether anything has changed since they were last sorted.
    bool put_in_order(const Domain& domain);

    // What integrals are made of; before they are placed for the first time.
    bool has_kernel() const { return integrals_.support() > 0.0; }
    // Which objects would be integrals.
    static WallChoice choose(std::span<const CollisionObject> objects, const Domain& domain, int dimensions,
                             double support, const WallOptions& options);
    void set_kernel(const SectionKernel& kernel) { integrals_ = IntegralWalls(kernel, spacing_); }

    bool is_empty() const { return size() == 0 && integrals_.is_empty(); }
    bool has_moving() const { return walls_.has_moving(); }
    std::size_t size() const { return walls_.particles().size(); }
    double max_speed() const;  // [m/s]

    const Walls& walls() const { return walls_; }
    const IntegralWalls& integrals() const { return integrals_; }
    const std::string& choice_remark() const { return choice_.remark; }
    const WallParticles& particles() const { return walls_.particles(); }
    WallState& state() { return state_; }
    const WallState& state() const { return state_; }
    OrderedPoints points() const;
    const Visibility* thin_walls() const { return walls_.has_thin() ? &walls_ : nullptr; }

    // A particle that was driven into a solid (an impact faster than the walls' pressure can answer) is put back on its
    // surface and loses its velocity into it: nothing leaks. Rare in a sound run. Returns how many were.
    // neighbours: tells which clusters of the fluid are near walls.
    std::uint64_t hold(Particles& particles, const PairNeighbours& neighbours, double dt) const;

  private:
    void place_integrals(const Surroundings& surroundings, const WallOptions& options);
    void run_belts(const Surroundings& surroundings, double t);
    bool may_be_in_integrals(const Vec3& x) const;
    void evaluate_gravity(const Surroundings& surroundings, double t, const Vec3& gravity);
    bool put_back(Index id, Vec3& x, Vec3& v, double dt) const;
    bool find_free_place(Vec3& x) const;
    void stop_at(std::size_t object, const Vec3& n, const Vec3& x, Vec3& v) const;

    int dimensions_;
    double spacing_;  // [m]
    Walls walls_;
    IntegralWalls integrals_;
    WallChoice choice_;
    WallState state_;
    ClusterOrder order_;
    bool is_in_order_{false};
    std::uint64_t version_{~std::uint64_t{0}};  // of the walls that the state belongs to
};

}  // namespace headrace::solver
