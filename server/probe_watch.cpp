#include "server/probe_watch.h"

#include <chrono>
#include <map>

namespace headrace::server {

using proto::Error;
using proto::ErrorCode;

namespace {

probes::RunView view_of(const scene::Run& run) {
    return {run.particles(), run.model(), run.surroundings(), run.scene().spacing, run.step_number(), run.time()};
}

proto::Status add_to(probes::ProbeSet& probes, scene::Run& run, const proto::ProbeDesc& probe,
                     const std::string& path) {
    // The model is asked whether it can, and can only when it follows them.
    const bool is_first = std::holds_alternative<proto::EnergyProbe>(probe.kind) && !probes.wants_energies();
    if (is_first) run.follow_energies(true);
    proto::Status added = probes.add(probe, view_of(run), path);
    if (!added && is_first) run.follow_energies(false);
    return added;
}

Error of_scene(Error error) {
    if (error.code != ErrorCode::limit_exceeded) error.code = ErrorCode::scene_invalid;
    return error;
}

std::string indexed(const char* list, std::size_t index) {
    return std::string("scene.") + list + "[" + std::to_string(index) + "]";
}

}  // namespace

proto::Result<probes::ProbeSet> ProbeWatch::make(scene::Run& run) {
    const proto::SceneDesc& scene = run.scene();
    probes::ProbeSet probes(scene.output.interval);
    for (std::size_t k = 0; k < scene.probes.size(); ++k)
        if (const proto::Status added = add_to(probes, run, scene.probes[k], indexed("probes", k)); !added)
            return of_scene(added.error());
    for (std::size_t k = 0; k < scene.events.size(); ++k) {
        if (!scene.events[k].probe) continue;
        const proto::Status known = probes.check(*scene.events[k].probe, indexed("events", k) + ".probe");
        if (!known) return of_scene(known.error());
    }
    return probes;
}

void ProbeWatch::restart(probes::ProbeSet probes, std::uint64_t generation) {
    probes_ = std::move(probes);
    seconds_ = 0.0;
    board_.restart(generation);
    for (const std::string& name : probes_.names()) board_.add(*probes_.find(name), probes_.columns(name));
}

proto::Status ProbeWatch::add(scene::Run& run, const proto::ProbeDesc& probe) {
    proto::Status added = add_to(probes_, run, probe, "params.probe");
    if (added) board_.add(probe, probes_.columns(probe.name));
    return added;
}

proto::Status ProbeWatch::remove(scene::Run& run, const std::string& name) {
    proto::Status removed = probes_.remove(name, "params.name");
    if (!removed) return removed;
    board_.remove(name);
    if (!probes_.wants_energies()) run.follow_energies(false);
    return removed;
}

std::vector<std::pair<std::string, std::string>> ProbeWatch::sample(const scene::Run& run) {
    std::vector<std::pair<std::string, std::string>> failed;
    if (probes_.is_empty()) return failed;
    const auto start = std::chrono::steady_clock::now();
    const std::vector<probes::Sample> samples = probes_.sample_due(view_of(run));
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (samples.empty()) return failed;
    proto::ProbeSamples shown{run.time(), {}};
    std::map<std::string, std::string> failures;
    for (const probes::Sample& sample : samples) {
        shown.samples.push_back({sample.probe, {}, sample.values});
        if (!sample.failure) continue;
        failures[sample.probe] = *sample.failure;
        if (sample.has_just_failed) failed.emplace_back(sample.probe, *sample.failure);
    }
    board_.append(shown, failures);
    return failed;
}

}  // namespace headrace::server
