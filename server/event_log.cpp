#include "server/event_log.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace headrace::server {

void EventLog::add_listener(Doorbell& doorbell) {
    const std::lock_guard lock(mutex_);
    listeners_.push_back(&doorbell);
}

std::uint64_t EventLog::add(proto::Event event) {
    using namespace std::chrono;
    event.wall_clock = duration<double>(system_clock::now().time_since_epoch()).count();
    const std::lock_guard lock(mutex_);
    event.seq = ++last_seq_;
    if (event.objects) with_objects_.push_back(event.seq);
    if (with_objects_.size() > kObjectLists) {
        const std::uint64_t oldest = with_objects_.front();
        with_objects_.pop_front();
        if (!events_.empty() && oldest >= events_.front().seq) events_[oldest - events_.front().seq].objects.reset();
    }
    events_.push_back(std::move(event));
    if (events_.size() > kCapacity) events_.pop_front();
    for (Doorbell* listener : listeners_) listener->ring();
    return last_seq_;
}

proto::EventsSinceReply EventLog::since(const proto::EventsSince& query) const {
    const std::lock_guard lock(mutex_);
    proto::EventsSinceReply reply;
    reply.last_seq = std::max(query.seq, last_seq_);
    if (query.seq >= last_seq_) return reply;
    const std::uint64_t oldest = events_.front().seq;
    if (query.seq + 1 < oldest) reply.lost = oldest - query.seq - 1;
    const auto first = static_cast<std::size_t>(query.seq + 1 < oldest ? 0 : query.seq + 1 - oldest);
    for (std::size_t k = first; k < events_.size(); ++k) {
        const proto::Event& event = events_[k];
        const bool wanted =
            query.types.empty() || std::find(query.types.begin(), query.types.end(), event.type) != query.types.end();
        if (!wanted) continue;
        if (std::ssize(reply.events) >= query.limit) {
            reply.last_seq = reply.events.back().seq;
            break;
        }
        reply.events.push_back(event);
    }
    return reply;
}

std::uint64_t EventLog::last_seq() const {
    const std::lock_guard lock(mutex_);
    return last_seq_;
}

}  // namespace headrace::server
