// Mutations waiting for the next step boundary.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <variant>

#include "proto/messages.h"
#include "proto/result.h"
#include "server/outbox.h"

namespace headrace::scene {
class Run;
}

namespace headrace::server {

// A scene under way into the simulation: what the loader worker posts when it is done.
struct LoadFinished {
    proto::Result<std::shared_ptr<scene::Run>> run;
    bool is_reset{false};
};

// sim.status with hash: true.
struct HashWanted {};

using Mutation = std::variant<proto::SceneLoad, proto::SimReset, proto::SimStep, proto::SimRun, proto::SimPause,
                              proto::SimResume, proto::SimCancel, proto::ParamsSet, proto::ObjectsAdd,
                              proto::ObjectsMove, proto::ObjectsRemove, proto::ProbesAdd, proto::ProbesRemove,
                              proto::SimInspect, HashWanted, proto::ServerShutdown, LoadFinished>;

struct InboxItem {
    Token token{};
    Mutation mutation;
};

// Filled by any thread, emptied by the simulation thread, which also sleeps here.
class Inbox {
  public:
    void put(Token token, Mutation mutation);
    void wake();  // ends a wait without an item: something else has changed (room in a stream's window)

    std::optional<InboxItem> take();
    // Returns when there is an item, after a wake(), or at the deadline.
    void wait();
    void wait_until(std::chrono::steady_clock::time_point deadline);

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<InboxItem> items_;
    bool woken_{false};
};

}  // namespace headrace::server
