#include "client/object_timeline.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace headrace::client {

proto::Result<ObjectTimeline> ObjectTimeline::make(std::vector<proto::ObjectDesc> initial,
                                                   const std::vector<proto::Event>& events,
                                                   const proto::SceneDesc& scene) {
    ObjectTimeline timeline;
    const auto add = [&](std::uint64_t step, std::vector<proto::ObjectDesc> objects) -> proto::Status {
        auto motions = scene::MovingObjects::make(objects, scene.dimensions, scene.spacing);
        if (!motions) {
            proto::Error error = motions.error();
            if (!timeline.changes_.empty())
                error.message += ", of the objects from step " + std::to_string(step) + " on";
            return error;
        }
        timeline.changes_.push_back({step, std::move(objects), *std::move(motions)});
        return proto::Done{};
    };
    if (auto added = add(0, std::move(initial)); !added) return added.error();
    for (const proto::Event& event : events)
        if (event.objects)
            if (auto added = add(event.step, *event.objects); !added) return added.error();
    // Events of one step keep their order: the last one counts.
    std::stable_sort(timeline.changes_.begin(), timeline.changes_.end(),
                     [](const Change& a, const Change& b) { return a.step < b.step; });
    return timeline;
}

std::vector<PlacedObject> ObjectTimeline::at(std::uint64_t step, double time) const {
    const auto after =
        std::upper_bound(changes_.begin(), changes_.end(), step,
                         [](std::uint64_t wanted, const Change& change) { return wanted < change.step; });
    if (after == changes_.begin()) return {};
    const Change& last = *std::prev(after);
    const std::vector<scene::Placement> places = last.motions.at(time);
    std::vector<PlacedObject> placed;
    for (std::size_t k = 0; k < last.objects.size(); ++k) placed.emplace_back(last.objects[k], places[k]);
    return placed;
}

}  // namespace headrace::client
