// Watches whether the fluid has come to rest, by the scene's criterion.
#pragma once

#include <optional>

#include "proto/scene_desc.h"
#include "server/scene/run.h"

namespace headrace::server {

class AtRestWatch {
  public:
    explicit AtRestWatch(const scene::Run& run);

    // After each step, when somebody asks. True once the share of slow particles has been large enough for the
    // criterion's duration; stays true while that lasts.
    bool update(const scene::Run& run);

    // Has the scene's time-out passed since the watch began?
    bool is_overdue(const scene::Run& run) const { return run.time() - watched_since_ > criterion_.timeout; }

  private:
    proto::AtRestDesc criterion_;
    std::optional<double> slow_since_;  // [s]
    double watched_since_{};            // [s]
};

}  // namespace headrace::server
