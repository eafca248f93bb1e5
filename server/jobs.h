// Runs as jobs: what `job.wait` asks. Written by the simulation, read by the service thread.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>

#include "proto/messages.h"

namespace headrace::server {

class JobBoard {
  public:
    static constexpr std::size_t kCapacity = 1'000;  // older jobs are forgotten

    void write(const proto::JobReply& job);  // new or changed; the event that follows wakes waiters
    std::optional<proto::JobReply> find(std::uint64_t job) const;  // nothing: never existed or forgotten

  private:
    mutable std::mutex mutex_;
    std::deque<proto::JobReply> jobs_;  // ascending by number
};

}  // namespace headrace::server
