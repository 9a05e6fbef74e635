// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/delaunay/cut_by_surface.hpp"
#include "tessera/delaunay/tetrahedralize.hpp"
#include "tessera/surface/coarse_surface.hpp"

namespace tessera::coarse {

/// @brief Delaunay tets inside of a skin that are tets of its domain. Those that cross the skin are
/// not: they leave *holes*. Local.
///
/// A hole is bounded by triangles of the skin, those that are faces of no tet among them, and by
/// faces of tets that are kept.
class KeptTets {
 public:
  /// @param[in] xyz  Vertices of the skin, then the points inside of it.
  /// @param[in] lattice_side  As tetrahedralize().
  /// @pre Skin and points outlive this.
  /// @throws MeshError as tetrahedralize(), and if the skin cuts itself.
  KeptTets(const surface::DomainSkin& skin, std::span<const double> xyz,
           std::span<const double> lattice_side);

  /// @brief Takes out flat tets with those beside them. No step of an optimiser helps if two faces
  /// of a flat one are of the skin. What fills the space of its neighbours too has other edges
  /// there.
  void take_out_flat();

  /// @brief Takes out all tets at these vertices.
  void take_out_around(std::span<const LocalIndex> vertices);

  /// @brief Closed surfaces that no tet fills. No two share a vertex. Makes them larger first where
  /// one would touch itself along an edge inside of the domain.
  /// @return `vertex` holds rows of `xyz`; triangles inside of the domain have a patch of their
  /// own, the last.
  [[nodiscard]] std::vector<surface::DomainSkin> holes();

  /// @brief Shape (num_kept, 4): rows of `xyz`.
  [[nodiscard]] std::vector<LocalIndex> tet_vertices() const;

 private:
  struct HoleTriangle {
    LocalIndex hole = 0;                   // Lowest vertex of those that hang together with it.
    std::array<LocalIndex, 3> vertices{};  // Normals point out of the hole.
    LocalIndex patch = 0;
  };

  [[nodiscard]] bool is_kept(LocalIndex tet) const
  {
    return cut_.tet_side[at(tet)] == delaunay::Side::inside;
  }
  void take_out(LocalIndex tet) { cut_.tet_side[at(tet)] = delaunay::Side::crossed; }
  [[nodiscard]] std::span<const LocalIndex, 4> vertices_of(LocalIndex tet) const
  {
    return std::span(tets_.tet_vertices).subspan(4 * at(tet)).first<4>();
  }
  [[nodiscard]] bool is_flat(LocalIndex tet) const;
  [[nodiscard]] const IndexLists& stars();
  [[nodiscard]] std::vector<HoleTriangle> hole_triangles() const;
  bool open_pinches(std::span<const HoleTriangle> triangles);
  void sort_by_hole(std::vector<HoleTriangle>& triangles) const;
  [[nodiscard]] surface::DomainSkin hole_of(std::span<const HoleTriangle> triangles) const;

  const surface::DomainSkin& skin_;
  std::span<const double> xyz_;
  LocalIndex inner_patch_;
  delaunay::Tetrahedralization tets_;
  delaunay::SurfaceCut cut_;
  IndexLists stars_{};  // Tets at each vertex; made when they are asked for.
};

}  // namespace tessera::coarse
