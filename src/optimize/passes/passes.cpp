// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/passes/passes.hpp"

namespace tessera::optimize {

void run_step(WorkingMesh& mesh, Step step, const Schedule& schedule)
{
  switch (step) {
    case Step::smooth:
      return smooth_pass(mesh);
    case Step::smooth_worst:
      return smooth_worst_pass(mesh, schedule);
    case Step::swap:
      return swap_pass(mesh, schedule);
    case Step::collapse:
      return collapse_pass(mesh, schedule);
    case Step::insert:
      return insert_pass(mesh, schedule);
    case Step::tighten:
      return tighten_bound(mesh);
    case Step::divide:
      return divide_pass(mesh);
  }
}

}  // namespace tessera::optimize
