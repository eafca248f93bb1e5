// Which objects stood where at a frame of a recording.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "proto/messages.h"

namespace headrace::client {

class ObjectTimeline {
  public:
    // `initial`: when the recording began; `events`: of the recording, ascending. Those with an object list count.
    ObjectTimeline(std::vector<proto::ObjectDesc> initial, const std::vector<proto::Event>& events);

    // A change tells the step before which it was applied: it shows from that step on.
    const std::vector<proto::ObjectDesc>& at(std::uint64_t step) const;

  private:
    std::vector<std::pair<std::uint64_t, std::vector<proto::ObjectDesc>>> changes_;  // ascending by step; never empty
};

}  // namespace headrace::client
