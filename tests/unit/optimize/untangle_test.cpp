// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/optimize/optimize.hpp"

#include "sample_meshes.hpp"

namespace tessera::optimize {
namespace {

using testing::boundary_of;
using testing::figures_of;
using testing::MeshFigures;
using testing::tangled_cube;

const OptimizeOptions kUntangle{.untangle = true};

TEST(Untangle, MakesInvertedTetsPositive)
{
  for (const double jitter : {0.6, 0.8, 1.0}) {
    for (const unsigned seed : {1U, 2U, 3U, 4U}) {
      const TetMesh mesh = tangled_cube(5, jitter, seed);
      ASSERT_LT(figures_of(mesh.vertex_xyz, mesh.tet_vertices).least_volume, 0.0);
      const OptimizeResult result = optimize(mesh, standard_schedule(), kUntangle);
      const MeshFigures figures = figures_of(result.vertex_xyz, result.tet_vertices);
      EXPECT_GT(figures.least_mean_ratio, 0.2);
      EXPECT_NEAR(figures.volume, 1.0, 1e-12);
      EXPECT_GT(result.statistics.num_untangled, 0);
      EXPECT_EQ(boundary_of(result.vertex_xyz, result.tet_vertices),
                boundary_of(mesh.vertex_xyz, mesh.tet_vertices));
    }
  }
}

TEST(Untangle, MakesFlatTetsPositive)
{
  TetMesh mesh = tangled_cube(2, 0.0, 1);
  for (std::size_t k = 0; k < 3; ++k) mesh.vertex_xyz[3 * 13 + k] = 0.0;  // The middle: a corner.
  const OptimizeResult result = optimize(mesh, standard_schedule(), kUntangle);
  EXPECT_GT(figures_of(result.vertex_xyz, result.tet_vertices).least_mean_ratio, 0.3);
}

TEST(Untangle, ChangesNothingWhereAllIsPositive)
{
  const TetMesh mesh = testing::jittered_cube(4, 0.8, 3);
  const OptimizeResult plain = optimize(mesh, standard_schedule());
  const OptimizeResult result = optimize(mesh, standard_schedule(), kUntangle);
  EXPECT_EQ(result.vertex_xyz, plain.vertex_xyz);
  EXPECT_EQ(result.tet_vertices, plain.tet_vertices);
  EXPECT_EQ(result.statistics.num_untangled, 0);
}

TEST(Untangle, IsTheSameForEveryInstructionSet)
{
  const TetMesh mesh = tangled_cube(5, 0.9, 6);
  const OptimizeResult expected = optimize(
      mesh, standard_schedule(), {.untangle = true, .instruction_set = InstructionSet::baseline});
  for (const InstructionSet set : available_instruction_sets()) {
    const OptimizeResult result =
        optimize(mesh, standard_schedule(), {.untangle = true, .instruction_set = set});
    EXPECT_EQ(result.vertex_xyz, expected.vertex_xyz) << name_of(set);
    EXPECT_EQ(result.tet_vertices, expected.tet_vertices) << name_of(set);
  }
}

TEST(Untangle, NamesATetThatCannotBePositive)
{
  TetMesh mesh = testing::one_tet();
  mesh.vertex_xyz[11] = -1.0;
  try {
    static_cast<void>(optimize(mesh, standard_schedule(), kUntangle));
    FAIL() << "not refused";
  } catch (const MeshError& error) {
    EXPECT_EQ(std::string(error.what()), "tet 0 is flat or inverted");
  }
}

}  // namespace
}  // namespace tessera::optimize
