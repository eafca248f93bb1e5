#include "client/command.h"

#include <iostream>

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

}  // namespace headrace::client
