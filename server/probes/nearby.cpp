#include "server/probes/nearby.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "server/solver/parallel.h"

namespace headrace::probes {

namespace {

struct Bounds {
    Vec3 min, max;
};

// A region as a shifted copy of the fluid sees it: a particle at x counts as one at x + shift.
struct Image {
    std::size_t region{};
    Vec3 shift{};
    Bounds bounds{};  // of the particles that may be in reach, before the shift
};

Bounds bounds_of(const Region& region, const Vec3& shift, int dimensions) {
    Bounds bounds{};
    for (int k = 0; k < dimensions; ++k) {
        bounds.min[k] = std::min(region.a[k], region.b[k]) - region.reach - shift[k];
        bounds.max[k] = std::max(region.a[k], region.b[k]) + region.reach - shift[k];
    }
    return bounds;
}

bool overlap(const Bounds& p, const Bounds& q, int dimensions) {
    for (int k = 0; k < dimensions; ++k)
        if (p.max[k] < q.min[k] || q.max[k] < p.min[k]) return false;
    return true;
}

// The region itself and, along periodic axes, its copies one period off that reach back into the domain.
void append_images(std::vector<Image>& images, std::size_t index, const Region& region, const solver::Domain& domain,
                   int dimensions) {
    const auto turns = [&](int axis) { return axis < dimensions && domain.periodic[axis] ? 1 : 0; };
    for (int i = -turns(0); i <= turns(0); ++i)
        for (int j = -turns(1); j <= turns(1); ++j)
            for (int k = -turns(2); k <= turns(2); ++k) {
                const std::array<int, 3> turn{i, j, k};
                Image image{index, {}, {}};
                for (int axis = 0; axis < dimensions; ++axis)
                    if (turn[axis] != 0) image.shift[axis] = turn[axis] * (domain.max[axis] - domain.min[axis]);
                image.bounds = bounds_of(region, image.shift, dimensions);
                const bool is_copy = i != 0 || j != 0 || k != 0;
                if (!is_copy || overlap(image.bounds, {domain.min, domain.max}, dimensions)) images.push_back(image);
            }
}

Bounds bounds_of(const solver::Particles& particles, std::size_t begin, std::size_t end) {
    Bounds bounds{};
    for (int k = 0; k < particles.dimensions; ++k) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        const double* x = particles.x[k].data();
        for (std::size_t i = begin; i < end; ++i) {
            low = std::min(low, x[i]);
            high = std::max(high, x[i]);
        }
        bounds.min[k] = low;
        bounds.max[k] = high;
    }
    return bounds;
}

double squared_distance(const Region& region, const Vec3& x, int dimensions) {
    double along = 0.0, length2 = 0.0;
    for (int k = 0; k < dimensions; ++k) {
        const double edge = region.b[k] - region.a[k];
        along += (x[k] - region.a[k]) * edge;
        length2 += edge * edge;
    }
    const double s = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
    double distance2 = 0.0;
    for (int k = 0; k < dimensions; ++k) {
        const double d = x[k] - region.a[k] - s * (region.b[k] - region.a[k]);
        distance2 += d * d;
    }
    return distance2;
}

using Found = std::vector<std::pair<std::size_t, NearParticle>>;  // region, particle

void search_block(const solver::Particles& particles, std::span<const Region> regions, const Image& image,
                  std::size_t begin, std::size_t end, Found& found) {
    const Region& region = regions[image.region];
    for (std::size_t i = begin; i < end; ++i) {
        Vec3 x{};
        bool is_within = true;
        for (int k = 0; k < particles.dimensions; ++k) {
            is_within &= particles.x[k][i] >= image.bounds.min[k] && particles.x[k][i] <= image.bounds.max[k];
            x[k] = particles.x[k][i] + image.shift[k];
        }
        if (!is_within || !(squared_distance(region, x, particles.dimensions) < region.reach * region.reach)) continue;
        found.push_back({image.region, {x, particles.m[i] / particles.rho[i], static_cast<solver::Index>(i)}});
    }
}

}  // namespace

std::vector<std::vector<NearParticle>> find_nearby(const solver::Particles& particles, const solver::Domain& domain,
                                                   std::span<const Region> regions) {
    std::vector<std::vector<NearParticle>> nearby(regions.size());
    if (regions.empty()) return nearby;
    std::vector<Image> images;
    for (std::size_t k = 0; k < regions.size(); ++k) append_images(images, k, regions[k], domain, particles.dimensions);

    const std::size_t count = particles.size();
    std::vector<Found> found((count + solver::kParticleBlock - 1) / solver::kParticleBlock);
    solver::parallel_for(count, solver::kParticleBlock, [&](std::size_t begin, std::size_t end, int) {
        const Bounds block = bounds_of(particles, begin, end);
        for (const Image& image : images)
            if (overlap(block, image.bounds, particles.dimensions))
                search_block(particles, regions, image, begin, end, found[begin / solver::kParticleBlock]);
    });
    for (const Found& block : found)
        for (const auto& [region, particle] : block) nearby[region].push_back(particle);
    return nearby;
}

}  // namespace headrace::probes
