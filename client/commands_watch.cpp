// watch: a run on the terminal while it goes on
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "client/command.h"
#include "client/dashboard.h"
#include "client/interrupt.h"
#include "client/terminal.h"
#include "client/text.h"

namespace headrace::client {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr const char* kWithoutTerminal = "headrace watch --once prints one snapshot";
constexpr auto kRefresh = 250ms;
constexpr const char* kEnergyProbe = "watched_energies";
constexpr int kSnapshotColumns = 80, kSnapshotRows = 1'000;

// A look at the server, and what the keys do there.
class Watch {
  public:
    Watch(Connection& connection, Dashboard& dashboard) : connection_(connection), dashboard_(dashboard) {}

    proto::Status look() {
        auto status = call<proto::SimStatusReply>(connection_, "sim.status", proto::SimStatus{});
        if (!status) return status.error();
        if (auto read = read_events(); !read) return read;
        dashboard_.add(*status, extras(*status));
        return proto::Done{};
    }

    void press(char key) {
        if (!dashboard_.choices().empty()) return choose(key);
        switch (key) {
            case 'p':
                return act("sim.pause", proto::Json::object(), "paused");
            case 'r':
                return act("sim.resume", proto::Json::object(), "resumed");
            case 's':
                return act("sim.step", proto::Json::object(), "stepped");
            case 'd':
                return offer_objects();
            case 'e':
                return toggle_energies();
            default:
                return;
        }
    }

    // Removes the probe that this one has added: nobody looks at it any more. Whoever leaves waits no longer than for a
    // query; the server removes it after a longer step all the same, and one that has gone is no error now.
    void leave() {
        if (!has_asked_for_probe_) return;
        static_cast<void>(connection_.request("probes.remove", {{"name", kEnergyProbe}}, Patience::query).ok());
    }

  private:
    proto::Status read_events() {
        for (;;) {
            auto reply = call<proto::EventsSinceReply>(connection_, "events.since", proto::EventsSince{.seq = seen_});
            if (!reply) return reply.error();
            for (const proto::Event& event : reply->events) dashboard_.add(event);
            seen_ = reply->last_seq;
            if (reply->events.empty()) return proto::Done{};
        }
    }

    // What the status does not hold. A model or a scene without them is no error.
    Dashboard::Extras extras(const proto::SimStatusReply& status) {
        Dashboard::Extras extras;
        if (!status.scene) return extras;
        if (auto got = call<proto::ParamsGetReply>(connection_, "params.get", proto::ParamsGet{{"rest_density"}}))
            if (const auto* value = std::get_if<double>(&got->parameters.at(0).value)) extras.rest_density = *value;
        if (auto probes = call<proto::ProbesListReply>(connection_, "probes.list", proto::ProbesList{}))
            for (const proto::ProbeState& probe : probes->probes)
                for (std::size_t k = 0; k < probe.columns.size() && k < probe.latest.size(); ++k)
                    if (probe.columns[k].name == "balance") extras.energy_balance = probe.latest[k];
        return extras;
    }

    void act(const char* method, const proto::Json& params, const std::string& done) {
        auto result = connection_.request(method, params, Patience::while_alive);
        if (!result) return dashboard_.say(error_line(result.error()));
        dashboard_.say(done + " at step " + with_thousands((*result).value("step", std::int64_t{})));
    }

    // The probe that tells the energy error. It makes steps longer, so it is there only when asked for, and while
    // somebody looks.
    void toggle_energies() {
        auto probes = call<proto::ProbesListReply>(connection_, "probes.list", proto::ProbesList{});
        if (!probes) return dashboard_.say(error_line(probes.error()));
        for (const proto::ProbeState& probe : probes->probes) {
            if (!std::holds_alternative<proto::EnergyProbe>(probe.probe.kind)) continue;
            if (probe.probe.name != kEnergyProbe)
                return dashboard_.say("the probe " + probe.probe.name + " tells the energy error already");
            has_asked_for_probe_ = false;
            return act("probes.remove", {{"name", kEnergyProbe}}, "no longer following energies");
        }
        const proto::Json probe{{"name", kEnergyProbe}, {"kind", {{"energies", proto::Json::object()}}}};
        has_asked_for_probe_ = true;
        act("probes.add", {{"probe", probe}}, "following energies (e ends that)");
    }

    void offer_objects() {
        auto list = call<proto::ObjectsListReply>(connection_, "objects.list", proto::ObjectsList{});
        if (!list) return dashboard_.say(error_line(list.error()));
        std::vector<std::string> names;
        for (const proto::ObjectDesc& object : list->objects) names.push_back(object.name);
        if (names.empty()) return dashboard_.say("there are no objects");
        dashboard_.ask(std::move(names));
    }

    void choose(char key) {
        const std::vector<std::string> names = dashboard_.choices();
        const auto index = static_cast<std::size_t>(key - '1');
        if (key != '\x1b' && (key < '1' || key > '9' || index >= names.size())) return;
        dashboard_.ask({});
        if (key != '\x1b') act("objects.remove", {{"name", names[index]}}, "removed " + names[index]);
    }

    Connection& connection_;
    Dashboard& dashboard_;
    std::uint64_t seen_{0};
    bool has_asked_for_probe_{
        false};  // for the probe of energies, and not for its end since; Ctrl-C may hide the reply
};

proto::Status watch_live(Watch& watch, Dashboard& dashboard) {
    auto terminal = Terminal::open(kWithoutTerminal);
    if (!terminal) return terminal.error();
    auto next_look = Clock::now();
    while (!is_interrupted()) {
        if (Clock::now() >= next_look) {
            if (auto looked = watch.look(); !looked) return looked;
            next_look = Clock::now() + kRefresh;
        }
        const Terminal::Size size = (*terminal)->size();
        (*terminal)->draw(dashboard.lines(size.rows, size.columns, true));
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(next_look - Clock::now());
        const auto key = (*terminal)->key(std::max(left, 0ms));
        if (!key) continue;
        if (*key == 'q') break;
        watch.press(*key);
        next_look = Clock::now();
    }
    return proto::Done{};
}

proto::Status watch(const Globals& globals, bool is_once) {
    if (!is_once && !globals.json)
        if (auto checked = Terminal::check(kWithoutTerminal); !checked) return checked;
    auto connection = connect(globals);
    if (!connection) return connection.error();
    if (globals.json)
        return request_and_print<proto::SimStatusReply>(globals, **connection, "sim.status", proto::Json::object(),
                                                        Patience::query, [](const proto::SimStatusReply&) {});
    const bool has_colors = !is_once && std::getenv("NO_COLOR") == nullptr;
    Dashboard dashboard((*connection)->endpoint(), {locale_glyphs(), has_colors});
    Watch watch(**connection, dashboard);
    if (!is_once) {
        const proto::Status watched = watch_live(watch, dashboard);
        if (watched || watched.error().code != proto::ErrorCode::connection_failed) watch.leave();
        return watched;
    }
    if (auto looked = watch.look(); !looked) return looked;
    for (const std::string& line : dashboard.lines(kSnapshotRows, kSnapshotColumns, false)) {
        const std::size_t end = line.find_last_not_of(' ');
        print_line(line.substr(0, end == std::string::npos ? 0 : end + 1));
    }
    return proto::Done{};
}

}  // namespace

void add_watch_command(CLI::App& app, CommandLine& line) {
    auto is_once = std::make_shared<bool>(false);
    add_command(app, line, "watch",
                "show a run on the terminal while it goes on; keys pause, resume, step, remove, follow energies, quit",
                [is_once](const Globals& globals) { return watch(globals, *is_once); })
        ->add_flag("--once", *is_once, "print one snapshot, for which no terminal is needed");
}

}  // namespace headrace::client
