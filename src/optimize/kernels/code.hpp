// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The body of kernels_*.cpp, which include it inside an unnamed namespace: the same code for every
// instruction set.
//
// Written with the vector extension of GCC and Clang rather than a library. Four lanes of doubles
// are one register with AVX2 and AVX-512, two with SSE2 or NEON. The arithmetic and its order are
// always the same, and so are the bits. std::experimental::simd and Highway choose the lanes by the
// instruction set, and so the order of sums; SIMDe would bind the code to the intrinsics of one
// set.
//
// No function of the standard library is called here. An inline one could be emitted with AVX
// instructions, and the linker may take that copy for the whole program.

#include "optimize/kernels/collapse.hpp"
#include "optimize/kernels/energies.hpp"
#include "optimize/kernels/smooth.hpp"
