// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/base/shared_bytes.hpp"
#include "tessera/config/case.hpp"
#include "tessera/io/options.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/number/id_layout.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/runtime/run_context.hpp"

/// Gives the workers of all ranks what their next jobs start from. All functions are collective and
/// throw on every rank if a worker dies, or Interrupted on a signal.
namespace tessera::pipeline {

/// @param[in] message Of share_mesh().
void load_mesh(const SharedBytes& message, RunContext& context);

/// @brief From now on fill jobs write the output files themselves. @param[in] counts Of all pieces.
void load_numbers(const std::vector<number::PieceCounts>& counts, const std::string& length_unit,
                  const io::OutputOptions& options, RunContext& context);

/// @param[in] kernels Shape (num_subdomains), as the case wants them.
void load_improvement(const config::Case& run_case, const std::vector<fill::KernelKind>& kernels,
                      RunContext& context);

/// @brief What the refine jobs start from.
void load_refinement(const RefineSettings& settings, const io::OutputOptions& options,
                     RunContext& context);

void load_limiter(const mesh::ProjectionLimiter& limiter, RunContext& context);

}  // namespace tessera::pipeline
