// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

namespace tessera::optimize {

/// @brief What the vector kernels were compiled for. All of them give the same bits.
enum class InstructionSet {
  baseline,  ///< What the whole library is compiled for: SSE2 on x86-64, NEON on AArch64.
  avx2,
  avx512,  ///< AVX-512 F and VL, on vectors of 256 bits.
};

/// @brief Those that were compiled and that this processor has, the fastest last. Local.
[[nodiscard]] const std::vector<InstructionSet>& available_instruction_sets();

[[nodiscard]] std::string_view name_of(InstructionSet set);

}  // namespace tessera::optimize
