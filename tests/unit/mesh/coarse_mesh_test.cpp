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
