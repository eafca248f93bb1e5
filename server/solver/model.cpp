#include "server/solver/model.h"

namespace headrace::solver {

void Model::prepare(Particles&, const Surroundings&) {}

void Model::relax(Particles&, const Surroundings&, const std::vector<bool>&) {}

std::vector<ObjectLoad> Model::object_loads(const Particles&, const Surroundings&) const {
    return {};
}

void Model::follow_energies(bool) {}

std::optional<EnergyBudget> Model::energies(const Particles&, const Surroundings&) const {
    return std::nullopt;
}

std::optional<ParticleInspection> Model::inspect(const Particles&, const Surroundings&, Index) const {
    return std::nullopt;
}

}  // namespace headrace::solver
