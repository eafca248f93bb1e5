#include "server/solver/faults.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/solver/parallel.h"

namespace headrace::solver {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

struct Finding {
    double max_speed2{0.0};
    std::size_t slot{kNone};  // of the faulty particle with the lowest id
};

bool is_finite(const Particles& particles, std::size_t i) {
    for (int k = 0; k < particles.dimensions; ++k) {
        if (!std::isfinite(particles.x[k][i]) ||
            (!particles.v_half[k].empty() && !std::isfinite(particles.v_half[k][i])) ||
            !std::isfinite(particles.v[k][i])) {
            return false;
        }
    }
    return true;
}

bool is_inside(const Particles& particles, const Domain& domain, std::size_t i) {
    for (int k = 0; k < particles.dimensions; ++k) {
        if (!(particles.x[k][i] >= domain.min[k] && particles.x[k][i] <= domain.max[k])) return false;
    }
    return true;
}

Vec3 component_wise(const VectorField& field, int dimensions, std::size_t i) {
    Vec3 value{};
    for (int k = 0; k < dimensions; ++k) value[k] = field[k][i];
    return value;
}

}  // namespace

const char* name_of(FaultKind kind) {
    switch (kind) {
        case FaultKind::non_finite:
            break;
        case FaultKind::left_domain:
            return "left_domain";
        case FaultKind::density:
            return "density";
        case FaultKind::speed:
            return "speed";
        case FaultKind::time_step:
            return "time_step";
    }
    return "non_finite";
}

Inspection inspect(const Particles& particles, const Domain& domain) {
    const auto lower = [&](std::size_t a, std::size_t b) {
        if (a == kNone || b == kNone) return std::min(a, b);
        return particles.id[a] < particles.id[b] ? a : b;
    };
    const Finding finding = parallel_reduce(
        particles.size(), Finding{},
        [&](std::size_t begin, std::size_t end) {
            Finding block;
            for (std::size_t i = begin; i < end; ++i) {
                if (!is_finite(particles, i) || !is_inside(particles, domain, i)) {
                    block.slot = lower(block.slot, i);
                    continue;
                }
                double speed2 = 0.0;
                for (int k = 0; k < particles.dimensions; ++k) speed2 += particles.v[k][i] * particles.v[k][i];
                block.max_speed2 = std::max(block.max_speed2, speed2);
            }
            return block;
        },
        [&](const Finding& a, const Finding& b) {
            return Finding{std::max(a.max_speed2, b.max_speed2), lower(a.slot, b.slot)};
        });

    Inspection inspection;
    inspection.max_speed = std::sqrt(finding.max_speed2);
    if (finding.slot != kNone) {
        const std::size_t i = finding.slot;
        inspection.fault = Fault{is_finite(particles, i) ? FaultKind::left_domain : FaultKind::non_finite,
                                 particles.id[i],
                                 component_wise(particles.x, particles.dimensions, i),
                                 component_wise(particles.v, particles.dimensions, i),
                                 {}};
    }
    return inspection;
}

}  // namespace headrace::solver
