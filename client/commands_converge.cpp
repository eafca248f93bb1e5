// converge: an error bar for each probe of a scene, from runs at three spacings and two sound speeds
#include <cmath>

#include "client/arguments.h"
#include "client/command.h"
#include "client/convergence_plan.h"
#include "client/convergence_report.h"
#include "client/jobs.h"
#include "client/probe_series.h"
#include "client/scene_request.h"
#include "client/spawn.h"
#include "client/text.h"
#include "client/writers/file_output.h"

namespace headrace::client {

namespace {

struct ConvergeWords {
    std::string scene, until, csv, of{"curve"};
    std::vector<std::string> assignments, probes;
    std::optional<double> spacing;  // [m] of the coarsest run
    double ratio{1.4142135623730951};
    double sound_speed_factor{2.0};
    int threads{0};
};

// What stays the same in all runs.
struct Task {
    Connection& connection;
    double until{};  // [s]
};

// "0.14 s", "12:03"
std::string wall_text(double seconds) {
    return seconds < 10 ? number(std::round(seconds * 100) / 100) + " s" : duration_text(seconds);
}

struct Simulated {
    StudyRun run;
    std::optional<SoundSpeed> sound;  // as the model tells it for this run
};

proto::Result<Simulated> load(const Task& task, const proto::SceneDesc& scene) {
    auto loaded = load_scene(task.connection, proto::to_json(proto::SceneLoad{scene, {}}));
    if (!loaded) return loaded.error();
    auto parameters = call<proto::ParamsGetReply>(task.connection, "params.get", proto::ParamsGet{});
    if (!parameters) return parameters.error();
    auto sound = find_sound_speed(parameters->parameters);
    if (!sound) return sound.error();
    Simulated simulated;
    simulated.run.spacing = scene.spacing;
    simulated.run.particles = loaded->particles;
    simulated.sound = *sound;
    if (*sound) simulated.run.sound_speed = (*sound)->value;
    return simulated;
}

// From the start to the end time; then takes in what the probes have measured.
proto::Status run_loaded(const Task& task, const proto::SceneDesc& scene, const std::string& label, StudyRun& run) {
    proto::RunUntil until;
    until.time = task.until;
    auto job = start_run(task.connection, until);
    if (job) job = JobWatch(task.connection, *job, until, label).wait();
    if (!job) return job.error();
    if (auto verdict = job_verdict(task.connection, *job); !verdict) return verdict;
    run.steps = job->steps;
    run.wall_s = job->wall_s;
    for (const proto::ProbeDesc& probe : scene.probes) {
        auto series = fetch_series(task.connection, probe.name);
        if (!series) return series.error();
        if (series->dropped > 0)
            print_note(label + ": " + plural(series->dropped, "older sample") + " of " + probe.name +
                       " no longer held by the server; the time they cover is not compared");
        run.probes.push_back(*std::move(series));
    }
    return proto::Done{};
}

proto::Result<Simulated> simulate(const Task& task, const proto::SceneDesc& scene, int number_of_run,
                                  const std::string& what) {
    const std::string label = "run " + std::to_string(number_of_run) + " of 4, " + what;
    const auto in_this_run = [&](proto::Error error) {
        error.message = label + ": " + error.message;
        return error;
    };
    auto simulated = load(task, scene);
    if (!simulated) return in_this_run(simulated.error());
    StudyRun& run = simulated->run;
    if (auto ran = run_loaded(task, scene, label, run); !ran) return in_this_run(ran.error());
    print_note(label + ": " + plural(run.particles, "particle") + ", " + plural(run.steps, "step") + ", " +
               wall_text(run.wall_s));
    return simulated;
}

std::string spacing_label(double spacing) {
    return "spacing " + number(spacing) + " m";
}

// Wall time grows with the particles and, as sound limits the steps, with 1/spacing.
void predict(const Study& study, const std::array<double, 3>& spacings, double factor) {
    const auto work = [&](Resolution which) {
        return std::pow(spacings[kCoarse] / spacings[which], study.dimensions + 1);
    };
    const double second_speed = study.runs[kCoarse].sound_speed ? factor : 0;
    print_note("the other runs will take about " +
               wall_text(study.runs[kCoarse].wall_s * (work(kMiddle) * (1 + second_speed) + work(kFine))));
}

// The runs at three spacings, all with the sound speed that the first one tells. Returns that of the middle one.
proto::Result<std::optional<SoundSpeed>> run_spacings(const Task& task, proto::SceneDesc scene,
                                                      const std::array<double, 3>& spacings, double factor,
                                                      Study& study) {
    std::optional<SoundSpeed> sound;
    for (const Resolution which : {kCoarse, kMiddle, kFine}) {
        scene.spacing = spacings[which];
        auto simulated = simulate(task, scene, which + 1, spacing_label(scene.spacing));
        if (!simulated) return simulated.error();
        study.runs[which] = std::move(simulated->run);
        if (which == kMiddle) sound = simulated->sound;
        if (which != kCoarse) continue;
        if (simulated->sound && !simulated->sound->is_stiffness)
            for (const auto& [name, value] : sound_speed_parameters(*simulated->sound, 1.0))
                scene.parameters[name] = value;
        predict(study, spacings, factor);
    }
    return sound;
}

// The middle spacing once more with a higher sound speed.
proto::Status run_faster(const Task& task, proto::SceneDesc scene, const SoundSpeed& sound, double factor,
                         Study& study) {
    scene.spacing = study.runs[kMiddle].spacing;
    for (const auto& [name, value] : sound_speed_parameters(sound, factor)) scene.parameters[name] = value;
    auto simulated = simulate(task, scene, 4,
                              spacing_label(scene.spacing) + ", sound speed " + number(factor * sound.value) + " m/s");
    if (!simulated) return simulated.error();
    study.faster = std::move(simulated->run);
    return proto::Done{};
}

proto::Status report(const Globals& globals, const ConvergeWords& words, const Study& study) {
    const std::vector<StudyRow> rows = evaluate(study);
    if (globals.json)
        print_json(study_json(study, rows));
    else
        print_line(study_table(study, rows));
    if (words.csv.empty()) return proto::Done{};
    return write_file(words.csv, {as_bytes(study_csv(rows))});
}

proto::Result<proto::SceneDesc> scene_to_refine(const ConvergeWords& words) {
    auto scene = read_scene(words.scene, words.assignments);
    if (!scene) return scene.error();
    for (const std::string& word : words.probes)
        if (auto added = add_probe(*scene, word); !added) return added.error();
    if (auto checked = check_refinable(*scene); !checked) return checked.error();
    return scene;
}

proto::Status converge(const Globals& globals, const ConvergeWords& words) {
    const auto until = parse_seconds(words.until);
    if (!until || *until <= 0)
        return usage_error("\"" + words.until + "\" is no time", "--until", "seconds of simulated time, such as 2");
    auto scene = scene_to_refine(words);
    if (!scene) return scene.error();
    auto server = PrivateServer::start(words.threads);
    if (!server) return server.error();
    auto connection = Connection::open((*server)->endpoint(), [&] { return (*server)->fate(); });
    if (!connection) return connection.error();

    const Task task{**connection, *until};
    Study study{scene->name, scene->dimensions, *until, *find_measure(words.of)};
    const auto spacings = choose_spacings(*scene, words.spacing.value_or(scene->spacing), words.ratio);
    auto sound = run_spacings(task, *scene, spacings, words.sound_speed_factor, study);
    if (!sound) return sound.error();
    // Three spacings are worth their report even if the last run fails.
    proto::Status outcome = proto::Done{};
    if (*sound)
        outcome = run_faster(task, *scene, **sound, words.sound_speed_factor, study);
    else
        print_note("the model has no sound speed to vary");
    auto reported = report(globals, words, study);
    return outcome ? reported : outcome;
}

}  // namespace

void add_converge_command(CLI::App& app, CommandLine& line) {
    auto words = std::make_shared<ConvergeWords>();
    CLI::App* command =
        add_command(app, line, "converge",
                    "tell how large the error of each probe is: a scene at three spacings and two sound speeds",
                    [words](const Globals& globals) { return converge(globals, *words); });
    command->add_option("SCENE", words->scene, "a scene's name (headrace scenes) or a file.json")->required();
    command->add_option("--until", words->until, "end of each run, in seconds of simulated time")->required();
    command
        ->add_option("--probe", words->probes,
                     R"(measures this too, NAME=JSON: 'gauge={"level": {"from": [0.1, 0], "to": [0.1, 0.5]}}'; )"
                     "can be repeated")
        ->allow_extra_args(false);
    command
        ->add_option("--of", words->of,
                     "what is compared: the whole curve over time (its rms), or its last, mean, min, max, rms")
        ->check(CLI::IsMember({"curve", "last", "mean", "min", "max", "rms"}))
        ->capture_default_str();
    command->add_option("--spacing", words->spacing, "of the coarsest run [m]; default: the scene's")
        ->check(positive());
    command
        ->add_option("--ratio", words->ratio,
                     "of one spacing to the next finer; fitted so that the fluid is filled evenly")
        ->check(CLI::Range(1.1, 4.0))
        ->default_str("1.414");
    command->add_option("--sound-speed-factor", words->sound_speed_factor, "of the second sound speed to the first")
        ->check(CLI::Range(1.2, 10.0))
        ->capture_default_str();
    command->add_option("--set", words->assignments, "parameter of the model in all runs, name=value; can be repeated")
        ->allow_extra_args(false);
    command->add_option("--csv", words->csv, "write the results to this file too, profiles with each of their points");
    command->add_option("--threads", words->threads, "of the solver; default: as many as the machine has")
        ->check(positive());
}

}  // namespace headrace::client
