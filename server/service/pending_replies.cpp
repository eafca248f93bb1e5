#include "server/service/pending_replies.h"

#include <exception>
#include <utility>
#include <variant>

#include "proto/envelope.h"
#include "server/service/limits.h"

namespace headrace::server {

using proto::ErrorCode;

namespace {

void answer_as_it_is(const proto::Result<proto::Reply>& result, Responder& responder) {
    if (!result) return responder.fail(result.error());
    responder.reply(std::visit([](const auto& reply) { return proto::to_json(reply); }, *result));
}

}  // namespace

std::optional<Token> PendingReplies::add(Responder& responder, Finish finish, std::optional<Early> early) {
    if (entries_.size() >= kMaxPendingReplies) {
        responder.fail({ErrorCode::limit_exceeded,
                        std::to_string(kMaxPendingReplies) + " commands wait for an answer already", "",
                        "read the replies before sending more"});
        return std::nullopt;
    }
    const Token token = ++last_token_;
    entries_.emplace(
        token, Entry{std::move(responder), finish ? std::move(finish) : Finish(answer_as_it_is), std::move(early)});
    return token;
}

void PendingReplies::resolve(const Outcome& outcome) {
    auto node = entries_.extract(outcome.token);
    if (node.empty()) return;
    auto& [responder, finish, early] = node.mapped();
    try {
        finish(outcome.result, responder);
    } catch (const std::exception& failure) {
        if (responder.is_open()) responder.fail({ErrorCode::internal_error, failure.what(), "", ""});
    }
}

void PendingReplies::expire(Clock::time_point now) {
    for (auto& [token, entry] : entries_) {
        if (!entry.early || entry.early->deadline > now) continue;
        entry.early->answer(entry.responder);
        entry.early.reset();
    }
}

std::optional<PendingReplies::Clock::time_point> PendingReplies::next_deadline() const {
    std::optional<Clock::time_point> next;
    for (const auto& [token, entry] : entries_)
        if (entry.early && (!next || entry.early->deadline < *next)) next = entry.early->deadline;
    return next;
}

void PendingReplies::refuse_all(const proto::Error& error) {
    for (auto& [token, entry] : std::exchange(entries_, {}))
        if (entry.responder.is_open()) entry.responder.fail(error);
}

}  // namespace headrace::server
