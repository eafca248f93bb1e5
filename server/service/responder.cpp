#include "server/service/responder.h"

#include <cassert>
#include <utility>

#include "proto/envelope.h"

namespace headrace::server {

Responder::Responder(std::string id, std::string method, bool is_notification, ReplySink sink, CallHook hook)
    : id_(std::move(id)),
      method_(std::move(method)),
      is_notification_(is_notification),
      sink_(std::move(sink)),
      hook_(std::move(hook)) {}

Responder::Responder(Responder&& other) noexcept
    : id_(std::move(other.id_)),
      method_(std::move(other.method_)),
      is_notification_(other.is_notification_),
      is_open_(std::exchange(other.is_open_, false)),
      sink_(std::move(other.sink_)),
      hook_(std::move(other.hook_)),
      arrival_(other.arrival_) {}

Responder::~Responder() {
    if (!is_open_) return;
    try {
        fail({proto::ErrorCode::internal_error, "the server gave no answer to this request", "", ""});
    } catch (...) {  // out of memory: nothing can be said any more
    }
}

void Responder::reply(const proto::Json& result) {
    finish(is_notification_ ? std::string() : proto::rpc_result_text(id_, result), nullptr);
}

void Responder::fail(const proto::Error& error) {
    finish(is_notification_ ? std::string() : proto::rpc_error_text(id_, error), &error);
}

void Responder::finish(const std::string& text, const proto::Error* error) {
    assert(is_open_);
    if (!std::exchange(is_open_, false)) return;
    if (!is_notification_) sink_(text);
    if (!hook_) return;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - arrival_;
    hook_({method_, elapsed.count(), error});
}

}  // namespace headrace::server
