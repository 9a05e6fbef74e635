// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/skin.hpp"
#include "tessera/mesh/triangle_grading.hpp"
#include "tessera/subdomain/refine_piece.hpp"

#include "subdomain/geometry_places.hpp"
#include "subdomain/piece_complex.hpp"

namespace tessera::subdomain {

// The surface of a piece that is split: what of it lies on the geometry, what on seams, and the
// points of both.
class SplitSurface {
 public:
  // @param[in] splits Levels of the split. The rest is borrowed.
  SplitSurface(const mesh::Piece& piece, const PieceSurroundings& around,
               const PartitionedMesh& cut, const GeometryFinder& finder, int splits);

  // The piece and the tets of its neighbours.
  [[nodiscard]] const PieceComplex& all() const { return all_; }

  // What lies on the geometry, as far as it matters: the complex of the skin comes first, then
  // other triangles of places().
  [[nodiscard]] mesh::RefinedLattice known_points(const refine::RefineContext& refine) const;

  // All lattice points. Their distances to the model are those of the skin alone: other triangles
  // are of other skins.
  [[nodiscard]] mesh::RefinedLattice points(const mesh::RefinedLattice& known,
                                            const mesh::ProjectionLimiter& limiter) const;

  // That of the subdomain, of the coarse mesh.
  [[nodiscard]] const mesh::Complex& skin() const { return skin_; }

  [[nodiscard]] const GeometryPlaces& places() const { return places_; }

  // Intervals of an edge of the piece.
  [[nodiscard]] LocalIndex intervals() const { return n_; }

  // Of the lattice in which the points of a triangle of the skeleton stand after the split.
  [[nodiscard]] LocalIndex intervals_of_triangle(LocalIndex triangle) const
  {
    return mesh::lattice::intervals(finder_.level_of(triangle) + splits_);
  }

  // Of an edge of the skeleton after the split.
  [[nodiscard]] LocalIndex intervals_of_skeleton_edge(LocalIndex edge) const
  {
    return mesh::lattice::intervals(finder_.level_of_edge(edge) + splits_);
  }

  // What makes the small triangles of a triangle of the skeleton.
  [[nodiscard]] mesh::TriangleGrading grading_of(LocalIndex triangle) const
  {
    return finder_.grading_of(triangle);
  }

  // The piece's surface with these points and the names that owners give.
  [[nodiscard]] mesh::Skin named_skin(const mesh::RefinedLattice& points) const;

  // Calls visit(simplex, kind, first point, number of points) for the piece's surface, in the order
  // of its points.
  template <class Visit>
  void for_each_surface_simplex(Visit&& visit) const
  {
    LocalIndex first = 0;
    const auto walk = [&](const std::vector<LocalIndex>& rows, mesh::HostKind kind) {
      const LocalIndex points_each = mesh::num_points_of_host(kind, n_);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i] == kNoIndex) continue;
        visit(i, kind, first, points_each);
        first += points_each;
      }
    };
    const mesh::Complex& faces = all_.complex.faces;
    walk(faces.vertex_skeleton, mesh::HostKind::vertex);
    walk(faces.edge_skeleton, mesh::HostKind::edge);
    walk(faces.triangle_skeleton, mesh::HostKind::triangle);
  }

  // One flag for each point of the surface. @param[in] size Of the result; the rest has 0.
  template <class Flag>
  [[nodiscard]] std::vector<std::uint8_t> surface_flags(std::size_t size, Flag&& flag) const
  {
    std::vector<std::uint8_t> flags(size, 0);
    for_each_surface_simplex(
        [&](std::size_t simplex, mesh::HostKind kind, LocalIndex first, LocalIndex num_points) {
          if (flag(simplex, kind)) std::fill_n(&flags[at(first)], num_points, 1);
        });
    return flags;
  }

  // Whether vertices inside this simplex of the complex move with the seam that it lies on.
  [[nodiscard]] bool is_free_on_seam(std::size_t simplex, mesh::HostKind kind) const;
  [[nodiscard]] bool is_on_geometry(std::size_t simplex, mesh::HostKind kind) const;
  [[nodiscard]] bool is_on_seam(std::size_t simplex, mesh::HostKind kind) const;

  // Edges of the complex that the piece has on lines: those of Piece::line.
  [[nodiscard]] std::vector<LocalIndex> edges_on_lines() const;

  // All new points on the geometry that these tets have stay midpoints from now on.
  [[nodiscard]] std::vector<mesh::PointLimit> limits_at(const std::vector<LocalIndex>& tets) const;

  // The same of triangles of the complex.
  [[nodiscard]] std::vector<mesh::PointLimit> limits_at_triangles(
      const std::vector<LocalIndex>& triangles) const;

 private:
  void tie_surface_to_geometry();
  [[nodiscard]] bool is_of_surface(std::size_t simplex, mesh::HostKind kind) const;

  // Calls visit(simplex, kind) for the faces of a tet and their edges and vertices, for some more
  // than once.
  template <class Visit>
  void for_each_face_of(LocalIndex tet, Visit&& visit) const
  {
    for (std::size_t c = 0; c < 4; ++c) {
      visit(at(all_.complex.tet_vertices[4 * at(tet) + c]), mesh::HostKind::vertex);
      const std::size_t t = at(all_.complex.tet_triangles[4 * at(tet) + c]);
      visit(t, mesh::HostKind::triangle);
      for (std::size_t side = 0; side < 3; ++side) {
        visit(at(all_.complex.faces.triangle_edges[3 * t + side]), mesh::HostKind::edge);
      }
    }
  }

  [[nodiscard]] bool needs_points_of(LocalIndex tet) const;
  [[nodiscard]] std::vector<char> needed_places() const;
  void order_places_by_need();
  [[nodiscard]] mesh::LatticeLevels levels_of(const mesh::Complex& complex) const;
  [[nodiscard]] bool is_outward(LocalIndex tet, std::size_t corner) const;
  [[nodiscard]] LocalIndex other_side(const GeometryPlace& place) const;

  const mesh::Piece& piece_;
  const PieceSurroundings& around_;
  const PartitionedMesh& cut_;
  const GeometryFinder& finder_;
  int splits_;
  LocalIndex n_;  // Intervals of an edge of the piece.
  PieceComplex all_;
  mesh::Complex skin_;
  GeometryPlaces places_;
};

}  // namespace tessera::subdomain
