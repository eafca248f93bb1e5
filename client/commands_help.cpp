// help, completion, man: what the program tells of itself
#include <filesystem>
#include <fstream>
#include <iostream>

#include "client/arguments.h"
#include "client/command.h"
#include "client/completion.h"
#include "client/help_topics.h"
#include "proto/man_page.h"
#include "proto/suggest.h"

namespace headrace::client {

namespace fs = std::filesystem;

namespace {

bool is_visible(const CLI::App* command) {
    return !command->get_group().empty();
}

void print_topics() {
    print_line("headrace help TOPIC, or headrace help COMMAND. Topics, with examples:\n");
    for (const HelpTopic& topic : help_topics()) {
        std::string name(topic.name);
        name.resize(std::max<std::size_t>(name.size(), 12), ' ');
        print_line("  " + name + std::string(topic.title));
    }
    print_line("\nheadrace --help lists the commands.");
}

proto::Status print_help(const CLI::App& app, const std::string& word) {
    if (word.empty()) {
        print_topics();
        return proto::Done{};
    }
    std::vector<std::string> known;
    for (const HelpTopic& topic : help_topics()) {
        known.emplace_back(topic.name);
        if (topic.name != word) continue;
        std::cout << topic.text << std::flush;
        return proto::Done{};
    }
    for (const CLI::App* command : app.get_subcommands(is_visible)) {
        known.push_back(command->get_name());
        if (command->get_name() != word) continue;
        std::cout << command->help(app.get_name()) << std::flush;
        return proto::Done{};
    }
    return usage_error("there is no topic \"" + word + "\"", "TOPIC", proto::suggest(word, known));
}

proto::Status write_file(const fs::path& file, const std::string& text) {
    std::ofstream out(file, std::ios::binary);
    if (!(out << text).flush())
        return proto::Error{proto::ErrorCode::file_error, "cannot be written", file.string(), ""};
    return proto::Done{};
}

// One page of the program and one of each command.
proto::Status write_man_pages(const CLI::App& app, const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return proto::Error{proto::ErrorCode::file_error, error.message(), folder.string(), ""};
    if (auto written = write_file(folder / "headrace.1", proto::man_page(app, "headrace", "headrace")); !written)
        return written;
    for (const CLI::App* command : app.get_subcommands(is_visible)) {
        const std::string& name = command->get_name();
        const std::string page = proto::man_page(*command, "headrace-" + name, "headrace " + name);
        if (auto written = write_file(folder / ("headrace-" + name + ".1"), page); !written) return written;
    }
    return proto::Done{};
}

proto::Status print_man_page(const CLI::App& app, const std::string& name) {
    if (name.empty()) {
        std::cout << proto::man_page(app, "headrace", "headrace") << std::flush;
        return proto::Done{};
    }
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands(is_visible)) {
        known.push_back(command->get_name());
        if (command->get_name() != name) continue;
        std::cout << proto::man_page(*command, "headrace-" + name, "headrace " + name) << std::flush;
        return proto::Done{};
    }
    return usage_error("there is no command \"" + name + "\"", "COMMAND", proto::suggest(name, known));
}

}  // namespace

void add_help_commands(CLI::App& app, CommandLine& line) {
    auto topic = std::make_shared<std::string>();
    add_command(app, line, "help", "explain a topic with examples, or a command", [&app, topic](const Globals&) {
        return print_help(app, *topic);
    })->add_option("TOPIC", *topic, "none: all topics are listed");

    auto shell = std::make_shared<std::string>();
    add_command(app, line, "completion", "print the script that completes headrace's words in a shell",
                [shell](const Globals&) -> proto::Status {
                    std::cout << completion_script(*shell) << std::flush;
                    return proto::Done{};
                })
        ->add_option("SHELL", *shell, "such as: eval \"$(headrace completion bash)\"")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));

    struct ManWords {
        std::string command, folder;
    };
    auto page = std::make_shared<ManWords>();
    CLI::App* man =
        add_command(app, line, "man", "print a manual page: headrace man run | man -l -", [&app, page](const Globals&) {
            return page->folder.empty() ? print_man_page(app, page->command) : write_man_pages(app, page->folder);
        });
    man->add_option("COMMAND", page->command, "none: the program's own page");
    man->add_option("--out", page->folder, "write all pages into this folder");
}

}  // namespace headrace::client
