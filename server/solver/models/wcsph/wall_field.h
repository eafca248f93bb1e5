// The walls as the wcsph model sees them: dummy particles sorted into cells of the fluid's division, what each stands
// for, and the surface that no fluid passes.
#pragma once

#include <cstdint>

#include "server/solver/boundaries/wall_particles.h"
#include "server/solver/model.h"
#include "server/solver/models/wcsph/state.h"
#include "server/solver/pair_loop.h"

namespace headrace::solver {

struct WallOptions {
    double cell_side{};          // [m] of the fluid's cells
    Vec3 gravity{};              // [m/s^2]
    Slip slip{Slip::free_slip};  // of objects that do not say
};

class WallField {
  public:
    WallField(int dimensions, double spacing, double support);

    // Puts the walls where they are at time t: `anew` when objects have changed, else only what moves.
    void place(const Surroundings& surroundings, double t, bool anew, const WallOptions& options);

    bool is_empty() const { return walls_.particles().size() == 0; }
    bool has_moving() const { return walls_.has_moving(); }
    std::size_t size() const { return walls_.particles().size(); }
    double max_speed() const;  // [m/s]

    const Walls& walls() const { return walls_; }
    const WallParticles& particles() const { return walls_.particles(); }
    WallState& state() { return state_; }
    const WallState& state() const { return state_; }
    PointSet points() const;  // without grid when there are none
    const Visibility* thin_walls() const { return walls_.has_thin() ? &walls_ : nullptr; }

    // A particle that was driven into a solid (an impact faster than the walls' pressure can answer) is put back on its
    // surface and loses its velocity into it: nothing leaks. Rare in a sound run. Returns how many were.
    std::uint64_t hold(Particles& particles, const CellGrid& grid, double dt) const;

  private:
    void evaluate_gravity(const Surroundings& surroundings, double t, const Vec3& gravity);
    bool put_back(Index id, Vec3& x, Vec3& v, double dt) const;
    bool find_free_place(Vec3& x) const;
    void stop_at(std::size_t object, const Vec3& n, const Vec3& x, Vec3& v) const;

    int dimensions_;
    double spacing_;  // [m]
    Walls walls_;
    WallState state_;
    std::vector<double> scratch_;
    std::vector<Index> scratch_id_;
};

}  // namespace headrace::solver
