// events, call
#include "client/command.h"
#include "client/interrupt.h"
#include "client/text.h"

namespace headrace::client {

namespace {

struct EventWords {
    bool follow{false};
    std::uint64_t since{0};
    std::vector<std::string> types;
};

proto::Status events(const Globals& globals, const EventWords& words) {
    auto connection = connect(globals);
    if (!connection) return connection.error();
    constexpr double kLongPoll = 1.0;  // [s] well below the patience for a query
    proto::EventsSince query;
    query.seq = words.since;
    query.types = words.types;
    for (;;) {
        auto reply = call<proto::EventsSinceReply>(**connection, "events.since", query);
        if (!reply) return reply.error();
        if (reply->lost > 0)
            print_note(plural(static_cast<std::int64_t>(reply->lost), "older event") + " forgotten by the server");
        for (const proto::Event& event : reply->events)
            print_line(globals.json ? proto::event_text(event) : event_line(event));
        const bool is_complete = reply->events.empty();
        query.seq = reply->last_seq;
        if (words.follow)
            query.timeout = kLongPoll;
        else if (is_complete)
            return proto::Done{};
        if (is_interrupted()) return proto::Done{};
    }
}

proto::Status call_raw(const Globals& globals, const std::string& method, const std::string& text) {
    auto params = proto::parse_json(text);
    if (!params) return params.error();
    auto connection = connect(globals);
    if (!connection) return connection.error();
    auto result = (*connection)->request(method, *params, Patience::while_alive);
    if (!result) return result.error();
    print_json(*result);
    return proto::Done{};
}

}  // namespace

void add_raw_commands(CLI::App& app, CommandLine& line) {
    auto words = std::make_shared<EventWords>();
    CLI::App* lister = add_command(app, line, "events", "list what has happened; --json: one event a line",
                                   [words](const Globals& globals) { return events(globals, *words); });
    lister->add_flag("--follow", words->follow, "go on as things happen, until Ctrl-C");
    lister->add_option("--since", words->since, "events after this number");
    lister->add_option("--type", words->types, "only these types, such as job.ended; can be repeated")
        ->allow_extra_args(false);

    struct RawCall {
        std::string method, params{"{}"};
    };
    auto raw = std::make_shared<RawCall>();
    CLI::App* caller =
        add_command(app, line, "call", "send one request as it stands, and print its result",
                    [raw](const Globals& globals) { return call_raw(globals, raw->method, raw->params); });
    caller->add_option("METHOD", raw->method, "such as sim.status; headrace call describe tells all")->required();
    caller->add_option("PARAMS", raw->params, "a JSON object")->capture_default_str();
}

}  // namespace headrace::client
