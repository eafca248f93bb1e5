// Small scenes for the solver's tests.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "server/solver/models/thesis_sums.h"
#include "server/solver/objects.h"
#include "server/solver/particles.h"

namespace headrace::solver::testing {

// The spacing at which the thesis's tables hold exactly [m].
inline const double kThesisSpacing = std::cbrt(0.02 / 998.29);

inline Particles make_particles(int dimensions, const std::vector<Vec3>& positions) {
    Particles particles;
    particles.dimensions = dimensions;
    particles.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        particles.id[i] = static_cast<Index>(i);
        for (int k = 0; k < dimensions; ++k) particles.x[k][i] = positions[i][k];
    }
    return particles;
}

// A block of n[0] x n[1] x n[2] particles from `corner` on.
inline std::vector<Vec3> lattice(const std::array<int, 3>& n, double spacing, const Vec3& corner = {}) {
    std::vector<Vec3> positions;
    for (int k = 0; k < n[2]; ++k) {
        for (int j = 0; j < n[1]; ++j) {
            for (int i = 0; i < n[0]; ++i) {
                positions.push_back({corner[0] + (i + 0.5) * spacing, corner[1] + (j + 0.5) * spacing,
                                     corner[2] + (k + 0.5) * spacing});
            }
        }
    }
    return positions;
}

inline std::vector<Vec3> random_points(int count, double extent, unsigned seed, int dimensions = 3) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-0.5 * extent, 0.5 * extent);
    std::vector<Vec3> points(count);
    for (Vec3& point : points) {
        for (int k = 0; k < dimensions; ++k) point[k] = uniform(random);
    }
    return points;
}

inline std::size_t slot_of(const Particles& particles, Index id) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (particles.id[i] == id) return i;
    }
    return particles.size();
}

inline Vec3 at(const VectorField& field, int dimensions, std::size_t i) {
    Vec3 value{};
    for (int k = 0; k < dimensions; ++k) value[k] = field[k][i];
    return value;
}

// Sorts the particles and evaluates the pair sums once; rho and p are computed unless given.
class SumBench {
  public:
    SumBench(Particles particles_in, const ThesisParameters& parameters_in)
        : particles(std::move(particles_in)), parameters(parameters_in) {
        grid.sort(particles, parameters.support_radius);
    }

    void compute_density(Isa isa = best_isa()) {
        choose_density_sum(particles.dimensions, isa)(input(), 0, grid.cells(), candidates, particles.rho.data());
    }

    void set_state(double rho, double p) {
        particles.rho.assign(particles.size(), rho);
        particles.p.assign(particles.size(), p);
    }

    void compute_acceleration(const ForceTerms& terms, Isa isa = best_isa()) {
        volume.resize(particles.size());
        for (std::size_t i = 0; i < particles.size(); ++i) volume[i] = parameters.particle_mass / particles.rho[i];
        choose_force_sum(particles.dimensions, terms, isa)(
            input(), 0, grid.cells(), candidates,
            {particles.a[0].data(), particles.a[1].data(), particles.a[2].data()});
    }

    Vec3 acceleration(Index id) const { return at(particles.a, particles.dimensions, slot_of(particles, id)); }
    SumInput input() const { return {grid, parameters, particles, volume.data(), step}; }

    Particles particles;
    ThesisParameters parameters;
    CellGrid grid;
    Candidates candidates;
    std::vector<double> volume;
    std::uint64_t step{0};
};

// Thesis tables without gravity.
inline ThesisParameters weightless(int dimensions) {
    ThesisParameters parameters = make_thesis_parameters(dimensions, kThesisSpacing, {});
    parameters.gravity = {};
    return parameters;
}

}  // namespace headrace::solver::testing
