#include <CLI/CLI.hpp>
#include <algorithm>
#include <catch2/catch.hpp>

#include "client/completion.h"

using namespace headrace;
using client::Candidate;

namespace {

// A program with what the real one has: global options, options with and without words, positionals, a hidden command.
struct Program {
    Program() {
        app.add_option("--server", server, "endpoint");
        app.add_flag("--json", json, "as JSON");
        CLI::App* set = app.add_subcommand("set", "set parameters");
        set->add_option("NAME=VALUE", words, "which");
        CLI::App* move = app.add_subcommand("move", "move an object");
        move->add_option("NAME", word, "which");
        move->add_option("--to", to, "where");
        move->add_option("--slip", slip, "how")->check(CLI::IsMember({"free_slip", "no_slip"}));
        app.add_subcommand("secret", "not shown")->group("");
    }
    // Candidates for the last word; the server knows one name of each kind and notes how it was asked for.
    std::vector<std::string> after(const std::vector<std::string>& typed) {
        const client::Completions found =
            client::complete(app, typed, [this](const std::string& what, const std::string& endpoint) {
                asked = what + "@" + endpoint;
                return std::vector<Candidate>{{"my_" + what, ""}};
            });
        std::vector<std::string> names;
        for (const Candidate& candidate : found.candidates) names.push_back(candidate.word);
        return names;
    }

    CLI::App app{"a program", "headrace"};
    std::string server, word, to, slip, asked;
    std::vector<std::string> words;
    bool json{false};
};

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("Completion.CommandsComeFirst") {
    Program program;
    CHECK(program.after({""}) == Words{"set", "move"});
    CHECK(program.after({"m"}) == Words{"move"});
    CHECK(program.after({"--json", "se"}) == Words{"set"});
    CHECK(program.after({}) == Words{"set", "move"});
}

TEST_CASE("Completion.OptionsAreThoseOfTheCommandAndOfTheProgram") {
    Program program;
    const Words all = program.after({"move", "-"});
    for (const char* option : {"--to", "--slip", "--server", "--json", "--help"})
        CHECK(std::count(all.begin(), all.end(), option) >= 1);
    CHECK(program.after({"set", "--t"}).empty());
}

TEST_CASE("Completion.NamesAreTheServersThatTheLineNames") {
    Program program;
    CHECK(program.after({"move", ""}) == Words{"my_object"});
    CHECK(program.asked == "object@");
    CHECK(program.after({"--server", "ipc:///x", "set", "my"}) == Words{"my_parameter="});
    CHECK(program.asked == "parameter@ipc:///x");
    CHECK(program.after({"set", "a=1", "--server=ipc:///y", ""}) == Words{"my_parameter="});
    CHECK(program.asked == "parameter@ipc:///y");
}

TEST_CASE("Completion.AnOptionsWordIsNotAPositional") {
    Program program;
    CHECK(program.after({"move", "--slip", "no"}) == Words{"no_slip"});
    CHECK(program.after({"move", "--slip=no"}) == Words{"--slip=no_slip"});
    CHECK(program.after({"move", "--to", ""}).empty());
    CHECK(program.after({"move", "--to", "1,2", ""}) == Words{"my_object"});
    CHECK(program.after({"move", "ball", ""}).empty());
}
