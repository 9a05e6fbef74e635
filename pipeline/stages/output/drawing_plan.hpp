// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "pipeline/drawing/mesh_scene.hpp"
#include "pipeline/run_result.hpp"

namespace tessera::pipeline {

/// @brief What the report needs of one file of tets and its file of boundary triangles.
struct FileToDraw {
  LocalIndex number = 0;
  bool has_boundary = false;  ///< Its boundary triangles are drawn.
  bool has_surface = false;   ///< They are part of the surface to turn.
  bool has_quality = false;   ///< That shows the quality of the tets behind.
  bool is_cut = false;        ///< Its tets are drawn where a plane cuts them.

  [[nodiscard]] bool reads_boundary() const { return has_boundary || has_surface; }
  [[nodiscard]] bool reads_tets() const { return has_quality || is_cut; }
};

/// @brief What is drawn from files, and what from the coarse mesh. Depends on counts alone, never
/// on ranks or time.
struct DrawingPlan {
  std::vector<FileToDraw> files{};       ///< Those that are needed, ascending.
  GlobalIndex num_tets = 0;              ///< That are read.
  std::vector<LocalIndex> coarse_cut{};  ///< Ascending; subdomains whose tets would take too long.
  bool is_coarse_boundary = false;
  bool is_coarse_surface = false;
};

/// @brief Plans the pictures and the surface to turn. What is read is bounded, whatever the size of
/// the mesh. Local.
/// @param[in] files That hold the pieces; empty: there are no files.
[[nodiscard]] DrawingPlan plan_drawing(const RunResult& run, const subdomain::PartitionedMesh& cut,
                                       const MeshScene& scene,
                                       const std::vector<subdomain::SubdomainRange>& files);

}  // namespace tessera::pipeline
