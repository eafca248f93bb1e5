#include "server/solver/pairs/block_grid.h"

#include <algorithm>
#include <numeric>

#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

// Of each block the boxes that its points are in, each once; first[b]: where those of block b begin.
// box_of_slot: of each point in the order.
template <class Box>
std::vector<Box> boxes_of_blocks(std::vector<Box> box_of_slot, std::size_t block_size, std::vector<Index>& first) {
    const std::size_t count = box_of_slot.size(), blocks = (count + block_size - 1) / block_size;
    first.assign(blocks + 1, 0);
    parallel_for(blocks, 16, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t b = begin; b < end; ++b) {
            const auto own = box_of_slot.begin() + static_cast<std::ptrdiff_t>(b * block_size),
                       own_end =
                           box_of_slot.begin() + static_cast<std::ptrdiff_t>(std::min((b + 1) * block_size, count));
            // Points of a block are in few boxes: each is looked for among those before it.
            auto last = own;
            for (auto box = own; box != own_end; ++box) {
                if (std::find(own, last, *box) == last) *last++ = *box;
            }
            first[b + 1] = static_cast<Index>(last - own);
        }
    });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<Box> boxes(first.back());
    for (std::size_t b = 0; b < blocks; ++b)
        std::copy_n(box_of_slot.begin() + static_cast<std::ptrdiff_t>(b * block_size), first[b + 1] - first[b],
                    boxes.begin() + first[b]);
    return boxes;
}

}  // namespace

void BlockGrid::build(const SpaceDivision& division, const BinRange& range, const std::array<int, 3>& box_shift,
                      const VectorField& x, const std::vector<Index>& order, std::size_t block_size) {
    division_ = division;
    range_ = range;
    box_shift_ = box_shift;
    start_.clear();
    box_of_.clear();
    entries_.clear();
    if (order.empty()) return;
    const BinRange all{{}, box_of(range.highest)};
    for (int c = 0; c < 3; ++c) boxes_[c] = all.width(c);
    const std::size_t blocks = (order.size() + block_size - 1) / block_size;
    is_dense_ = all.bins() <= static_cast<double>(std::max(kDenseMinimum, kDenseBoxes * blocks));
    const auto find_all = [&](auto&& number) {
        std::vector<decltype(number(Box{}))> found(order.size());
        parallel_for(order.size(), kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t slot = begin; slot < end; ++slot)
                found[slot] = number(box_of(division.find(x, order[slot])));
        });
        return found;
    };
    std::vector<Index> first;
    if (is_dense_) {
        const std::vector<Index> numbers = boxes_of_blocks(
            find_all([&](const Box& box) { return static_cast<Index>(number_of(box)); }), block_size, first);
        // Counting sort.
        start_.assign(static_cast<std::size_t>(all.bins()) + 2, 0);
        for (const Index number : numbers) ++start_[number + 2];
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        entries_.resize(numbers.size());
        for (std::size_t b = 0; b < blocks; ++b)
            for (Index n = first[b]; n < first[b + 1]; ++n) entries_[start_[numbers[n] + 1]++] = static_cast<Index>(b);
        return;
    }
    const std::vector<Box> found = boxes_of_blocks(find_all([](const Box& box) { return box; }), block_size, first);
    std::vector<Index> block_of(found.size()), sorted(found.size());
    for (std::size_t b = 0; b < blocks; ++b)
        std::fill(block_of.begin() + first[b], block_of.begin() + first[b + 1], static_cast<Index>(b));
    std::iota(sorted.begin(), sorted.end(), Index{0});
    std::stable_sort(sorted.begin(), sorted.end(), [&](Index a, Index b) { return found[a] < found[b]; });
    for (const Index n : sorted) {
        box_of_.push_back(found[n]);
        entries_.push_back(block_of[n]);
    }
}

BlockGrid::Entries BlockGrid::find_entries(const Box& first, std::int64_t last) const {
    if (is_dense_) {
        const std::size_t number = number_of(first);
        return {start_[number], start_[number + static_cast<std::size_t>(last - first[2]) + 1]};
    }
    const auto number = [&](auto found) { return static_cast<Index>(found - box_of_.begin()); };
    return {number(std::lower_bound(box_of_.begin(), box_of_.end(), first)),
            number(std::upper_bound(box_of_.begin(), box_of_.end(), Box{first[0], first[1], last}))};
}

}  // namespace headrace::solver
