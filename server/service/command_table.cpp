#include "server/service/command_table.h"

#include <cassert>
#include <exception>
#include <variant>

#include "proto/envelope.h"
#include "proto/suggest.h"
#include "server/service/limits.h"
#include "server/state_table.h"

namespace headrace::server {

using proto::Error;
using proto::ErrorCode;

CommandTable::CommandTable(std::function<proto::SimState()> state, CallHook hook)
    : state_(std::move(state)), hook_(std::move(hook)) {}

void CommandTable::add_entry(std::string_view name, MethodRules rules, Run run) {
    const proto::MethodInfo* info = proto::find_method(name);
    assert(info != nullptr);
    entries_.push_back({*info, std::move(rules), std::move(run)});
}

const CommandTable::Entry* CommandTable::find(std::string_view name) const {
    for (const Entry& entry : entries_)
        if (entry.info.name == name) return &entry;
    return nullptr;
}

std::vector<std::string> CommandTable::names() const {
    std::vector<std::string> names;
    for (const Entry& entry : entries_) names.emplace_back(entry.info.name);
    return names;
}

void CommandTable::handle(std::string_view text, ReplySink sink) {
    auto parsed = proto::parse_rpc_request(text, static_cast<std::size_t>(kSoftMessageLimit));
    if (const auto* refusal = std::get_if<proto::RpcRefusal>(&parsed)) {
        Responder(refusal->id, "(refused)", false, std::move(sink), hook_).fail(refusal->error);
        return;
    }
    auto& request = std::get<proto::RpcRequest>(parsed);
    Responder responder(std::move(request.id), request.method, request.is_notification, std::move(sink), hook_);
    const Entry* entry = find(request.method);
    if (entry == nullptr) {
        responder.fail({ErrorCode::method_not_found, "there is no method \"" + request.method + "\"", "method",
                        proto::suggest(request.method, names())});
        return;
    }
    try {
        call(*entry, request.params, responder);
    } catch (const std::exception& failure) {
        if (responder.is_open()) responder.fail({ErrorCode::internal_error, failure.what(), "", ""});
    }
}

void CommandTable::call(const Entry& entry, const proto::Json& params, Responder& responder) const {
    if (entry.info.socket == proto::MethodSocket::data) return responder.fail(wrong_socket_error(entry.info.name));
    if (entry.rules.checks_state)
        if (const auto refusal = refuse_in_state(entry.info.name, state_())) return responder.fail(*refusal);
    entry.run(params, responder);
}

void CommandTable::refuse(std::string_view text, const Error& error, const ReplySink& sink) const {
    const auto parsed = proto::parse_rpc_request(text, static_cast<std::size_t>(kSoftMessageLimit));
    if (const auto* refusal = std::get_if<proto::RpcRefusal>(&parsed)) {
        sink(proto::rpc_error_text(refusal->id, error));
    } else if (const auto& request = std::get<proto::RpcRequest>(parsed); !request.is_notification) {
        sink(proto::rpc_error_text(request.id, error));
    }
}

proto::Error wrong_socket_error(std::string_view method) {
    return {ErrorCode::wrong_socket, std::string(method) + " is answered on the data socket, not on this one", "method",
            "connect a DEALER to the data port that hello tells"};
}

}  // namespace headrace::server
