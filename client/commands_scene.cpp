// load, scenes, plan, reset, status, shutdown
#include "client/command.h"
#include "client/endpoints.h"
#include "client/jobs.h"
#include "client/plan_text.h"
#include "client/scene_request.h"
#include "client/spawn.h"
#include "client/text.h"

namespace headrace::client {

namespace {

struct SceneChoice {
    std::string scene;
    std::vector<std::string> assignments;
};

proto::Status load(const Globals& globals, const SceneChoice& choice) {
    auto params = scene_load_params(choice.scene, choice.assignments);
    if (!params) return params.error();
    auto connection = connect(globals);
    if (!connection) return connection.error();
    return request_and_print<proto::SceneLoadReply>(
        globals, **connection, "scene.load", *params, Patience::while_alive,
        [](const proto::SceneLoadReply& reply) { print_line(loaded_line(reply)); });
}

void print_scenes(const proto::SceneListReply& reply) {
    for (const proto::SceneSummary& scene : reply.scenes)
        print_line(scene.name + "  (" + std::to_string(scene.dimensions) + "D, " + plural(scene.particles, "particle") +
                   ")\n    " + scene.description);
}

// A server for a question that needs no run of its own: the chosen one, else a private one.
proto::Status with_any_server(const Globals& globals, bool always_private,
                              const std::function<proto::Status(Connection&)>& ask) {
    if (!always_private && is_server_chosen(globals.server)) {
        auto connection = connect(globals);
        return connection ? ask(**connection) : connection.error();
    }
    auto server = PrivateServer::start(1);
    if (!server) return server.error();
    auto connection = Connection::open((*server)->endpoint(), [&] { return (*server)->fate(); });
    return connection ? ask(**connection) : connection.error();
}

proto::Status scenes(const Globals& globals) {
    return with_any_server(globals, false, [&](Connection& connection) {
        return request_and_print<proto::SceneListReply>(globals, connection, "scene.list", proto::Json::object(),
                                                        Patience::query, print_scenes);
    });
}

struct PlanChoice {
    SceneChoice scene;  // none: that of the chosen server
    std::int64_t steps{0};
};

proto::Status print_plan(const Globals& globals, Connection& connection, const std::string& headline) {
    auto status = call<proto::SimStatusReply>(connection, "sim.status", proto::SimStatus{});
    if (!status) return status.error();
    if (globals.json) {
        print_json(proto::to_json(*status)["plan"]);
        return proto::Done{};
    }
    if (!status->scene) {
        print_line("no scene is loaded");
        return proto::Done{};
    }
    print_line(headline.empty()
                   ? *status->scene + " (" + status->model.value_or("?") + "): " + at_moment(status->step, status->time)
                   : headline);
    for (const std::string& line : plan_lines(status->plan)) print_line(line);
    return proto::Done{};
}

proto::Status plan(const Globals& globals, const PlanChoice& choice) {
    if (choice.scene.scene.empty()) {
        auto connection = connect(globals);
        return connection ? print_plan(globals, **connection, "") : connection.error();
    }
    auto params = scene_load_params(choice.scene.scene, choice.scene.assignments);
    if (!params) return params.error();
    return with_any_server(globals, true, [&](Connection& connection) -> proto::Status {
        auto loaded = load_scene(connection, *params);
        if (!loaded) return loaded.error();
        std::string headline = loaded_line(*loaded);
        if (choice.steps > 0) {
            auto job =
                call<proto::JobReply>(connection, "sim.step", proto::SimStep{choice.steps}, Patience::while_alive);
            if (!job) return job.error();
            if (auto verdict = job_verdict(connection, *job); !verdict) return verdict;
            headline += "; after " + at_moment(job->step, job->time);
        }
        return print_plan(globals, connection, headline);
    });
}

void print_status(const proto::SimStatusReply& status) {
    if (!status.scene) {
        std::string line = state_text(status.state);
        if (status.state == proto::SimState::loading)
            line += " (" + std::to_string(static_cast<int>(status.load_progress * 100)) + " %)";
        return print_line(status.state == proto::SimState::empty ? line + ": no scene is loaded" : line);
    }
    print_line(*status.scene + " (" + status.model.value_or("?") + "): " + state_text(status.state) + ", " +
               at_moment(status.step, status.time) + (status.stalled ? ", held up by a lossless reader" : ""));
    std::string line = plural(status.particles, "particle") + ", dt " + number(status.time_step) + " s";
    if (!status.time_step_limit.empty()) line += " (" + status.time_step_limit + ")";
    if (status.steps_per_second > 0)
        line +=
            ", " + number(status.steps_per_second) + " steps/s, " + number(status.real_time_factor) + " x real time";
    print_line(line);
    if (status.strategy) {
        const std::string busiest = busiest_stages(status.plan);
        const std::string threads = status.threads ? ", " + plural(*status.threads, "thread") : "";
        print_line("pairs: " + *status.strategy + threads + (busiest.empty() ? "" : "; time in " + busiest));
    }
    if (status.diagnostics)
        print_line("max speed " + number(status.diagnostics->max_speed) + " m/s, kinetic energy " +
                   energy_text(status.diagnostics->kinetic_energy, status.dimensions) + ", density mean " +
                   number(status.diagnostics->mean_density) + ", max " + number(status.diagnostics->max_density) +
                   " kg/m^3");
    if (status.job)
        print_line("job " + std::to_string(status.job->job) + ": " + job_state_text(status.job->state) +
                   (status.job->reason.empty() ? "" : ", " + status.job->reason));
    if (status.fault) print_line("fault: " + error_line(fault_error(*status.fault)));
    if (status.streams > 0 || status.recordings > 0)
        print_line(plural(status.streams, "open stream") + ", " + plural(status.recordings, "recording"));
    if (status.state_hash)
        print_line("state hash " + status.state_hash->value + " at step " +
                   with_thousands(static_cast<std::int64_t>(status.state_hash->step)));
}

void add_scene_options(CLI::App& subcommand, SceneChoice& choice) {
    subcommand.add_option("SCENE", choice.scene, "a scene's name (headrace scenes) or a file.json");
    subcommand.add_option("--set", choice.assignments, "parameter of the model, name=value; can be repeated")
        ->allow_extra_args(false);
}

}  // namespace

void add_scene_commands(CLI::App& app, CommandLine& line) {
    auto to_load = std::make_shared<SceneChoice>();
    CLI::App& loader = *add_command(app, line, "load", "load a scene",
                                    [to_load](const Globals& globals) { return load(globals, *to_load); });
    add_scene_options(loader, *to_load);
    loader.get_option("SCENE")->required();
    auto to_plan = std::make_shared<PlanChoice>();
    CLI::App& planner =
        *add_command(app, line, "plan", "tell which stages a step has, which are skipped and why, and what they take",
                     [to_plan](const Globals& globals) { return plan(globals, *to_plan); });
    planner.footer("With a SCENE a private server plans it. Without one: the plan of the server's scene, as it runs.");
    add_scene_options(planner, to_plan->scene);
    planner.add_option("--steps", to_plan->steps, "run so many steps of SCENE first, to time the stages")
        ->check(non_negative())
        ->needs("SCENE");
    planner.get_option("--set")->needs("SCENE");
    add_command(app, line, "scenes", "list the scenes that need no file", scenes);
    add_command(app, line, "reset", "load the scene anew: step 0, its own objects and parameters",
                [](const Globals& globals) {
                    return command<proto::SceneLoadReply>(
                        globals, "sim.reset", proto::SimReset{}, Patience::while_alive,
                        [](const proto::SceneLoadReply& reply) { print_line(loaded_line(reply)); });
                });
    auto with_hash = std::make_shared<bool>(false);
    add_command(app, line, "status", "how the simulation is", [with_hash](const Globals& globals) {
        return command<proto::SimStatusReply>(globals, "sim.status", proto::SimStatus{*with_hash},
                                              *with_hash ? Patience::while_alive : Patience::query, print_status);
    })->add_flag("--hash", *with_hash, "with a fresh hash of the particles' state");
    add_command(app, line, "shutdown", "end the server; recordings are closed", [](const Globals& globals) {
        return command<proto::Applied>(globals, "server.shutdown", proto::ServerShutdown{}, Patience::query,
                                       [](const proto::Applied&) { print_line("the server ends"); });
    });
}

}  // namespace headrace::client
