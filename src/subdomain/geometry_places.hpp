// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/complex.hpp"
#include "tessera/mesh/edge_levels.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/mesh/refined_lattice.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/mesh/triangle_grading.hpp"

#include "subdomain/files/line_edges.hpp"

namespace tessera::subdomain {

// Where an edge or triangle of a piece lies in the lattice of a skeleton triangle on the geometry;
// of an edge the first two corners count.
struct GeometryPlace {
  LocalIndex triangle = kNoIndex;  // Row of GeometryPlaces::triangles; kNoIndex: not on it.
  std::array<mesh::lattice::TrianglePoint, 3> corners{};

  [[nodiscard]] bool is_on_geometry() const { return triangle != kNoIndex; }

  // Point (i, j) of the entity's own lattice with n intervals, in that of the skeleton triangle
  // with n times the intervals that GeometryFinder::level_of() has.
  [[nodiscard]] mesh::lattice::TrianglePoint point(LocalIndex n, LocalIndex i, LocalIndex j) const;
};

// The part of the geometry that some tets touch.
struct GeometryPlaces {
  std::vector<LocalIndex> triangles{};        // Of the skeleton.
  LocalIndex num_known = 0;                   // Of the triangles: those whose lattice is known.
  std::vector<char> vertex_on_geometry{};     // Shape (num named vertices).
  std::vector<GeometryPlace> edges{};         // Shape (num edges of the complex).
  std::vector<GeometryPlace> of_triangles{};  // Shape (num triangles of the complex).
  std::vector<char> edge_on_line{};           // Shape (num edges of the complex): inside of solids.
};

// Finds it by the names of the vertices: tets may be exchanged between pieces, but edges and
// triangles on the geometry stay those of the skeleton's lattice.
class GeometryFinder {
 public:
  // Borrowed, with the levels on which the pieces were filled.
  explicit GeometryFinder(const PartitionedMesh& cut);

  // @param[in] names Of the first vertices of the complex; ascending.
  [[nodiscard]] GeometryPlaces find(const mesh::Complex& complex,
                                    const std::vector<mesh::HostPoint>& names) const;

  // Level of the lattice of a skeleton triangle in which corners stand: that of its finest side.
  [[nodiscard]] int level_of(LocalIndex triangle) const;

  // Of an edge of the skeleton.
  [[nodiscard]] int level_of_edge(LocalIndex edge) const { return levels_.edge(edge); }

  // What the small triangles of a skeleton triangle are a function of.
  [[nodiscard]] mesh::TriangleGrading grading_of(LocalIndex triangle) const
  {
    return mesh::triangle_grading(skeleton_, coarse_, levels_, triangle);
  }

 private:
  [[nodiscard]] std::vector<LocalIndex> triangles_around(
      const std::vector<mesh::HostPoint>& names) const;
  [[nodiscard]] mesh::HostPoint name_of(LocalIndex triangle, LocalIndex n,
                                        const mesh::lattice::TrianglePoint& p) const;
  void place_lines(const mesh::Complex& complex, const std::vector<mesh::HostPoint>& names,
                   GeometryPlaces& places) const;
  void place_lattice(LocalIndex row, const mesh::Complex& complex,
                     const std::vector<mesh::HostPoint>& names, GeometryPlaces& places) const;

  const mesh::Skeleton& skeleton_;
  const mesh::CoarseMesh& coarse_;
  mesh::LatticeLevels levels_;  // Of the skeleton.
  mesh::HostLayout hosts_;
  IndexLists triangles_of_host_;  // On the geometry only; by host of the skeleton.
  const std::vector<LineEdge>& lines_;
};

// Points that are known before a complex is refined. All borrowed.
struct KnownPoints {
  const GeometryPlaces& places;
  const mesh::RefinedLattice& lattice;  // Of the known triangles.
  const mesh::Skeleton& skeleton;
  const mesh::ProjectionLimiter& limiter;
};

// The lattice of a complex whose edges and triangles in known places have their points already; all
// others are midpoints, level by level. So are points that are held back altogether: on an edge
// that cuts a triangle of the skeleton, the middle of that edge is not where the skeleton's lattice
// has it, and a tet is only sure to have positive children if its own midpoints are taken.
// @param[in] vertex_xyz Of the vertices of the complex, shape (num_vertices, 3).
[[nodiscard]] mesh::RefinedLattice midpoint_lattice(const mesh::Complex& complex,
                                                    std::span<const double> vertex_xyz,
                                                    const KnownPoints& known, int levels);

// Name of a lattice point of a skeleton triangle that is no corner. @param[in] n Its intervals.
[[nodiscard]] mesh::LatticePointKey key_of(const mesh::Skeleton& skeleton, LocalIndex triangle,
                                           LocalIndex n, const mesh::lattice::TrianglePoint& p);

}  // namespace tessera::subdomain
