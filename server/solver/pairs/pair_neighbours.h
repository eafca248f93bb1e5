// The neighbours of a model that has fluid and walls: places as the pair loops read them, and the lists between them,
// in one precision.
#pragma once

#include <functional>
#include <memory>

#include "server/solver/pairs/field_view.h"
#include "server/solver/pairs/pair_list.h"

namespace headrace::solver {

// Arithmetic of the pair loops; what is carried from step to step is always in double precision.
enum class Arithmetic { single_precision, double_precision };

// Points in the order of `order`.
struct OrderedPoints {
    const ClusterOrder* order{};
    const VectorField* x{};  // [m]
    FieldView V;             // [m^3] (2D: m^2)
    std::size_t count{};
};

struct NeighbourInput {
    int dimensions{3};
    OrderedPoints fluid, walls;  // walls.count = 0: none
    ReachOptions reach;
    double wall_skin{};                   // [m] of the lists between fluid and walls; 0: the same
    bool walls_move{true};                // will move_walls() be called?
    bool has_new_walls{true};             // since the last find(): others, elsewhere, or in another order
    const PairVisibility* among_fluid{};  // all three null unless thin solids stand between pairs
    const PairVisibility* fluid_to_wall{};
    const PairVisibility* wall_to_fluid{};
};

class PairNeighbours {
  public:
    virtual ~PairNeighbours() = default;
    virtual Arithmetic arithmetic() const = 0;

    // Makes the lists anew; the points are in a new order.
    virtual void find(const NeighbourInput& input) = 0;

    // The points have moved, or their volumes have changed; the order is the same. Returns false where a pair may be
    // missing: find() is due before the next sum.
    virtual bool move_fluid(const VectorField& x, const FieldView& V) = 0;
    virtual bool move_walls(const VectorField& x, const FieldView& V) = 0;

    // Asks the visibilities of find() again, for the places of now.
    virtual void refresh_visibility() = 0;

    virtual bool is_near_walls(std::size_t fluid_cluster) const = 0;

    // visit(wall, fluid) for all pairs within reach, and some others. Those of one wall particle come one after the
    // other; different ones in parallel.
    virtual void for_each_wall_pair(const std::function<void(Index wall, Index fluid)>& visit) const = 0;

    virtual std::size_t bytes() const = 0;
    virtual double neighbours_per_particle() const = 0;  // listed ones, walls included
};

template <class S>
class PairNeighboursOf final : public PairNeighbours {
  public:
    Arithmetic arithmetic() const override {
        return sizeof(S) == sizeof(float) ? Arithmetic::single_precision : Arithmetic::double_precision;
    }
    void find(const NeighbourInput& input) override;
    bool move_fluid(const VectorField& x, const FieldView& V) override;
    bool move_walls(const VectorField& x, const FieldView& V) override;
    void refresh_visibility() override;
    bool is_near_walls(std::size_t fluid_cluster) const override;
    void for_each_wall_pair(const std::function<void(Index wall, Index fluid)>& visit) const override;
    std::size_t bytes() const override;
    double neighbours_per_particle() const override;

    bool has_walls() const { return walls_.size() > 0; }
    const ClusterPoints<S>& fluid() const { return fluid_; }
    const ClusterPoints<S>& walls() const { return walls_; }
    const PairList<S>& among_fluid() const { return among_fluid_; }
    const PairList<S>& fluid_to_wall() const { return fluid_to_wall_; }
    const PairList<S>& wall_to_fluid() const { return wall_to_fluid_; }

  private:
    bool keep_whole();
    void prune();

    NeighbourInput input_;
    ClusterPoints<S> fluid_, walls_;
    PairList<S> among_fluid_, fluid_to_wall_, wall_to_fluid_;
};

std::unique_ptr<PairNeighbours> make_pair_neighbours(Arithmetic arithmetic);

}  // namespace headrace::solver
