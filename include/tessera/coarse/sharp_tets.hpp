// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::coarse {

/// @brief A tet with a small dihedral angle, and where it is.
struct SharpTet {
  double angle_deg = 0.0;             ///< Its smallest dihedral angle.
  double shortest_edge = 0.0;         ///< Its length.
  Vec3 centre{};                      ///< Mean of the corners.
  std::vector<LocalIndex> patches{};  ///< Rows of patches that it touches, ascending.
};

/// @brief The tets of a coarse mesh with small angles.
struct SharpTets {
  LocalIndex num_forced = 0;  ///< At sharp places of the model.
  LocalIndex num_others = 0;
  std::vector<SharpTet> worst{};  ///< Of the others, the smallest angle first; kMost at most.

  static constexpr std::size_t kMost = 10;
};

/// @brief Finds tets with a dihedral angle below `angle_deg`, and which of them the model forces.
/// Local.
///
/// The model forces an angle in two places:
/// - Between faces: at a boundary edge the tets of one material fill less than twice `angle_deg`,
///   and the tet is one of them.
/// - In a face: two curves meet at less than twice `angle_deg`, so there is a triangle that sharp
/// at
///   the tip. Triangles as sharp that follow it by edges belong to it, since the face is as narrow
///   there. A tet with an edge of one of these triangles is forced.
[[nodiscard]] SharpTets find_sharp_tets(const mesh::CoarseMesh& mesh, double angle_deg);

}  // namespace tessera::coarse
