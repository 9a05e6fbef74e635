// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_samples.hpp"

#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "support/meshes.hpp"

namespace tessera::testing {
namespace {

using mesh::MeshArrays;

constexpr GlobalIndex kFirstId = 5'000'000'000;

[[nodiscard]] std::vector<GlobalIndex> ids_from(GlobalIndex first, GlobalIndex num_ids)
{
  std::vector<GlobalIndex> ids(static_cast<std::size_t>(num_ids));
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = first + static_cast<GlobalIndex>(i) * 7;
  return ids;
}

/// Points, and the arrays that tets and triangles both have.
[[nodiscard]] MeshArrays with_points(const mesh::CoarseMesh& cube)
{
  MeshArrays mesh;
  mesh.point_xyz = cube.vertex_xyz.to_vector();
  for (double& x : mesh.point_xyz) x = x / 3.0 + 1e-17;
  mesh.point_ids = ids_from(kFirstId, mesh.num_points());
  auto& owner = mesh.point_ints["owner"];
  for (GlobalIndex point = 0; point < mesh.num_points(); ++point) {
    owner.push_back(static_cast<std::int32_t>(point % 5));
  }
  mesh.field_texts["patch_names"] = {"inlet", "", "Fläche <&> \"2\""};
  mesh.field_texts["length_unit"] = {"mm"};
  return mesh;
}

template <class T>
void expect_same_bytes(const std::vector<T>& actual, const std::vector<T>& expected,
                       const std::string& name)
{
  ASSERT_EQ(actual.size(), expected.size()) << name;
  const bool is_same =
      actual.empty() || std::memcmp(actual.data(), expected.data(), actual.size() * sizeof(T)) == 0;
  EXPECT_TRUE(is_same) << name;
}

template <class T>
void expect_same_maps(const std::map<std::string, std::vector<T>>& actual,
                      const std::map<std::string, std::vector<T>>& expected)
{
  for (const auto& [name, values] : expected) {
    ASSERT_TRUE(actual.contains(name)) << name;
    expect_same_bytes(actual.at(name), values, name);
  }
  EXPECT_EQ(actual.size(), expected.size());
}

}  // namespace

MeshArrays sample_tets(int n)
{
  const mesh::CoarseMesh cube = kuhn_cube(n);
  MeshArrays mesh = with_points(cube);
  mesh.cell_points.assign(cube.tet_vertices.begin(), cube.tet_vertices.end());
  mesh.cell_ids = ids_from(3 * kFirstId, mesh.num_cells());
  mesh.cell_ints["attribute"].assign(static_cast<std::size_t>(mesh.num_cells()), 1);
  auto& quality = mesh.cell_doubles["mean_ratio"];
  for (GlobalIndex cell = 0; cell < mesh.num_cells(); ++cell) {
    quality.push_back(1.0 / static_cast<double>(cell + 3));
  }
  return mesh;
}

MeshArrays sample_triangles(int n)
{
  const mesh::CoarseMesh cube = kuhn_cube(n);
  MeshArrays mesh = with_points(cube);
  mesh.vertices_per_cell = 3;
  mesh.cell_points.assign(cube.face_vertices.begin(), cube.face_vertices.end());
  mesh.cell_ids = ids_from(0, mesh.num_cells());
  mesh.cell_ints["patch"].assign(cube.face_patch.begin(), cube.face_patch.end());
  mesh.cell_longs["tet"] = ids_from(kFirstId, mesh.num_cells());
  return mesh;
}

void expect_same_bits(const MeshArrays& actual, const MeshArrays& expected)
{
  EXPECT_EQ(actual.vertices_per_cell, expected.vertices_per_cell);
  EXPECT_EQ(actual.num_other_cells, expected.num_other_cells);
  expect_same_bytes(actual.point_xyz, expected.point_xyz, "point_xyz");
  expect_same_bytes(actual.cell_points, expected.cell_points, "cell_points");
  expect_same_bytes(actual.point_ids, expected.point_ids, "point_ids");
  expect_same_bytes(actual.cell_ids, expected.cell_ids, "cell_ids");
  expect_same_maps(actual.point_ints, expected.point_ints);
  expect_same_maps(actual.cell_ints, expected.cell_ints);
  expect_same_maps(actual.cell_longs, expected.cell_longs);
  expect_same_maps(actual.cell_doubles, expected.cell_doubles);
  EXPECT_EQ(actual.field_texts, expected.field_texts);
}

}  // namespace tessera::testing
