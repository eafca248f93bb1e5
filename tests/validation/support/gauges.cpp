#include "tests/validation/support/gauges.h"

#include <algorithm>
#include <array>

namespace headrace::validation {

Gauge::Gauge(const scene::Run& run, const std::string& name) {
    const auto& all = run.scene().probes;
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& probe) { return probe.name == name; });
    probe_ = probes::make_probe(*found, run.scene().dimensions);
}

double Gauge::read(const scene::Run& run) const {
    const proto::SceneDesc& scene = run.scene();
    const probes::RunView view{run.particles(), run.model(),       run.surroundings(),
                               scene.spacing,   run.step_number(), run.time()};
    std::vector<probes::NearParticle> near;
    if (const auto region = probe_->region(run.model().support_radius()))
        near = probes::find_nearby(run.particles(), view.surroundings.domain, std::array{*region}).front();
    proto::ProbeRow values(probe_->columns().size());
    if (probe_->sample(view, near, values)) return 0.0;
    return values.front().value_or(0.0);
}

}  // namespace headrace::validation
