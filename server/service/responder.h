// The right to answer one request, once.
#pragma once

#include <chrono>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "proto/messages_json.h"
#include "proto/result.h"

namespace headrace::server {

// Where the text of a reply goes. It never blocks and never throws: a reply that cannot be sent is dropped and counted
// by its owner.
using ReplySink = std::function<void(std::string text)>;

// What a finished call looked like, for the log.
struct CallReport {
    std::string method;
    double seconds{};           // [s] from arrival to answer
    const proto::Error* error;  // null: it succeeded
};
using CallHook = std::function<void(const CallReport&)>;

// Moves with the request from the table to whoever answers it. A responder that is dropped unanswered answers
// internal_error by itself, so that each request gets exactly one reply. For a notification the answers go nowhere.
// Owner: the service thread.
class Responder {
  public:
    Responder(std::string id, std::string method, bool is_notification, ReplySink sink, CallHook hook);
    ~Responder();
    Responder(Responder&& other) noexcept;
    Responder& operator=(Responder&&) = delete;

    void reply(const proto::Json& result);
    void fail(const proto::Error& error);

    template <class Reply>
    void answer(const proto::Result<Reply>& result) {
        if (result)
            reply(proto::to_json(*result));
        else
            fail(result.error());
    }

    // False once it has answered or was moved away.
    bool is_open() const { return is_open_; }
    const std::string& method() const { return method_; }

  private:
    void finish(const std::string& text, const proto::Error* error);

    std::string id_;
    std::string method_;
    bool is_notification_;
    bool is_open_{true};
    ReplySink sink_;
    CallHook hook_;
    std::chrono::steady_clock::time_point arrival_{std::chrono::steady_clock::now()};
};

}  // namespace headrace::server
