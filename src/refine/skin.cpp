// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/refine/skin.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/lattice_numbering.hpp"
#include "tessera/mesh/triangle_grading.hpp"

namespace tessera::refine {
namespace {

namespace lattice = mesh::lattice;
using lattice::TrianglePoint;

// Puts every vertex where the numbering says.
class SkinBuilder {
 public:
  SkinBuilder(const mesh::Complex& complex, const mesh::RefinedLattice& points,
              const mesh::Skeleton& skeleton)
      : complex_(complex),
        points_(points),
        skeleton_(skeleton),
        hosts_(skeleton),
        numbering_(complex, points.levels())
  {
    const std::size_t num_vertices = at(numbering_.num_skeleton_points());
    skin_.vertex_xyz.resize(3 * num_vertices);
    skin_.vertex_host.resize(num_vertices);
    skin_.vertex_index.resize(num_vertices);
  }

  mesh::Skin run(LocalIndex subdomain) &&
  {
    for (LocalIndex e = 0; e < complex_.num_edges(); ++e) {
      place_ends(e);
      if (complex_.edge_skeleton[at(e)] != kNoIndex) place_inside_edge(e);
    }
    for (LocalIndex t = 0; t < complex_.num_triangles(); ++t) {
      if (complex_.triangle_skeleton[at(t)] == kNoIndex) continue;
      place_inside_triangle(t);
      append_triangles(t, subdomain);
    }
    return std::move(skin_);
  }

 private:
  // Edges write the same bits for a vertex that they share.
  void place_ends(LocalIndex e)
  {
    for (LocalIndex end = 0; end < 2; ++end) {
      const LocalIndex v = complex_.edge_vertices[2 * at(e) + at(end)];
      const LocalIndex skeleton_vertex = complex_.vertex_skeleton[at(v)];
      if (skeleton_vertex == kNoIndex) continue;
      place(numbering_.vertex(v), points_.edge_point(e, end * points_.edge_intervals(e)),
            {hosts_.vertex(skeleton_vertex), 0});
    }
  }

  void place_inside_edge(LocalIndex e)
  {
    const mesh::HostEntity host = hosts_.edge(complex_.edge_skeleton[at(e)]);
    for (LocalIndex k = 1; k < points_.edge_intervals(e); ++k) {
      place(numbering_.edge_point(e, k), points_.edge_point(e, k), {host, k - 1});
    }
  }

  void place_inside_triangle(LocalIndex t)
  {
    const LocalIndex n = points_.triangle_intervals(t);
    const mesh::HostEntity host = hosts_.triangle(complex_.triangle_skeleton[at(t)]);
    for (LocalIndex j = 1; j < n; ++j) {
      for (LocalIndex i = 1; i + j < n; ++i) {
        place(numbering_.triangle_point(t, n, {i, j}), points_.triangle_point(t, {i, j}),
              {host, lattice::inner_triangle_index(n, i, j)});
      }
    }
  }

  void place(LocalIndex vertex, const Vec3& point, const mesh::HostPoint& name)
  {
    std::ranges::copy(point, &skin_.vertex_xyz[3 * at(vertex)]);
    skin_.vertex_host[at(vertex)] = name.host;
    skin_.vertex_index[at(vertex)] = name.index;
  }

  void append_triangles(LocalIndex t, LocalIndex subdomain)
  {
    const LocalIndex parent = complex_.triangle_skeleton[at(t)];
    const bool ascending_is_outward = skeleton_.triangle_subdomains[2 * at(parent)] == subdomain;
    const mesh::TriangleGrading grading = mesh::triangle_grading(complex_, points_, t);
    const LocalIndex n = grading.finest_intervals();
    mesh::for_each_graded_triangle(
        grading, [&](const TrianglePoint& a, TrianglePoint b, TrianglePoint c) {
          if (!ascending_is_outward) std::swap(b, c);
          for (const TrianglePoint& p : {a, b, c}) {
            skin_.triangle_vertices.push_back(numbering_.triangle_point(t, n, p));
          }
          skin_.triangle_parent.push_back(parent);
        });
  }

  const mesh::Complex& complex_;
  const mesh::RefinedLattice& points_;
  const mesh::Skeleton& skeleton_;
  mesh::HostLayout hosts_;
  mesh::LatticeNumbering numbering_;
  mesh::Skin skin_{};
};

}  // namespace

mesh::Skin extract_skin(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
                        const mesh::Skeleton& skeleton, LocalIndex subdomain)
{
  return SkinBuilder(complex, lattice, skeleton).run(subdomain);
}

}  // namespace tessera::refine
