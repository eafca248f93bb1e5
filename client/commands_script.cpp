// script: commands from a file, one after the other
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <iterator>

#include "client/command.h"
#include "client/endpoints.h"
#include "client/interrupt.h"
#include "client/json_words.h"
#include "client/script.h"
#include "client/script_check.h"
#include "client/script_wait.h"
#include "client/spawn.h"
#include "client/text.h"

namespace headrace::client {

namespace fs = std::filesystem;

namespace {

struct ScriptWords {
    std::string file, data{"."};
    std::vector<std::string> assignments;
    int threads{0};
    bool is_dry{false};
};

struct Script {
    std::string name;
    std::vector<ScriptStep> steps;
};

proto::Result<Script> read_script(const ScriptWords& words) {
    auto variables = ScriptVariables::parse(words.assignments);
    if (!variables) return variables.error();
    const bool is_stdin = words.file == "-";
    Script script{is_stdin ? "standard input" : words.file, {}};
    std::string text;
    if (is_stdin) {
        text.assign(std::istreambuf_iterator<char>(std::cin), {});
    } else {
        auto read = read_text_file(words.file, R"("-" reads standard input)");
        if (!read) return read.error();
        text = *std::move(read);
    }
    auto steps =
        parse_script(text, script.name, is_stdin ? fs::path() : fs::path(words.file).parent_path(), *variables);
    if (!steps) return steps.error();
    script.steps = *std::move(steps);
    return script;
}

// "3 objects.remove", "4 wait"
std::string step_name(const ScriptStep& step) {
    const auto* command = std::get_if<ScriptCommand>(&step.what);
    return std::to_string(step.line) + " " + (command != nullptr ? command->method : "wait");
}

// Numbers with the ten digits that a run's clock means: a sum of steps such as 7.039999999999894 is 7.04.
proto::Json with_digits(const proto::Json& value) {
    if (value.is_number_float()) {
        char text[32];
        std::snprintf(text, sizeof text, "%.10g", value.get<double>());
        return std::strtod(text, nullptr);
    }
    proto::Json rounded = value;
    if (value.is_structured())
        for (auto& member : rounded) member = with_digits(member);
    return rounded;
}

// Results are what a script is for: one line each, the place and the reply. --json has all digits.
void print_result(const Globals& globals, const ScriptStep& step, const proto::Json& result) {
    const auto* command = std::get_if<ScriptCommand>(&step.what);
    if (globals.json)
        print_line(proto::Json{
            {"line", step.line}, {"method", command != nullptr ? command->method : "wait"}, {"result", result}}
                       .dump());
    else
        print_line(step_name(step) + ": " + with_digits(result).dump());
}

proto::Result<proto::Json> take_step(Connection& connection, ScriptWaits& waits, const ScriptStep& step) {
    if (const auto* command = std::get_if<ScriptCommand>(&step.what))
        return connection.request(command->method, command->params, Patience::while_alive);
    const auto* run = std::get_if<ScriptRun>(&step.what);
    const proto::Status waited =
        run != nullptr ? waits.wait(run->until, step_name(step)) : waits.wait(std::get<ScriptEvent>(step.what));
    if (!waited) return waited.error();
    auto status = connection.request("sim.status", proto::Json::object(), Patience::query);
    if (!status) return status.error();
    return proto::Json{{"step", (*status)["step"]}, {"time", (*status)["time"]}};
}

proto::Status run_script(const Globals& globals, const ScriptWords& words) {
    auto script = read_script(words);
    if (!script) return script.error();

    // A server that the user chose, else one of our own that ends with the script.
    std::unique_ptr<PrivateServer> server;
    std::string endpoint = control_endpoint(globals.server);
    Connection::PeerCheck peer_check;
    if (!is_server_chosen(globals.server)) {
        auto started = PrivateServer::start(words.threads, fs::absolute(words.data));
        if (!started) return started.error();
        server = *std::move(started);
        endpoint = server->endpoint();
        peer_check = [&server] { return server->fate(); };
    }
    auto connection = Connection::open(endpoint, peer_check);
    if (!connection) return connection.error();

    // Nothing is done when a line cannot be.
    auto description = (*connection)->request("describe", proto::Json::object(), Patience::query);
    if (!description) return description.error();
    for (const ScriptStep& step : script->steps)
        if (auto checked = check_step(step, *description); !checked)
            return error_at(script->name, step.line, checked.error());
    if (words.is_dry) {
        print_line(script->name + ": " + plural(std::ssize(script->steps), "line") + " to do, nothing wrong with them");
        return proto::Done{};
    }

    ScriptWaits waits(**connection);
    if (auto begun = waits.begin(); !begun) return begun.error();
    for (const ScriptStep& step : script->steps) {
        auto result = take_step(**connection, waits, step);
        if (!result) return error_at(script->name, step.line, result.error());
        print_result(globals, step, *result);
        if (is_interrupted()) break;
    }
    return proto::Done{};
}

}  // namespace

void add_script_command(CLI::App& app, CommandLine& line) {
    auto words = std::make_shared<ScriptWords>();
    CLI::App* script = add_command(app, line, "script", "do the commands of a file, one a line, up to the first error",
                                   [words](const Globals& globals) { return run_script(globals, *words); });
    script->add_option("FILE", words->file, R"(JSON Lines; "-": standard input; headrace help scripts explains them)")
        ->required();
    script->add_option("--set", words->assignments, "value of ${name}, name=value; can be repeated")
        ->allow_extra_args(false);
    script->add_flag("--dry-run", words->is_dry, "check every line, do none");
    script->add_option("--data", words->data, "of a private server: folder below which it records")
        ->capture_default_str();
    script->add_option("--threads", words->threads, "of a private server's solver; default: as many as the machine has")
        ->check(positive());
}

}  // namespace headrace::client
