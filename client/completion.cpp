#include "client/completion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>

#include "client/call.h"
#include "client/endpoints.h"
#include "client/help_topics.h"
#include "client/writers/palette.h"
#include "client/writers/writer.h"
#include "proto/event_types.h"
#include "proto/fields.h"
#include "proto/methods.h"
#include "proto/presets.h"

namespace headrace::client {

namespace {

using namespace std::chrono_literals;

constexpr auto kServerPatience = 300ms;  // somebody is waiting with a finger on the key

// What an option's word is. Options whose words are chosen from a list (CLI::IsMember) need no row.
struct WordKind {
    std::string_view command;  // empty: any
    std::string_view option;
    std::string_view kind;   // of names below, or "file"
    std::string_view end{};  // behind each name
};
constexpr WordKind kWordKinds[] = {
    {"", "SCENE", "scene"},
    {"get", "NAME", "parameter"},
    {"set", "NAME=VALUE", "parameter", "="},
    {"remove", "NAME", "object"},
    {"move", "NAME", "object"},
    {"probes", "NAME", "probe"},
    {"run", "--remove", "object", "@"},
    {"script", "--set", ""},
    {"", "--set", "parameter", "="},
    {"resume", "--until", "end"},
    {"run", "--until", "end"},
    {"", "FILE", "file"},
    {"", "--csv", "file"},
    {"", "--out", "file"},
    {"", "--data", "file"},
    {"", "--shape", "file"},
    {"", "--motion", "file"},
    {"", "--fields", "field"},
    {"", "--color-by", "field"},
    {"", "--palette", "palette"},
    {"", "--view", "view"},
    {"", "--crop", "crop"},
    {"", "--format", "format"},
    {"", "--precision", "precision"},
    {"call", "METHOD", "method"},
    {"events", "--type", "event"},
    {"help", "TOPIC", "topic"},
    {"man", "COMMAND", "command"},
};

const WordKind* kind_of(const std::string& command, const std::string& option) {
    for (const WordKind& row : kWordKinds)
        if ((row.command.empty() || row.command == command) && row.option == option) return &row;
    return nullptr;
}

std::string visible_name(const CLI::Option& option) {
    if (!option.get_lnames().empty()) return "--" + option.get_lnames().front();
    return option.get_name(true);
}

bool takes_word(const CLI::Option& option) {
    return option.get_items_expected_max() > 0;
}

// The list of a CLI::IsMember, which is told in braces.
std::vector<Candidate> listed_words(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t begin = type.find('{'), end = type.find('}');
    if (begin == std::string::npos || end == std::string::npos) return {};
    std::vector<Candidate> words;
    for (const std::string& word : CLI::detail::split(type.substr(begin + 1, end - begin - 1), ','))
        words.push_back({word, ""});
    return words;
}

std::vector<Candidate> commands_of(const CLI::App& app) {
    std::vector<Candidate> commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); }))
        commands.push_back({command->get_name(), command->get_description()});
    return commands;
}

// Names of a kind that this program knows itself, or the server tells.
std::vector<Candidate> names_of(std::string_view kind, const CLI::App& app, const ServerNames& server_names,
                                const std::string& server) {
    std::vector<Candidate> names;
    if (kind == "method") {
        for (const proto::MethodInfo& info : proto::kMethods)
            names.push_back({std::string(info.name), std::string(info.summary)});
    } else if (kind == "event") {
        for (const proto::EventTypeInfo& info : proto::kEventTypes)
            names.push_back({std::string(info.type), std::string(info.when)});
    } else if (kind == "field") {
        for (const proto::FieldInfo& info : proto::kFields) names.push_back({std::string(info.name), ""});
    } else if (kind == "format") {
        for (const FormatInfo& format : writer_formats()) names.push_back({std::string(format.name), ""});
    } else if (kind == "palette") {
        for (const std::string_view palette : kPaletteNames) names.push_back({std::string(palette), ""});
    } else if (kind == "view") {
        for (const std::string_view view : kViewNames) names.push_back({std::string(view), ""});
    } else if (kind == "crop") {
        names = {{"fluid", "what it reaches over the recording"}, {"scene", "all"}};
    } else if (kind == "precision") {
        names = {{"f4", "single"}, {"f8", "double"}};
    } else if (kind == "command") {
        names = commands_of(app);
    } else if (kind == "topic") {
        for (const HelpTopic& topic : help_topics())
            names.push_back({std::string(topic.name), std::string(topic.title)});
        for (Candidate& command : commands_of(app)) names.push_back(std::move(command));
    } else if (kind == "end") {
        names = {{"at-rest", "the fluid is at rest"}, {"step=", "a step"}, {"steps=", "so many steps"}};
        for (Candidate& probe : server_names("probe", server)) names.push_back({probe.word + ">", probe.about});
    } else if (kind == "scene") {
        names = server_names("scene", server);
        if (names.empty())
            for (const proto::Preset& preset : proto::presets()) names.push_back({std::string(preset.name), ""});
    } else if (kind == "object" || kind == "parameter" || kind == "probe") {
        names = server_names(std::string(kind), server);
    }
    return names;
}

// What the words before the last one have said.
struct Before {
    const CLI::App* command;              // the subcommand, or the app
    const CLI::Option* pending{nullptr};  // an option that waits for its word
    std::size_t positionals{0};           // given to the subcommand
    std::string server;                   // --server
};

const CLI::Option* find_option(const CLI::App& app, const CLI::App& command, const std::string& name) {
    for (const CLI::App* each : {&command, &app})
        if (const CLI::Option* option = each->get_option_no_throw(name)) return option;
    return nullptr;
}

Before read_words(const CLI::App& app, const std::vector<std::string>& words) {
    Before before{&app};
    for (std::size_t k = 0; k + 1 < words.size(); ++k) {
        const std::string& word = words[k];
        if (before.pending != nullptr) {
            if (visible_name(*before.pending) == "--server") before.server = word;
            before.pending = nullptr;
        } else if (word.starts_with("--")) {
            const std::size_t equals = word.find('=');
            const CLI::Option* option = find_option(app, *before.command, word.substr(0, equals));
            if (option == nullptr || !takes_word(*option)) continue;
            if (equals == std::string::npos)
                before.pending = option;
            else if (visible_name(*option) == "--server")
                before.server = word.substr(equals + 1);
        } else if (before.command == &app) {
            for (const CLI::App* command :
                 app.get_subcommands([&](const CLI::App* each) { return each->get_name() == word; }))
                before.command = command;
        } else {
            ++before.positionals;
        }
    }
    return before;
}

// The positional that stands next; one that repeats stands for all that follow.
const CLI::Option* next_positional(const CLI::App& command, std::size_t given) {
    for (const CLI::Option* option : command.get_options()) {
        if (!option->get_positional()) continue;
        const auto most = static_cast<std::size_t>(option->get_items_expected_max());
        if (given < most) return option;
        given -= most;
    }
    return nullptr;
}

void add_words(Completions& result, const CLI::Option& option, const CLI::App& app, const Before& before,
               const ServerNames& server_names) {
    for (Candidate& word : listed_words(option)) result.candidates.push_back(std::move(word));
    const WordKind* row = kind_of(before.command->get_name(), visible_name(option));
    if (row == nullptr) return;
    result.wants_files = row->kind == "file" || row->kind == "scene";
    for (Candidate& name : names_of(row->kind, app, server_names, before.server)) {
        name.word += row->end;
        result.candidates.push_back(std::move(name));
    }
}

std::vector<Candidate> ask_server(const std::string& what, const std::string& server) {
    auto connection = Connection::open(control_endpoint(server), {}, kServerPatience);
    if (!connection) return {};
    std::vector<Candidate> names;
    if (what == "object") {
        if (auto list = call<proto::ObjectsListReply>(**connection, "objects.list", proto::ObjectsList{}))
            for (const proto::ObjectDesc& object : list->objects) names.push_back({object.name, ""});
    } else if (what == "parameter") {
        if (auto list = call<proto::ParamsGetReply>(**connection, "params.get", proto::ParamsGet{}))
            for (const proto::ParameterEntry& entry : list->parameters) names.push_back({entry.name, entry.meaning});
    } else if (what == "probe") {
        if (auto list = call<proto::ProbesListReply>(**connection, "probes.list", proto::ProbesList{}))
            for (const proto::ProbeState& state : list->probes) names.push_back({state.probe.name, ""});
    } else if (auto list = call<proto::SceneListReply>(**connection, "scene.list", proto::SceneList{})) {
        for (const proto::SceneSummary& scene : list->scenes) names.push_back({scene.name, scene.description});
    }
    return names;
}

}  // namespace

Completions complete(const CLI::App& app, const std::vector<std::string>& words, const ServerNames& server_names) {
    const std::string last = words.empty() ? "" : words.back();
    const Before before = read_words(app, words);
    Completions result;
    if (before.pending != nullptr) {
        add_words(result, *before.pending, app, before, server_names);
    } else if (const std::size_t equals = last.find('='); last.starts_with("--") && equals != std::string::npos) {
        const std::string name = last.substr(0, equals);
        if (const CLI::Option* option = find_option(app, *before.command, name); option && takes_word(*option))
            add_words(result, *option, app, before, server_names);
        result.wants_files = false;  // a shell would seek files that begin with the option's name
        for (Candidate& candidate : result.candidates) candidate.word.insert(0, name + "=");
    } else if (last.starts_with("-")) {
        for (const CLI::App* each : {before.command, &app}) {
            for (const CLI::Option* option : each->get_options())
                if (!option->get_positional() && !option->get_group().empty())
                    result.candidates.push_back({visible_name(*option), option->get_description()});
            if (before.command == &app) break;
        }
    } else if (before.command == &app) {
        result.candidates = commands_of(app);
    } else if (const CLI::Option* positional = next_positional(*before.command, before.positionals)) {
        add_words(result, *positional, app, before, server_names);
    }
    std::erase_if(result.candidates, [&](const Candidate& each) { return !each.word.starts_with(last); });
    return result;
}

void print_completions(const CLI::App& app, const std::vector<std::string>& words) {
    const Completions completions = complete(app, words, ask_server);
    for (const Candidate& candidate : completions.candidates)
        std::cout << candidate.word << '\t' << candidate.about.substr(0, candidate.about.find('\n')) << '\n';
    if (completions.wants_files) std::cout << ":files\n";
    std::cout.flush();
}

}  // namespace headrace::client
