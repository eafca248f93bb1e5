// Owner of scene, particles, model and clock; the only writer of particles. Runs on its own thread.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <thread>

#include "server/event_log.h"
#include "server/inbox.h"
#include "server/jobs.h"
#include "server/outbox.h"
#include "server/probe_board.h"
#include "server/status.h"

namespace headrace::publish {
class FrameHub;
}

namespace headrace::server {

struct SimulationOptions {
    int threads{0};                     // OpenMP team; 0: as many as the machine has
    std::filesystem::path data_folder;  // scenes read files below it
};

class Simulation {
  public:
    // All references outlive the simulation.
    Simulation(const SimulationOptions& options, Outbox& outbox, EventLog& events, JobBoard& jobs, StatusBoard& board,
               ProbeBoard& probe_board, publish::FrameHub& hub);
    ~Simulation();  // stop()

    void start();
    void stop();  // cancels what runs, answers what waits with shutting_down, joins; idempotent

    // Any thread. The outcome arrives in the outbox under the token, exactly once, unless the token is 0.
    // sim.step, and sim.run with wait: when the run has ended. Everything else: when applied.
    void post(Token token, Mutation mutation);

    // Any thread: something a waiting run depends on has changed.
    void wake();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace headrace::server
