// Height of the free surface along a line.
//
// The surface is where the particles' concentration, sum of V_j W_j, is half of what it would be inside the fluid: on a
// flat surface exactly one half of the kernel's weight is filled. What walls take of the support counts as missing on
// both sides, so that a gauge may stand on a wall. Drops and films thinner than about one and a half spacings fill less
// than half and are not seen; a fluid that reaches past the far end reads the line's whole length, and a dry line 0.
//
// Where the line crosses several surfaces the highest counts, looked for from the far end, or the lowest, looked for
// from the beginning: what flies above the fluid does not count then, and the level is 0 where the beginning is dry.
#include <algorithm>
#include <cmath>

#include "server/probes/interpolation.h"
#include "server/probes/probe.h"
#include "server/probes/solids.h"
#include "server/probes/vectors.h"

namespace headrace::probes {

namespace {

class Level final : public Probe {
  public:
    explicit Level(const proto::LevelProbe& desc)
        : from_(desc.from), to_(desc.to), surface_(desc.surface), length_(length(minus(desc.to, desc.from))) {}
    std::vector<proto::ProbeColumn> columns() const override { return {{"level", "m", {}}}; }
    std::optional<Region> region(double support) const override { return Region{from_, to_, support}; }
    Failure sample(const RunView& run, std::span<const NearParticle> near, proto::ProbeRow& values) const override {
        const Line line(*this, near, run);
        values[0] = surface_ == proto::LevelSurface::highest ? find_highest(run, line) : find_lowest(run, line);
        return std::nullopt;
    }

  private:
    // The particles near the line, by their place along it: a point looks at its neighbours only.
    class Line {
      public:
        Line(const Level& level, std::span<const NearParticle> near, const RunView& run)
            : R_(run.model.support_radius()),
              near_(near.begin(), near.end()),
              solids_(run.surroundings, run.particles.dimensions) {
            const Vec3 along = unit(minus(level.to_, level.from_));
            const auto place = [&](const NearParticle& j) { return dot(minus(j.x, level.from_), along); };
            std::stable_sort(near_.begin(), near_.end(),
                             [&](const NearParticle& i, const NearParticle& j) { return place(i) < place(j); });
            for (const NearParticle& j : near_) places_.push_back(place(j));
        }
        double concentration_at(const Vec3& x, double s, int dimensions) const {
            const auto first = std::lower_bound(places_.begin(), places_.end(), s - R_);
            const auto last = std::upper_bound(first, places_.end(), s + R_);
            return concentration(dimensions, R_, x,
                                 std::span(near_).subspan(static_cast<std::size_t>(first - places_.begin()),
                                                          static_cast<std::size_t>(last - first)));
        }
        double open_fraction(const Vec3& x) const { return solids_.open_fraction(x, R_); }
        double top() const { return places_.empty() ? -R_ : places_.back(); }
        double bottom() const { return places_.empty() ? 0.0 : places_.front(); }
        double R() const { return R_; }

      private:
        double R_;
        std::vector<NearParticle> near_;
        Solids solids_;
        std::vector<double> places_;  // [m] from the line's beginning
    };

    bool is_filled(const RunView& run, const Line& line, double s) const {
        const int dimensions = run.particles.dimensions;
        const Vec3 x = between(from_, to_, s / length_);
        const double c = line.concentration_at(x, s, dimensions);
        if (c >= 0.5) return true;
        // Even a gauge in a corner of three walls has an eighth of its support open.
        if (c < 0.5 / 8.0) return false;
        return c >= 0.5 * line.open_fraction(x);
    }

    // Half a spacing: no fluid that is thick enough to be seen fits between two points.
    static double step_along(const RunView& run) { return 0.5 * run.spacing; }

    double find_highest(const RunView& run, const Line& line) const {
        const double step = step_along(run);
        double dry = std::min(length_, line.top() + line.R());
        if (dry <= 0.0) return 0.0;
        if (is_filled(run, line, dry)) return dry;
        for (double wet = dry; wet > 0.0 && dry > line.bottom() - line.R(); dry = wet) {
            wet = std::max(0.0, wet - step);
            if (is_filled(run, line, wet)) return refine(run, line, wet, dry);
        }
        return 0.0;
    }

    double find_lowest(const RunView& run, const Line& line) const {
        // On the fluid's own lower edge the kernel is just half full.
        double wet = std::min(length_, step_along(run));
        if (!is_filled(run, line, wet)) return is_filled(run, line, 0.0) ? refine(run, line, 0.0, wet) : 0.0;
        for (double next = wet; wet < length_; wet = next) {
            next = std::min(length_, wet + step_along(run));
            if (!is_filled(run, line, next)) return refine(run, line, wet, next);
        }
        return length_;
    }

    double refine(const RunView& run, const Line& line, double wet, double dry) const {
        // To a ten-thousandth of a spacing.
        while (dry - wet > 1e-4 * run.spacing) {
            const double middle = 0.5 * (wet + dry);
            (is_filled(run, line, middle) ? wet : dry) = middle;
        }
        return 0.5 * (wet + dry);
    }

    Vec3 from_, to_;
    proto::LevelSurface surface_;
    double length_;
};

}  // namespace

std::unique_ptr<Probe> make_probe(const proto::LevelProbe& desc, int) {
    return std::make_unique<Level>(desc);
}

}  // namespace headrace::probes
