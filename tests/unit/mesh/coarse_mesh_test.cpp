// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/coarse_mesh.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/meshes.hpp"

namespace tessera::mesh {
namespace {

TEST(CoarseMesh, TheCubesOfTheTestsAreValid)
{
  EXPECT_NO_THROW(validate(testing::kuhn_cube(3)));
  EXPECT_NO_THROW(validate(testing::two_material_cube(2)));
}

TEST(CoarseMesh, ByteImageBringsBackEveryArray)
{
  const CoarseMesh mesh = testing::two_material_cube(2);

  const CoarseMesh copy = coarse_mesh_from_bytes(to_bytes(mesh));

  EXPECT_EQ(copy.vertex_xyz, mesh.vertex_xyz);
  EXPECT_EQ(copy.tet_vertices, mesh.tet_vertices);
  EXPECT_EQ(copy.tet_material, mesh.tet_material);
  EXPECT_EQ(copy.face_vertices, mesh.face_vertices);
  EXPECT_EQ(copy.face_patch, mesh.face_patch);
  EXPECT_EQ(copy.segment_vertices, mesh.segment_vertices);
  EXPECT_EQ(copy.segment_curve, mesh.segment_curve);
  EXPECT_EQ(copy.patch_names, mesh.patch_names);
  EXPECT_EQ(copy.patch_surface, mesh.patch_surface);
  EXPECT_EQ(copy.material_names, mesh.material_names);
}

TEST(CoarseMesh, EveryTruncatedByteImageIsRefused)
{
  const Bytes bytes = to_bytes(testing::kuhn_cube(1));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(static_cast<void>(coarse_mesh_from_bytes(std::span(bytes).first(size))),
                 InputError)
        << size << " of " << bytes.size() << " bytes";
  }
}

TEST(CoarseMesh, ValidateFindsEachDefect)
{
  const std::vector<std::function<void(CoarseMesh&)>> defects{
      [](CoarseMesh& m) { std::swap(m.tet_vertices[0], m.tet_vertices[1]); },
      [](CoarseMesh& m) { m.tet_vertices[0] = 1000; },
      [](CoarseMesh& m) { m.tet_material[0] = 0; },
      [](CoarseMesh& m) { m.tet_material[0] = 3; },
      [](CoarseMesh& m) { m.face_patch.pop_back(); },
      [](CoarseMesh& m) { m.face_patch[0] = 99; },
      [](CoarseMesh& m) { m.segment_vertices[0] = -1; },
      [](CoarseMesh& m) {
        m.face_vertices.resize(m.face_vertices.size() - 3);
        m.face_patch.pop_back();
      },
      [](CoarseMesh& m) { std::copy_n(m.face_vertices.begin(), 3, m.face_vertices.begin() + 3); },
      [](CoarseMesh& m) { m.tet_vertices.clear(); },
  };
  for (std::size_t d = 0; d < defects.size(); ++d) {
    CoarseMesh mesh = testing::two_material_cube(2);
    defects[d](mesh);
    EXPECT_THROW(validate(mesh), MeshError) << "defect " << d;
  }
}

}  // namespace
}  // namespace tessera::mesh
