// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/smooth_surface.hpp"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "tessera/mesh/tet_topology.hpp"

#include "support/meshes.hpp"

namespace tessera::coarse {
namespace {

constexpr double kAngle = 30.0;

// Tets from the middle to the triangles of an octahedron, each cut into n^2 on the unit sphere.
mesh::CoarseMesh ball(int n)
{
  mesh::CoarseMesh mesh;
  std::map<Vec3, LocalIndex> known;
  const auto vertex = [&](const Vec3& p) {
    const auto [found, is_new] = known.try_emplace(p, mesh.num_vertices());
    if (is_new) mesh.vertex_xyz.insert(mesh.vertex_xyz.end(), p.begin(), p.end());
    return found->second;
  };
  const LocalIndex middle = vertex({});
  for (int octant = 0; octant < 8; ++octant) {
    const auto point = [&](int i, int j) {
      Vec3 p{static_cast<double>(i), static_cast<double>(j), static_cast<double>(n - i - j)};
      p = (1.0 / norm(p)) * p;
      for (int axis = 0; axis < 3; ++axis) {
        if (((octant >> axis) & 1) != 0) p[static_cast<std::size_t>(axis)] *= -1.0;
      }
      for (double& x : p) x += 0.0;  // No -0: it is the same place.
      return vertex(p);
    };
    const auto add = [&](LocalIndex a, LocalIndex b, LocalIndex c) {
      const Vec3 p = mesh.position(a);
      if (dot(p, cross(mesh.position(b) - p, mesh.position(c) - p)) < 0.0) std::swap(b, c);
      mesh.tet_vertices.insert(mesh.tet_vertices.end(), {middle, a, b, c});
      mesh.tet_material.push_back(1);
      mesh.face_vertices.insert(mesh.face_vertices.end(), {a, b, c});
      mesh.face_patch.push_back(0);
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        add(point(i, j), point(i + 1, j), point(i, j + 1));
        if (i + j + 1 < n) add(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
      }
    }
  }
  mesh.patch_names = {"skin"};
  mesh.patch_surface = {0};
  mesh.material_names = {"core"};
  return mesh;
}

double largest_distance(const mesh::CoarseMesh& mesh, const SmoothSurface& surface)
{
  double largest = 0.0;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    for (const auto& [b, c] : {std::pair(0.5, 0.0), std::pair(0.0, 0.5), std::pair(0.5, 0.5),
                               std::pair(1.0 / 3.0, 1.0 / 3.0)}) {
      const Vec3 point = surface.on_face({2.0 * f + b, c});
      largest = std::max(largest, std::abs(norm(point) - 1.0));
    }
  }
  return largest;
}

TEST(SmoothSurface, FollowsASphereMuchMoreCloselyThanItsTriangles)
{
  const mesh::CoarseMesh coarse = ball(4);
  const mesh::CoarseMesh fine = ball(8);
  mesh::validate(coarse);
  const double off = largest_distance(coarse, SmoothSurface(coarse, kAngle));
  EXPECT_LT(off, 0.01);  // The triangles are off by 0.06.
  EXPECT_LT(largest_distance(fine, SmoothSurface(fine, kAngle)), off / 6.0);
}

TEST(SmoothSurface, HasItsVerticesAndTheSamePointsOnBothSidesOfAnEdge)
{
  mesh::CoarseMesh mesh = ball(4);
  const SmoothSurface surface(mesh, kAngle);
  surface.add_parameters(mesh);
  mesh::validate(mesh);
  EXPECT_EQ(mesh.num_segments(), 0);
  std::map<std::pair<LocalIndex, LocalIndex>, Vec3> middle_of_edge;
  std::size_t num_compared = 0;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const double* uv = &mesh.face_uv[6 * at(f)];
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex v = mesh.face_vertices[3 * at(f) + c];
      EXPECT_EQ(surface.on_face({uv[2 * c], uv[2 * c + 1]}), mesh.position(v));
      const std::size_t next = (c + 1) % 3;
      const Vec3 middle = surface.on_face(
          {0.5 * (uv[2 * c] + uv[2 * next]), 0.5 * (uv[2 * c + 1] + uv[2 * next + 1])});
      const auto [found, is_new] =
          middle_of_edge.try_emplace(std::minmax(v, mesh.face_vertices[3 * at(f) + next]), middle);
      if (is_new) continue;
      ++num_compared;
      EXPECT_LT(norm(found->second - middle), 1e-15);
    }
  }
  EXPECT_EQ(2 * num_compared, mesh.face_vertices.size());
}

// Normal of a face's patch beside its side, at `t` of the way along it, by differences.
Vec3 normal_at(const SmoothSurface& surface, LocalIndex face, std::size_t side, double t)
{
  constexpr double kStep = 1e-6;
  const auto point = [&](double along, double inward) {
    std::array<double, 3> weights{};
    weights[side] = 1.0 - along - 0.5 * inward;
    weights[(side + 1) % 3] = along - 0.5 * inward;
    weights[(side + 2) % 3] = inward;
    return surface.on_face({2.0 * face + weights[1], weights[2]});
  };
  return unit(
      cross(point(t + kStep, 0.0) - point(t - kStep, 0.0), point(t, kStep) - point(t, 0.0)));
}

TEST(SmoothSurface, HasOneTangentPlaneOnBothSidesOfAnEdge)
{
  mesh::CoarseMesh mesh = ball(3);
  for (std::size_t i = 0; i < mesh.vertex_xyz.size(); i += 3) mesh.vertex_xyz[i] *= 1.7;
  const SmoothSurface surface(mesh, 80.0);  // No edge is sharp.
  std::map<std::pair<LocalIndex, LocalIndex>, std::array<Vec3, 3>> normals_of_edge;
  std::size_t num_compared = 0;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    for (std::size_t side = 0; side < 3; ++side) {
      const LocalIndex a = mesh.face_vertices[3 * at(f) + side];
      const LocalIndex b = mesh.face_vertices[3 * at(f) + (side + 1) % 3];
      std::array<Vec3, 3> normals{};
      for (std::size_t i = 0; i < 3; ++i) {
        const double t = 0.25 * static_cast<double>(i + 1);
        normals[i] = normal_at(surface, f, side, a < b ? t : 1.0 - t);
      }
      const auto [found, is_new] = normals_of_edge.try_emplace(std::minmax(a, b), normals);
      for (std::size_t i = 0; !is_new && i < 3; ++i, ++num_compared) {
        EXPECT_LT(norm(cross(found->second[i], normals[i])), 1e-4);  // Of differences.
        EXPECT_GT(dot(found->second[i], normals[i]), 0.0);
      }
    }
  }
  EXPECT_EQ(2 * num_compared, 3 * mesh.face_vertices.size());
}

TEST(SmoothSurface, ACubeStaysACube)
{
  mesh::CoarseMesh cube = testing::kuhn_cube(2);
  cube.segment_vertices.clear();
  cube.segment_curve.clear();
  const SmoothSurface surface(cube, kAngle);
  surface.add_parameters(cube);
  EXPECT_EQ(cube.num_segments(), 24);  // Two on each edge of the cube.
  for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
    const Vec3 a = cube.position(cube.face_vertices[3 * at(f)]);
    const Vec3 b = cube.position(cube.face_vertices[3 * at(f) + 1]);
    const Vec3 c = cube.position(cube.face_vertices[3 * at(f) + 2]);
    const Vec3 flat = 0.25 * a + 0.25 * b + 0.5 * c;
    EXPECT_LT(norm(surface.on_face({2.0 * f + 0.25, 0.5}) - flat), 1e-14);
  }
  for (LocalIndex s = 0; s < cube.num_segments(); ++s) {
    const Vec3 a = cube.position(cube.segment_vertices[2 * at(s)]);
    const Vec3 b = cube.position(cube.segment_vertices[2 * at(s) + 1]);
    EXPECT_LT(norm(surface.on_segment(2.0 * s + 0.5) - midpoint(a, b)), 1e-15);
    EXPECT_EQ(surface.on_segment(2.0 * s), a);
    EXPECT_EQ(surface.on_segment(2.0 * s + 1.0), b);
  }
}

}  // namespace
}  // namespace tessera::coarse
