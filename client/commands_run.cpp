// step, resume, pause, cancel
#include "client/arguments.h"
#include "client/command.h"
#include "client/interrupt.h"
#include "client/jobs.h"
#include "client/text.h"

namespace headrace::client {

namespace {

struct ResumeOptions {
    std::string until;
    std::optional<double> pace;
    std::optional<double> timeout;
    bool no_wait{false};
};

void print_job(const proto::JobReply& job) {
    print_line("job " + std::to_string(job.job) + " " + job_state_text(job.state) + ": " +
               at_moment(job.step, job.time));
}

// Starts a run and, unless told otherwise, waits for its end.
proto::Status run_until(const Globals& globals, Connection& connection, const proto::RunUntil& until,
                        const ResumeOptions& options) {
    auto job = start_run(connection, until, options.pace);
    if (!job) return job.error();
    if (!options.no_wait) {
        job = JobWatch(connection, *job, until, "running").wait();
        if (!job) {
            if (is_interrupted()) print_note("interrupted; the run goes on (headrace status, headrace pause)");
            return job.error();
        }
    }
    if (globals.json)
        print_json(proto::to_json(*job));
    else if (options.no_wait)
        print_job(*job);
    else if (job->state == proto::JobState::finished || job->state == proto::JobState::paused)
        print_line(job_line(*job, until));
    return job_verdict(connection, *job,
                       until.at_rest.value_or(false) ? "go on with: headrace resume --until at-rest" : "");
}

proto::Status resume(const Globals& globals, const ResumeOptions& options) {
    auto connection = connect(globals);
    if (!connection) return connection.error();
    const bool is_new_run = !options.until.empty() || options.pace || options.timeout;
    if (!is_new_run)
        return request_and_print<proto::JobReply>(globals, **connection, "sim.resume", proto::Json::object(),
                                                  Patience::while_alive, print_job);
    proto::RunUntil until;
    if (!options.until.empty()) {
        auto parsed = parse_until(options.until);
        if (!parsed) return parsed.error();
        until = *parsed;
    }
    until.timeout = options.timeout;
    return run_until(globals, **connection, until, options);
}

proto::Status step(const Globals& globals, std::int64_t steps) {
    return command<proto::JobReply>(globals, "sim.step", proto::SimStep{steps}, Patience::while_alive,
                                    [](const proto::JobReply& job) { print_line(at_moment(job.step, job.time)); });
}

void add_plain(CLI::App& app, CommandLine& line, const std::string& name, const std::string& description,
               const std::string& method, const std::string& done) {
    add_command(app, line, name, description, [method, done](const Globals& globals) -> proto::Status {
        auto connection = connect(globals);
        if (!connection) return connection.error();
        return request_and_print<proto::Applied>(
            globals, **connection, method, proto::Json::object(), Patience::while_alive,
            [&](const proto::Applied& applied) { print_line(done + " at " + at_moment(applied.step, applied.time)); });
    });
}

}  // namespace

void add_run_commands(CLI::App& app, CommandLine& line) {
    auto steps = std::make_shared<std::int64_t>(1);
    add_command(app, line, "step", "compute some steps and wait for them",
                [steps](const Globals& globals) { return step(globals, *steps); })
        ->add_option("N", *steps, "how many")
        ->check(positive())
        ->capture_default_str();

    auto options = std::make_shared<ResumeOptions>();
    CLI::App* subcommand = add_command(app, line, "resume", "go on with the paused run, or start one",
                                       [options](const Globals& globals) { return resume(globals, *options); });
    subcommand->add_option("--until", options->until,
                           "end of the run, which is waited for: at-rest, 2 (t = 2 s), +2 (2 s from now), step=400, "
                           "steps=400, or a probe's value, 'gauge>0.3'");
    subcommand->add_option("--pace", options->pace, "simulated seconds per wall second at most; 1 is real time")
        ->check(positive());
    subcommand->add_option("--timeout", options->timeout, "simulated seconds after which the run has timed out")
        ->check(positive());
    subcommand->add_flag("--no-wait", options->no_wait, "do not wait for the end of the run");

    add_plain(app, line, "pause", "pause the run; headrace resume goes on", "sim.pause", "paused");
    add_plain(app, line, "cancel", "end the run, or the load under way", "sim.cancel", "cancelled");
}

}  // namespace headrace::client
