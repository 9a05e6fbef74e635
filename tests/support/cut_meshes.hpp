// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "tessera/cut/cut_mesh.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/model.hpp"

namespace tessera::testing {

/// @brief A tree in the making. Without planes below it, a leaf.
struct Branch {
  cut::Plane plane{};
  std::shared_ptr<Branch> below{};
  std::shared_ptr<Branch> above{};
};

[[nodiscard]] Branch leaf();
[[nodiscard]] Branch branch(const cut::Plane& plane, const Branch& below, const Branch& above);

/// @brief The tree of these solids; parts from 0 in the order of the leaves.
[[nodiscard]] cut::CutTree tree_of(const std::vector<Branch>& solids);

[[nodiscard]] double volume_of(const mesh::CoarseMesh& mesh, LocalIndex material);

/// @brief Expects each tet with all its corners in the cell of its part, and every part to have
/// some.
/// @param[in] tolerance By how much a corner may be beyond a plane.
void expect_parts_in_their_cells(const cut::CutMesh& cut, const cut::CutTree& tree,
                                 double tolerance);

/// @brief Expects the same names of patches and materials, and each patch on the same surface.
void expect_same_names(const mesh::CoarseMesh& cut, const mesh::CoarseMesh& uncut);

/// @brief Expects corners of faces on the surface of their patch, and ends of segments on their
/// curve.
void expect_points_on_surfaces(const mesh::CoarseMesh& mesh, const model::Model& model,
                               double tolerance);

}  // namespace tessera::testing
