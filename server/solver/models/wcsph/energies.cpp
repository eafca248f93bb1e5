#include "server/solver/models/wcsph/energies.h"

#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

// sum over the particles of m_i a_i . (v_i + tau/2 a_total,i); 0 where the term has no field.
double power_of(const VectorField& a, const Particles& particles, double tau) {
    if (a[0].empty()) return 0.0;
    return parallel_reduce(
        particles.size(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double sum = 0.0;
            for (std::size_t i = begin; i < end; ++i) {
                double power = 0.0;
                for (int k = 0; k < particles.dimensions; ++k)
                    power += a[k][i] * (particles.v[k][i] + 0.5 * tau * particles.a[k][i]);
                sum += particles.m[i] * power;
            }
            return sum;
        },
        [](double one, double other) { return one + other; });
}

// a - b, into b.
void subtract_from(const VectorField& a, VectorField& b, int dimensions) {
    for (int k = 0; k < dimensions; ++k) {
        for (std::size_t i = 0; i < a[k].size(); ++i) b[k][i] = a[k][i] - b[k][i];
    }
}

}  // namespace

EnergySetting make_energy_setting(const Vec3& gravity, const Domain& domain, double rest_density,
                                  const StateEquation& eos) {
    EnergySetting setting{gravity, rest_density, eos};
    for (int k = 0; k < 3; ++k) {
        if (domain.periodic[k]) setting.gravity[k] = 0.0;
    }
    return setting;
}

StoredEnergy compute_stored_energy(const Particles& particles, const std::vector<double>& delta,
                                   const EnergySetting& setting) {
    return parallel_reduce(
        particles.size(), StoredEnergy{},
        [&](std::size_t begin, std::size_t end) {
            StoredEnergy sum;
            for (std::size_t i = begin; i < end; ++i) {
                double v2 = 0.0, g_x = 0.0;
                for (int k = 0; k < particles.dimensions; ++k) {
                    v2 += particles.v[k][i] * particles.v[k][i];
                    g_x += setting.gravity[k] * particles.x[k][i];
                }
                sum.kinetic += 0.5 * particles.m[i] * v2;
                sum.potential -= particles.m[i] * g_x;
                sum.internal += particles.m[i] * setting.eos.internal_energy(delta[i], setting.rest_density);
            }
            return sum;
        },
        [](const StoredEnergy& a, const StoredEnergy& b) {
            return StoredEnergy{a.kinetic + b.kinetic, a.potential + b.potential, a.internal + b.internal};
        });
}

void EnergyAccount::follow(bool on) {
    *this = {};
    is_on_ = on;
}

void EnergyAccount::start(double stored) {
    has_started_ = true;
    start_ = stored;
}

EnergyBudget EnergyAccount::budget(const StoredEnergy& stored) const {
    EnergyBudget budget{stored.kinetic, stored.potential, stored.internal};
    if (!has_started_) return budget;
    budget.dissipated = dissipated_;
    budget.work = work_;
    budget.balance = stored.total() - start_ + dissipated_ - work_;
    return budget;
}

void EnergyAccount::permute(const ClusterOrder& order, std::vector<double>& scratch) {
    for (VectorField* field : {&body_, &viscosity_, &artificial_}) {
        for (std::vector<double>& component : *field) {
            if (!component.empty()) order.permute(component, scratch);
        }
    }
}

void EnergyAccount::note_body_force(const VectorField& a, const EnergySetting& setting, int dimensions) {
    slow_before_ = body_ = a;
    for (int k = 0; k < dimensions; ++k) {
        for (double& component : body_[k]) component -= setting.gravity[k];
    }
    viscosity_ = {};
}

void EnergyAccount::note_viscosity(const VectorField& a, int dimensions) {
    viscosity_ = slow_before_;
    subtract_from(a, viscosity_, dimensions);
    slow_before_ = a;
}

void EnergyAccount::note_tension(const VectorField& a, int dimensions) {
    for (int k = 0; k < dimensions; ++k) {
        for (std::size_t i = 0; i < a[k].size(); ++i) body_[k][i] += a[k][i] - slow_before_[k][i];
    }
}

void EnergyAccount::note_with_artificial(const VectorField& a, int dimensions) {
    subtract_from(a, artificial_, dimensions);
}

void EnergyAccount::count_kick(const Particles& particles, double tau) {
    const double by_body = power_of(body_, particles, tau);
    const double by_viscosity = power_of(viscosity_, particles, tau) + power_of(artificial_, particles, tau);
    work_ += tau * (by_body + wall_pressure_power_ + wall_viscosity_power_);
    dissipated_ += tau * (wall_viscosity_power_ - by_viscosity);
}

void EnergyAccount::count_diffusion(const Particles& particles, const WcsphState& state, const EnergySetting& setting,
                                    double dt) {
    const auto energy = [&](double delta) { return setting.eos.internal_energy(delta, setting.rest_density); };
    dissipated_ += parallel_reduce(
        particles.size(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double sum = 0.0;
            for (std::size_t i = begin; i < end; ++i) {
                const double change = dt * (state.delta_rate[i] - rate_without_diffusion_[i]);
                sum += particles.m[i] * (energy(state.delta[i] - change) - energy(state.delta[i]));
            }
            return sum;
        },
        [](double one, double other) { return one + other; });
}

}  // namespace headrace::solver
