#include "server/jobs.h"

#include <algorithm>

namespace headrace::server {

namespace {

auto position_of(auto& jobs, std::uint64_t job) {
    return std::lower_bound(jobs.begin(), jobs.end(), job,
                            [](const proto::JobReply& entry, std::uint64_t number) { return entry.job < number; });
}

}  // namespace

void JobBoard::write(const proto::JobReply& job) {
    const std::lock_guard lock(mutex_);
    const auto place = position_of(jobs_, job.job);
    if (place != jobs_.end() && place->job == job.job) {
        *place = job;
        return;
    }
    jobs_.insert(place, job);
    if (jobs_.size() <= kCapacity) return;
    // The oldest that has ended; one that is paused or runs is still waited for.
    const auto ended = std::find_if(jobs_.begin(), jobs_.end(), [](const proto::JobReply& entry) {
        return entry.state != proto::JobState::running && entry.state != proto::JobState::paused;
    });
    if (ended != jobs_.end()) jobs_.erase(ended);
}

std::optional<proto::JobReply> JobBoard::find(std::uint64_t job) const {
    const std::lock_guard lock(mutex_);
    const auto place = position_of(jobs_, job);
    if (place == jobs_.end() || place->job != job) return std::nullopt;
    return *place;
}

}  // namespace headrace::server
