// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/subdivide.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/lattice_numbering.hpp"
#include "tessera/mesh/tet_grading.hpp"
#include "tessera/mesh/tet_lattice.hpp"
#include "tessera/mesh/tet_points.hpp"

namespace tessera::fill {
namespace {

namespace lattice = mesh::lattice;

void require_local(GlobalIndex num_tets)
{
  if (4 * num_tets <= std::numeric_limits<LocalIndex>::max()) return;
  throw MeshError(fmt::format(
      "{} tets in one subdomain are too many for 32-bit indices; use more subdomains", num_tets));
}

LocalIndex num_tets_in(const mesh::TetComplex& complex)
{
  return static_cast<LocalIndex>(complex.tets.size());
}

// Points on edges and triangles first, then one coarse tet after the other; the array by place is
// reused.
class Subdivider {
 public:
  Subdivider(const mesh::TetComplex& complex, const mesh::RefinedLattice& lattice)
      : complex_(complex),
        lattice_(lattice),
        numbering_(complex.faces, lattice.levels()),
        next_inner_(numbering_.num_points())
  {
    GlobalIndex num_tets = 0;
    LocalIndex num_points = next_inner_;
    gradings_.reserve(complex.tets.size());
    for (LocalIndex t = 0; t < num_tets_in(complex); ++t) {
      const mesh::TetGrading& grading =
          gradings_.emplace_back(mesh::tet_grading(complex, lattice, t));
      num_tets += mesh::num_children(grading);
      require_local(num_tets);
      num_points += lattice::num_inner_tet_points(grading.intervals());
    }
    result_.vertex_xyz.resize(3 * at(num_points));
    result_.tet_vertices.resize(4 * static_cast<std::size_t>(num_tets));
    next_corner_ = result_.tet_vertices.data();
  }

  FillOutput run()
  {
    place_faces();
    for (LocalIndex t = 0; t < num_tets_in(complex_); ++t) {
      number_points(t);
      place_inside(gradings_[at(t)]);
      append_children(gradings_[at(t)]);
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] Vec3 point_at_place(LocalIndex place) const
  {
    return point_at(std::span<const double>(result_.vertex_xyz), number_[at(place)]);
  }

  void put(LocalIndex vertex, const Vec3& point)
  {
    std::copy(point.begin(), point.end(), &result_.vertex_xyz[3 * at(vertex)]);
  }

  void place_faces()
  {
    const mesh::Complex& faces = complex_.faces;
    for (LocalIndex e = 0; e < faces.num_edges(); ++e) {
      for (LocalIndex k = 0; k <= lattice_.edge_intervals(e); ++k) {
        put(numbering_.edge_point(e, k), lattice_.edge_point(e, k));
      }
    }
    for (LocalIndex t = 0; t < faces.num_triangles(); ++t) {
      const LocalIndex n = lattice_.triangle_intervals(t);
      for (LocalIndex j = 1; j < n; ++j) {
        for (LocalIndex i = 1; i + j < n; ++i) {
          put(numbering_.triangle_point(t, n, {i, j}), lattice_.triangle_point(t, {i, j}));
        }
      }
    }
  }

  // Inner points get the next numbers, in the order of their places.
  void number_points(LocalIndex tet)
  {
    const mesh::TetGrading& grading = gradings_[at(tet)];
    const LocalIndex n = mesh::intervals_of_places(grading);
    number_.assign(at(lattice::num_tet_points(n)), kNoIndex);
    mesh::for_each_outer_point(
        complex_, lattice_.levels(), tet, grading,
        [&](LocalIndex place, LocalIndex edge, LocalIndex k) {
          number_[at(place)] = numbering_.edge_point(edge, k);
        },
        [&](LocalIndex place, LocalIndex triangle, const lattice::TrianglePoint& p) {
          number_[at(place)] =
              numbering_.triangle_point(triangle, lattice_.triangle_intervals(triangle), p);
        });
    const LocalIndex step = n / grading.intervals();
    for (LocalIndex k = step; k < n; k += step) {
      for (LocalIndex j = step; j + k < n; j += step) {
        for (LocalIndex i = step; i + j + k < n; i += step) {
          number_[at(lattice::tet_index(n, {i, j, k}))] = next_inner_++;
        }
      }
    }
  }

  void place_inside(const mesh::TetGrading& grading)
  {
    mesh::for_each_inner_point(grading, [&](LocalIndex place, LocalIndex a, LocalIndex b) {
      put(number_[at(place)], midpoint(point_at_place(a), point_at_place(b)));
    });
  }

  void append_children(const mesh::TetGrading& grading)
  {
    LocalIndex* to = next_corner_;
    mesh::for_each_child(
        grading, [&](LocalIndex place) { return point_at_place(place); },
        [&](LocalIndex a, LocalIndex b, LocalIndex c, LocalIndex d) {
          to[0] = number_[at(a)];
          to[1] = number_[at(b)];
          to[2] = number_[at(c)];
          to[3] = number_[at(d)];
          to += 4;
        });
    next_corner_ = to;
  }

  const mesh::TetComplex& complex_;
  const mesh::RefinedLattice& lattice_;
  mesh::LatticeNumbering numbering_;
  std::vector<mesh::TetGrading> gradings_{};
  std::vector<LocalIndex> number_{};  ///< By place: vertex of the piece, or kNoIndex.
  LocalIndex next_inner_;
  LocalIndex* next_corner_ = nullptr;  ///< In the result.
  FillOutput result_{};
};

}  // namespace

FillOutput subdivide(const mesh::TetComplex& complex, const mesh::RefinedLattice& lattice)
{
  return Subdivider(complex, lattice).run();
}

SubdivisionCounts count_subdivision(const mesh::TetComplex& complex, const mesh::CoarseMesh& coarse,
                                    const mesh::EdgeLevels& levels)
{
  const mesh::Complex& faces = complex.faces;
  const mesh::LatticeLevels of_faces = mesh::lattice_levels(faces, levels);
  SubdivisionCounts counts{.interior_vertices =
                               std::ranges::count(faces.vertex_skeleton, kNoIndex)};
  for (LocalIndex e = 0; e < faces.num_edges(); ++e) {
    if (faces.edge_skeleton[at(e)] != kNoIndex) continue;
    counts.interior_vertices += lattice::num_inner_edge_points(of_faces.edge_intervals(e));
  }
  for (LocalIndex t = 0; t < faces.num_triangles(); ++t) {
    if (faces.triangle_skeleton[at(t)] != kNoIndex) continue;
    counts.interior_vertices += lattice::num_inner_triangle_points(of_faces.triangle_intervals(t));
  }
  for (const LocalIndex tet : complex.tets) {
    const mesh::TetGrading grading = mesh::tet_grading(coarse, levels, tet);
    counts.tets += mesh::num_children(grading);
    counts.interior_vertices += lattice::num_inner_tet_points(grading.intervals());
  }
  return counts;
}

}  // namespace tessera::fill
