// The pair sums of the plain fluid (speed_plain.h) by four strategies, all with the same terms, in single precision:
//
//   clusters   the engine of server/solver/pairs: lists of 4 x 4 points, reused over steps
//   half       the same with each pair listed once, for both of its points
//   buffer     cells sorted every step; the candidates of a cell copied once, then as many of them as a vector has
//              lanes with one particle at a time
//   broadcast  the same candidates one at a time with as many particles of the cell as a vector has lanes
#pragma once

#include <memory>
#include <string_view>

#include "tests/bench/speed_plain.h"
#include "tests/bench/stage_seconds.h"

namespace headrace::bench {

enum class PairStrategy { clusters, half, buffer, broadcast };

std::string_view pair_strategy_name(PairStrategy strategy);

class PlainSums {
  public:
    virtual ~PlainSums() = default;
    // a and delta_rate of the state as it is. Sorts the fluid where that is due.
    virtual void compute(PlainFluid& fluid, StageSeconds& seconds) = 0;
    // Pairs looked at per particle.
    virtual double candidates() const = 0;
    virtual long sorts() const = 0;  // so far
};

// In the instruction set of now (OnlyInstructionSet).
std::unique_ptr<PlainSums> make_plain_sums(PairStrategy strategy, int dimensions);

}  // namespace headrace::bench
