// probes, inspect
#include <algorithm>

#include "client/arguments.h"
#include "client/command.h"
#include "client/probe_csv.h"
#include "client/probe_series.h"
#include "client/text.h"
#include "client/writers/file_output.h"

namespace headrace::client {

namespace {

struct ProbeWords {
    std::string name, csv;
};

std::string value_text(const std::optional<double>& value, const std::string& unit) {
    if (!value) return "-";
    return number(*value) + (unit == "1" ? "" : " " + unit);
}

// "P2  t 0.44 s: pressure 2150.5 Pa  (441 samples)"
std::string probe_line(const proto::ProbeState& state) {
    constexpr std::size_t kShown = 7;  // of a profile's many values
    std::string line = state.probe.name + "  ";
    if (!state.latest.empty()) line += "t " + value_text(state.latest[0], "s") + ":";
    const std::size_t count = std::min(state.latest.size(), state.columns.size());
    for (std::size_t k = 1; k < std::min(count, kShown + 1); ++k)
        line += (k > 1 ? ", " : " ") + state.columns[k].name + " " + value_text(state.latest[k], state.columns[k].unit);
    if (count > kShown + 1) line += ", ...";
    line += "  (" + plural(state.samples, "sample") + ")";
    if (state.failure) line += "  cannot be evaluated: " + *state.failure;
    return line;
}

proto::Status list_probes(const Globals& globals) {
    return command<proto::ProbesListReply>(globals, "probes.list", proto::ProbesList{}, Patience::query,
                                           [](const proto::ProbesListReply& reply) {
                                               for (const proto::ProbeState& state : reply.probes)
                                                   print_line(probe_line(state));
                                               if (reply.probes.empty()) print_line("no probes");
                                           });
}

proto::Status show_series(const Globals& globals, const ProbeWords& words) {
    auto connection = connect(globals);
    if (!connection) return connection.error();
    auto series = fetch_series(**connection, words.name);
    if (!series) return series.error();
    if (series->dropped > 0) print_note(plural(series->dropped, "older sample") + " no longer held by the server");
    if (globals.json) {
        proto::ProbesGetReply all;
        all.probes.push_back(*series);
        print_json(proto::to_json(all)["probes"][0]);
        return proto::Done{};
    }
    std::string text = csv_header(series->columns);
    for (const proto::ProbeRow& row : series->rows) text += csv_row(row);
    if (words.csv.empty()) {
        text.pop_back();
        print_line(text);
        return proto::Done{};
    }
    if (auto written = write_file(words.csv, {as_bytes(text)}); !written) return written.error();
    print_line(plural(std::ssize(series->rows), "sample") + " in " + words.csv);
    return proto::Done{};
}

proto::Status show_probes(const Globals& globals, const ProbeWords& words) {
    if (!words.name.empty()) return show_series(globals, words);
    if (!words.csv.empty())
        return usage_error("a file holds one probe", "--csv", "name the probe: headrace probes NAME");
    return list_probes(globals);
}

std::string vector_text(const proto::Vec3& vector) {
    return number(vector[0]) + "," + number(vector[1]) + "," + number(vector[2]);
}

// A line of a table: what, then values in columns.
std::string table_line(std::string what, const std::string& value) {
    constexpr std::size_t kWidth = 24;
    what.resize(std::max(what.size() + 1, kWidth), ' ');
    return what + value;
}

void print_particle(const proto::SimInspectReply& reply) {
    print_line("particle " + std::to_string(reply.id) + " at " + at_moment(reply.step, reply.time));
    print_line(table_line("position [m]", vector_text(reply.position)));
    print_line(table_line("velocity [m/s]", vector_text(reply.velocity)));
    print_line(table_line("density [kg/m^3]", number(reply.density)));
    print_line(table_line("pressure [Pa]", number(reply.pressure)));
    print_line(table_line("concentration", number(reply.concentration)));
    print_line(table_line("smallest eigenvalue", number(reply.min_eigenvalue)));
    print_line(table_line("acceleration [m/s^2]", vector_text(reply.acceleration)));
    for (const proto::InspectedTerm& term : reply.terms)
        print_line(table_line("  " + term.term, vector_text(term.acceleration)));
    print_line(plural(std::ssize(reply.neighbours), "neighbour") + ", nearest first: distance [m], weight");
    for (const proto::InspectedNeighbour& neighbour : reply.neighbours)
        print_line(table_line(
            "  " + (neighbour.id ? std::to_string(*neighbour.id) : "wall of " + neighbour.object.value_or("?")),
            number(neighbour.distance) + "  " + number(neighbour.weight)));
}

}  // namespace

void add_probe_commands(CLI::App& app, CommandLine& line) {
    auto words = std::make_shared<ProbeWords>();
    CLI::App* prober = add_command(app, line, "probes", "tell what the probes measure, or all samples of one",
                                   [words](const Globals& globals) { return show_probes(globals, *words); });
    prober->add_option("NAME", words->name, "which one: its samples as CSV; none: the last sample of each");
    prober->add_option("--csv", words->csv, "write the samples to this file");

    auto id = std::make_shared<std::uint32_t>();
    add_command(app, line, "inspect", "explain one particle: neighbours, and what each term does to it",
                [id](const Globals& globals) {
                    return command<proto::SimInspectReply>(globals, "sim.inspect", proto::SimInspect{*id},
                                                           Patience::while_alive, print_particle);
                })
        ->add_option("ID", *id, "its id")
        ->required();
}

}  // namespace headrace::client
