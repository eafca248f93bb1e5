// set, get
#include "client/arguments.h"
#include "client/command.h"
#include "client/text.h"

namespace headrace::client {

namespace {

proto::Status set(const Globals& globals, const std::vector<std::string>& words, std::optional<std::int64_t> at_step) {
    auto parameters = parse_assignments(words);
    if (!parameters) return parameters.error();
    const proto::ParamsSet request{*parameters, at_step};
    return command<proto::ParamsSetReply>(
        globals, "params.set", request, Patience::while_alive, [&](const proto::ParamsSetReply& reply) {
            std::string line = "before step " + with_thousands(static_cast<std::int64_t>(reply.step)) + ":";
            for (const auto& [name, previous] : reply.previous) {
                const auto now = request.parameters.find(name);
                if (now == request.parameters.end()) continue;
                line += (line.ends_with(':') ? " " : ", ") + name + " " + parameter_text(previous) + " -> " +
                        parameter_text(now->second);
            }
            print_line(line);
        });
}

void print_parameters(const proto::ParamsGetReply& reply) {
    for (const proto::ParameterEntry& entry : reply.parameters) {
        const std::string unit = entry.unit.empty() || entry.unit == "1" ? "" : " " + entry.unit;
        std::string line = entry.name + " = " + parameter_text(entry.value) + unit;
        if (entry.value != entry.default_value) line += " (default " + parameter_text(entry.default_value) + ")";
        print_line(line + ": " + entry.meaning);
    }
}

}  // namespace

void add_parameter_commands(CLI::App& app, CommandLine& line) {
    struct SetOptions {
        std::vector<std::string> assignments;
        std::optional<std::int64_t> at_step;
    };
    auto to_set = std::make_shared<SetOptions>();
    CLI::App* setter =
        add_command(app, line, "set", "change parameters of the model, all or none",
                    [to_set](const Globals& globals) { return set(globals, to_set->assignments, to_set->at_step); });
    setter->add_option("NAME=VALUE", to_set->assignments, "such as viscosity=5 or gravity=0,-9.8,0")->required();
    setter->add_option("--at-step", to_set->at_step, "before this step instead of the next one")->check(non_negative());

    auto names = std::make_shared<std::vector<std::string>>();
    add_command(app, line, "get", "tell parameters of the model", [names](const Globals& globals) {
        return command<proto::ParamsGetReply>(globals, "params.get", proto::ParamsGet{*names}, Patience::query,
                                              print_parameters);
    })->add_option("NAME", *names, "which ones; none: all");
}

}  // namespace headrace::client
