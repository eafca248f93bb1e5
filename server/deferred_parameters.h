// Changes of parameters that wait for their step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "proto/errors.h"
#include "proto/scene_desc.h"
#include "server/outbox.h"

namespace headrace::server {

// Owner: the simulation thread.
class DeferredParameters {
  public:
    static constexpr std::size_t kMost = 1'000;

    struct Change {
        Token token{};
        proto::Parameters values;
    };

    // `now`: steps done. The error of a step that is past, or when too many wait; then nothing is added.
    std::optional<proto::Error> add(std::uint64_t at_step, std::uint64_t now, Change change);

    std::vector<Change> take_due(std::uint64_t now);  // in the order of their steps
    std::vector<Change> take_all();

  private:
    std::multimap<std::uint64_t, Change> changes_;  // by step
};

}  // namespace headrace::server
