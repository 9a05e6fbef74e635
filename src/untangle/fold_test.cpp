// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/untangle/fold_test.hpp"

#include <algorithm>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/tet_face_map.hpp"
#include "tessera/mesh/tet_lattice.hpp"
#include "tessera/mesh/tet_points.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::untangle {
namespace {

namespace lattice = mesh::lattice;
using lattice::TetPoint;
using lattice::TrianglePoint;

bool has_bad_child(const mesh::TetPoints& points, LocalIndex n, LocalIndex step)
{
  bool bad = false;
  lattice::for_each_child(
      n, step, points.diagonal(),
      [&](const TetPoint& a, const TetPoint& b, const TetPoint& c, const TetPoint& d) {
        bad = bad || !(tet_volume(points.at(a), points.at(b), points.at(c), points.at(d)) > 0.0);
      });
  return bad;
}

// Keys of the new points of one level on the geometry, on the faces and edges of one tet.
class NewPoints {
 public:
  NewPoints(const mesh::TetComplex& complex, const mesh::Skeleton& skeleton, LocalIndex n,
            LocalIndex step)
      : complex_(complex), skeleton_(skeleton), n_(n), step_(step)
  {
  }

  [[nodiscard]] std::vector<mesh::LatticePointKey> of_tet(LocalIndex tet) const
  {
    std::vector<mesh::LatticePointKey> keys;
    const mesh::Complex& faces = complex_.faces;
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex t = complex_.tet_triangles[4 * at(tet) + c];
      for (std::size_t side = 0; side < 3; ++side) {
        append_edge(faces.edge_skeleton[at(faces.triangle_edges[3 * at(t) + side])], keys);
      }
      append_triangle(faces.triangle_skeleton[at(t)], keys);
    }
    return keys;
  }

 private:
  void append_edge(LocalIndex edge, std::vector<mesh::LatticePointKey>& keys) const
  {
    if (edge == kNoIndex || skeleton_.edge_patch[at(edge)] == kNoIndex) return;
    for (LocalIndex k = step_; k < n_; k += 2 * step_) {
      keys.push_back(mesh::LatticePointKey::on_edge(edge, n_, k));
    }
  }

  void append_triangle(LocalIndex triangle, std::vector<mesh::LatticePointKey>& keys) const
  {
    if (triangle == kNoIndex || skeleton_.triangle_patch[at(triangle)] == kNoIndex) return;
    for (LocalIndex j = step_; j < n_; j += step_) {
      for (LocalIndex i = step_; i + j < n_; i += step_) {
        if ((i / step_) % 2 == 0 && (j / step_) % 2 == 0) continue;
        keys.push_back(mesh::LatticePointKey::on_triangle(triangle, n_, {i, j}));
      }
    }
  }

  const mesh::TetComplex& complex_;
  const mesh::Skeleton& skeleton_;
  LocalIndex n_;
  LocalIndex step_;
};

}  // namespace

double next_factor(double factor)
{
  if (factor > 0.75) return 0.75;
  if (factor > 0.5) return 0.5;
  return factor > 0.25 ? 0.25 : 0.0;
}

std::vector<char> vertices_on_geometry(const mesh::CoarseMesh& coarse,
                                       const mesh::Skeleton& skeleton)
{
  std::vector<char> on_geometry(at(coarse.num_vertices()), 0);
  for (LocalIndex e = 0; e < skeleton.num_edges(); ++e) {
    if (skeleton.edge_patch[at(e)] == kNoIndex) continue;
    for (std::size_t end = 0; end < 2; ++end) {
      on_geometry[at(skeleton.vertex_coarse[at(skeleton.edge_vertices[2 * at(e) + end])])] = 1;
    }
  }
  return on_geometry;
}

std::vector<LocalIndex> tets_on_geometry(const mesh::CoarseMesh& coarse,
                                         std::span<const LocalIndex> tets,
                                         const std::vector<char>& on_geometry)
{
  std::vector<LocalIndex> touching;
  for (const LocalIndex t : tets) {
    const auto corners = coarse.tet(t);
    const auto num_on_geometry = std::count_if(
        corners.begin(), corners.end(), [&](LocalIndex v) { return on_geometry[at(v)] != 0; });
    if (num_on_geometry >= 2) touching.push_back(t);
  }
  return touching;
}

std::vector<mesh::PointLimit> find_folds(const mesh::TetComplex& complex,
                                         const mesh::Skeleton& skeleton,
                                         const mesh::RefinedLattice& lattice,
                                         const mesh::ProjectionLimiter& limiter)
{
  std::vector<mesh::PointLimit> smaller;
  for (LocalIndex step = lattice.n / 2; step >= 1 && smaller.empty(); step /= 2) {
    const NewPoints new_points(complex, skeleton, lattice.n, step);
    for (LocalIndex t = 0; t < static_cast<LocalIndex>(complex.tets.size()); ++t) {
      const mesh::TetPoints points(complex, lattice, t);
      if (!has_bad_child(points, lattice.n, step)) continue;
      for (const mesh::LatticePointKey& key : new_points.of_tet(t)) {
        const double factor = limiter.factor(key);
        if (factor > 0.0) smaller.push_back({key, next_factor(factor)});
      }
    }
  }
  return smaller;
}

}  // namespace tessera::untangle
