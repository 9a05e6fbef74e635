// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/own_mesh.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/meshes.hpp"

namespace tessera::coarse {
namespace {

using model::TetMeshFile;

constexpr double kAngle = 30.0;

// As a file has it; elements count from 1.
TetMeshFile file_of(const mesh::CoarseMesh& mesh)
{
  TetMeshFile file;
  file.point_xyz = mesh.vertex_xyz.to_vector();
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) file.point_number.push_back(v + 1);
  file.tets.points = mesh.tet_vertices.to_vector();
  file.tets.group = mesh.tet_material.to_vector();
  file.tets.entity.assign(mesh.tet_material.size(), 0);
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) file.tets.number.push_back(t + 1);
  file.triangles.points = mesh.face_vertices.to_vector();
  file.triangles.entity = mesh.face_patch.to_vector();
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    file.triangles.number.push_back(f + 1);
    file.triangles.group.push_back(mesh.face_patch[at(f)] + 1);
    ++file.triangles.entity[at(f)];
  }
  for (LocalIndex p = 0; p < mesh.num_patches(); ++p) {
    file.triangle_group_names[p + 1] = mesh.patch_names[at(p)];
  }
  for (LocalIndex m = 0; m < mesh.num_materials(); ++m) {
    file.tet_group_names[m + 1] = mesh.material_names[at(m)];
  }
  return file;
}

OwnMesh made(const TetMeshFile& file) { return make_own_mesh(file, "part.msh", kAngle); }

std::string refusal_of(const TetMeshFile& file)
{
  try {
    (void)made(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

void expect_refused(const TetMeshFile& file, const std::string& part)
{
  const std::string message = refusal_of(file);
  EXPECT_TRUE(message.starts_with("part.msh: ")) << message;
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

LocalIndex add_point(TetMeshFile& file, const Vec3& point)
{
  file.point_xyz.insert(file.point_xyz.end(), point.begin(), point.end());
  file.point_number.push_back(static_cast<GlobalIndex>(file.point_number.size()) + 1);
  return static_cast<LocalIndex>(file.point_number.size()) - 1;
}

void add_tet(TetMeshFile& file, const std::array<LocalIndex, 4>& points)
{
  file.tets.points.insert(file.tets.points.end(), points.begin(), points.end());
  file.tets.number.push_back(static_cast<GlobalIndex>(file.tets.size()) + 1);
  file.tets.group.push_back(1);
  file.tets.entity.push_back(0);
}

void drop_triangles(TetMeshFile& file) { file.triangles = {}; }

// One tet on the corner of the unit cube.
TetMeshFile one_tet()
{
  TetMeshFile file;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    add_point(file, p);
  }
  add_tet(file, {0, 1, 2, 3});
  return file;
}

TEST(OwnMesh, KeepsMaterialsPatchesAndNames)
{
  mesh::CoarseMesh cube = testing::two_material_cube(2);
  cube.material_names = {"steel", "copper"};
  const OwnMesh own = made(file_of(cube));
  EXPECT_EQ(own.mesh.material_names, cube.material_names);
  EXPECT_EQ(own.mesh.tet_material, cube.tet_material);
  EXPECT_EQ(own.mesh.num_faces(), cube.num_faces());
  EXPECT_EQ(own.mesh.patch_names, cube.patch_names);
  EXPECT_TRUE(own.repairs.empty());
}

TEST(OwnMesh, MakesUpMissingTrianglesByFeatureAngle)
{
  TetMeshFile file = file_of(testing::two_material_cube(2));
  drop_triangles(file);
  const OwnMesh own = made(file);
  // Four sides of either half, two ends, and the seam between the materials.
  EXPECT_EQ(own.mesh.num_patches(), 11);
  const std::set<std::string> names(own.mesh.patch_names.begin(), own.mesh.patch_names.end());
  EXPECT_EQ(names.size(), 11U);
  ASSERT_EQ(own.repairs.size(), 1U);
  EXPECT_NE(own.repairs[0].find("boundary triangles are not in the file"), std::string::npos);
}

TEST(OwnMesh, PatchesOfOneGroupHaveOneRow)
{
  TetMeshFile file = file_of(testing::kuhn_cube(1));
  std::ranges::fill(file.triangles.group, 4);
  file.triangle_group_names = {{4, "skin"}};
  const OwnMesh own = made(file);
  ASSERT_EQ(own.mesh.num_patches(), 6);
  EXPECT_EQ(std::ranges::count(own.mesh.patch_row, 0), 6);
  EXPECT_EQ(std::ranges::count(own.mesh.patch_names, "skin"), 6);
}

TEST(OwnMesh, ANumberNamesWhatTheFileDoesNot)
{
  TetMeshFile file = file_of(testing::kuhn_cube(1));
  file.triangle_group_names.clear();
  file.tet_group_names.clear();
  std::ranges::fill(file.tets.group, 12);
  const OwnMesh own = made(file);
  EXPECT_EQ(own.mesh.material_names, std::vector<std::string>{"material_12"});
  EXPECT_EQ(own.mesh.patch_names[3], "patch_4");
}

TEST(OwnMesh, JoinsEqualPointsAndDropsLooseOnes)
{
  TetMeshFile file = one_tet();
  add_point(file, {7, 7, 7});
  const LocalIndex twin = add_point(file, {1, 0, 0});
  const LocalIndex far = add_point(file, {1, 1, 1});
  add_tet(file, {twin, 2, 3, far});
  file.tets.points[4 + 0] = twin;
  const OwnMesh own = made(file);
  EXPECT_EQ(own.mesh.num_vertices(), 5);
  EXPECT_EQ(own.mesh.num_faces(), 6);
  EXPECT_EQ(own.repairs.size(), 2U);
}

TEST(OwnMesh, TurnsTetsThatAreAllInsideOut)
{
  const mesh::CoarseMesh cube = testing::kuhn_cube(1);
  TetMeshFile file = file_of(cube);
  for (std::size_t t = 0; t < file.tets.size(); ++t) {
    std::swap(file.tets.points[4 * t + 2], file.tets.points[4 * t + 3]);
  }
  const OwnMesh own = made(file);
  EXPECT_NO_THROW(mesh::validate(own.mesh));
  ASSERT_EQ(own.repairs.size(), 1U);
  EXPECT_NE(own.repairs[0].find("inside out"), std::string::npos);
}

TEST(OwnMesh, TetsThatStandTwiceCountOnce)
{
  TetMeshFile file = one_tet();
  add_tet(file, {0, 1, 2, 3});
  EXPECT_EQ(made(file).mesh.num_tets(), 1);
}

TEST(OwnMesh, RefusesABrokenMeshWithThePlace)
{
  TetMeshFile odd = file_of(testing::kuhn_cube(1));
  std::swap(odd.tets.points[10], odd.tets.points[11]);
  expect_refused(odd, "tet 3 at (");

  TetMeshFile flat = one_tet();
  flat.point_xyz[11] = 1e-12;
  expect_refused(flat, "tet 1 at (0.25, 0.25, 2.5e-13) is flat");

  TetMeshFile doubled = one_tet();
  doubled.tets.points[3] = 0;
  expect_refused(doubled, "has one corner twice");

  TetMeshFile loose = file_of(testing::kuhn_cube(1));
  std::copy_n(std::array{1, 2, 4}.begin(), 3, loose.triangles.points.begin());
  expect_refused(loose, "triangle 1 at (");
  expect_refused(TetMeshFile{}, "it has no tets");

  TetMeshFile three = one_tet();
  const LocalIndex below = add_point(three, {0.2, 0.2, -1});
  const LocalIndex deeper = add_point(three, {0.3, 0.2, -2});
  add_tet(three, {0, 2, 1, below});
  add_tet(three, {0, 2, 1, deeper});
  expect_refused(three, "share one triangle");
}

TEST(OwnMesh, RefusesTetsThatMeetWithoutSharingFaces)
{
  // A tet whose corner lies on the middle of another one's face.
  TetMeshFile hanging = one_tet();
  const LocalIndex on_face = add_point(hanging, {0.25, 0.25, 0});
  const LocalIndex a = add_point(hanging, {0, 0, -1});
  const LocalIndex b = add_point(hanging, {1, 0, -1});
  const LocalIndex c = add_point(hanging, {0, 1, -1});
  add_tet(hanging, {a, b, c, on_face});
  expect_refused(hanging, "meet at (0.25, 0.25, 0) but do not share a face");

  // Two bodies on either side of a square, which they cut by its two diagonals.
  TetMeshFile crossed;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0},
                        Vec3{0.5, 0.4, 1}, Vec3{0.5, 0.4, -1}}) {
    add_point(crossed, p);
  }
  add_tet(crossed, {0, 1, 2, 4});
  add_tet(crossed, {0, 2, 3, 4});
  add_tet(crossed, {0, 3, 1, 5});
  add_tet(crossed, {1, 3, 2, 5});
  expect_refused(crossed, "do not share a face there");
}

TEST(OwnMesh, BodiesThatShareAnEdgeOnlyAreTaken)
{
  TetMeshFile file = one_tet();
  const LocalIndex a = add_point(file, {0, -1, 0});
  const LocalIndex b = add_point(file, {0, 0, -1});
  add_tet(file, {0, 1, a, b});
  EXPECT_EQ(made(file).mesh.num_tets(), 2);
}

}  // namespace
}  // namespace tessera::coarse
