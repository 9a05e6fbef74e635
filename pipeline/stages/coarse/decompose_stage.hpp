// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "tessera/config/case.hpp"
#include "tessera/decompose/decompose.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "pipeline/run_result.hpp"
#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief Cuts the coarse mesh of a run, with its levels, into subdomains on rank 0 and gives the
/// result to all ranks.
/// @note Collective.
/// @throws ConfigError on every rank if a region names an unknown material.
[[nodiscard]] decompose::DecomposeResult run_decompose_stage(const RunResult& run,
                                                             RunContext& context);

/// @brief What to say if the case asks for more subdomains than there are coarse tets. Local.
[[nodiscard]] std::optional<std::string> too_many_subdomains(const config::Case& run_case,
                                                             const mesh::CoarseMesh& coarse);

}  // namespace tessera::pipeline
