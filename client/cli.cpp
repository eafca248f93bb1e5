#include "client/cli.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "client/arguments.h"
#include "client/completion.h"
#include "client/endpoints.h"
#include "client/interrupt.h"
#include "client/text.h"
#include "proto/suggest.h"
#include "proto/version.h"

namespace headrace::client {

namespace {

constexpr const char* kFooter =
    R"(A server is chosen by --server, else by HEADRACE_SERVER, else it is tcp://127.0.0.1:5755. `run`,
`converge` and `plan SCENE` need none: they start a private headraced (HEADRACE_SERVER_BINARY, else the one beside this
program); so does `script` where no server is chosen.

headrace help lists topics with examples; headrace completion SHELL makes words complete themselves.

Exit status:
  0  done                                  5  not possible in this state, busy, cancelled
  1  anything else                         6  a file cannot be read or written
  2  wrong usage, or a bad request         7  the simulation has faulted
  3  no server answers, or it is foreign   8  timed out
  4  there is no such thing              130  interrupted (Ctrl-C); files are complete)";

int exit_status(const proto::Status& outcome) {
    if (is_interrupted()) {
        if (!outcome && outcome.error().code != proto::ErrorCode::cancelled)
            std::cerr << error_line(outcome.error()) << "\n";
        return kInterruptedExit;
    }
    if (outcome) return 0;
    std::cerr << error_line(outcome.error()) << "\n";
    return proto::error_info(outcome.error().code).exit_code;
}

proto::Error parse_error(const CLI::ParseError& error) {
    const std::string said = error.what();
    // "Could not convert: --fps = abc": only numbers are ever converted.
    const std::size_t name = said.find("--"), equals = said.find(" = ");
    if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr && name < equals && equals != std::string::npos)
        return usage_error("\"" + said.substr(equals + 3) + "\" is no number", said.substr(name, equals - name),
                           "counts are whole numbers, others may have a fraction: 12.5");
    return usage_error(said, "", "headrace --help, or headrace COMMAND --help");
}

// No subcommand was recognised: there was none, or an unknown word stands in its place.
proto::Error command_error(const CLI::App& app) {
    constexpr const char* kRemedy = "headrace --help lists the commands";
    const std::vector<std::string> words = app.remaining();
    if (words.empty()) return usage_error("a command is missing", "", kRemedy);
    std::vector<std::string> known;
    for (const CLI::App* subcommand : app.get_subcommands(nullptr)) known.push_back(subcommand->get_name());
    const std::string hint = proto::suggest(words.front(), known);
    return usage_error("there is no command \"" + words.front() + "\"", "",
                       hint.starts_with("did you mean") ? hint : kRemedy);
}

}  // namespace

int run_command_line(int argc, char** argv) {
    CLI::App app("Commands a fluid simulation: loads scenes, runs, changes, records and converts them.", "headrace");
    CommandLine line;
    app.require_subcommand(1);
    app.fallthrough();  // global options may stand behind the subcommand
    app.set_version_flag("--version", std::string("headrace ") + proto::kProgramVersion);
    app.footer(kFooter);
    app.add_option("--server", line.globals.server, "control endpoint, tcp://HOST:PORT or ipc://PATH");
    app.add_flag("--json", line.globals.json, "print the result as JSON");
    add_local_run_command(app, line);
    add_converge_command(app, line);
    add_scene_commands(app, line);
    add_run_commands(app, line);
    add_parameter_commands(app, line);
    add_object_commands(app, line);
    add_probe_commands(app, line);
    add_record_command(app, line);
    add_script_command(app, line);
    add_file_commands(app, line);
    add_raw_commands(app, line);
    add_watch_command(app, line);
    add_doctor_command(app, line);
    add_help_commands(app, line);

    // The shells' question comes before the parser: what it asks about is not finished.
    if (argc > 1 && std::string_view(argv[1]) == "__complete") {
        print_completions(app, {argv + 2, argv + argc});
        return 0;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& wanted) {
        return app.exit(wanted);  // --help, --version
    } catch (const CLI::RequiredError& error) {
        return exit_status(app.get_subcommands().empty() ? command_error(app) : parse_error(error));
    } catch (const CLI::ParseError& error) {
        return exit_status(parse_error(error));
    }

    watch_interrupts();
    try {
        return exit_status(line.action());
    } catch (const std::exception& error) {
        return exit_status(proto::Error{proto::ErrorCode::internal_error, error.what(), "", ""});
    }
}

}  // namespace headrace::client
