#include "server/scene_events.h"

namespace headrace::server {

namespace {

bool is_due(const proto::SceneEventDesc& event, const scene::Run& run, const probes::ProbeSet& probes,
            bool is_at_rest) {
    constexpr double kSlack = 1e-12;  // [1] times are sums of rounded time steps
    return (event.at_rest && is_at_rest) || (event.time && run.time() >= *event.time * (1 - kSlack)) ||
           (event.step && run.step_number() >= static_cast<std::uint64_t>(*event.step)) ||
           (event.probe && probes.holds(*event.probe));
}

}  // namespace

std::vector<std::size_t> SceneEvents::take_due(const scene::Run& run, const probes::ProbeSet& probes, bool is_at_rest) {
    std::vector<std::size_t> due;
    const auto& events = run.scene().events;
    for (std::size_t k = 0; k < events.size(); ++k) {
        if (fired_.contains(k) || !is_due(events[k], run, probes, is_at_rest)) continue;
        fired_.insert(k);
        due.push_back(k);
    }
    return due;
}

bool SceneEvents::wait_for_rest(const scene::Run& run) const {
    const auto& events = run.scene().events;
    for (std::size_t k = 0; k < events.size(); ++k)
        if (events[k].at_rest && !fired_.contains(k)) return true;
    return false;
}

}  // namespace headrace::server
