// run: a whole simulation in one command, on a private server
#include <filesystem>

#include "client/arguments.h"
#include "client/command.h"
#include "client/convert.h"
#include "client/interrupt.h"
#include "client/jobs.h"
#include "client/json_words.h"
#include "client/record.h"
#include "client/record_run.h"
#include "client/scene_request.h"
#include "client/spawn.h"
#include "client/text.h"

namespace headrace::client {

namespace fs = std::filesystem;

namespace {

struct LocalRun {
    std::string scene, until, out, format_words{"vtp"}, field_words;
    std::vector<std::string> assignments, removals, probes;
    std::optional<std::int64_t> steps;
    std::optional<double> fps;
    bool at_rest{false}, overwrite{false}, writes_probes{false};
    int threads{0};

    bool wants_probes() const { return writes_probes || !probes.empty(); }
    std::vector<std::string> formats() const {
        return format_words.empty() ? std::vector<std::string>{} : split(format_words, ',');
    }
};

// Runs one after the other; each may end with an object that leaves.
struct Phase {
    proto::RunUntil until;
    std::string removed;  // afterwards; empty: nothing
};

proto::Result<std::vector<Phase>> make_phases(const LocalRun& words) {
    std::vector<Phase> phases;
    for (const std::string& word : words.removals) {
        auto removal = parse_removal(word);
        if (!removal) return removal.error();
        phases.push_back({removal->when, removal->object});
    }
    Phase last;
    if (words.steps)
        last.until.steps = *words.steps;
    else if (words.at_rest || words.until.empty())
        last.until.at_rest = true;
    else if (auto until = parse_until(words.until))
        last.until = *until;
    else
        return until.error();
    phases.push_back(last);
    return phases;
}

// Runs all phases, recording. Error: how the first one ended that did not end well.
proto::Status run_phases(Connection& connection, Recorder& recorder, const std::vector<Phase>& phases,
                         const std::string& label) {
    for (const Phase& phase : phases) {
        auto job = start_run(connection, phase.until);
        if (job) job = follow_job(connection, &recorder, *job, phase.until, label);
        if (!job) return job.error();
        if (is_interrupted()) return proto::Done{};
        if (auto verdict = job_verdict(connection, *job); !verdict) return verdict;
        print_note(job_line(*job, phase.until));
        if (phase.removed.empty()) continue;
        auto removed = call<proto::Applied>(connection, "objects.remove", proto::ObjectsRemove{phase.removed},
                                            Patience::while_alive);
        if (!removed) return removed.error();
        print_note("removed " + phase.removed + " before step " +
                   with_thousands(static_cast<std::int64_t>(removed->step)));
    }
    return proto::Done{};
}

struct Recorded {
    fs::path file;
    std::uint64_t frames{}, gaps{};
    proto::Status outcome{proto::Done{}};  // of the run: the recording is there in any case
};

// The fields that the user chose. Error: they are unknown, or too few for the files to look at.
proto::Result<std::optional<proto::FieldSet>> chosen_fields(const LocalRun& words) {
    const std::vector<std::string> formats = words.formats();
    if (auto checked = check_formats(formats); !checked) return checked.error();
    if (words.field_words.empty()) return std::optional<proto::FieldSet>{};
    auto fields = parse_fields(words.field_words);
    if (!fields) return fields.error();
    if (auto checked = check_fields(formats, *fields, PictureOptions{}.color_field); !checked) return checked.error();
    return std::optional<proto::FieldSet>{*fields};
}

// Whether the scene has what the files to look at need: fields of its own choice, probes.
proto::Status check_scene(Connection& connection, const LocalRun& words, bool has_own_fields) {
    auto document = connection.request("scene.get", proto::Json::object(), Patience::query);
    if (!document) return document.error();
    auto scene = proto::parse_scene(document->dump());
    if (!scene) return scene.error();
    if (words.writes_probes && words.probes.empty() && scene->probes.empty())
        return usage_error("the scene has no probes", "--probes",
                           R"(add one here: --probe 'gauge={"level": {"from": [0.1, 0], "to": [0.1, 0.5]}}')");
    if (!has_own_fields) return proto::Done{};
    return check_fields(words.formats(), scene->output.fields, PictureOptions{}.color_field);
}

// Errors that the server tells of a probe are told of the option that gave it.
proto::Status add_probes(Connection& connection, const std::vector<proto::ProbeDesc>& probes) {
    for (const proto::ProbeDesc& probe : probes) {
        auto added = call<proto::Applied>(connection, "probes.add", proto::ProbesAdd{probe}, Patience::while_alive);
        if (added) continue;
        proto::Error error = added.error();
        constexpr std::string_view kRoot = "params.probe";
        if (error.path.starts_with(kRoot)) error.path = "--probe " + probe.name + error.path.substr(kRoot.size());
        return error;
    }
    return proto::Done{};
}

proto::Result<Recorded> simulate(const LocalRun& words, const std::vector<Phase>& phases, const proto::Json& params,
                                 const std::optional<proto::FieldSet>& fields,
                                 const std::vector<proto::ProbeDesc>& probes) {
    auto server = PrivateServer::start(words.threads, scene_folder(words.scene));
    if (!server) return server.error();
    print_note("server " + (*server)->endpoint());
    auto connection = Connection::open((*server)->endpoint(), [&] { return (*server)->fate(); });
    if (!connection) return connection.error();
    auto loaded = load_scene(**connection, params);
    if (!loaded) return loaded.error();
    print_note(loaded_line(*loaded));
    if (auto checked = check_scene(**connection, words, !fields); !checked) return checked.error();
    if (auto added = add_probes(**connection, probes); !added) return added.error();

    const fs::path folder = words.out.empty() ? fs::path(loaded->scene) : fs::path(words.out);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return proto::Error{proto::ErrorCode::file_error, error.message(), folder.string(), ""};
    RecordOptions options;
    options.file = folder / (loaded->scene + ".mcap");
    options.overwrite = words.overwrite;
    if (words.fps) options.interval = 1.0 / *words.fps;
    options.fields = fields;
    auto recorder = Recorder::open(**connection, options);
    if (!recorder) return recorder.error();
    proto::Status outcome = run_phases(**connection, **recorder, phases, loaded->scene);
    outcome = end_recording(**recorder, outcome);
    return Recorded{options.file, (*recorder)->frames(), (*recorder)->gaps(), outcome};
}

// The files to look at; none where there is nothing to convert.
proto::Result<Conversion> convert_recorded(const LocalRun& words, const Recorded& recorded) {
    ConvertOptions options;
    options.recording = recorded.file;
    options.folder = recorded.file.parent_path();
    options.formats = words.formats();
    options.probes = words.wants_probes();
    if ((options.formats.empty() && !options.probes) || recorded.frames == 0 || is_interrupted()) return Conversion{};
    return convert(options);
}

proto::Status run(const Globals& globals, const LocalRun& words) {
    auto phases = make_phases(words);
    if (!phases) return phases.error();
    auto params = scene_load_params(words.scene, words.assignments);
    if (!params) return params.error();
    auto fields = chosen_fields(words);
    if (!fields) return fields.error();
    std::vector<proto::ProbeDesc> probes;
    for (const std::string& word : words.probes) {
        auto probe = parse_probe(word);
        if (!probe) return probe.error();
        probes.push_back(*std::move(probe));
    }
    auto recorded = simulate(words, *phases, *params, *fields, probes);
    if (!recorded) return recorded.error();

    auto conversion = convert_recorded(words, *recorded);
    if (globals.json) {
        proto::Json result{{"file", recorded->file.string()}, {"frames", recorded->frames}, {"gaps", recorded->gaps}};
        if (conversion && words.wants_probes()) result["probe_files"] = conversion->probe_files;
        print_json(result);
    } else {
        print_line(recording_summary(recorded->frames, recorded->gaps) + ", " + recorded->file.string());
    }
    if (!conversion) return recorded->outcome ? proto::Status(conversion.error()) : recorded->outcome;
    if (globals.json) return recorded->outcome;
    for (const std::string& line : conversion->summaries) print_line(line);
    for (const std::string& file : conversion->probe_files) print_line(file);
    return recorded->outcome;
}

}  // namespace

void add_local_run_command(CLI::App& app, CommandLine& line) {
    auto words = std::make_shared<LocalRun>();
    CLI::App* runner =
        add_command(app, line, "run", "simulate a scene here: private server, recording, files to look at",
                    [words](const Globals& globals) { return run(globals, *words); });
    runner->add_option("SCENE", words->scene, "a scene's name (headrace scenes) or a file.json")->required();
    CLI::Option* until = runner->add_option(
        "--until", words->until,
        "end: 2 (t = 2 s), +2 (2 s after the last --remove), step=400, a probe's value ('tip>0.3'), at-rest (default)");
    CLI::Option* steps =
        runner->add_option("--steps", words->steps, "end after so many steps")->check(positive())->excludes(until);
    runner->add_flag("--at-rest", words->at_rest, "end when the fluid is at rest")->excludes(until)->excludes(steps);
    runner
        ->add_option("--remove", words->removals,
                     "an object that leaves, NAME@at-rest or NAME@TIME; can be repeated, in order")
        ->allow_extra_args(false);
    runner->add_option("--set", words->assignments, "parameter of the model, name=value; can be repeated")
        ->allow_extra_args(false);
    runner->add_option("--out", words->out, "folder of the results; default: the scene's name");
    runner->add_option("--fps", words->fps, "frames per simulated second; default: the scene's")->check(positive());
    runner->add_option("--fields", words->field_words, "such as id,position,velocity; default: the scene's");
    runner
        ->add_option("--format", words->format_words,
                     "files to look at: vtp, csv, png; several with commas; \"\": none")
        ->capture_default_str();
    runner->add_flag("--probes", words->writes_probes, "write a CSV file with the samples of each probe of the scene");
    runner
        ->add_option("--probe", words->probes,
                     R"(a further probe, NAME=JSON, with its CSV file, such as 'tip={"front": {}}'; can be repeated)")
        ->allow_extra_args(false);
    runner->add_option("--threads", words->threads, "of the solver; default: as many as the machine has")
        ->check(positive());
    runner->add_flag("--overwrite", words->overwrite, "replace an earlier recording");
}

}  // namespace headrace::client
