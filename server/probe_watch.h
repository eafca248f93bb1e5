// The probes of the simulation's run: made with it, sampled after its steps, shown on the board.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "proto/result.h"
#include "server/probe_board.h"
#include "server/probes/probe_set.h"
#include "server/scene/run.h"

namespace headrace::server {

// Owner: the simulation thread.
class ProbeWatch {
  public:
    explicit ProbeWatch(ProbeBoard& board) : board_(board) {}

    // The probes of a scene that was just built, and whether its events name what these give. Errors: scene_invalid,
    // limit_exceeded, with a path that starts with "scene".
    static proto::Result<probes::ProbeSet> make(scene::Run& run);

    // Another run takes the place of the one before. `generation`: as its frames count it.
    void restart(probes::ProbeSet probes, std::uint64_t generation);

    proto::Status add(scene::Run& run, const proto::ProbeDesc& probe);
    proto::Status remove(scene::Run& run, const std::string& name);

    // After a load, an addition and each step. Returns those that can no longer be evaluated: probe and why.
    std::vector<std::pair<std::string, std::string>> sample(const scene::Run& run);

    const probes::ProbeSet& probes() const { return probes_; }
    double seconds() const { return seconds_; }  // [s] wall time spent in sample() since the run began

  private:
    ProbeBoard& board_;
    probes::ProbeSet probes_{1.0};
    double seconds_{};
};

}  // namespace headrace::server
