// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/kernels/kernels.hpp"

namespace tessera::optimize {
namespace {

#include "optimize/kernels/code.hpp"

}  // namespace

const Kernels kAvx2Kernels{tet_energies, smooth_vertices<1>, smooth_vertices<4>, find_best_collapse,
                           measure_ring_of_four};

}  // namespace tessera::optimize
