// WcsphSums for one kernel type: instances of the pair loop for each pass and instruction set.
#pragma once

#include "server/solver/models/wcsph/sums.h"
#include "server/solver/parallel.h"

namespace headrace::solver {

// Occupied cells a thread takes at a time: some hundred particles, enough work to hide the hand-out.
inline constexpr std::size_t kPairCellBlock = 16;

// One instance per instruction set; the loop is inlined into each.
template <int D, class Pass>
void pairs_baseline(const PairInput& in, const Pass& pass, std::size_t first, std::size_t last, PairScratch& scratch) {
    sum_over_pairs<D>(in, pass, first, last, scratch);
}
template <int D, class Pass>
HEADRACE_TARGET_AVX2 void pairs_avx2(const PairInput& in, const Pass& pass, std::size_t first, std::size_t last,
                                     PairScratch& scratch) {
    sum_over_pairs<D>(in, pass, first, last, scratch);
}
template <int D, class Pass>
HEADRACE_TARGET_AVX512 void pairs_avx512(const PairInput& in, const Pass& pass, std::size_t first, std::size_t last,
                                         PairScratch& scratch) {
    sum_over_pairs<D>(in, pass, first, last, scratch);
}

template <int D, class Kernel>
class SumsOf final : public WcsphSums {
  public:
    SumsOf(const Kernel& kernel, Isa isa)
        : kernel_(kernel), isa_(isa), scratch_(static_cast<std::size_t>(max_threads())) {}

    double W(double r) const override { return kernel_.W(r); }
    double F(double r) const override { return kernel_.F(r); }
    double dF_dr(double r) const override { return kernel_.dF_dr(r); }

    void geometry(const PairInput& in, const PassData& data, const GeometryOptions& options) override {
        if (options.shifting || options.reconstructs) {
            run(in, GeometryPass<D, Kernel, true>{kernel_, data, options});
        } else {
            run(in, GeometryPass<D, Kernel, false>{kernel_, data, options});
        }
    }

    void continuity(const PairInput& in, const PassData& data, DensityDiffusion diffusion,
                    const ContinuityOptions& options) override {
        using enum DensityDiffusion;
        if (diffusion == none) {
            run(in, ContinuityPass<D, Kernel, none>{kernel_, data, options});
        } else if (diffusion == antuono) {
            run(in, ContinuityPass<D, Kernel, antuono>{kernel_, data, options});
        } else {
            run(in, ContinuityPass<D, Kernel, fourtakas>{kernel_, data, options});
        }
    }

    void pressure(const PairInput& in, const PassData& data, bool is_adjoint, const PressureOptions& options) override {
        const bool has_alpha = options.artificial_viscosity != 0.0;
        if (is_adjoint && has_alpha) {
            run(in, PressurePass<D, Kernel, true, true>{kernel_, data, options});
        } else if (is_adjoint) {
            run(in, PressurePass<D, Kernel, true, false>{kernel_, data, options});
        } else if (has_alpha) {
            run(in, PressurePass<D, Kernel, false, true>{kernel_, data, options});
        } else {
            run(in, PressurePass<D, Kernel, false, false>{kernel_, data, options});
        }
    }

    void viscosity(const PairInput& in, const PassData& data, bool is_morris,
                   const ViscosityOptions& options) override {
        if (is_morris) {
            run(in, ViscosityPass<D, Kernel, true>{kernel_, data, options});
        } else {
            run(in, ViscosityPass<D, Kernel, false>{kernel_, data, options});
        }
    }

    void continuum_tension(const PairInput& in, const PassData& data, const TensionOptions& options) override {
        run(in, SurfaceStressPass<D, Kernel>{kernel_, data, options});
        run(in, ContinuumTensionPass<D>{TensionKernel<D>(in.support), data, options});
    }

    void thesis_tension(const PairInput& in, const PassData& data, const TensionOptions& options) override {
        run(in, ThesisTensionPass<D, Kernel>{kernel_, data, options});
    }

    void wall_pressure(const PairInput& in, const PassData& data, const WallPressureOptions& options) override {
        run(in, WallPressurePass<D, Kernel>{kernel_, data, options});
    }

  private:
    template <class Pass>
    void run(const PairInput& in, const Pass& pass) {
        auto* const loop = isa_ == Isa::avx512 ? pairs_avx512<D, Pass>
                           : isa_ == Isa::avx2 ? pairs_avx2<D, Pass>
                                               : pairs_baseline<D, Pass>;
        if (scratch_.size() < static_cast<std::size_t>(max_threads()))
            scratch_.resize(static_cast<std::size_t>(max_threads()));
        parallel_for(in.centres.grid->cells(), kPairCellBlock, [&](std::size_t first, std::size_t last, int thread) {
            loop(in, pass, first, last, scratch_[static_cast<std::size_t>(thread)]);
        });
    }

    Kernel kernel_;
    Isa isa_;
    std::vector<PairScratch> scratch_;  // one per thread
};

}  // namespace headrace::solver
