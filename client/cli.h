// The command line: global options, subcommands, exit status.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "proto/messages_json.h"
#include "proto/result.h"

namespace CLI {
class App;
}

namespace headrace::client {

// Parses, does, prints, and says how it went: 0, or the exit status of the error (proto/errors.h), or 130 after Ctrl-C.
int run_command_line(int argc, char** argv);

// What every subcommand knows.
struct Globals {
    std::string server;  // --server; empty: not given
    bool json{false};
};

// Subcommands put what is to be done here while the line is parsed.
struct CommandLine {
    Globals globals;
    std::function<proto::Status()> action;
};

void add_scene_commands(CLI::App& app, CommandLine& line);
void add_run_commands(CLI::App& app, CommandLine& line);
void add_parameter_commands(CLI::App& app, CommandLine& line);
void add_object_commands(CLI::App& app, CommandLine& line);
void add_probe_commands(CLI::App& app, CommandLine& line);
void add_record_command(CLI::App& app, CommandLine& line);
void add_local_run_command(CLI::App& app, CommandLine& line);
void add_converge_command(CLI::App& app, CommandLine& line);
void add_script_command(CLI::App& app, CommandLine& line);
void add_file_commands(CLI::App& app, CommandLine& line);
void add_raw_commands(CLI::App& app, CommandLine& line);
void add_watch_command(CLI::App& app, CommandLine& line);
void add_doctor_command(CLI::App& app, CommandLine& line);
void add_help_commands(CLI::App& app, CommandLine& line);  // help, completion, man: of all commands before them

}  // namespace headrace::client
