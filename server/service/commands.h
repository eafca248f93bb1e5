// The commands, by family. Handlers are a few lines: queries are answered from the boards, mutations are handed to the
// simulation, streams and recordings to the publisher.
#pragma once

#include <chrono>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "server/event_log.h"
#include "server/inbox.h"
#include "server/jobs.h"
#include "server/probe_board.h"
#include "server/publish/publisher.h"
#include "server/service/command_table.h"
#include "server/service/pending_replies.h"
#include "server/service/waiters.h"
#include "server/status.h"

namespace headrace::server {

// What the handlers work with. The ways out are functions, so that tests need neither threads nor sockets.
// Owner: the service thread; outlives the table.
struct CommandContext {
    const StatusBoard& board;
    const EventLog& events;
    const JobBoard& jobs;
    const ProbeBoard& probes;
    proto::HelloReply hello;
    std::function<void(Token, Mutation)> to_simulation;
    std::function<void(Token, publish::PublisherRequest)> to_publisher;
    std::function<void(std::string json, double time)> record_command;  // an applied command, for the recordings
    std::function<publish::PublisherCounts()> publisher_counts;
    std::function<void()> shut_down;  // after the reply is on its way
    std::chrono::steady_clock::time_point started{std::chrono::steady_clock::now()};
    PendingReplies pending;
    Waiters waiters;
};

void add_query_commands(CommandTable& table, CommandContext& context);
void add_scene_commands(CommandTable& table, CommandContext& context);
void add_run_commands(CommandTable& table, CommandContext& context);
void add_probe_commands(CommandTable& table, CommandContext& context);
void add_stream_commands(CommandTable& table, CommandContext& context);

// All of them, in the order of the protocol's description.
void add_commands(CommandTable& table, CommandContext& context);

// The OpenRPC document (https://spec.open-rpc.org/) of the table.
proto::Json make_description(const CommandTable& table);

}  // namespace headrace::server
