#include "tests/bench/count_steps.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "proto/messages_json.h"
#include "server/probe_watch.h"
#include "server/publish/encode.h"
#include "server/publish/frame_builder.h"
#include "server/scene/run.h"

namespace headrace::bench {

namespace {

struct Options {
    std::string scene;
    int warmup{3};
    int steps{3};
    bool has_reader{false};
};

// A run with all that the simulation and the publisher do around its steps, in one thread and without sockets.
struct Service {
    explicit Service(scene::Run& of) : run(of), probes(board) {}

    // Somebody wants each step's frame.
    void add_reader() {
        publish::Demand demand;
        demand.fields = proto::FieldSet{proto::Field::position, proto::Field::velocity, proto::Field::pressure};
        demand.trigger = publish::Trigger::every_steps;
        fields = demand.fields;
        reader = hub.add(demand);
    }

    // Did they go well?
    bool make_steps(int count) {
        for (int k = 0; k < count; ++k)
            if (!step()) return false;
        return true;
    }

    bool step() {
        if (run.step().fault) return false;
        probes.sample(run);
        const publish::Moment now{run.step_number(), run.time(), std::chrono::steady_clock::now()};
        hub.capture_due(now, [&](proto::FieldSet wanted, proto::Precision precision) {
            return publish::copy_fields(run.particles(), wanted, precision, now, hub.generation());
        });
        for (const publish::CaptureFor& capture : hub.take()) {
            bytes += publish::encode_capture(*capture.capture, fields, "frame/1", 1, ++frames).size();
            hub.release(reader);
        }
        return true;
    }

    scene::Run& run;
    server::ProbeBoard board;
    server::ProbeWatch probes;
    publish::FrameHub hub;
    publish::DemandId reader{};
    proto::FieldSet fields;
    std::uint64_t frames{}, bytes{};
};

}  // namespace

// What is counted. A name of its own, not to be inlined: `valgrind --toggle-collect` finds it.
[[gnu::noinline]] bool make_counted_steps(Service& service, int steps) {
    return service.make_steps(steps);
}

int run_count_steps(int argc, char** argv) {
    CLI::App app{
        "Loads a scene document and steps it, with its probes and, if asked, a reader of every frame. The function\n"
        "make_counted_steps makes the counted ones. Prints how many particles and counted steps there were and the\n"
        "plan of the last one, as JSON."};
    Options options;
    app.add_option("scene", options.scene, "Scene document")->required()->check(CLI::ExistingFile);
    app.add_option("--warmup", options.warmup, "Steps before the counted ones")->capture_default_str();
    app.add_option("--steps", options.steps, "Counted steps")->capture_default_str();
    app.add_flag("--reader", options.has_reader, "Copy and encode a frame of x, v and p after each step");
    CLI11_PARSE(app, argc, argv);

    std::ifstream file(options.scene);
    auto scene = proto::parse_scene(std::string(std::istreambuf_iterator<char>(file), {}));
    auto run = scene ? scene::Run::build(*scene) : scene.error();
    auto measured = run ? server::ProbeWatch::make(**run) : run.error();
    if (!measured) {
        std::cerr << "headrace_bench: " << measured.error().path << ": " << measured.error().message << '\n';
        return 1;
    }
    Service service(**run);
    service.probes.restart(*std::move(measured), 0);
    if (options.has_reader) service.add_reader();
    if (!service.make_steps(options.warmup) || !make_counted_steps(service, options.steps)) {
        std::cerr << "headrace_bench: the scene faulted\n";
        return 1;
    }
    proto::Json told{{"particles", (*run)->particles().size()}, {"steps", options.steps}};
    for (const solver::Stage& stage : (*run)->plan())
        told["plan"].push_back({{"stage", stage.name}, {"active", stage.active}, {"reason", stage.reason}});
    std::cout << told << '\n';
    return 0;
}

}  // namespace headrace::bench
