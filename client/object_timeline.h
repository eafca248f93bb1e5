// Which objects stood where at a frame of a recording.
#pragma once

#include <cstdint>
#include <vector>

#include "client/writers/placed_object.h"
#include "proto/messages.h"
#include "proto/result.h"
#include "proto/values/motion.h"

namespace headrace::client {

class ObjectTimeline {
  public:
    ObjectTimeline() = default;  // without objects

    // `initial`: when the recording began; `events`: of the recording, ascending. Those with an object list count.
    // Errors: scene_invalid for a motion that cannot be evaluated, telling from which step on it is there.
    static proto::Result<ObjectTimeline> make(std::vector<proto::ObjectDesc> initial,
                                              const std::vector<proto::Event>& events, const proto::SceneDesc& scene);

    // A change tells the step before which it was applied: it shows from that step on. Moving objects stand where they
    // do at `time` [s]. Safe from any thread.
    std::vector<PlacedObject> at(std::uint64_t step, double time) const;

    bool has_changes() const { return changes_.size() > 1; }  // else the step does not matter to at()

  private:
    struct Change {
        std::uint64_t step;
        std::vector<proto::ObjectDesc> objects;
        scene::MovingObjects motions;
    };
    std::vector<Change> changes_;  // ascending by step, the first at 0
};

}  // namespace headrace::client
