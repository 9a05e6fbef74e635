// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <tuple>
#include <vector>

#include "tessera/base/repair.hpp"
#include "tessera/coarse/model_figures.hpp"
#include "tessera/coarse/snap_vertices.hpp"
#include "tessera/config/case.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/sizing/coarse_sizes.hpp"

#include "pipeline/runtime/run_context.hpp"

namespace tessera::pipeline {

/// @brief The coarse mesh and how it was got.
struct CoarseResult {
  mesh::CoarseMesh mesh{};
  std::vector<LocalIndex> tet_part{};   ///< Of the parts it was meshed in; empty: as a whole.
  surface::CoarseOptions options{};     ///< Those of the try that succeeded.
  int tries = 0;                        ///< Tries that were needed, from 1.
  coarse::VertexDistance distance{};    ///< Output length unit.
  surface::Defeatured defeatured{};     ///< Output length unit.
  std::vector<std::string> failures{};  ///< What the tries before said, for the report.
  bool was_limited = false;             ///< A try ended for time or memory: not reproducible.
  RepairCounts repairs{};               ///< That are in this mesh, without those of the import.
  /// Where edges are longest in wanted sizes, if no finer mesh could be made for these; else 0.
  sizing::PartInSizes missed_size{};

  static auto fields(auto& self)
  {
    return std::tie(self.mesh, self.tet_part, self.options, self.tries, self.distance,
                    self.defeatured, self.failures, self.was_limited, self.missed_size,
                    self.repairs);
  }
};

/// @brief Makes the coarse mesh in jobs and gives it to all ranks. Surfaces of later tries are made
/// beside the first on ranks that are free (CoarseLadder); after the fallbacks comes Gmsh.
///
/// If parts that planes make of the model cannot be meshed, it is meshed as a whole.
/// @param[in] figures Of measure_model().
/// @param[in] planes Into which parts the model is cut; without nodes: not at all.
/// @note Collective.
/// @throws GeometryError, MeshError on every rank, with the words of every try, if none succeeds.
[[nodiscard]] CoarseResult run_coarse_stage(const config::Case& run_case,
                                            const std::optional<coarse::ModelFigures>& figures,
                                            const cut::CutTree& planes, RunContext& context);

/// @brief As run_coarse_stage(), of a run that has a mesh already and goes on with that one if no
/// try succeeds. Then the result, on all ranks, has no tets.
/// @note Collective.
[[nodiscard]] CoarseResult run_second_coarse_stage(
    const config::Case& run_case, const std::optional<coarse::ModelFigures>& figures,
    const CoarseResult& before, const cut::CutTree& planes, RunContext& context);

}  // namespace tessera::pipeline
