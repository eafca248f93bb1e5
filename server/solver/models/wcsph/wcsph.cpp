#include <algorithm>
#include <cmath>
#include <utility>

#include "server/solver/models/wcsph/sound_speed.h"
#include "server/solver/models/wcsph/wcsph_model.h"
#include "server/solver/parallel.h"

namespace headrace::solver {

void Wcsph::set_state_equation() {
    eos_ = {p_.rest_density * c0_ * c0_, p_.state_equation == StateEquationKind::tait ? 7.0 : 1.0};
}

void Wcsph::resize_state(std::size_t count) {
    for (std::vector<double>* field : {&state_.delta, &state_.delta_rate}) field->assign(count, 0.0);
    for (std::vector<float>* field : {&state_.min_eigenvalue, &state_.unevenness, &state_.ddelta})
        field->assign(count, 0.0F);
    for (NarrowField* field : {&state_.grad_delta, &state_.dx, &state_.dv})
        for (int k = 0; k < dimensions_; ++k) (*field)[k].assign(count, 0.0F);
    for (MatrixField* field : {&state_.B, &state_.strain})
        for (int k = 0; k < symmetric_size(dimensions_); ++k) (*field)[k].assign(count, 0.0F);
}

void Wcsph::put_body_force(Particles& particles, const Surroundings& surroundings) {
    for (int k = 0; k < 3; ++k) std::fill(particles.a[k].begin(), particles.a[k].end(), 0.0);
    if (surroundings.body_force != nullptr) (*surroundings.body_force)(surroundings.time, particles, particles.a);
}

void Wcsph::prepare(Particles& particles, const Surroundings& surroundings) {
    for (int k = 0; k < 3; ++k) {
        std::vector<double>().swap(particles.v_half[k]);
        period_[k] = surroundings.domain.max[k] - surroundings.domain.min[k];
    }
    put_body_force(particles, surroundings);
    place_walls(surroundings, surroundings.time, true);
    c0_ = choose_sound_speed(p_, particles, spacing_, walls_.max_speed());
    set_state_equation();
}

// Shifting alone, until the particles have settled. Along a free surface they move sideways only, so its shape stays.
void Wcsph::relax(Particles& particles, const Surroundings& surroundings, const std::vector<bool>& spread) {
    constexpr int kMostTurns = 500;
    constexpr double kSettled = 1e-3;  // [spacings] largest shift of a turn
    prepare(particles, surroundings);
    resize_state(particles.size());
    std::fill(particles.m.begin(), particles.m.end(), std::pow(spacing_, dimensions_));
    std::fill(particles.rho.begin(), particles.rho.end(), 1.0);  // what counts is the volume
    std::vector<bool> may_move(spread);                          // by id: sorting changes the slots
    for (std::size_t i = 0; i < particles.size(); ++i) may_move[particles.id[i]] = spread[i];
    GeometryOptions options = geometry_options(true);
    options.shift_factor = 0.5 * h() * h();
    options.shift_speed = 1.0;
    options.strain_length = 0.0;
    options.dynamic_pressure = 1.0;
    options.noise = 0.0;
    for (int turn = 0; turn < kMostTurns; ++turn) {
        find_neighbours(particles, surroundings);
        sums_->geometry(data(particles), options);
        double longest2 = 0.0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            if (!may_move[particles.id[i]]) continue;
            double shift2 = 0.0;
            for (int k = 0; k < dimensions_; ++k) {
                const double dx = state_.dx[k][i];
                particles.x[k][i] += dx;
                shift2 += dx * dx;
            }
            longest2 = std::max(longest2, shift2);
        }
        if (std::sqrt(longest2) < kSettled * spacing_) break;
    }
    wrap(particles, surroundings.domain);
}

StepReport Wcsph::initialise(Particles& particles, const Surroundings& surroundings) {
    prepare(particles, surroundings);
    resize_state(particles.size());
    artificial_weight_ = 1;
    const double volume = std::pow(spacing_, dimensions_);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        state_.delta[i] = eos_.deviation(particles.p[i]);
        particles.m[i] = p_.rest_density * (1.0 + state_.delta[i]) * volume;
    }
    compute_state(particles, 0.0, 0.0);
    sort_all(particles, surroundings);
    compute_geometry(particles, false);
    compute_slow_forces(particles, surroundings);
    compute_pressure_forces(particles, surroundings);
    return finish(particles, surroundings, 0.0);
}

std::unique_ptr<Model> make_wcsph(int dimensions, double spacing, const ParameterMap& overrides) {
    return std::make_unique<Wcsph>(dimensions, spacing, overrides);
}

}  // namespace headrace::solver
