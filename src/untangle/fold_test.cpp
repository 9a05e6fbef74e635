// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/untangle/fold_test.hpp"

#include <algorithm>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/mesh/tet_lattice.hpp"
#include "tessera/mesh/tet_points.hpp"

namespace tessera::untangle {
namespace {

namespace lattice = mesh::lattice;
using lattice::TetPoint;

bool is_bad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  return !(tet_volume(a, b, c, d) > 0.0);
}

// Of the children on one level; `level` is at most one more than the tet's own.
bool has_bad_child(const mesh::TetPoints& points, int level)
{
  bool bad = false;
  if (level > points.grading().level) {
    const auto& all = points.all();
    points.for_each_child([&](LocalIndex a, LocalIndex b, LocalIndex c, LocalIndex d) {
      bad = bad || is_bad(all[at(a)], all[at(b)], all[at(c)], all[at(d)]);
    });
    return bad;
  }
  lattice::for_each_child(
      points.intervals(), points.intervals() >> level, points.grading().diagonal,
      [&](const TetPoint& a, const TetPoint& b, const TetPoint& c, const TetPoint& d) {
        bad = bad || is_bad(points.at(a), points.at(b), points.at(c), points.at(d));
      });
  return bad;
}

// Whether a tet has children on a level that it has not on the one before.
bool is_split_on(const mesh::TetGrading& grading, int level)
{
  return level <= grading.level + (grading.is_uniform() ? 0 : 1);
}

// Keys of the new points of one level on the geometry, on the faces and edges of one tet.
class NewPoints {
 public:
  NewPoints(const mesh::TetComplex& complex, const mesh::Skeleton& skeleton,
            const mesh::LatticeLevels& levels, int level)
      : complex_(complex), skeleton_(skeleton), levels_(levels), level_(level)
  {
  }

  [[nodiscard]] std::vector<mesh::LatticePointKey> of_tet(LocalIndex tet) const
  {
    std::vector<mesh::LatticePointKey> keys;
    for (std::size_t c = 0; c < 4; ++c) {
      const LocalIndex t = complex_.tet_triangles[4 * at(tet) + c];
      for (std::size_t side = 0; side < 3; ++side) {
        append_edge(complex_.faces.triangle_edges[3 * at(t) + side], keys);
      }
      append_triangle(t, keys);
    }
    return keys;
  }

 private:
  void append_edge(LocalIndex e, std::vector<mesh::LatticePointKey>& keys) const
  {
    const LocalIndex edge = complex_.faces.edge_skeleton[at(e)];
    if (edge == kNoIndex || skeleton_.edge_patch[at(edge)] == kNoIndex) return;
    if (levels_.edge(e) < level_) return;
    const LocalIndex n = lattice::intervals(level_);
    for (LocalIndex k = 1; k < n; k += 2) {
      keys.push_back(mesh::LatticePointKey::on_edge(edge, n, k));
    }
  }

  void append_triangle(LocalIndex t, std::vector<mesh::LatticePointKey>& keys) const
  {
    const LocalIndex triangle = complex_.faces.triangle_skeleton[at(t)];
    if (triangle == kNoIndex || skeleton_.triangle_patch[at(triangle)] == kNoIndex) return;
    if (levels_.triangle(t) < level_) return;
    const LocalIndex n = lattice::intervals(level_);
    for (LocalIndex j = 1; j < n; ++j) {
      for (LocalIndex i = 1; i + j < n; ++i) {
        if (i % 2 == 0 && j % 2 == 0) continue;
        keys.push_back(mesh::LatticePointKey::on_triangle(triangle, n, {i, j}));
      }
    }
  }

  const mesh::TetComplex& complex_;
  const mesh::Skeleton& skeleton_;
  const mesh::LatticeLevels& levels_;
  int level_;
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
                                         std::span<const char> on_geometry)
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
  const mesh::LatticeLevels& levels = lattice.levels();
  for (int level = 1; level <= levels.largest() && smaller.empty(); ++level) {
    const NewPoints new_points(complex, skeleton, levels, level);
    for (LocalIndex t = 0; t < static_cast<LocalIndex>(complex.tets.size()); ++t) {
      if (!is_split_on(mesh::tet_grading(complex, lattice, t), level)) continue;
      if (!has_bad_child(mesh::TetPoints(complex, lattice, t), level)) continue;
      for (const mesh::LatticePointKey& key : new_points.of_tet(t)) {
        const double factor = limiter.factor(key);
        if (factor > 0.0) smaller.push_back({key, next_factor(factor)});
      }
    }
  }
  return smaller;
}

}  // namespace tessera::untangle
