#include "server/deferred_parameters.h"

#include <limits>
#include <string>
#include <utility>

namespace headrace::server {

using proto::Error;
using proto::ErrorCode;

std::optional<Error> DeferredParameters::add(std::uint64_t at_step, std::uint64_t now, Change change) {
    if (at_step < now)
        return Error{ErrorCode::invalid_params,
                     "step " + std::to_string(at_step) + " is past; the next one is " + std::to_string(now),
                     "params.at_step", "name a step to come, or leave it out"};
    if (changes_.size() >= kMost)
        return Error{ErrorCode::limit_exceeded, "too many changes are waiting for their step", "params.at_step",
                     "wait for some of them"};
    changes_.emplace(at_step, std::move(change));
    return std::nullopt;
}

std::vector<DeferredParameters::Change> DeferredParameters::take_due(std::uint64_t now) {
    std::vector<Change> due;
    while (!changes_.empty() && changes_.begin()->first <= now) {
        due.push_back(std::move(changes_.begin()->second));
        changes_.erase(changes_.begin());
    }
    return due;
}

std::vector<DeferredParameters::Change> DeferredParameters::take_all() {
    return take_due(std::numeric_limits<std::uint64_t>::max());
}

}  // namespace headrace::server
