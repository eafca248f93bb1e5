// What is summed over the whole fluid: front, discharge, density error.
#include <algorithm>
#include <cmath>
#include <limits>

#include "server/probes/interpolation.h"
#include "server/probes/probe.h"
#include "server/probes/vectors.h"
#include "server/solver/parallel.h"

namespace headrace::probes {

namespace {

Vec3 at(const solver::VectorField& field, std::size_t i, int dimensions) {
    return {field[0][i], field[1][i], dimensions == 3 ? field[2][i] : 0.0};
}

class Front final : public Probe {
  public:
    explicit Front(const proto::FrontProbe& desc) : direction_(unit(desc.direction)) {}
    std::vector<proto::ProbeColumn> columns() const override { return {{"front", "m", {}}}; }
    Failure sample(const RunView& run, std::span<const NearParticle>, proto::ProbeRow& values) const override {
        const solver::Particles& particles = run.particles;
        const double lowest = -std::numeric_limits<double>::infinity();
        const double furthest = solver::parallel_reduce(
            particles.size(), lowest,
            [&](std::size_t begin, std::size_t end) {
                double block = lowest;
                for (std::size_t i = begin; i < end; ++i)
                    block = std::max(block, dot(at(particles.x, i, particles.dimensions), direction_));
                return block;
            },
            [](double a, double b) { return std::max(a, b); });
        values[0] = furthest + 0.5 * run.spacing;
        return std::nullopt;
    }

  private:
    Vec3 direction_;
};

// Q = sum of V_j (v_j . n) w(distance of j from the plane), w a kernel in one dimension: the flux through the plane,
// averaged over a support radius to both sides.
class Discharge final : public Probe {
  public:
    Discharge(const proto::DischargeProbe& desc, int dimensions)
        : point_(desc.point), normal_(unit(desc.normal)), dimensions_(dimensions) {}
    std::vector<proto::ProbeColumn> columns() const override {
        return {{"discharge", dimensions_ == 3 ? "m^3/s" : "m^2/s", {}}};
    }
    Failure sample(const RunView& run, std::span<const NearParticle>, proto::ProbeRow& values) const override {
        const solver::Particles& particles = run.particles;
        const double R = run.model.support_radius();
        const double period = period_across(run.surroundings.domain);
        values[0] = solver::parallel_reduce(
            particles.size(), 0.0,
            [&](std::size_t begin, std::size_t end) {
                double sum = 0.0;
                for (std::size_t i = begin; i < end; ++i) {
                    double distance = dot(minus(at(particles.x, i, dimensions_), point_), normal_);
                    if (period > 0.0) distance -= period * std::round(distance / period);
                    const double w = wendland_c2_line(R, distance);
                    if (w > 0.0)
                        sum += particles.m[i] / particles.rho[i] * dot(at(particles.v, i, dimensions_), normal_) * w;
                }
                return sum;
            },
            [](double a, double b) { return a + b; });
        return std::nullopt;
    }

  private:
    // [m] of the domain when the plane stands across a periodic axis; 0 otherwise.
    double period_across(const solver::Domain& domain) const {
        for (int k = 0; k < dimensions_; ++k)
            if (domain.periodic[k] && std::abs(normal_[k]) > 1.0 - 1e-12) return domain.max[k] - domain.min[k];
        return 0.0;
    }

    Vec3 point_, normal_;
    int dimensions_;
};

class DensityError final : public Probe {
  public:
    explicit DensityError(int dimensions) : dimensions_(dimensions) {}
    std::vector<proto::ProbeColumn> columns() const override {
        return {{"mean_error", "1", {}}, {"max_error", "1", {}}, {"volume", dimensions_ == 3 ? "m^3" : "m^2", {}}};
    }
    Failure sample(const RunView& run, std::span<const NearParticle>, proto::ProbeRow& values) const override {
        struct Sums {
            double error, largest, volume;
        };
        const solver::Particles& particles = run.particles;
        const double rho0 = run.model.rest_density();
        const Sums sums = solver::parallel_reduce(
            particles.size(), Sums{},
            [&](std::size_t begin, std::size_t end) {
                Sums block{};
                for (std::size_t i = begin; i < end; ++i) {
                    const double error = std::abs(particles.rho[i] / rho0 - 1.0);
                    block.error += error;
                    block.largest = std::max(block.largest, error);
                    block.volume += particles.m[i] / particles.rho[i];
                }
                return block;
            },
            [](const Sums& a, const Sums& b) {
                return Sums{a.error + b.error, std::max(a.largest, b.largest), a.volume + b.volume};
            });
        values = {sums.error / static_cast<double>(particles.size()), sums.largest, sums.volume};
        return std::nullopt;
    }

  private:
    int dimensions_;
};

}  // namespace

std::unique_ptr<Probe> make_probe(const proto::FrontProbe& desc, int) {
    return std::make_unique<Front>(desc);
}

std::unique_ptr<Probe> make_probe(const proto::DischargeProbe& desc, int dimensions) {
    return std::make_unique<Discharge>(desc, dimensions);
}

std::unique_ptr<Probe> make_probe(const proto::DensityProbe&, int dimensions) {
    return std::make_unique<DensityError>(dimensions);
}

}  // namespace headrace::probes
