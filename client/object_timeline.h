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
    // `initial`: when the recording began; `events`: of the recording, ascending. Those with an object list count.
    // Errors: scene_invalid for a motion that cannot be evaluated.
    static proto::Result<ObjectTimeline> make(std::vector<proto::ObjectDesc> initial,
                                              const std::vector<proto::Event>& events, const proto::SceneDesc& scene);

    // A change tells the step before which it was applied: it shows from that step on. Moving objects stand where they
    // do at `time` [s]. Safe from any thread.
    std::vector<PlacedObject> at(std::uint64_t step, double time) const;

  private:
    struct Change {
        std::uint64_t step;
        std::vector<proto::ObjectDesc> objects;
        scene::MovingObjects motions;
    };
    std::vector<Change> changes_;  // ascending by step; never empty
};

}  // namespace headrace::client
