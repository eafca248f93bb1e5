// Puts the simulation's state on the status board: cheap numbers at each step, diagnostics and plan now and then.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "server/job.h"
#include "server/probe_watch.h"
#include "server/scene/run.h"
#include "server/status.h"

namespace headrace::server {

// What the simulation tells about itself beside its run.
struct SimulationView {
    proto::SimState state{proto::SimState::empty};
    const scene::Run* run{nullptr};
    int threads{};  // of its steps
    std::optional<proto::JobReply> job;
    bool stalled{false};
    double load_progress{0.0};
    // What is done around the run's steps, for the plan; not touched without a run.
    const ProbeWatch* probes{nullptr};
    std::size_t frame_demands{0};  // consumers of frames
    double frame_seconds{0.0};     // [s] wall time spent in copying for them
};

// Owner: the simulation thread.
class StatusWriter {
  public:
    explicit StatusWriter(StatusBoard& board) : board_(board) {}

    void write(const SimulationView& view);
    // Parameters or objects have changed, or another scene is there: the shared lists are made anew.
    void refresh_lists(const scene::Run& run);
    proto::StateHash set_hash(std::uint64_t hash, std::uint64_t step);
    void set_fault(const proto::FaultReport& fault) { fault_ = fault; }
    void forget_run();  // another run takes its place: rates, hash and fault go

  private:
    using Clock = std::chrono::steady_clock;
    void update_rates(const SimulationView& view, Clock::time_point now);
    void update_details(const SimulationView& view, Clock::time_point now);

    StatusBoard& board_;
    std::shared_ptr<const proto::SceneDesc> scene_;
    std::shared_ptr<const std::vector<proto::ParameterEntry>> parameters_;
    std::shared_ptr<const std::vector<proto::ObjectDesc>> objects_;
    std::optional<proto::StateHash> hash_;
    std::optional<proto::FaultReport> fault_;

    std::optional<proto::Diagnostics> diagnostics_;
    std::vector<proto::PlanStage> plan_;
    Clock::time_point details_at_{};
    std::optional<std::uint64_t> details_step_;

    Clock::time_point window_start_{};  // of the rate measurement
    std::uint64_t window_step_{0};
    double window_time_{0.0};
    bool was_running_{false};
    double steps_per_second_{0.0};
    double real_time_factor_{0.0};
};

}  // namespace headrace::server
