#include "server/probes/solids.h"

#include <algorithm>

#include "server/probes/interpolation.h"
#include "server/probes/vectors.h"
#include "server/solver/boundaries/rigid_motion.h"

namespace headrace::probes {

Solids::Solids(const solver::Surroundings& surroundings, int dimensions) : dimensions_(dimensions) {
    for (const solver::CollisionObject& object : surroundings.objects) {
        Solid solid{solver::make_body(object, surroundings.domain, dimensions), {}};
        if (object.motion) solid.state = object.motion(surroundings.time);
        solids_.push_back(std::move(solid));
    }
}

bool Solids::hold(const Vec3& x) const {
    return std::any_of(solids_.begin(), solids_.end(), [&](const Solid& solid) {
        const Vec3 X = solid.state ? solver::rigid::to_body(*solid.state, x) : x;
        return solver::nearest_surface(solid.body, X).distance < 0.0;
    });
}

double Solids::open_fraction(const Vec3& x, double R) const {
    constexpr int kHalf = 4;
    const double step = R / kHalf;
    const int first = dimensions_ == 3 ? -kHalf : 0, last = dimensions_ == 3 ? kHalf : 1;
    double open = 0.0, all = 0.0;
    // Points stand at odd multiples of half the step: symmetric, and none on a wall through x.
    for (int i = -kHalf; i < kHalf; ++i)
        for (int j = -kHalf; j < kHalf; ++j)
            for (int k = first; k < last; ++k) {
                const Vec3 d{(i + 0.5) * step, (j + 0.5) * step, dimensions_ == 3 ? (k + 0.5) * step : 0.0};
                const double W = wendland_c2(dimensions_, R, length(d));
                if (W == 0.0) continue;
                all += W;
                if (!hold({x[0] + d[0], x[1] + d[1], x[2] + d[2]})) open += W;
            }
    return open / all;
}

}  // namespace headrace::probes
