// An order of the blocks of a half list in which threads may add to both points of a pair: blocks of one colour have no
// neighbour in common. They are coloured some at a time, which stand together, so that what one reads the next one
// finds near by. The order depends on the list alone.
#pragma once

#include <vector>

#include "server/solver/pairs/pair_list.h"
#include "server/solver/parallel.h"

namespace headrace::solver {

class BlockColours {
  public:
    template <class S>
    void build(const PairList<S>& list);

    // body(block) for every block, colour after colour.
    template <class Body>
    void for_each_block(Body&& body) const {
        for (const std::vector<Index>& chunks : colours_) {
            parallel_for(chunks.size(), 1, [&](std::size_t first, std::size_t last, int) {
                for (std::size_t c = first; c < last; ++c) {
                    const std::size_t begin = chunks[c] * kChunk, end = std::min(begin + kChunk, blocks_);
                    for (std::size_t b = begin; b < end; ++b) body(b);
                }
            });
        }
    }

    std::size_t colours() const { return colours_.size(); }

  private:
    static constexpr std::size_t kChunk = 8;  // blocks

    std::size_t blocks_{};
    std::vector<std::vector<Index>> colours_;  // chunks of each
};

extern template void BlockColours::build(const PairList<float>&);
extern template void BlockColours::build(const PairList<double>&);

}  // namespace headrace::solver
