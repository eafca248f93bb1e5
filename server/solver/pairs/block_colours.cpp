#include "server/solver/pairs/block_colours.h"

#include <bit>
#include <cstdint>

namespace headrace::solver {

// The first colour that no block has which the chunk's lists lead to; where there are none left, one of its own.
template <class S>
void BlockColours::build(const PairList<S>& list) {
    constexpr std::size_t kMasked = 64;
    blocks_ = list.blocks().size();
    colours_.assign(kMasked, {});
    std::vector<std::uint64_t> taken(blocks_, 0);  // of each block: bit k: colour k
    for (std::size_t begin = 0; begin < blocks_; begin += kChunk) {
        const std::size_t end = std::min(begin + kChunk, blocks_);
        const auto chunk = static_cast<Index>(begin / kChunk);
        std::uint64_t not_free = 0;
        for (std::size_t b = begin; b < end; ++b)
            for (const PairWay<S>& way : list.blocks()[b].ways) not_free |= taken[way.first / kBlockClusters];
        const auto colour = static_cast<std::size_t>(std::countr_one(not_free));
        if (colour == kMasked) {
            colours_.push_back({chunk});
            continue;
        }
        colours_[colour].push_back(chunk);
        for (std::size_t b = begin; b < end; ++b)
            for (const PairWay<S>& way : list.blocks()[b].ways)
                taken[way.first / kBlockClusters] |= std::uint64_t{1} << colour;
    }
    std::erase_if(colours_, [](const std::vector<Index>& chunks) { return chunks.empty(); });
}

template void BlockColours::build(const PairList<float>&);
template void BlockColours::build(const PairList<double>&);

}  // namespace headrace::solver
