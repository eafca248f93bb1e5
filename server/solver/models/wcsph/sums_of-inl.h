// WcsphSums for one kernel type and precision, for the instruction set this file is compiled for.
#include "server/solver/models/wcsph/sums.h"
#include "server/solver/pairs/packed_fields-inl.h"
#include "server/solver/pairs/pair_sums-inl.h"

#if defined(HEADRACE_WCSPH_SUMS_OF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEADRACE_WCSPH_SUMS_OF_INL_H
#undef HEADRACE_WCSPH_SUMS_OF_INL_H
#else
#define HEADRACE_WCSPH_SUMS_OF_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace headrace::solver::HWY_NAMESPACE {

template <int D, class Kernel, class S>
class SumsOf final : public WcsphSums {
  public:
    SumsOf(const Kernel& kernel, const PairNeighboursOf<S>& neighbours, double support)
        : kernel_(kernel), neighbours_(neighbours), support_(support) {}

    double W(double r) const override { return kernel_.W(r); }
    double F(double r) const override { return kernel_.F(r); }
    double dF_dr(double r) const override { return kernel_.dF_dr(r); }

    void geometry(const PassData& data, const GeometryOptions& options) override {
        if (options.shifting || options.reconstructs) {
            run(GeometryPass<D, Kernel, true>{kernel_, data, options});
        } else {
            run(GeometryPass<D, Kernel, false>{kernel_, data, options});
        }
    }

    void continuity(const PassData& data, DensityDiffusion diffusion, const ContinuityOptions& options) override {
        using enum DensityDiffusion;
        if (diffusion == none) {
            run(ContinuityPass<D, Kernel, none>{kernel_, data, options});
        } else if (diffusion == antuono) {
            run(ContinuityPass<D, Kernel, antuono>{kernel_, data, options});
        } else {
            run(ContinuityPass<D, Kernel, fourtakas>{kernel_, data, options});
        }
    }

    void pressure(const PassData& data, bool is_adjoint, const PressureOptions& options) override {
        const bool has_alpha = options.artificial_viscosity != 0.0;
        if (is_adjoint && has_alpha) {
            run(PressurePass<D, Kernel, true, true>{kernel_, data, options});
        } else if (is_adjoint) {
            run(PressurePass<D, Kernel, true, false>{kernel_, data, options});
        } else if (has_alpha) {
            run(PressurePass<D, Kernel, false, true>{kernel_, data, options});
        } else {
            run(PressurePass<D, Kernel, false, false>{kernel_, data, options});
        }
    }

    void viscosity(const PassData& data, bool is_morris, const ViscosityOptions& options) override {
        if (is_morris) {
            run(ViscosityPass<D, Kernel, true>{kernel_, data, options});
        } else {
            run(ViscosityPass<D, Kernel, false>{kernel_, data, options});
        }
    }

    void continuum_tension(const PassData& data, const TensionOptions& options) override {
        run(SurfaceStressPass<D, Kernel>{kernel_, data, options});
        run(ContinuumTensionPass<D>{TensionKernel<D>(support_), data, options});
    }

    void thesis_tension(const PassData& data, const TensionOptions& options) override {
        run(ThesisTensionPass<D, Kernel>{kernel_, data, options});
    }

    void wall_pressure(const PassData& data, const WallPressureOptions& options) override {
        const WallPressurePass<D, Kernel> pass{kernel_, data, options};
        if (!neighbours_.has_walls()) return;
        fields_.fill(pass.fluid_fields(), neighbours_.fluid().size());
        sum(pass, neighbours_.walls(), {&neighbours_.wall_to_fluid(), &neighbours_.fluid(), fields_.fluid()}, {});
    }

    void release() override { fields_.release(); }

  private:
    // With the fluid as centres.
    template <class Pass>
    void run(const Pass& pass) {
        fields_.fill(pass.fluid_fields(), neighbours_.fluid().size(), pass.wall_fields(), neighbours_.walls().size());
        NeighbourSource<S> walls;
        if (neighbours_.has_walls()) walls = {&neighbours_.fluid_to_wall(), &neighbours_.walls(), fields_.walls()};
        sum(pass, neighbours_.fluid(), {&neighbours_.among_fluid(), &neighbours_.fluid(), fields_.fluid()}, walls);
    }

    template <class Pass>
    void sum(const Pass& pass, const ClusterPoints<S>& centres, const NeighbourSource<S>& fluid,
             const NeighbourSource<S>& walls) {
        parallel_for(fluid.list->blocks().size(), 2, [&](std::size_t first, std::size_t last, int) {
            for (std::size_t b = first; b < last; ++b) sum_block<D, S>(pass, centres, fluid, walls, b);
        });
    }

    Kernel kernel_;
    const PairNeighboursOf<S>& neighbours_;
    double support_;
    PackedFields<S> fields_;
};

template <int D, class Kernel>
WcsphSums* make_sums_of(const Kernel& kernel, const PairNeighbours& neighbours, double support) {
    if (neighbours.arithmetic() == Arithmetic::double_precision)
        return new SumsOf<D, Kernel, double>(kernel, static_cast<const PairNeighboursOf<double>&>(neighbours), support);
    return new SumsOf<D, Kernel, float>(kernel, static_cast<const PairNeighboursOf<float>&>(neighbours), support);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace headrace::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
