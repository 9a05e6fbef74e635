// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/optimize/instruction_set.hpp"

#include <algorithm>
#include <cstdlib>

#include "optimize/kernels/kernels.hpp"

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

// TESSERA_TEST_INSTRUCTION_SET is the name of the last one to be used: the tests show with it that
// no bit of the mesh depends on the processor. No option, for no user needs it.
std::vector<InstructionSet> up_to_wanted_set(std::vector<InstructionSet> sets)
{
  const char* const wanted = std::getenv("TESSERA_TEST_INSTRUCTION_SET");
  const auto last = std::ranges::find_if(
      sets, [&](InstructionSet set) { return wanted != nullptr && name_of(set) == wanted; });
  if (last != sets.end()) sets.erase(last + 1, sets.end());
  return sets;
}

}  // namespace

const std::vector<InstructionSet>& available_instruction_sets()
{
  static const std::vector<InstructionSet> sets = up_to_wanted_set(find_instruction_sets());
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
