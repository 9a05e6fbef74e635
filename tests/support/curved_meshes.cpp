// SPDX-License-Identifier: BSD-3-Clause
#include "support/curved_meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tessera/mesh/tet_topology.hpp"

#include "support/meshes.hpp"

namespace tessera::testing {
namespace {

// Scales a point such that the cubes |p|_max = s around the origin become the spheres |p| = s.
Vec3 cube_to_ball(const Vec3& p)
{
  const double largest = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  return largest == 0.0 ? p : (largest / norm(p)) * p;
}

template <class Map>
void move_vertices(mesh::CoarseMesh& mesh, const Map& map)
{
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    const Vec3 moved = map(mesh.position(v));
    std::copy(moved.begin(), moved.end(), &mesh.vertex_xyz[3 * at(v)]);
  }
}

void remove_segments(mesh::CoarseMesh& mesh)
{
  mesh.segment_vertices.clear();
  mesh.segment_curve.clear();
}

// Drops the tets whose middle is in the cube |p|_max < 1/2, and the vertices that no tet is left
// of.
void cut_out_the_middle(mesh::CoarseMesh& mesh)
{
  std::vector<LocalIndex> kept;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    Vec3 middle{};
    for (const LocalIndex v : mesh.tet(t)) middle = middle + 0.25 * mesh.position(v);
    if (std::max({std::abs(middle[0]), std::abs(middle[1]), std::abs(middle[2])}) < 0.5) continue;
    const auto tet = mesh.tet(t);
    kept.insert(kept.end(), tet.begin(), tet.end());
  }
  std::vector<LocalIndex> used = kept;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<double> xyz;
  for (const LocalIndex v : used) {
    const Vec3 p = mesh.position(v);
    xyz.insert(xyz.end(), p.begin(), p.end());
  }
  for (LocalIndex& v : kept) {
    v = static_cast<LocalIndex>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
  }
  mesh.tet_material.assign(kept.size() / 4, 1);
  mesh.tet_vertices = std::move(kept);
  mesh.vertex_xyz = std::move(xyz);
}

// Faces and parameters of the cylinder's patches: what kuhn_cube() calls x0, x1, y0, y1 is patch 0.
void name_patches_of_cylinder(mesh::CoarseMesh& mesh)
{
  mesh.patch_names = {"mantle", "bottom", "top"};
  mesh.patch_surface = {0, 1, 2};
  for (LocalIndex& patch : mesh.face_patch) patch = std::max(0, patch - 3);
}

double angle_of(const Vec3& p)
{
  const double angle = std::atan2(p[1], p[0]);
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

// The angles in [0, 2 pi), the small ones a turn higher if there are large ones too.
template <std::size_t N>
std::array<double, N> angles_of_one_branch(std::array<double, N> angles)
{
  const double largest = *std::max_element(angles.begin(), angles.end());
  for (double& angle : angles) {
    if (largest - angle > std::numbers::pi) angle += 2.0 * std::numbers::pi;
  }
  return angles;
}

void add_face_parameters(mesh::CoarseMesh& mesh)
{
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    std::array<Vec3, 3> p;
    std::array<double, 3> angles;
    for (std::size_t c = 0; c < 3; ++c) {
      p[c] = mesh.position(mesh.face_vertices[3 * at(f) + c]);
      angles[c] = angle_of(p[c]);
    }
    angles = angles_of_one_branch(angles);
    const bool on_mantle = mesh.face_patch[at(f)] == 0;
    for (std::size_t c = 0; c < 3; ++c) {
      mesh.face_uv.push_back(on_mantle ? angles[c] : p[c][0]);
      mesh.face_uv.push_back(on_mantle ? p[c][2] : p[c][1]);
    }
  }
}

// Keeps the segments of the two rims; the cube's upright edges are inside the mantle.
void add_rims(mesh::CoarseMesh& mesh)
{
  const FlatArray<LocalIndex> all = std::move(mesh.segment_vertices);
  remove_segments(mesh);
  for (std::size_t s = 0; s < all.size(); s += 2) {
    const Vec3 a = mesh.position(all[s]);
    const Vec3 b = mesh.position(all[s + 1]);
    if (a[2] != b[2]) continue;
    mesh.segment_vertices.insert(mesh.segment_vertices.end(), {all[s], all[s + 1]});
    mesh.segment_curve.push_back(a[2] == 0.0 ? 0 : 1);
    const auto t = angles_of_one_branch(std::array<double, 2>{angle_of(a), angle_of(b)});
    mesh.segment_t.insert(mesh.segment_t.end(), t.begin(), t.end());
  }
}

}  // namespace

mesh::CoarseMesh ball(int n)
{
  mesh::CoarseMesh mesh = kuhn_cube(n);
  move_vertices(mesh, [](const Vec3& p) { return cube_to_ball(2.0 * p - Vec3{1, 1, 1}); });
  std::fill(mesh.face_patch.begin(), mesh.face_patch.end(), 0);
  mesh.patch_names = {"skin"};
  mesh.patch_surface = {0};
  remove_segments(mesh);
  return mesh;
}

mesh::CoarseMesh shell()
{
  mesh::CoarseMesh mesh = kuhn_cube(4);
  remove_segments(mesh);
  move_vertices(mesh, [](const Vec3& p) { return 2.0 * p - Vec3{1, 1, 1}; });
  cut_out_the_middle(mesh);
  move_vertices(mesh, cube_to_ball);
  mesh.patch_names = {"outside", "cavity"};
  mesh.patch_surface = {0, 1};
  mesh.face_vertices.clear();
  mesh.face_patch.clear();
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(mesh.tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    mesh.face_vertices.insert(mesh.face_vertices.end(), triangle.vertices.begin(),
                              triangle.vertices.end());
    mesh.face_patch.push_back(norm(mesh.position(triangle.vertices[0])) > 0.75 ? 0 : 1);
  }
  return mesh;
}

mesh::CoarseMesh cylinder(int n)
{
  mesh::CoarseMesh mesh = kuhn_cube(n);
  move_vertices(mesh, [](const Vec3& p) {
    const Vec3 disc = cube_to_ball({2.0 * p[0] - 1.0, 2.0 * p[1] - 1.0, 0.0});
    return Vec3{disc[0], disc[1], p[2]};
  });
  name_patches_of_cylinder(mesh);
  add_face_parameters(mesh);
  add_rims(mesh);
  return mesh;
}

mesh::Decomposition halves(const mesh::CoarseMesh& coarse)
{
  mesh::Decomposition decomposition;
  decomposition.subdomain_material = {1, 1};
  decomposition.subdomain_weight = {1.0, 1.0};
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    double y = 0.0;
    for (const LocalIndex v : coarse.tet(t)) y += 0.25 * coarse.position(v)[1];
    decomposition.tet_subdomain.push_back(y < 0.0 ? 0 : 1);
  }
  return decomposition;
}

}  // namespace tessera::testing
