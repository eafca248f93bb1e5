// The pair sums of the wcsph model behind one interface: which kernel, dimension, precision, terms and instruction set
// a loop is made of is chosen here, once, never inside it.
#pragma once

#include <memory>

#include "server/solver/models/wcsph/passes.h"
#include "server/solver/models/wcsph/tension_passes.h"
#include "server/solver/pairs/pair_neighbours.h"
#include "server/solver/smoothing_kernels.h"

namespace headrace::solver {

class WcsphSums {
  public:
    virtual ~WcsphSums() = default;

    virtual double W(double r) const = 0;      // [m^-D]
    virtual double F(double r) const = 0;      // [m^-(D+2)]
    virtual double dF_dr(double r) const = 0;  // [m^-(D+3)]

    // Over the neighbours given at the start, which must cover the places of now.
    virtual void geometry(const PassData& data, const GeometryOptions& options) = 0;
    virtual void continuity(const PassData& data, DensityDiffusion diffusion, const ContinuityOptions& options) = 0;
    virtual void pressure(const PassData& data, bool is_adjoint, const PressureOptions& options) = 0;
    virtual void viscosity(const PassData& data, bool is_morris, const ViscosityOptions& options) = 0;
    virtual void continuum_tension(const PassData& data, const TensionOptions& options) = 0;
    virtual void thesis_tension(const PassData& data, const TensionOptions& options) = 0;
    virtual void wall_pressure(const PassData& data, const WallPressureOptions& options) = 0;

    // Gives its memory back until the next pass.
    virtual void release() = 0;
};

struct SumsChoice {
    int dimensions{3};
    KernelKind kernel{KernelKind::wendland_c2};
    double support{};  // [m]
};

// In the best instruction set of the machine that Highway is not told to leave out.
std::unique_ptr<WcsphSums> make_wcsph_sums(const SumsChoice& choice, const PairNeighbours& neighbours);

}  // namespace headrace::solver
