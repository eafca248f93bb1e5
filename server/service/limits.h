// How much a peer may ask for.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace headrace::server {

inline constexpr std::int64_t kSoftMessageLimit = 16 << 20;   // [bytes] larger requests are answered with an error
inline constexpr std::int64_t kHardMessageLimit = 64 << 20;   // [bytes] larger messages disconnect the peer
inline constexpr std::chrono::milliseconds kPromptAnswer{5};  // sim.pause and sim.cancel wait so long for a step's end
inline constexpr std::size_t kMaxPendingReplies = 4096;       // commands handed over and not yet answered
inline constexpr std::size_t kMaxWaiters = 4096;              // job.wait and events.since that wait

}  // namespace headrace::server
