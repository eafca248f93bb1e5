#include "tests/stability/cases/watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "server/solver/boundaries/rigid_motion.h"
#include "server/solver/eos.h"
#include "tests/validation/support/leaks.h"
#include "tests/validation/support/model_values.h"

namespace headrace::stability {

namespace {

double total_mass(const solver::Particles& particles) {
    double mass = 0.0;
    for (const double m : particles.m) mass += m;
    return mass;
}

double length_of(const solver::Vec3& u) {
    return std::hypot(u[0], u[1], u[2]);
}

double internal_energy(const scene::Run& run) {
    const double c0 = validation::find_sound_speed(run), rho0 = run.model().rest_density();
    const solver::StateEquation eos{rho0 * c0 * c0, validation::has_tait(run) ? 7.0 : 1.0};
    const solver::Particles& particles = run.particles();
    double energy = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        energy += particles.m[i] * eos.internal_energy(particles.rho[i] / rho0 - 1.0, rho0);
    return energy;
}

// Particles by cubes at least `reach` wide, periodic where the domain is.
class Cells {
  public:
    Cells(const solver::Particles& particles, const solver::Domain& domain, double reach)
        : particles_(particles), low_(domain.min), side_{reach, reach, reach} {
        for (int k = 0; k < particles.dimensions; ++k) {
            if (!domain.periodic[k]) continue;
            period_[k] = domain.max[k] - domain.min[k];
            around_[k] = std::max(1L, static_cast<long>(period_[k] / reach));
            side_[k] = period_[k] / static_cast<double>(around_[k]);
        }
        for (std::size_t i = 0; i < particles.size(); ++i) members_[cell_of(i)].push_back(i);
    }

    // visit(distance) of each other particle in the cells around particle i. Precondition: periods of three cells.
    template <class Visit>
    void visit(std::size_t i, Visit&& visit) const {
        const Cell home = cell_of(i);
        const long deep = particles_.dimensions == 3 ? 1 : 0;
        for (long a = -1; a <= 1; ++a)
            for (long b = -1; b <= 1; ++b)
                for (long c = -deep; c <= deep; ++c) {
                    const auto there =
                        members_.find({wrap(home[0] + a, 0), wrap(home[1] + b, 1), wrap(home[2] + c, 2)});
                    if (there == members_.end()) continue;
                    for (const std::size_t j : there->second)
                        if (j != i) visit(distance(i, j));
                }
    }

  private:
    using Cell = std::array<long, 3>;

    long wrap(long c, int k) const { return around_[k] > 0 ? ((c % around_[k]) + around_[k]) % around_[k] : c; }
    Cell cell_of(std::size_t i) const {
        Cell cell{};
        for (int k = 0; k < particles_.dimensions; ++k)
            cell[k] = wrap(static_cast<long>(std::floor((particles_.x[k][i] - low_[k]) / side_[k])), k);
        return cell;
    }
    double distance(std::size_t i, std::size_t j) const {
        double r2 = 0.0;
        for (int k = 0; k < particles_.dimensions; ++k) {
            double d = particles_.x[k][i] - particles_.x[k][j];
            if (period_[k] > 0.0) d -= period_[k] * std::round(d / period_[k]);
            r2 += d * d;
        }
        return std::sqrt(r2);
    }

    const solver::Particles& particles_;
    solver::Vec3 low_, side_;  // [m]
    solver::Vec3 period_{};    // [m]; 0: none
    std::array<long, 3> around_{};
    std::map<Cell, std::vector<std::size_t>> members_;
};

}  // namespace

double nearest_distance(const solver::Particles& particles, const solver::Domain& domain, double spacing, double q) {
    const double reach = 2.0 * spacing * (1.0 + 1e-9);
    const std::size_t inside = particles.dimensions == 2 ? 9 : 24;  // of 12 and 32
    const Cells cells(particles, domain, reach);
    std::vector<double> nearest;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        double least = reach;
        std::size_t count = 0;
        cells.visit(i, [&](double r) {
            if (r > reach) return;
            least = std::min(least, r);
            ++count;
        });
        if (count >= inside) nearest.push_back(least);
    }
    if (nearest.empty()) return std::numeric_limits<double>::infinity();
    const auto at = nearest.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(nearest.size()));
    std::nth_element(nearest.begin(), at, nearest.end());
    return *at;
}

Watch::Watch(const Scenario& scenario, const scene::Run& run)
    : scenario_(scenario),
      count_(run.particles().size()),
      mass_(total_mass(run.particles())),
      rest_density_(run.model().rest_density()) {
    start_anew(run);
}

void Watch::start_anew(const scene::Run& run) {
    first_step_ = shortest_ = run.model().time_step();
    energy_then_ = 1e300;
    momentum_ = {};
    momentum_time_ = run.time();
    const solver::Particles& particles = run.particles();
    for (std::size_t i = 0; i < particles.size(); ++i)
        for (int k = 0; k < particles.dimensions; ++k) momentum_[k] += particles.m[i] * particles.v[k][i];
    sample_energy(run);
}

void Watch::note_step(const scene::Run& run) {
    if (std::exchange(is_disturbed_, false)) start_anew(run);
    shortest_ = std::min(shortest_, run.model().time_step());
    step_ = std::max(step_, 1e-3 * first_step_ / shortest_);
    largest_speed_ = std::max(largest_speed_, run.last_report().max_speed);
    if (run.time() < scenario_.judged_from) return;
    for (const double rho : run.particles().rho)
        density_ = std::max(density_, std::abs(rho / run.model().rest_density() - 1.0));
}

void Watch::sample(const scene::Run& run) {
    const double mass = total_mass(run.particles()) * rest_density_ / run.model().rest_density();
    lost_ = std::max({lost_, std::abs(static_cast<double>(run.particles().size()) - static_cast<double>(count_)),
                      1e-3 * std::floor(std::abs(mass / mass_ - 1.0) / 1e-9)});
    sample_energy(run);
    if (scenario_.conserves_momentum) sample_momentum(run);
    sample_leaks(run);
    sample_density(run);
}

void Watch::sample_energy(const scene::Run& run) {
    const solver::Diagnostics now = run.diagnostics();
    const double internal = internal_energy(run);
    largest_stored_ = std::max(largest_stored_, now.kinetic_energy + internal);
    double stored = now.kinetic_energy + now.potential_energy + internal;
    if (const auto budget = run.model().energies(run.particles(), run.surroundings()))
        stored -= budget->work;
    else if (scenario_.has_moving_walls)
        return;
    if (energy_then_ > 1e299) energy_then_ = stored;
    const double scale = largest_stored_ + mass_ * length_of(run.model().gravity()) * run.fluid_height();
    if (scale > 0.0) energy_ = std::max(energy_, (stored - energy_then_) / scale);
}

void Watch::sample_momentum(const scene::Run& run) {
    const solver::Particles& particles = run.particles();
    const solver::Vec3 g = run.model().gravity();
    solver::Vec3 change{};
    for (int k = 0; k < particles.dimensions; ++k) {
        for (std::size_t i = 0; i < particles.size(); ++i)
            change[k] += particles.m[i] * (particles.v[k][i] - g[k] * (run.time() - momentum_time_));
        change[k] -= momentum_[k];
    }
    if (largest_speed_ > 0.0) drift_ = std::max(drift_, length_of(change) / (mass_ * largest_speed_));
}

void Watch::sample_leaks(const scene::Run& run) {
    const solver::Particles& particles = run.particles();
    const auto solids = run.surroundings().objects;
    for (std::size_t k = 0; k < solids.size(); ++k) {
        const solver::RigidState state = solids[k].motion ? solids[k].motion(run.time()) : solver::RigidState{};
        for (std::size_t i = 0; i < particles.size(); ++i) {
            solver::Vec3 x{};
            for (int axis = 0; axis < particles.dimensions; ++axis) x[axis] = particles.x[axis][i];
            if (solids[k].motion) x = solver::rigid::to_body(state, x);
            const double depth = validation::depth_behind(run.objects()[k], x, particles.dimensions);
            leak_ = std::max(leak_, depth / run.scene().spacing);
        }
    }
}

void Watch::sample_density(const scene::Run& run) {
    if (run.time() < scenario_.judged_from) return;
    const solver::Particles& particles = run.particles();
    double sum = 0.0;
    for (const double rho : particles.rho) sum += std::abs(rho / run.model().rest_density() - 1.0);
    const double mean = sum / static_cast<double>(std::max<std::size_t>(particles.size(), 1));
    if (!mean_then_) mean_then_ = mean;
    mean_density_ = std::max(mean_density_, mean - *mean_then_);
    const double dx = run.scene().spacing;
    const double nearest = nearest_distance(particles, run.surroundings().domain, dx, 0.01);
    distance_ = std::max(distance_, 0.3 * dx / std::max(nearest, 1e-6 * dx));
}

std::vector<Criterion> Watch::criteria() const {
    return {{"lost", true, lost_, 1e-3},
            {"leak", true, leak_, 0.1},
            {"energy", true, energy_, 0.05},
            {"momentum", true, drift_, 0.02},
            {"step", true, step_, 1.0},
            {"density", false, density_, 0.3},
            {"mean_density", false, mean_density_, 0.05},
            {"distance", false, distance_, 1.0}};
}

}  // namespace headrace::stability
