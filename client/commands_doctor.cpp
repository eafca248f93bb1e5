// doctor: is this machine in order?
#include <algorithm>

#include "client/command.h"
#include "client/doctor.h"
#include "client/text.h"

namespace headrace::client {

namespace {

const char* word_for(Health health) {
    return health == Health::good ? "ok" : health == Health::warning ? "warning" : "failure";
}

void print_finding(const Finding& finding) {
    const auto padded = [](std::string text, std::size_t width) {
        text.resize(std::max(text.size(), width), ' ');
        return text;
    };
    print_line(padded(word_for(finding.health), 9) + padded(finding.subject, 18) + finding.found);
    if (!finding.remedy.empty()) print_line(std::string(27, ' ') + "-> " + finding.remedy);
}

proto::Json as_json(const std::vector<Finding>& findings) {
    proto::Json list = proto::Json::array();
    for (const Finding& finding : findings)
        list.push_back({{"subject", finding.subject},
                        {"health", word_for(finding.health)},
                        {"found", finding.found},
                        {"remedy", finding.remedy}});
    return list;
}

proto::Status doctor(const Globals& globals) {
    const std::vector<Finding> findings = examine(globals.server);
    if (globals.json)
        print_json(as_json(findings));
    else
        for (const Finding& finding : findings) print_finding(finding);
    const auto is_failure = [](const Finding& finding) { return finding.health == Health::failure; };
    const auto first = std::find_if(findings.begin(), findings.end(), is_failure);
    if (first == findings.end()) return proto::Done{};
    return proto::Error{first->code,
                        plural(std::count_if(findings.begin(), findings.end(), is_failure), "failure") + " found",
                        first->subject, first->remedy};
}

}  // namespace

void add_doctor_command(CLI::App& app, CommandLine& line) {
    add_command(app, line, "doctor", "look whether this machine is in order: programs, ports, limits, folders", doctor);
}

}  // namespace headrace::client
