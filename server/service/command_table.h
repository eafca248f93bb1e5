// Method name -> typed handler. Decoding, state check, timing, logging and the mapping of failures to errors are
// written once, here; no socket is in sight.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "proto/messages_json.h"
#include "proto/methods.h"
#include "server/service/responder.h"

namespace headrace::server {

// What the server adds to a method of proto/methods.h.
struct MethodRules {
    std::vector<proto::ErrorCode> errors{};  // besides those that every method may give
    // True: the state table is asked here. False: whoever carries the command out asks it.
    bool checks_state{false};
};

// Owner: the service thread.
class CommandTable {
  public:
    // Answers the responder, or moves it away to answer later.
    using Run = std::function<void(const proto::Json& params, Responder& responder)>;

    struct Entry {
        proto::MethodInfo info;
        MethodRules rules;
        Run run;
    };

    CommandTable(std::function<proto::SimState()> state, CallHook hook);
    CommandTable(const CommandTable&) = delete;
    CommandTable& operator=(const CommandTable&) = delete;

    // A handler that answers at once, or keeps the responder. Precondition: proto/methods.h lists the name.
    template <class Params>
    void add(std::string_view name, MethodRules rules, std::function<void(Params, Responder&)> handler) {
        add_entry(name, std::move(rules),
                  [handler = std::move(handler)](const proto::Json& json, Responder& responder) {
                      proto::Result<Params> params = proto::from_json<Params>(json, "params");
                      if (!params) return responder.fail(params.error());
                      handler(std::move(*params), responder);
                  });
    }

    // A handler that only looks: the state table is asked first, the value it returns is the reply.
    template <class Params, class Reply>
    void add_query(std::string_view name, MethodRules rules,
                   std::function<proto::Result<Reply>(const Params&)> handler) {
        rules.checks_state = true;
        add<Params>(name, std::move(rules), [handler = std::move(handler)](const Params& params, Responder& responder) {
            responder.answer(handler(params));
        });
    }

    // Handles one request as it came off the wire. `sink` gets the reply: now, later, or never for a notification.
    void handle(std::string_view text, ReplySink sink);

    // Answers instead of handling, in the words of the envelope.
    void refuse(std::string_view text, const proto::Error& error, const ReplySink& sink) const;

    const std::vector<Entry>& entries() const { return entries_; }  // in the order they were added
    std::vector<std::string> names() const;

  private:
    void add_entry(std::string_view name, MethodRules rules, Run run);
    const Entry* find(std::string_view name) const;
    void call(const Entry& entry, const proto::Json& params, Responder& responder) const;

    std::vector<Entry> entries_;
    std::function<proto::SimState()> state_;
    CallHook hook_;
};

// The error of a method that is called on the control socket and belongs to the data socket.
proto::Error wrong_socket_error(std::string_view method);

}  // namespace headrace::server
