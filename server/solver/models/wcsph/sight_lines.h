// Which pairs see each other where thin panels stand between them, as the pair lists ask.
#pragma once

#include "server/solver/pairs/pair_list.h"
#include "server/solver/visibility.h"

namespace headrace::solver {

class SightLines final : public PairVisibility {
  public:
    enum class Between { fluid_and_fluid, fluid_and_wall, wall_and_fluid };

    SightLines() = default;
    SightLines(Between between, const Visibility& panels, const VectorField& centres, const VectorField& neighbours,
               int dimensions, double support)
        : between_(between),
          panels_(&panels),
          centres_(&centres),
          neighbours_(&neighbours),
          dimensions_(dimensions),
          support_(support) {}

    bool is_needed_near(const Vec3& centre) const override {
        // The cluster and its neighbours are at most so far away.
        return panels_->is_near_thin(centre, 2.5 * support_);
    }
    bool may_interact(Index centre, Index neighbour) const override {
        const Vec3 x = place(*centres_, centre);
        switch (between_) {
            case Between::fluid_and_fluid:
                return !panels_->is_blocked(x, place(*neighbours_, neighbour));
            case Between::fluid_and_wall:
                return panels_->sees(x, neighbour);
            case Between::wall_and_fluid:
                break;
        }
        return panels_->sees(place(*neighbours_, neighbour), centre);
    }

  private:
    Vec3 place(const VectorField& x, Index i) const {
        Vec3 place{};
        for (int k = 0; k < dimensions_; ++k) place[k] = x[k][i];
        return place;
    }

    Between between_{};
    const Visibility* panels_{};
    const VectorField *centres_{}, *neighbours_{};
    int dimensions_{3};
    double support_{};  // [m]
};

}  // namespace headrace::solver
