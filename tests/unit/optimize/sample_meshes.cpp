// SPDX-License-Identifier: BSD-3-Clause
#include "sample_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>

#include "tessera/fill/subdivide.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/mesh/tet_neighbours.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/quality/tet_quality.hpp"
#include "tessera/refine/lattice_refiner.hpp"

#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"

namespace tessera::testing {
namespace {

optimize::TetMesh kuhn_tets(int n)
{
  const mesh::CoarseMesh cube = kuhn_cube(n);
  return {.vertex_xyz = cube.vertex_xyz.to_vector(), .tet_vertices = cube.tet_vertices.to_vector()};
}

bool is_on_cube(const Vec3& p)
{
  return std::any_of(p.begin(), p.end(), [](double x) { return x == 0.0 || x == 1.0; });
}

quality::TetCorners corners_of(const std::vector<double>& xyz,
                               const std::vector<LocalIndex>& tet_vertices, std::size_t t)
{
  quality::TetCorners corners;
  for (std::size_t c = 0; c < 4; ++c) {
    corners[c] = point_at(std::span(xyz), tet_vertices[4 * t + c]);
  }
  return corners;
}

}  // namespace

optimize::TetMesh tangled_cube(int n, double jitter, unsigned seed)
{
  optimize::TetMesh mesh = kuhn_tets(n);
  std::mt19937 random(seed);
  for (std::size_t v = 0; v < mesh.vertex_xyz.size(); v += 3) {
    if (is_on_cube(point_at(std::span(mesh.vertex_xyz), v / 3))) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const double unit = static_cast<double>(random()) / static_cast<double>(random.max());
      mesh.vertex_xyz[v + k] += jitter / n * (2.0 * unit - 1.0);
    }
  }
  return mesh;
}

optimize::TetMesh jittered_cube(int n, double jitter, unsigned seed)
{
  constexpr double kLeast = 0.02;
  const optimize::TetMesh regular = kuhn_tets(n);
  optimize::TetMesh mesh = tangled_cube(n, jitter, seed);
  bool is_valid = false;
  while (!is_valid) {
    is_valid = true;
    for (std::size_t t = 0; 4 * t < mesh.tet_vertices.size(); ++t) {
      if (quality::mean_ratio(corners_of(mesh.vertex_xyz, mesh.tet_vertices, t)) > kLeast) continue;
      is_valid = false;
      for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t i = 3 * at(mesh.tet_vertices[4 * t + c]) + k;
          mesh.vertex_xyz[i] = 0.5 * (mesh.vertex_xyz[i] + regular.vertex_xyz[i]);
        }
      }
    }
  }
  return mesh;
}

optimize::TetMesh subdivided_cube(int n)
{
  mesh::CoarseMesh coarse = kuhn_cube(n);
  for (std::size_t v = 0; v < coarse.vertex_xyz.size(); v += 3) {
    const double x = coarse.vertex_xyz[v];
    coarse.vertex_xyz[v + 1] *= 1.0 + 0.5 * x * x;
    coarse.vertex_xyz[v + 2] *= 1.5 - x;
  }
  const mesh::Decomposition decomposition = one_subdomain_a_material(coarse);
  const mesh::Skeleton skeleton = mesh::build_skeleton(coarse, decomposition);
  const FlatModel model;
  const mesh::ProjectionLimiter no_limits;
  std::vector<LocalIndex> tets(at(coarse.num_tets()));
  for (std::size_t t = 0; t < tets.size(); ++t) tets[t] = static_cast<LocalIndex>(t);
  const mesh::TetComplex complex = mesh::tet_complex(coarse, skeleton, tets);
  const fill::FillOutput children = fill::subdivide(
      complex, refine::refine_lattice(complex.faces, {coarse, skeleton, model, no_limits, 2}));
  return {.vertex_xyz = children.vertex_xyz, .tet_vertices = children.tet_vertices};
}

optimize::TetMesh one_tet()
{
  return {.vertex_xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, .tet_vertices = {0, 1, 2, 3}};
}

std::vector<LocalIndex> neighbours_of(const std::vector<LocalIndex>& tet_vertices)
{
  const LocalIndex num_vertices = *std::ranges::max_element(tet_vertices) + 1;
  return mesh::find_tet_neighbours(tet_vertices, num_vertices);
}

MeshFigures figures_of(const std::vector<double>& vertex_xyz,
                       const std::vector<LocalIndex>& tet_vertices)
{
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  MeshFigures figures{.least_volume = kInfinity, .least_mean_ratio = kInfinity};
  const std::size_t num_tets = tet_vertices.size() / 4;
  for (std::size_t t = 0; t < num_tets; ++t) {
    const quality::TetCorners corners = corners_of(vertex_xyz, tet_vertices, t);
    const double volume = tet_volume(corners[0], corners[1], corners[2], corners[3]);
    const double mean_ratio = quality::mean_ratio(corners);
    figures.volume += volume;
    figures.least_volume = std::min(figures.least_volume, volume);
    figures.least_mean_ratio = std::min(figures.least_mean_ratio, mean_ratio);
    figures.mean_mean_ratio += mean_ratio / static_cast<double>(num_tets);
  }
  return figures;
}

std::vector<std::array<Vec3, 3>> boundary_of(const std::vector<double>& vertex_xyz,
                                             const std::vector<LocalIndex>& tet_vertices)
{
  std::vector<std::array<Vec3, 3>> boundary;
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(tet_vertices)) {
    if (triangle.tets[1] != kNoIndex) continue;
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t c = mesh::kTetFaceCorners[at(triangle.corners[0])][k];
      corners[k] = point_at(std::span(vertex_xyz), tet_vertices[4 * at(triangle.tets[0]) + c]);
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    boundary.push_back(corners);
  }
  std::sort(boundary.begin(), boundary.end());
  return boundary;
}

}  // namespace tessera::testing
