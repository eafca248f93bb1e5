#include "server/solver/models/wcsph/solid_loads.h"

#include "server/solver/boundaries/rigid_motion.h"

namespace headrace::solver {
namespace {

template <int D>
void add_loads(const WcsphView& view, const SolidSums& sums, const TermOptions& options,
               std::vector<ObjectLoad>& loads) {
    const PairTerms<D> terms(view, options);
    const auto add = [&](std::size_t object, Index i, const std::array<double, D>& a) {
        Vec3 x{}, force{};
        for (int k = 0; k < D; ++k) {
            x[k] = view.particles.x[k][i];
            force[k] = -view.particles.m[i] * a[k];
        }
        loads[object].force = rigid::plus(loads[object].force, force);
        loads[object].torque = rigid::plus(loads[object].torque, rigid::cross(x, force));
    };
    for (Index i = 0; i < view.particles.size(); ++i) {
        const std::array<double, D> x = vector_at<D>(view.particles.x, i);
        if (!view.solid.is_near(x)) continue;
        for (std::size_t object = 0; object < sums.objects.size(); ++object) {
            const PressureSums<D, double> of_object{vector_at<D>(sums.objects[object].grad_1, i),
                                                    vector_at<D>(sums.objects[object].pB_grad, i)};
            add(object, i, terms.wall_pressure(i, of_object));
        }
        if (options.viscosity.mu > 0.0) {
            terms.for_each_solid_viscosity(
                i, [&](std::size_t object, const std::array<double, D>& a) { add(object, i, a); });
        }
    }
}

}  // namespace

void add_solid_loads(const WcsphView& view, const SolidSums& sums, const TermOptions& options,
                     std::vector<ObjectLoad>& loads) {
    if (view.particles.dimensions == 2) {
        add_loads<2>(view, sums, options, loads);
    } else {
        add_loads<3>(view, sums, options, loads);
    }
}

}  // namespace headrace::solver
