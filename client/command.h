// What subcommands share. Includes CLI11 and the JSON library: for the commands_*.cpp files only.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "client/call.h"
#include "client/cli.h"
#include "client/connection.h"

namespace headrace::client {

void print_line(const std::string& text);    // to standard output: results
void print_note(const std::string& text);    // to standard error: what goes on
void print_json(const proto::Json& result);  // indented, to standard output

// The server that the user chose, or the default one.
proto::Result<std::unique_ptr<Connection>> connect(const Globals& globals);

// Declares a subcommand; `act` runs once the whole line is parsed.
CLI::App* add_command(CLI::App& app, CommandLine& line, const std::string& name, const std::string& description,
                      std::function<proto::Status(const Globals&)> act);

// Checks of options: their refusals are for people, CLI11's own tell the range of a double with all its digits.
CLI::Validator positive();
CLI::Validator non_negative();

// One request: its result as JSON under --json, else as `print` says it.
template <class Reply, class Print>
proto::Status request_and_print(const Globals& globals, Connection& connection, std::string_view method,
                                const proto::Json& params, Patience patience, Print print) {
    auto result = connection.request(method, params, patience);
    if (!result) return result.error();
    if (globals.json) {
        print_json(*result);
        return proto::Done{};
    }
    auto reply = proto::from_json<Reply>(*result, "result");
    if (!reply) return reply.error();
    print(*reply);
    return proto::Done{};
}

// The same on the chosen server.
template <class Reply, class Params, class Print>
proto::Status command(const Globals& globals, std::string_view method, const Params& params, Patience patience,
                      Print print) {
    auto connection = connect(globals);
    if (!connection) return connection.error();
    return request_and_print<Reply>(globals, **connection, method, proto::to_json(params), patience, print);
}

}  // namespace headrace::client
