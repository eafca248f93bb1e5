// The events of the scene document: which have fired, and which are due now.
#pragma once

#include <cstddef>
#include <set>
#include <vector>

#include "server/probes/probe_set.h"
#include "server/scene/run.h"

namespace headrace::server {

// Owner: the simulation thread.
class SceneEvents {
  public:
    void restart() { fired_.clear(); }

    // Those that are due, in the scene's order. They count as fired from now on.
    std::vector<std::size_t> take_due(const scene::Run& run, const probes::ProbeSet& probes, bool is_at_rest);

    // Is there one that waits for rest?
    bool wait_for_rest(const scene::Run& run) const;

  private:
    std::set<std::size_t> fired_;
};

}  // namespace headrace::server
