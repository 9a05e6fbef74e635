// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/tet_mesh_file.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/meshes.hpp"
#include "support/msh_files.hpp"
#include "support/temporary_file.hpp"

namespace tessera::model {
namespace {

using testing::kMshForms;
using testing::msh_text;
using testing::MshForm;
using testing::TemporaryFile;
using testing::two_material_cube;
using testing::vol_text;

TetMeshFile read(const std::string& content)
{
  return read_msh(TemporaryFile("mesh.msh", content).path());
}

std::string message_of(const std::string& content,
                       TetMeshFile (*reader)(const std::filesystem::path&))
{
  const TemporaryFile file("mesh.msh", content);
  try {
    (void)reader(file.path());
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with(file.path().string())) << message;
    return message.substr(file.path().string().size());
  }
  return {};
}

std::string message_of_msh(const std::string& content) { return message_of(content, read_msh); }

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

void expect_same(const TetMeshFile& read, const mesh::CoarseMesh& mesh)
{
  EXPECT_EQ(read.point_xyz, mesh.vertex_xyz);
  EXPECT_EQ(read.tets.points, mesh.tet_vertices);
  EXPECT_EQ(read.tets.group, mesh.tet_material);
  EXPECT_EQ(read.triangles.points, mesh.face_vertices);
  ASSERT_EQ(read.triangles.size(), mesh.face_patch.size());
  for (std::size_t f = 0; f < mesh.face_patch.size(); ++f) {
    EXPECT_EQ(read.triangles.entity[f], mesh.face_patch[f] + 1);
    const auto name = read.triangle_group_names.find(read.triangles.group[f]);
    ASSERT_NE(name, read.triangle_group_names.end());
    EXPECT_EQ(name->second, mesh.patch_names[at(mesh.face_patch[f])]);
  }
  ASSERT_EQ(read.tet_group_names.size(), 2U);
  EXPECT_EQ(read.tet_group_names.at(2), mesh.material_names[1]);
}

TEST(MshFile, EveryFormKeepsEveryBitAllTagsAndNames)
{
  mesh::CoarseMesh mesh = two_material_cube(2);
  mesh.material_names = {"left side", "right"};
  for (const MshForm form : kMshForms) {
    SCOPED_TRACE(static_cast<int>(form));
    expect_same(read(msh_text(mesh, form)), mesh);
  }
}

TEST(MshFile, TruncationsAreRefused)
{
  const mesh::CoarseMesh mesh = testing::kuhn_cube(1);
  for (const MshForm form : kMshForms) {
    const std::string whole = msh_text(mesh, form);
    const std::size_t last = whole.rfind("$EndElements") + std::string("$EndElements").size();
    for (std::size_t size = 0; size < last; size += 3) {
      EXPECT_FALSE(message_of_msh(whole.substr(0, size)).empty())
          << "form " << static_cast<int>(form) << ", first " << size << " bytes";
    }
  }
}

// Whatever a byte becomes, the reader neither crashes nor takes much memory; and what it takes is
// consistent.
TEST(MshFile, DamagedBytesAreRefusedOrHarmless)
{
  const mesh::CoarseMesh mesh = testing::kuhn_cube(1);
  std::size_t num_refused = 0;
  for (const MshForm form : kMshForms) {
    const std::string whole = msh_text(mesh, form);
    for (std::size_t place = 0; place < whole.size(); place += 3) {
      std::string damaged = whole;
      damaged[place] = static_cast<char>(damaged[place] ^ 0x15);
      try {
        const TetMeshFile file = read(damaged);
        const auto num_points = static_cast<LocalIndex>(file.point_number.size());
        EXPECT_EQ(file.point_xyz.size(), 3 * file.point_number.size());
        for (const LocalIndex p : file.tets.points) EXPECT_TRUE(p >= 0 && p < num_points);
      } catch (const InputError&) {
        ++num_refused;
      }
    }
  }
  EXPECT_GT(num_refused, 100U);
}

TEST(MshFile, SaysWhereTheTextIsWrong)
{
  const std::string good = msh_text(testing::kuhn_cube(1), MshForm::text22);
  const auto says = [&](const std::string& from, const std::string& to, const std::string& part) {
    const std::string message = message_of_msh(replaced(good, from, to));
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  says("$MeshFormat", "solid part", "does not begin with $MeshFormat");
  says("2.2 0 8", "1.0 0 8", "is of version 1.0");
  says("2.2 0 8", "2.2 0 4", "numbers of 4 bytes");
  says("$Nodes\n8\n1 0 0 0 \n", "$Nodes\n8\n1 nan 0 0 \n", ":16: a coordinate is not a finite");
  says("$Nodes\n8\n1 0 0 0 \n", "$Nodes\n8\n1 zero 0 0 \n", "found 'zero'");
  says("$Nodes\n8\n", "$Nodes\n900000000\n", "only");
  says("$Elements\n18\n1 2 2 ", "$Elements\n18\n1 2 0 99 ",
       "element 1 has node 99, which the file does not have");
  says("$Elements\n18\n1 2 2 ", "$Elements\n18\n1 5 2 ", "element 1: the mesh has hexahedra");
  says("$Elements\n18\n1 2 2 ", "$Elements\n18\n1 11 2 ", "-order 1");
  says("$Elements\n18\n1 2 2 ", "$Elements\n18\n1 77 2 ", "elements of type 77");
  says("$Elements", "$Elefants", "the file is truncated: it ends where $EndElefants");
}

TEST(VolFile, KeepsTagsAndNamesAndTurnsNothing)
{
  const mesh::CoarseMesh mesh = two_material_cube(2);
  const TetMeshFile file = read_vol(TemporaryFile("mesh.vol", vol_text(mesh)).path());
  EXPECT_EQ(file.point_xyz, mesh.vertex_xyz);
  EXPECT_EQ(file.triangles.points, mesh.face_vertices);
  EXPECT_EQ(file.tets.group, mesh.tet_material);
  ASSERT_EQ(file.tets.size(), at(mesh.num_tets()));
  EXPECT_EQ(file.tets.points[2], mesh.tet_vertices[3]);
  EXPECT_EQ(file.triangle_group_names.at(1), mesh.patch_names[0]);
  EXPECT_EQ(file.tet_group_names.at(2), mesh.material_names[1]);
}

TEST(VolFile, SaysWhatIsWrong)
{
  const std::string good = vol_text(testing::kuhn_cube(1));
  const auto says = [&](const std::string& from, const std::string& to, const std::string& part) {
    const std::string message = message_of(replaced(good, from, to), read_vol);
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  says("mesh3d", "mesh2d", "does not begin with mesh3d");
  says("mesh3d", "# mesh3d", "does not begin with mesh3d");
  const TemporaryFile commented("newer.vol", "# Generated by NETGEN v6.2.2501\n\n" + good);
  EXPECT_EQ(read_vol(commented.path()).tets.points,
            read_vol(TemporaryFile("mesh.vol", good).path()).tets.points);
  says("dimension\n3", "dimension\n2", "not of three dimensions");
  says("volumeelements\n6\n1 4", "volumeelements\n6\n1 10", "volume element 1 has 10 points");
  says("volumeelements\n6\n1 4 1 ", "volumeelements\n6\n1 4 99 ", "tet 1 has point 99");
  says("volumeelements\n6\n1 4 1 ", "volumeelements\n6\n1 4 0 ", "has point 0");
  says("points\n8\n0 0 0", "points\n8\n0 inf 0", "not a finite number");
  const std::size_t last = good.find("\n\nmaterials");
  for (std::size_t size = 0; size < last; ++size) {
    EXPECT_FALSE(message_of(good.substr(0, size), read_vol).empty())
        << "first " << size << " bytes";
  }
}

}  // namespace
}  // namespace tessera::model
