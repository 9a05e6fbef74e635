// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/topology/options.hpp"

namespace tessera::topology {

/// @brief How a face is opened. Faces of one patch that are opened alike stay one patch.
struct Opening {
  bool is_open = false;
  /// Of a joint: which of SplitOptions::joints there is on either side, or kNoIndex. Ascending.
  std::array<LocalIndex, 2> joints{kNoIndex, kNoIndex};
  bool is_wake = false;

  [[nodiscard]] bool is_joint() const { return is_wake || joints[1] != kNoIndex; }
  friend auto operator<=>(const Opening&, const Opening&) = default;
};

/// @brief The faces along which a mesh is to be opened, and what there is on both sides.
class SplitFaces {
 public:
  /// @throws ConfigError if an entry fits no patch, or one on the outside, or no
  /// solid.
  SplitFaces(const mesh::CoarseMesh& mesh, const SplitOptions& options);

  /// @brief Those of the wakes of a mesh. @pre Nothing else is open at their vertices.
  explicit SplitFaces(const mesh::CoarseMesh& mesh);

  [[nodiscard]] const std::vector<LocalIndex>& faces() const { return faces_; }  ///< Ascending.
  [[nodiscard]] const Opening& opening(LocalIndex face) const { return openings_[at(face)]; }
  [[nodiscard]] bool is_split(LocalIndex face) const { return opening(face).is_open; }
  /// @brief The tets of any face: first that of the body with the lower number; inside of a body,
  /// that on the side which the face's normal points to. Of a joint, in the order of its opening.
  [[nodiscard]] const std::array<LocalIndex, 2>& tets(LocalIndex face) const
  {
    return tets_[at(face)];
  }

  /// @brief Which of the sides of a vertex a tet is on, from 0. Tets around a vertex are on one
  /// side if they hang together by triangles that are not split.
  [[nodiscard]] LocalIndex side(LocalIndex tet, LocalIndex vertex) const
  {
    return side_[corner(tet, vertex)];
  }
  [[nodiscard]] LocalIndex num_sides(LocalIndex vertex) const { return num_sides_[at(vertex)]; }

  /// @brief Whether a split face parts its tets at one of its vertices.
  [[nodiscard]] bool is_parted(LocalIndex face, LocalIndex vertex) const
  {
    return side(tets(face)[0], vertex) != side(tets(face)[1], vertex);
  }

 private:
  [[nodiscard]] std::size_t corner(LocalIndex tet, LocalIndex vertex) const;
  [[nodiscard]] bool is_minus_first(LocalIndex face, const std::array<LocalIndex, 2>& tets) const;
  void find_faces(const SplitOptions& options, std::span<const mesh::TriangleTets> triangles);
  void find_sides(std::span<const mesh::TriangleTets> triangles);
  void drop_closed_joints();

  const mesh::CoarseMesh& mesh_;
  std::vector<Opening> openings_{};  // Shape (num_faces).
  std::vector<std::array<LocalIndex, 2>> tets_{};
  std::vector<LocalIndex> faces_{};
  std::vector<LocalIndex> side_{};       // Shape (num_tets, 4).
  std::vector<LocalIndex> num_sides_{};  // Shape (num_vertices).
};

}  // namespace tessera::topology
