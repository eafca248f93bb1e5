// Pressure and velocity at a point, pressure over a patch, a field along a line.
#include <array>
#include <cmath>

#include "server/probes/interpolation.h"
#include "server/probes/probe.h"
#include "server/probes/vectors.h"

namespace headrace::probes {

namespace {

// A field at a point; nothing where no fluid is in reach.
std::optional<double> value_at(const RunView& run, std::span<const NearParticle> near, const Vec3& x,
                               const std::vector<double>& field) {
    std::vector<double> weights;
    if (!make_weights(run.particles.dimensions, run.model.support_radius(), x, near, weights)) return std::nullopt;
    double sum = 0.0;
    for (std::size_t j = 0; j < near.size(); ++j) sum += weights[j] * field[near[j].slot];
    return sum;
}

class PointPressure final : public Probe {
  public:
    explicit PointPressure(const proto::PressureProbe& desc) : x_(desc.point) {}
    std::vector<proto::ProbeColumn> columns() const override { return {{"pressure", "Pa", {}}}; }
    std::optional<Region> region(double support) const override { return Region{x_, x_, support}; }
    Failure sample(const RunView& run, std::span<const NearParticle> near, proto::ProbeRow& values) const override {
        values[0] = value_at(run, near, x_, run.particles.p);
        return std::nullopt;
    }

  private:
    Vec3 x_;
};

// Mean over a disc (2D: a segment). Dry points count as 0 Pa: they carry no load.
class PatchPressure final : public Probe {
  public:
    PatchPressure(const proto::PressureProbe& desc, int dimensions) : center_(desc.point), radius_(desc.radius) {
        if (dimensions == 2)
            place_on_segment(unit({-desc.normal[1], desc.normal[0], 0.0}));
        else
            place_on_disc(unit(desc.normal));
    }
    std::vector<proto::ProbeColumn> columns() const override { return {{"pressure", "Pa", {}}}; }
    std::optional<Region> region(double support) const override { return Region{center_, center_, support + radius_}; }
    Failure sample(const RunView& run, std::span<const NearParticle> near, proto::ProbeRow& values) const override {
        double sum = 0.0;
        for (const Vec3& x : points_) sum += value_at(run, near, x, run.particles.p).value_or(0.0);
        values[0] = sum / static_cast<double>(points_.size());
        return std::nullopt;
    }

  private:
    // Midpoint rule with equal parts: equal weights.
    static constexpr int kRings = 3;
    static constexpr int kSegmentPoints = 9;

    void place_on_segment(const Vec3& along) {
        for (int k = 0; k < kSegmentPoints; ++k)
            add(along, radius_ * ((2.0 * k + 1.0) / kSegmentPoints - 1.0), {}, 0.0);
    }
    // Ring k of kRings with 4 (2 k + 1) points, each for the same area: 36 points in all. Each stands at the radius
    // that halves the area of its ring.
    void place_on_disc(const Vec3& normal) {
        const Vec3 aside = std::abs(normal[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 u = unit(cross(normal, aside)), w = cross(normal, u);
        for (int k = 0; k < kRings; ++k) {
            const int count = 4 * (2 * k + 1);
            const double r = radius_ / kRings * std::sqrt(0.5 * (k * k + (k + 1.0) * (k + 1.0)));
            for (int j = 0; j < count; ++j) {
                const double angle = 2.0 * std::numbers::pi * (j + 0.5) / count;
                add(u, r * std::cos(angle), w, r * std::sin(angle));
            }
        }
    }
    void add(const Vec3& u, double a, const Vec3& w, double b) {
        Vec3 x = center_;
        for (int k = 0; k < 3; ++k) x[k] += a * u[k] + b * w[k];
        points_.push_back(x);
    }

    Vec3 center_;
    double radius_;
    std::vector<Vec3> points_;
};

class PointVelocity final : public Probe {
  public:
    PointVelocity(const proto::VelocityProbe& desc, int dimensions) : x_(desc.point), dimensions_(dimensions) {}
    std::vector<proto::ProbeColumn> columns() const override {
        std::vector<proto::ProbeColumn> columns{{"vx", "m/s", {}}, {"vy", "m/s", {}}};
        if (dimensions_ == 3) columns.push_back({"vz", "m/s", {}});
        return columns;
    }
    std::optional<Region> region(double support) const override { return Region{x_, x_, support}; }
    Failure sample(const RunView& run, std::span<const NearParticle> near, proto::ProbeRow& values) const override {
        for (int k = 0; k < dimensions_; ++k) values[k] = value_at(run, near, x_, run.particles.v[k]);
        return std::nullopt;
    }

  private:
    Vec3 x_;
    int dimensions_;
};

struct ProfileFieldInfo {
    const char* name;
    const char* unit;
};
// In the order of proto::ProfileField.
constexpr std::array<ProfileFieldInfo, 5> kProfileFields{
    {{"pressure", "Pa"}, {"density", "kg/m^3"}, {"vx", "m/s"}, {"vy", "m/s"}, {"vz", "m/s"}}};

class Profile final : public Probe {
  public:
    explicit Profile(const proto::ProfileProbe& desc) : desc_(desc) {}
    std::vector<proto::ProbeColumn> columns() const override {
        const ProfileFieldInfo& info = kProfileFields[static_cast<std::size_t>(desc_.field)];
        const double whole = length(minus(desc_.to, desc_.from));
        std::vector<proto::ProbeColumn> columns;
        for (std::int64_t k = 0; k < desc_.points; ++k)
            columns.push_back({std::string(info.name) + "_" + std::to_string(k), info.unit, share(k) * whole});
        return columns;
    }
    std::optional<Region> region(double support) const override { return Region{desc_.from, desc_.to, support}; }
    Failure sample(const RunView& run, std::span<const NearParticle> near, proto::ProbeRow& values) const override {
        const double R = run.model.support_radius();
        std::vector<NearParticle> local;
        for (std::int64_t k = 0; k < desc_.points; ++k) {
            const Vec3 x = between(desc_.from, desc_.to, share(k));
            local.clear();
            for (const NearParticle& j : near)
                if (length(minus(j.x, x)) < R) local.push_back(j);
            values[static_cast<std::size_t>(k)] = value_at(run, local, x, field(run.particles));
        }
        return std::nullopt;
    }

  private:
    double share(std::int64_t k) const { return static_cast<double>(k) / static_cast<double>(desc_.points - 1); }
    const std::vector<double>& field(const solver::Particles& particles) const {
        switch (desc_.field) {
            case proto::ProfileField::pressure:
                return particles.p;
            case proto::ProfileField::density:
                return particles.rho;
            case proto::ProfileField::velocity_x:
                return particles.v[0];
            case proto::ProfileField::velocity_y:
                return particles.v[1];
            case proto::ProfileField::velocity_z:
                break;
        }
        return particles.v[2];
    }

    proto::ProfileProbe desc_;
};

}  // namespace

std::unique_ptr<Probe> make_probe(const proto::PressureProbe& desc, int dimensions) {
    if (desc.radius > 0.0) return std::make_unique<PatchPressure>(desc, dimensions);
    return std::make_unique<PointPressure>(desc);
}

std::unique_ptr<Probe> make_probe(const proto::VelocityProbe& desc, int dimensions) {
    return std::make_unique<PointVelocity>(desc, dimensions);
}

std::unique_ptr<Probe> make_probe(const proto::ProfileProbe& desc, int) {
    return std::make_unique<Profile>(desc);
}

}  // namespace headrace::probes
