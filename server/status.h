// The last summary of the simulation: written by it, read by anyone without stopping it.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "proto/messages.h"

namespace headrace::server {

struct StatusSnapshot {
    proto::SimStatusReply status;
    // Change only by mutations; shared between snapshots. Null when no scene is loaded.
    std::shared_ptr<const proto::SceneDesc> scene;
    std::shared_ptr<const std::vector<proto::ParameterEntry>> parameters;
    std::shared_ptr<const std::vector<proto::ObjectDesc>> objects;
};

class StatusBoard {
  public:
    // Precondition of read(): none; before the first write it is the empty state.
    std::shared_ptr<const StatusSnapshot> read() const {
        const std::lock_guard lock(mutex_);
        return snapshot_;
    }
    void write(std::shared_ptr<const StatusSnapshot> snapshot) {
        const std::lock_guard lock(mutex_);
        snapshot_ = std::move(snapshot);
    }

  private:
    mutable std::mutex mutex_;
    std::shared_ptr<const StatusSnapshot> snapshot_{std::make_shared<StatusSnapshot>()};
};

}  // namespace headrace::server
