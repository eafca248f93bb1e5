#include "client/command.h"

#include <iostream>

#include "client/arguments.h"
#include "client/endpoints.h"

namespace headrace::client {

void print_line(const std::string& text) {
    std::cout << text << std::endl;
}
void print_note(const std::string& text) {
    std::cerr << text << std::endl;
}
void print_json(const proto::Json& result) {
    std::cout << result.dump(2) << std::endl;
}

proto::Result<std::unique_ptr<Connection>> connect(const Globals& globals) {
    return Connection::open(control_endpoint(globals.server));
}

CLI::App* add_command(CLI::App& app, CommandLine& line, const std::string& name, const std::string& description,
                      std::function<proto::Status(const Globals&)> act) {
    CLI::App* subcommand = app.add_subcommand(name, description);
    subcommand->callback([&line, act = std::move(act)] { line.action = [&line, act] { return act(line.globals); }; });
    return subcommand;
}

namespace {

// The word as it stands, and the numbers wanted.
template <class Wanted>
CLI::Validator number_check(const std::string& name, const std::string& what, const Wanted& is_wanted) {
    return {[what, is_wanted](const std::string& word) {
                const auto value = parse_number(word);
                return value && is_wanted(*value) ? std::string() : "\"" + word + "\" is no number " + what;
            },
            name};
}

}  // namespace

CLI::Validator positive() {
    return number_check("POSITIVE", "above 0", [](double value) { return value > 0; });
}
CLI::Validator non_negative() {
    return number_check("NONNEGATIVE", "of 0 or more", [](double value) { return value >= 0; });
}

}  // namespace headrace::client
