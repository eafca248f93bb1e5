#include "server/inbox.h"

#include <utility>

namespace headrace::server {

void Inbox::put(Token token, Mutation mutation) {
    {
        const std::lock_guard lock(mutex_);
        items_.push_back({token, std::move(mutation)});
    }
    changed_.notify_one();
}

void Inbox::wake() {
    {
        const std::lock_guard lock(mutex_);
        woken_ = true;
    }
    changed_.notify_one();
}

std::optional<InboxItem> Inbox::take() {
    const std::lock_guard lock(mutex_);
    if (items_.empty()) return std::nullopt;
    InboxItem item = std::move(items_.front());
    items_.pop_front();
    return item;
}

void Inbox::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return woken_ || !items_.empty(); });
    woken_ = false;
}

void Inbox::wait_until(std::chrono::steady_clock::time_point deadline) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, deadline, [this] { return woken_ || !items_.empty(); });
    woken_ = false;
}

}  // namespace headrace::server
