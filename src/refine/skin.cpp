// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/refine/skin.hpp"

#include <cstddef>
#include <utility>

#include "tessera/mesh/lattice_numbering.hpp"

namespace tessera::refine {
namespace {

namespace lattice = mesh::lattice;
using lattice::TrianglePoint;

// Appends skin vertices in the order of mesh::LatticeNumbering.
class VertexList {
 public:
  explicit VertexList(mesh::Skin& skin) : skin_(skin) {}

  void append(const Vec3& point, mesh::HostEntity host, LocalIndex index)
  {
    skin_.vertex_xyz.insert(skin_.vertex_xyz.end(), point.begin(), point.end());
    skin_.vertex_host.push_back(host);
    skin_.vertex_index.push_back(index);
  }

 private:
  mesh::Skin& skin_;
};

void append_coarse_vertices(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
                            VertexList& vertices)
{
  std::vector<Vec3> positions(at(complex.num_vertices()));
  for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
    positions[at(complex.edge_vertices[2 * at(e)])] = lattice.edge_point(e, 0);
    positions[at(complex.edge_vertices[2 * at(e) + 1])] = lattice.edge_point(e, lattice.n);
  }
  for (LocalIndex v = 0; v < complex.num_vertices(); ++v) {
    if (complex.vertex_skeleton[at(v)] == kNoIndex) continue;
    vertices.append(positions[at(v)], complex.vertex_skeleton[at(v)], 0);
  }
}

void append_lattice_points(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
                           const mesh::HostLayout& hosts, VertexList& vertices)
{
  const LocalIndex n = lattice.n;
  for (LocalIndex e = 0; e < complex.num_edges(); ++e) {
    if (complex.edge_skeleton[at(e)] == kNoIndex) continue;
    const mesh::HostEntity host = hosts.first_edge + complex.edge_skeleton[at(e)];
    for (LocalIndex k = 1; k < n; ++k) vertices.append(lattice.edge_point(e, k), host, k - 1);
  }
  for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
    if (complex.triangle_skeleton[at(t)] == kNoIndex) continue;
    const mesh::HostEntity host = hosts.first_triangle + complex.triangle_skeleton[at(t)];
    LocalIndex index = 0;
    for (LocalIndex j = 1; j < n; ++j) {
      for (LocalIndex i = 1; i + j < n; ++i) {
        vertices.append(lattice.triangle_point(t, {i, j}), host, index++);
      }
    }
  }
}

void append_triangles(const mesh::Complex& complex, LocalIndex n, const mesh::Skeleton& skeleton,
                      LocalIndex subdomain, mesh::Skin& skin)
{
  const mesh::LatticeNumbering numbering(complex, n);
  for (LocalIndex t = 0; t < complex.num_triangles(); ++t) {
    const LocalIndex parent = complex.triangle_skeleton[at(t)];
    if (parent == kNoIndex) continue;
    const bool ascending_is_outward = skeleton.triangle_subdomains[2 * at(parent)] == subdomain;
    lattice::for_each_small_triangle(
        n, 1, [&](const TrianglePoint& a, TrianglePoint b, TrianglePoint c) {
          if (!ascending_is_outward) std::swap(b, c);
          for (const TrianglePoint& p : {a, b, c}) {
            skin.triangle_vertices.push_back(numbering.triangle_point(t, p));
          }
          skin.triangle_parent.push_back(parent);
        });
  }
}

}  // namespace

mesh::Skin extract_skin(const mesh::Complex& complex, const mesh::RefinedLattice& lattice,
                        const mesh::Skeleton& skeleton, LocalIndex subdomain)
{
  mesh::Skin skin;
  VertexList vertices(skin);
  append_coarse_vertices(complex, lattice, vertices);
  append_lattice_points(complex, lattice, mesh::HostLayout(skeleton), vertices);
  append_triangles(complex, lattice.n, skeleton, subdomain, skin);
  return skin;
}

}  // namespace tessera::refine
