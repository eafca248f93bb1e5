// The pair sums of the wcsph model behind one interface: which kernel, dimension, terms and instruction set a loop is
// made of is chosen here, once, never inside it.
#pragma once

#include <memory>

#include "server/solver/isa.h"
#include "server/solver/models/wcsph/passes.h"
#include "server/solver/models/wcsph/tension_passes.h"
#include "server/solver/smoothing_kernels.h"

namespace headrace::solver {

class WcsphSums {
  public:
    virtual ~WcsphSums() = default;

    virtual double W(double r) const = 0;      // [m^-D]
    virtual double F(double r) const = 0;      // [m^-(D+2)]
    virtual double dF_dr(double r) const = 0;  // [m^-(D+3)]

    virtual void geometry(const PairInput& in, const PassData& data, const GeometryOptions& options) = 0;
    virtual void continuity(const PairInput& in, const PassData& data, DensityDiffusion diffusion,
                            const ContinuityOptions& options) = 0;
    virtual void pressure(const PairInput& in, const PassData& data, bool is_adjoint,
                          const PressureOptions& options) = 0;
    virtual void viscosity(const PairInput& in, const PassData& data, bool is_morris,
                           const ViscosityOptions& options) = 0;
    virtual void continuum_tension(const PairInput& in, const PassData& data, const TensionOptions& options) = 0;
    virtual void thesis_tension(const PairInput& in, const PassData& data, const TensionOptions& options) = 0;
    virtual void wall_pressure(const PairInput& in, const PassData& data, const WallPressureOptions& options) = 0;
};

std::unique_ptr<WcsphSums> make_wcsph_sums(int dimensions, KernelKind kernel, double support, Isa isa);

// The two makers behind it, a file each: the default kernel, and any.
std::unique_ptr<WcsphSums> make_wendland_sums(int dimensions, double support, Isa isa);
std::unique_ptr<WcsphSums> make_any_kernel_sums(int dimensions, KernelKind kernel, double support, Isa isa);

}  // namespace headrace::solver
