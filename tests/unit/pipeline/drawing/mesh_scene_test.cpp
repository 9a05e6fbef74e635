// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/drawing/mesh_scene.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::pipeline {
namespace {

std::size_t num_drawn(Canvas& canvas)
{
  return static_cast<std::size_t>(
      std::ranges::count_if(canvas.pixels(), [](std::uint64_t pixel) { return pixel != 0; }));
}

TEST(CutPlane, KeepsWhatIsBehindIt)
{
  const CutPlane plane{.axis = 1, .towards_eye = -1.0, .position = 2.0};
  EXPECT_GT(plane.height({0.0, 1.0, 0.0}), 0.0);
  EXPECT_LT(plane.height({0.0, 3.0, 0.0}), 0.0);
}

TEST(QualityColours, GoFromRedToBlue)
{
  const std::vector<Colour>& colours = quality_colours();
  ASSERT_EQ(colours.size(), 10U);
  EXPECT_GT(colours.front()[0], colours.front()[2] + 80);
  EXPECT_GT(colours.back()[2], colours.back()[0] + 80);
}

// The octants of a cube, each its own subdomain.
class SceneOfACube : public ::testing::Test {
 protected:
  [[nodiscard]] std::vector<char> made(LocalIndex first, LocalIndex last) const
  {
    std::vector<char> is_made(8);
    for (LocalIndex s = first; s < last; ++s) is_made[at(s)] = 1;
    return is_made;
  }

  mesh::CoarseMesh cube_ = testing::kuhn_cube(4);
  mesh::Decomposition octants_ = testing::octants(cube_);
  subdomain::PartitionedMesh cut_{cube_, octants_, mesh::EdgeLevels(1)};
  MeshScene scene_{cube_.vertex_xyz};
};

TEST_F(SceneOfACube, ShowsTheSubdomainsThatFaceTheEye)
{
  scene_.draw_coarse_boundary(cut_, made(0, 8));
  Canvas& canvas = *scene_.canvases()[0];
  std::set<LocalIndex> seen;
  for (int y = 0; y < canvas.camera().height; ++y) {
    for (int x = 0; x < canvas.camera().width; ++x) seen.insert(canvas.row(x, y));
  }
  seen.erase(kNoIndex);
  // The eye is in front, to the right and above: only one octant is hidden.
  EXPECT_EQ(seen.size(), 7U);
}

TEST_F(SceneOfACube, ClosesAPartOfAMesh)
{
  scene_.draw_coarse_boundary(cut_, made(0, 8));
  MeshScene part(cube_.vertex_xyz);
  part.draw_coarse_boundary(cut_, made(0, 1));
  const std::size_t whole = num_drawn(*scene_.canvases()[0]);
  const std::size_t of_part = num_drawn(*part.canvases()[0]);
  EXPECT_NEAR(static_cast<double>(of_part), 0.25 * static_cast<double>(whole),
              0.02 * static_cast<double>(whole));
}

TEST_F(SceneOfACube, CutsEveryOctantNearTheMiddle)
{
  LocalIndex num_cut = 0;
  for (LocalIndex s = 0; s < 8; ++s) {
    if (!scene_.is_cut(cut_, s)) continue;
    ++num_cut;
    scene_.draw_coarse_cut(cut_, s, 0.95);
  }
  EXPECT_GE(num_cut, 4);
  Canvas& canvas = *scene_.canvases()[2];
  EXPECT_GT(num_drawn(canvas), canvas.pixels().size() / 5);
  EXPECT_EQ(canvas.row(canvas.camera().width / 2, canvas.camera().height / 2), 9);
}

TEST_F(SceneOfACube, DrawsTheSameTetsFromAFile)
{
  mesh::MeshArrays file;
  file.point_xyz = cube_.vertex_xyz.to_vector();
  file.cell_points = cube_.tet_vertices.to_vector();
  scene_.draw_cut_tets(file);
  MeshScene coarse(cube_.vertex_xyz);
  for (LocalIndex s = 0; s < 8; ++s) coarse.draw_coarse_cut(cut_, s, 0.95);
  EXPECT_EQ(num_drawn(*scene_.canvases()[2]), num_drawn(*coarse.canvases()[2]));
}

TEST_F(SceneOfACube, DrawsTheBoundaryOfAFileBySubdomainAndPatch)
{
  mesh::MeshArrays file{.vertices_per_cell = 3};
  file.point_xyz = cube_.vertex_xyz.to_vector();
  file.cell_points = cube_.face_vertices.to_vector();
  file.cell_ints["patch"] = cube_.face_patch.to_vector();
  file.cell_ints["subdomain"].assign(cube_.face_patch.size(), 5);
  scene_.draw_boundary(file);
  MeshScene coarse(cube_.vertex_xyz);
  coarse.draw_coarse_boundary(cut_, made(0, 8));
  EXPECT_EQ(scene_.canvases()[1]->pixels(), coarse.canvases()[1]->pixels());
  const Canvas& canvas = *scene_.canvases()[0];
  EXPECT_EQ(canvas.row(canvas.camera().width / 2, canvas.camera().height / 2), 5);
}

TEST_F(SceneOfACube, MakesThreePictures)
{
  scene_.draw_coarse_boundary(cut_, made(0, 8));
  const std::vector<MeshPicture> pictures = scene_.pictures();
  ASSERT_EQ(pictures.size(), 3U);
  for (const MeshPicture& picture : pictures) EXPECT_GT(picture.png.size(), 500U) << picture.name;
}

}  // namespace
}  // namespace tessera::pipeline
