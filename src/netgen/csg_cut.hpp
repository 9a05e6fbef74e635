// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include <csg.hpp>
#include <meshing.hpp>

#include "tessera/base/types.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

#include "netgen/mesh_conversion.hpp"

namespace tessera::netgen {

/// @brief What the top-level objects of a cut geometry were before. Rows of both arrays are
/// top-level objects, domains less 1.
struct CutObjects {
  std::vector<LocalIndex> solid{};  ///< Top-level object of the uncut geometry, from 0.
  std::vector<LocalIndex> part{};   ///< Of the tree; kNoIndex: a surface.
  LocalIndex num_surfaces = 0;      ///< Of the uncut geometry; planes of cuts come after them.
};

/// @brief Replaces the solids to be meshed by their parts. Planes come after all surfaces, so
/// surfaces keep their numbers.
/// @throws NetgenError if the geometry identifies faces or has singular ones: these are told by
/// the numbers of its solids.
[[nodiscard]] CutObjects cut_geometry(::netgen::CSGeometry& geometry, const cut::CutTree& tree);

/// @brief The faces of an uncut geometry in NETGEN's order, which numbers patches.
class FaceOrder {
 public:
  /// @brief Meshes the edges of the geometry, which NETGEN finds its faces by.
  FaceOrder(::netgen::CSGeometry& uncut, ::netgen::MeshingParameters parameters);

  /// @brief Row of the uncut face that a face of the cut geometry is of. New rows come last.
  [[nodiscard]] LocalIndex row_of(const ::netgen::FaceDescriptor& face, const CutObjects& objects);

 private:
  using Key = std::array<int, 4>;  // Surface, the two domains, and the top-level surface.
  std::map<Key, LocalIndex> rows_{};
};

/// @brief Gives every connected piece of a patch a patch of its own, as NETGEN does. Local.
void separate_patches(mesh::CoarseMesh& mesh);

}  // namespace tessera::netgen
