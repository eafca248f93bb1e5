#include "server/outbox.h"

#include <utility>

namespace headrace::server {

void Outbox::put(Token token, proto::Result<proto::Reply> result) {
    if (token == 0) return;
    {
        const std::lock_guard lock(mutex_);
        outcomes_.push_back({token, std::move(result)});
    }
    doorbell_.ring();
}

std::vector<Outcome> Outbox::take() {
    doorbell_.quiet();
    const std::lock_guard lock(mutex_);
    return std::exchange(outcomes_, {});
}

}  // namespace headrace::server
