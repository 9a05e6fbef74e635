// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/optimize/optimize.hpp"

#include "optimize/kernels/kernels.hpp"
#include "optimize/passes/passes.hpp"
#include "optimize/passes/untangle.hpp"
#include "optimize/working_mesh.hpp"

namespace tessera::optimize {

OptimizeResult optimize(const TetMesh& mesh, const Schedule& schedule,
                        const OptimizeOptions& options)
{
  const InstructionSet set = options.instruction_set.value_or(available_instruction_sets().back());
  WorkingMesh working = make_working_mesh(mesh, kernels_of(set), options.untangle);
  if (options.untangle) {
    working.statistics.num_untangled = count_not_positive(working);
    untangle(working);
    require_positive(working);
  }
  tighten_bound(working);
  for (const Step step : schedule.steps) {
    run_step(working, step, schedule);
    ++working.statistics.num_passes;
  }
  return to_result(working, mesh);
}

}  // namespace tessera::optimize
