#include "server/service/waiters.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "server/service/limits.h"

namespace headrace::server {

using proto::ErrorCode;

void Waiters::add(Responder& responder, std::optional<Clock::time_point> deadline, Attempt attempt) {
    attempt(responder, false);
    if (!responder.is_open()) return;
    if (waiters_.size() >= kMaxWaiters) {
        responder.fail({ErrorCode::limit_exceeded, std::to_string(kMaxWaiters) + " requests wait already", "",
                        "ask with a timeout, or with timeout 0"});
        return;
    }
    waiters_.push_back(std::make_unique<Waiter>(Waiter{std::move(responder), deadline, std::move(attempt)}));
}

void Waiters::retry() {
    for (auto& waiter : waiters_) try_once(*waiter, false);
    forget_answered();
}

void Waiters::expire(Clock::time_point now) {
    for (auto& waiter : waiters_)
        if (waiter->deadline && *waiter->deadline <= now) try_once(*waiter, true);
    forget_answered();
}

std::optional<Waiters::Clock::time_point> Waiters::next_deadline() const {
    std::optional<Clock::time_point> next;
    for (const auto& waiter : waiters_)
        if (waiter->deadline && (!next || *waiter->deadline < *next)) next = waiter->deadline;
    return next;
}

void Waiters::refuse_all(const proto::Error& error) {
    for (auto& waiter : std::exchange(waiters_, {})) waiter->responder.fail(error);
}

void Waiters::try_once(Waiter& waiter, bool is_late) {
    try {
        waiter.attempt(waiter.responder, is_late);
    } catch (const std::exception& failure) {
        if (waiter.responder.is_open()) waiter.responder.fail({ErrorCode::internal_error, failure.what(), "", ""});
    }
}

void Waiters::forget_answered() {
    std::erase_if(waiters_, [](const auto& waiter) { return !waiter->responder.is_open(); });
}

}  // namespace headrace::server
