// record
#include "client/arguments.h"
#include "client/command.h"
#include "client/jobs.h"
#include "client/record.h"
#include "client/record_run.h"
#include "client/text.h"

namespace headrace::client {

namespace {

struct RecordCommand {
    std::string file, fields, precision{"f4"};
    std::optional<double> for_seconds, fps;
    std::optional<std::int64_t> every;
    bool at_server{false}, overwrite{false};
};

proto::Result<RecordOptions> record_options(const RecordCommand& words) {
    RecordOptions options;
    options.file = words.file;
    options.overwrite = words.overwrite;
    if (!words.fields.empty()) {
        auto fields = parse_fields(words.fields);
        if (!fields) return fields.error();
        options.fields = *fields;
    }
    auto precision = parse_precision(words.precision);
    if (!precision) return precision.error();
    options.precision = *precision;
    if (words.fps) options.interval = 1.0 / *words.fps;
    options.every_steps = words.every;
    return options;
}

void print_recording(const Globals& globals, const std::string& file, std::uint64_t frames, std::uint64_t gaps,
                     const std::string& summary) {
    if (globals.json)
        print_json({{"file", file}, {"frames", frames}, {"gaps", gaps}});
    else
        print_line(summary);
}

// The simulation as recording finds it. Error: it has faulted, so that no run can come.
proto::Result<proto::SimStatusReply> status_to_record(Connection& connection) {
    auto status = call<proto::SimStatusReply>(connection, "sim.status", proto::SimStatus{});
    if (status && status->fault) return fault_error(*status->fault);
    return status;
}

constexpr const char* kNothingRuns =
    "nothing runs yet: recording begins with the next run (headrace resume); Ctrl-C ends it";

// Runs an idle simulation for the time asked for, else follows what runs.
proto::Result<proto::JobReply> run_or_follow(Connection& connection, Recorder* recorder,
                                             const proto::SimStatusReply& before, const RecordCommand& words) {
    const bool is_idle = before.state == proto::SimState::idle;
    if (!is_idle || !words.for_seconds) {
        if (is_idle) print_note(kNothingRuns);
        return follow_others(connection, recorder, before, words.for_seconds, words.file);
    }
    proto::RunUntil until;
    until.duration = *words.for_seconds;
    auto started = start_run(connection, until);
    if (!started) return started;
    auto job = follow_job(connection, recorder, *started, until, words.file);
    // A run that this command has started ends with it.
    const bool is_lost = !job && job.error().code == proto::ErrorCode::connection_failed;
    if (!is_lost && (!job || !has_ended(job->state)))
        (void)connection.request("sim.cancel", proto::Json::object(), Patience::query);
    return job;
}

// A recording of ours.
proto::Status record_here(const Globals& globals, Connection& connection, const RecordCommand& words,
                          const RecordOptions& options) {
    auto before = status_to_record(connection);
    if (!before) return before.error();
    auto opened = Recorder::open(connection, options);
    if (!opened) return opened.error();
    Recorder& recorder = **opened;
    auto job = run_or_follow(connection, &recorder, *before, words);
    const proto::Status outcome = job ? proto::Status(proto::Done{}) : proto::Status(job.error());
    const proto::Status ended = end_recording(recorder, outcome);
    print_recording(globals, words.file, recorder.frames(), recorder.gaps(), recorder.summary());
    if (!ended) return ended;
    return job_verdict(connection, *job);
}

// The server writes; nothing but commands travels.
proto::Status record_there(const Globals& globals, Connection& connection, const RecordCommand& words,
                           const RecordOptions& options) {
    auto before = status_to_record(connection);
    if (!before) return before.error();
    proto::RecordStart start;
    start.file = words.file;
    if (options.fields) start.fields = *options.fields;
    start.precision = options.precision;
    start.interval = options.interval;
    start.every_steps = options.every_steps;
    start.overwrite = options.overwrite;
    auto started = call<proto::RecordStartReply>(connection, "record.start", start, Patience::while_alive);
    if (!started) return started.error();
    auto job = run_or_follow(connection, nullptr, *before, words);
    auto stopped = call<proto::RecordStopReply>(connection, "record.stop", proto::RecordStop{started->recording},
                                                Patience::while_alive);
    if (!job) return job.error();
    if (!stopped) return stopped.error();
    print_recording(globals, stopped->file, stopped->frames, stopped->gaps,
                    recording_summary(stopped->frames, stopped->gaps) + ", " + stopped->file + " at the server");
    return job_verdict(connection, *job);
}

proto::Status record(const Globals& globals, const RecordCommand& words) {
    auto options = record_options(words);
    if (!options) return options.error();
    auto connection = connect(globals);
    if (!connection) return connection.error();
    return words.at_server ? record_there(globals, **connection, words, *options)
                           : record_here(globals, **connection, words, *options);
}

}  // namespace

void add_record_command(CLI::App& app, CommandLine& line) {
    auto words = std::make_shared<RecordCommand>();
    CLI::App* recorder = add_command(app, line, "record", "record every frame of a run, without loss",
                                     [words](const Globals& globals) { return record(globals, *words); });
    recorder->add_option("FILE", words->file, "the recording, .mcap")->required();
    recorder
        ->add_option("--for", words->for_seconds,
                     "simulated seconds; an idle simulation runs for so long. Without it: until the run ends or Ctrl-C")
        ->check(positive());
    CLI::Option* fps = recorder->add_option("--fps", words->fps, "frames per simulated second")->check(positive());
    recorder->add_option("--every", words->every, "a frame every so many steps")->check(positive())->excludes(fps);
    recorder->add_option("--fields", words->fields, "such as id,position,velocity; default: the scene's");
    recorder->add_option("--precision", words->precision, "f4 or f8")->capture_default_str();
    recorder->add_flag("--at-server", words->at_server, "the server writes FILE below its data folder");
    recorder->add_flag("--overwrite", words->overwrite, "replace FILE");
}

}  // namespace headrace::client
