// SPDX-License-Identifier: BSD-3-Clause
#include "support/meshes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::testing {
namespace {

// Bit set of the sides of the unit cube a point lies on: x=0, x=1, y=0, y=1, z=0, z=1.
unsigned sides_of(const Vec3& p)
{
  unsigned sides = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    if (p[axis] == 0.0) sides |= 1U << (2 * axis);
    if (p[axis] == 1.0) sides |= 2U << (2 * axis);
  }
  return sides;
}

LocalIndex lowest_bit(unsigned bits)
{
  LocalIndex bit = 0;
  while (((bits >> bit) & 1U) == 0) ++bit;
  return bit;
}

// Every triangle on the outside or between two materials becomes a face.
void add_faces(mesh::CoarseMesh& mesh)
{
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(mesh.tet_vertices)) {
    const bool outside = triangle.tets[1] == kNoIndex;
    const auto material = [&](std::size_t side) {
      return mesh.tet_material[static_cast<std::size_t>(triangle.tets[side])];
    };
    if (!outside && material(0) == material(1)) continue;
    unsigned sides = ~0U;
    for (const LocalIndex v : triangle.vertices) sides &= sides_of(mesh.position(v));
    mesh.face_vertices.insert(mesh.face_vertices.end(), triangle.vertices.begin(),
                              triangle.vertices.end());
    mesh.face_patch.push_back(outside ? lowest_bit(sides) : 6);
  }
}

// Edges of the mesh that lie on one of the twelve edges of the cube.
void add_segments(mesh::CoarseMesh& mesh)
{
  std::set<std::pair<LocalIndex, LocalIndex>> done;
  std::map<unsigned, LocalIndex> curve_of;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto at = 3 * static_cast<std::size_t>(f);
      const LocalIndex a = mesh.face_vertices[at + c];
      const LocalIndex b = mesh.face_vertices[at + (c + 1) % 3];
      const unsigned sides = sides_of(mesh.position(a)) & sides_of(mesh.position(b));
      const bool on_one_side_only = (sides & (sides - 1)) == 0;
      if (on_one_side_only || !done.insert(std::minmax(a, b)).second) continue;
      const auto curve = curve_of.emplace(sides, static_cast<LocalIndex>(curve_of.size())).first;
      mesh.segment_vertices.insert(mesh.segment_vertices.end(), {a, b});
      mesh.segment_curve.push_back(curve->second);
    }
  }
}

void add_boundary(mesh::CoarseMesh& mesh)
{
  mesh.patch_names = {"x0", "x1", "y0", "y1", "z0", "z1"};
  if (mesh.num_materials() > 1) mesh.patch_names.emplace_back("interface");
  for (LocalIndex p = 0; p < mesh.num_patches(); ++p) mesh.patch_surface.push_back(p);
  add_faces(mesh);
  add_segments(mesh);
}

mesh::CoarseMesh cube_tets(int n)
{
  mesh::CoarseMesh mesh;
  const auto vertex = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  const auto coordinate = [n](int i) { return static_cast<double>(i) / n; };
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.vertex_xyz.insert(mesh.vertex_xyz.end(),
                               {coordinate(i), coordinate(j), coordinate(k)});

  // Each tet walks from corner (0,0,0) to (1,1,1) of its cell along the axes in one of 3! orders;
  // odd orders swap the last two corners so that all volumes are positive.
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        for (std::size_t o = 0; o < kOrders.size(); ++o) {
          std::array<int, 3> at{i, j, k};
          std::array<LocalIndex, 4> tet{vertex(i, j, k), 0, 0, 0};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[kOrders[o][step]];
            tet[step + 1] = vertex(at[0], at[1], at[2]);
          }
          if (o >= 3) std::swap(tet[2], tet[3]);
          mesh.tet_vertices.insert(mesh.tet_vertices.end(), tet.begin(), tet.end());
          mesh.tet_material.push_back(1);
        }
      }
    }
  }
  mesh.material_names = {"material_1"};
  return mesh;
}

}  // namespace

mesh::CoarseMesh kuhn_cube(int n)
{
  mesh::CoarseMesh mesh = cube_tets(n);
  add_boundary(mesh);
  return mesh;
}

mesh::CoarseMesh two_material_cube(int n)
{
  mesh::CoarseMesh mesh = cube_tets(n);
  mesh.material_names.emplace_back("material_2");
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    double x = 0.0;
    for (const LocalIndex v : mesh.tet(t)) x += 0.25 * mesh.position(v)[0];
    if (x > 0.5) mesh.tet_material[static_cast<std::size_t>(t)] = 2;
  }
  add_boundary(mesh);
  return mesh;
}

double volume_of(const mesh::CoarseMesh& mesh)
{
  double volume = 0.0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto tet = mesh.tet(t);
    volume += tet_volume(mesh.position(tet[0]), mesh.position(tet[1]), mesh.position(tet[2]),
                         mesh.position(tet[3]));
  }
  return volume;
}

}  // namespace tessera::testing
