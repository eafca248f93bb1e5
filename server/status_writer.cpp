#include "server/status_writer.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace headrace::server {

namespace {

// Diagnostics cost a pass over the particles: ten a second are enough for a reader.
constexpr auto kDetailsInterval = std::chrono::milliseconds(100);
constexpr auto kRateWindow = std::chrono::milliseconds(1'000);

proto::Diagnostics to_proto(const solver::Diagnostics& from) {
    return {from.max_speed, from.kinetic_energy, from.potential_energy, from.mean_density, from.max_density};
}

std::string list_of(const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 5;
    std::string text;
    for (std::size_t k = 0; k < std::min(names.size(), kMost); ++k) text += (k == 0 ? "" : ", ") + names[k];
    return names.size() > kMost ? text + ", ..." : text;
}

proto::PlanStage probes_stage(const ProbeWatch& watch) {
    if (watch.probes().is_empty()) return {"probes", false, "there are none", 0.0};
    return {"probes", true, "sampled when due: " + list_of(watch.probes().names()), watch.seconds()};
}

proto::PlanStage frames_stage(const SimulationView& view) {
    const bool is_wanted = view.frame_demands > 0;
    return {"frames", is_wanted,
            is_wanted ? "copied when due; consumers: " + std::to_string(view.frame_demands)
                      : "no stream with a subscriber, no recording, no request",
            view.frame_seconds};
}

}  // namespace

void StatusWriter::refresh_lists(const scene::Run& run) {
    if (!scene_) scene_ = std::make_shared<proto::SceneDesc>(run.scene());
    objects_ = std::make_shared<std::vector<proto::ObjectDesc>>(run.objects());
    auto entries = std::make_shared<std::vector<proto::ParameterEntry>>();
    const solver::ParameterMap values = run.model().parameters();
    for (const solver::ParameterInfo& info : run.model().parameter_table())
        entries->push_back({info.name, values.at(info.name), info.default_value, info.unit, info.meaning});
    parameters_ = std::move(entries);
    details_step_.reset();  // the plan depends on both
}

proto::StateHash StatusWriter::set_hash(std::uint64_t hash, std::uint64_t step) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    hash_ = proto::StateHash{text, step};
    return *hash_;
}

void StatusWriter::forget_run() {
    scene_.reset();
    hash_.reset();
    fault_.reset();
    diagnostics_.reset();
    details_step_.reset();
    steps_per_second_ = real_time_factor_ = 0.0;
    was_running_ = false;
}

void StatusWriter::update_rates(const SimulationView& view, Clock::time_point now) {
    const bool is_running = view.state == proto::SimState::running;
    if (is_running && !was_running_) {
        window_start_ = now;
        window_step_ = view.run->step_number();
        window_time_ = view.run->time();
    }
    const bool has_ended = was_running_ && !is_running;
    if ((is_running && now - window_start_ >= kRateWindow) || (has_ended && steps_per_second_ == 0.0)) {
        const double wall = std::chrono::duration<double>(now - window_start_).count();
        steps_per_second_ = static_cast<double>(view.run->step_number() - window_step_) / wall;
        real_time_factor_ = (view.run->time() - window_time_) / wall;
        window_start_ = now;
        window_step_ = view.run->step_number();
        window_time_ = view.run->time();
    }
    was_running_ = is_running;
}

void StatusWriter::update_details(const SimulationView& view, Clock::time_point now) {
    if (details_step_ == view.run->step_number()) return;
    if (details_step_ && view.state == proto::SimState::running && now - details_at_ < kDetailsInterval) return;
    details_at_ = now;
    details_step_ = view.run->step_number();
    diagnostics_ = to_proto(view.run->diagnostics());
    plan_.clear();
    for (const solver::Stage& stage : view.run->plan())
        plan_.push_back({stage.name, stage.active, stage.reason, stage.seconds});
}

void StatusWriter::write(const SimulationView& view) {
    auto snapshot = std::make_shared<StatusSnapshot>();
    proto::SimStatusReply& status = snapshot->status;
    status.state = view.state;
    status.job = view.job;
    status.stalled = view.stalled;
    status.load_progress = view.load_progress;
    if (view.run != nullptr) {
        const auto now = Clock::now();
        update_rates(view, now);
        update_details(view, now);
        status.scene = scene_->name;
        status.model = view.run->model().name();
        status.dimensions = scene_->dimensions;
        status.strategy = view.run->model().strategy();
        status.threads = view.threads;
        status.step = view.run->step_number();
        status.time = view.run->time();
        status.time_step = view.run->model().time_step();
        status.time_step_limit = view.run->model().time_step_limit();
        status.particles = static_cast<std::int64_t>(view.run->particles().size());
        status.steps_per_second = steps_per_second_;
        status.real_time_factor = real_time_factor_;
        status.diagnostics = diagnostics_;
        status.plan = plan_;
        status.plan.push_back(probes_stage(*view.probes));
        status.plan.push_back(frames_stage(view));
        status.state_hash = hash_;
        status.fault = fault_;
        snapshot->scene = scene_;
        snapshot->parameters = parameters_;
        snapshot->objects = objects_;
    }
    board_.write(std::move(snapshot));
}

}  // namespace headrace::server
