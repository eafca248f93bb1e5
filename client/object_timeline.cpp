#include "client/object_timeline.h"

#include <algorithm>

namespace headrace::client {

ObjectTimeline::ObjectTimeline(std::vector<proto::ObjectDesc> initial, const std::vector<proto::Event>& events) {
    changes_.emplace_back(0, std::move(initial));
    for (const proto::Event& event : events)
        if (event.objects) changes_.emplace_back(event.step, *event.objects);
    // Events of one step keep their order: the last one counts.
    std::stable_sort(changes_.begin() + 1, changes_.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
}

const std::vector<proto::ObjectDesc>& ObjectTimeline::at(std::uint64_t step) const {
    const auto after = std::upper_bound(changes_.begin() + 1, changes_.end(), step,
                                        [](std::uint64_t wanted, const auto& change) { return wanted < change.first; });
    return std::prev(after)->second;
}

}  // namespace headrace::client
