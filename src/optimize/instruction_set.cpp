// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/optimize/instruction_set.hpp"

#include "optimize/kernels.hpp"

namespace tessera::optimize {
namespace {

std::vector<InstructionSet> find_instruction_sets()
{
  std::vector<InstructionSet> sets{InstructionSet::baseline};
#ifdef TESSERA_X86_KERNELS
  if (__builtin_cpu_supports("avx2") != 0) sets.push_back(InstructionSet::avx2);
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0) {
    sets.push_back(InstructionSet::avx512);
  }
#endif
  return sets;
}

}  // namespace

const std::vector<InstructionSet>& available_instruction_sets()
{
  static const std::vector<InstructionSet> sets = find_instruction_sets();
  return sets;
}

std::string_view name_of(InstructionSet set)
{
  switch (set) {
    case InstructionSet::avx2:
      return "AVX2";
    case InstructionSet::avx512:
      return "AVX-512";
    default:
      return "baseline";
  }
}

const Kernels& kernels_of([[maybe_unused]] InstructionSet set)
{
#ifdef TESSERA_X86_KERNELS
  if (set == InstructionSet::avx2) return kAvx2Kernels;
  if (set == InstructionSet::avx512) return kAvx512Kernels;
#endif
  return kBaselineKernels;
}

}  // namespace tessera::optimize
