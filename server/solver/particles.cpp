#include "server/solver/particles.h"

namespace headrace::solver {

void Particles::resize(std::size_t count) {
    id.resize(count);
    for (VectorField* field : {&x, &v_half, &v, &a}) {
        for (int axis = 0; axis < 3; ++axis) (*field)[axis].resize(axis < dimensions ? count : 0);
    }
    m.resize(count);
    rho.resize(count);
    p.resize(count);
}

}  // namespace headrace::solver
