// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/netgen/factory.hpp"

#include "support/cut_meshes.hpp"
#include "support/temporary_file.hpp"

namespace tessera {
namespace {

using testing::branch;
using testing::leaf;
using testing::tree_of;

constexpr const char* kCube =
    "algebraic3d\nsolid cube = orthobrick (0, 0, 0; 1, 1, 1) -bcname=wall;\ntlo cube;\n";
constexpr const char* kSphere =
    "algebraic3d\nsolid ball = sphere (1, 2, 3; 2) -bcname=hull;\ntlo ball;\n";
constexpr const char* kHole =
    "algebraic3d\nsolid cube = orthobrick (0, 0, 0; 1, 1, 1) -bcname=wall;\n"
    "solid pin = cylinder (0.5, 0.5, 0; 0.5, 0.5, 1; 0.2) -bcname=mantle;\n"
    "solid plate = cube and not pin;\nsolid core = cube and pin;\n"
    "tlo plate -material=steel;\ntlo core -material=copper;\n";

std::unique_ptr<model::Model> load(const std::string& text)
{
  const testing::TemporaryFile file("model.geo", text);
  return netgen::load_model(netgen::import_model(file.path(), {}));
}

surface::CoarseOptions options_of(double max_size)
{
  surface::CoarseOptions options;
  options.max_size = max_size;
  return options;
}

mesh::CoarseMesh uncut_mesh(const model::Model& model, double max_size)
{
  return netgen::make_coarse_mesher(model)->generate(options_of(max_size));
}

TEST(CsgCut, HalvesOfACubeAreOneMaterialWithoutAPatchBetweenThem)
{
  const auto model = load(kCube);
  const cut::CutTree tree = tree_of({branch({{1, 0, 0}, 0.5}, leaf(), leaf())});
  const cut::CutMesh cut =
      netgen::make_coarse_mesher(*model)->generate_parts(options_of(0.3), tree);
  EXPECT_NO_THROW(mesh::validate(cut.mesh));
  testing::expect_parts_in_their_cells(cut, tree, 1e-12);
  EXPECT_EQ(cut.mesh.num_materials(), 1);
  EXPECT_NEAR(testing::volume_of(cut.mesh, 1), 1.0, 1e-12);
  testing::expect_same_names(cut.mesh, uncut_mesh(*model, 0.3));
}

TEST(CsgCut, PiecesOfASphereAreOnePatch)
{
  const auto model = load(kSphere);
  const cut::CutTree tree =
      tree_of({branch({{0, 0, 1}, 3.2}, leaf(), branch({{1, 0, 0}, 1.3}, leaf(), leaf()))});
  const cut::CutMesh cut =
      netgen::make_coarse_mesher(*model)->generate_parts(options_of(0.7), tree);
  testing::expect_parts_in_their_cells(cut, tree, 1e-12);
  EXPECT_EQ(cut.mesh.patch_names, std::vector<std::string>{"hull"});
  EXPECT_EQ(cut.mesh.num_segments(), uncut_mesh(*model, 0.7).num_segments());
}

TEST(CsgCut, MaterialsAndPatchesOfTwoSolidsAreThoseOfTheUncutModel)
{
  const auto model = load(kHole);
  const cut::CutTree tree = tree_of(
      {branch({{1, 0, 0}, 0.47}, leaf(), leaf()), branch({{0, 0, 1}, 0.6}, leaf(), leaf())});
  const cut::CutMesh cut =
      netgen::make_coarse_mesher(*model)->generate_parts(options_of(0.3), tree);
  testing::expect_parts_in_their_cells(cut, tree, 1e-12);
  const mesh::CoarseMesh uncut = uncut_mesh(*model, 0.3);
  testing::expect_same_names(cut.mesh, uncut);
  for (const LocalIndex material : {1, 2}) {
    EXPECT_NEAR(testing::volume_of(cut.mesh, material), testing::volume_of(uncut, material), 0.01);
  }
  testing::expect_points_on_surfaces(cut.mesh, *model, 1e-9);
}

// The face between the halves has traces of both other planes, which cross there.
TEST(CsgCut, TracesOfTwoPlanesThatCrossOnAThirdMeetConformingly)
{
  const auto model = load(kCube);
  const cut::CutTree tree =
      tree_of({branch({{1, 0, 0}, 0.5}, branch({{0, 1, 0}, 0.4}, leaf(), leaf()),
                      branch({{0, 0, 1}, 0.7}, leaf(), leaf()))});
  const cut::CutMesh cut =
      netgen::make_coarse_mesher(*model)->generate_parts(options_of(0.3), tree);
  EXPECT_NO_THROW(mesh::validate(cut.mesh));
  testing::expect_parts_in_their_cells(cut, tree, 1e-12);
  EXPECT_NEAR(testing::volume_of(cut.mesh, 1), 1.0, 1e-12);
}

}  // namespace
}  // namespace tessera
