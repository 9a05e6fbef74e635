// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/mesh_arrays.hpp"

namespace tessera::testing {

/// @brief The unit cube as a mesh of many pieces, each made when it is asked for: what a run that
/// is too large for memory leaves in its files.
///
/// 8^levels cubes of 6 n^3 tets (Kuhn) each, in the order of a Z curve, so that neighbours in space
/// have neighbouring numbers. Ids are dense and numbered as a run does: first the points that
/// pieces share, then those inside each piece.
class BoxPieces {
 public:
  /// @pre 0 <= levels <= 10, n >= 1
  BoxPieces(int levels, GlobalIndex n);

  [[nodiscard]] LocalIndex num_pieces() const { return LocalIndex{1} << (3 * levels_); }
  [[nodiscard]] GlobalIndex tets_per_piece() const { return 6 * n_ * n_ * n_; }

  /// @brief Tets with ids, "attribute" 1 and "subdomain".
  [[nodiscard]] mesh::MeshArrays tets(LocalIndex piece) const;
  /// @brief Triangles on the surface of the cube with ids, "patch", "subdomain" and "tet".
  [[nodiscard]] mesh::MeshArrays boundary(LocalIndex piece) const;

 private:
  using Cell = std::array<GlobalIndex, 3>;  // Place in a grid.

  [[nodiscard]] Cell place_of(LocalIndex piece) const;
  [[nodiscard]] GlobalIndex point_id(const Cell& point) const;
  [[nodiscard]] Vec3 position(const Cell& point) const;
  template <class Visit>
  void for_each_tet(LocalIndex piece, const Visit& visit) const;

  int levels_;
  GlobalIndex n_;                               // Cells of a piece along an axis.
  GlobalIndex side_;                            // Pieces along an axis.
  std::array<GlobalIndex, 8> first_of_kind_{};  // First id of each kind of point.
};

}  // namespace tessera::testing
