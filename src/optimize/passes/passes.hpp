// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/optimize/schedule.hpp"

#include "optimize/working_mesh.hpp"

namespace tessera::optimize {

// One pass each, over what has changed since the last one of its kind; in the order of the arrays.

void run_step(WorkingMesh& mesh, Step step, const Schedule& schedule);

void smooth_pass(WorkingMesh& mesh);
void smooth_worst_pass(WorkingMesh& mesh, const Schedule& schedule);
void swap_pass(WorkingMesh& mesh, const Schedule& schedule);
void collapse_pass(WorkingMesh& mesh, const Schedule& schedule);
void insert_pass(WorkingMesh& mesh, const Schedule& schedule);
void divide_pass(WorkingMesh& mesh);

}  // namespace tessera::optimize
