// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/cut/choose_planes.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/netgen/factory.hpp"

#include "support/cut_meshes.hpp"

#include "netgen/cad/occ_fixture.hpp"

namespace tessera {
namespace {

using testing::branch;
using testing::leaf;
using testing::tree_of;

// A corner is off a plane by OpenCASCADE's tolerances.
constexpr double kTolerance = 1e-6;

struct CutModel {
  CutModel(const std::string& name, double max_size, const cut::CutTree& tree)
      : model(testing::load_own(name)), uncut(testing::coarse_mesh_of(*model, max_size))
  {
    surface::CoarseOptions options;
    options.max_size = max_size;
    cut = netgen::make_coarse_mesher(*model)->generate_parts(options, tree);
  }

  std::unique_ptr<model::Model> model;
  mesh::CoarseMesh uncut;
  cut::CutMesh cut{};
};

void expect_equal_models(const CutModel& cut, const cut::CutTree& tree)
{
  EXPECT_NO_THROW(mesh::validate(cut.cut.mesh));
  testing::expect_parts_in_their_cells(cut.cut, tree, kTolerance);
  testing::expect_same_names(cut.cut.mesh, cut.uncut);
  testing::expect_points_on_surfaces(cut.cut.mesh, *cut.model, 1e-5);
  for (LocalIndex m = 1; m <= cut.uncut.num_materials(); ++m) {
    const double volume = testing::volume_of(cut.uncut, m);
    EXPECT_NEAR(testing::volume_of(cut.cut.mesh, m), volume, 0.05 * volume);
  }
}

TEST(OccCut, PartsOfABracketKeepItsFacesAndEdges)
{
  const cut::CutTree tree =
      tree_of({branch({{1, 0, 0}, 7}, leaf(), branch({{0, 1, 0}, 6}, leaf(), leaf()))});
  const CutModel bracket("bracket.step", 5.0, tree);
  expect_equal_models(bracket, tree);
}

TEST(OccCut, TracesOfTwoPlanesThatCrossOnAThirdMeetConformingly)
{
  const cut::CutTree tree = tree_of({branch({{1, 0, 0}, 1}, branch({{0, 1, 0}, 2}, leaf(), leaf()),
                                            branch({{0, 0, 1}, 3}, leaf(), leaf()))});
  expect_equal_models(CutModel("sphere.step", 4.0, tree), tree);
}

TEST(OccCut, ASeamOfAPeriodicFaceMayBeCutAway)
{
  const cut::CutTree tree =
      tree_of({branch({{0, 1, 0}, 0.5}, leaf(), branch({{1, 0, 0}, 0.7}, leaf(), leaf()))});
  expect_equal_models(CutModel("torus.step", 2.5, tree), tree);
  expect_equal_models(CutModel("cylinder.step", 3.0, tree), tree);
}

// The seams of its holes are edges for NETGEN, with tiny tets beside those that a plane comes near.
TEST(OccCut, ChosenPlanesMakeFewMoreTets)
{
  const auto model = testing::load_own("bracket.step");
  const cut::CutChoice choice =
      cut::choose_planes(netgen::describe_model(*model), {.parts = 6, .coarse_size = 5.0});
  EXPECT_EQ(choice.tree.num_parts, 6);
  const CutModel bracket("bracket.step", 5.0, choice.tree);
  expect_equal_models(bracket, choice.tree);
  EXPECT_LE(bracket.cut.mesh.num_tets(), 1.15 * bracket.uncut.num_tets());
}

// Traces of both cross on the face between the blocks.
TEST(OccCut, BlocksThatShareAFaceAreCutEachByItsOwnPlanes)
{
  const cut::CutTree tree =
      tree_of({branch({{0, 1, 0}, 4.4}, leaf(), leaf()), branch({{0, 0, 1}, 5.3}, leaf(), leaf())});
  expect_equal_models(CutModel("two_blocks.step", 3.0, tree), tree);
}

}  // namespace
}  // namespace tessera
