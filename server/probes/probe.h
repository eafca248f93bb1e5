// One probe, ready to be evaluated: what it needs of the particles around it, what it computes, in which columns.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "proto/messages.h"
#include "proto/result.h"
#include "server/probes/nearby.h"
#include "server/solver/model.h"

namespace headrace::probes {

// What probes see of a run at one instant. All of it outlives the call it is passed to.
struct RunView {
    const solver::Particles& particles;
    const solver::Model& model;
    solver::Surroundings surroundings;
    double spacing{};      // [m] of the scene
    std::uint64_t step{};  // done
    double time{};         // [s]
};

// Why a probe cannot be evaluated; nothing when it could.
using Failure = std::optional<std::string>;

// Owner: the simulation thread.
class Probe {
  public:
    virtual ~Probe() = default;

    virtual std::vector<proto::ProbeColumn> columns() const = 0;

    // Where it wants to know the particles; none: it looks at all of them, or asks the model.
    virtual std::optional<Region> region(double /*support*/) const { return std::nullopt; }

    // Sets one value per column, nothing where there is no fluid to measure. `near`: the particles in its region.
    virtual Failure sample(const RunView& run, std::span<const NearParticle> near, proto::ProbeRow& values) const = 0;
};

// Precondition: check_probe found nothing.
std::unique_ptr<Probe> make_probe(const proto::ProbeDesc& desc, int dimensions);

// The kinds, one file per family.
std::unique_ptr<Probe> make_probe(const proto::PressureProbe& desc, int dimensions);
std::unique_ptr<Probe> make_probe(const proto::VelocityProbe& desc, int dimensions);
std::unique_ptr<Probe> make_probe(const proto::LevelProbe& desc, int dimensions);
std::unique_ptr<Probe> make_probe(const proto::ProfileProbe& desc, int dimensions);
std::unique_ptr<Probe> make_probe(const proto::FrontProbe& desc, int dimensions);
std::unique_ptr<Probe> make_probe(const proto::DischargeProbe& desc, int dimensions);
std::unique_ptr<Probe> make_probe(const proto::ForceProbe& desc, int dimensions);
std::unique_ptr<Probe> make_probe(const proto::EnergyProbe& desc, int dimensions);
std::unique_ptr<Probe> make_probe(const proto::DensityProbe& desc, int dimensions);

// Does the description make sense in this run's dimensions and domain? Errors: invalid_params with a path below `path`.
proto::Status check_probe(const proto::ProbeDesc& desc, const RunView& run, const std::string& path);

}  // namespace headrace::probes
