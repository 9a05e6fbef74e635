// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>

#include "tessera/config/case.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/edge_levels.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief A coarse mesh and the levels of its edges.
struct LevelledMesh {
  mesh::CoarseMesh mesh{};
  mesh::EdgeLevels levels{};

  static auto fields(auto& self) { return std::tie(self.mesh, self.levels); }
};

/// @brief The coarse mesh such that it can be opened by `[[split]]` and `[[geometry.contact]]`.
/// @note Collective: a job of rank 0 if something is to be done. @throws on every rank as
/// topology::divide_at_rims().
[[nodiscard]] mesh::CoarseMesh run_rim_stage(const config::Case& run_case, mesh::CoarseMesh coarse,
                                             RunContext& context);

/// @brief The coarse mesh, open along the patches of `[[split]]`.
/// @note Collective. @throws on every rank as topology::split_patches().
[[nodiscard]] LevelledMesh run_split_stage(const config::Case& run_case, const LevelledMesh& closed,
                                           RunContext& context);

}  // namespace tessera::pipeline
