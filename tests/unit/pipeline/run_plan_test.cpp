// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/run_plan.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "pipeline/stages/coarse/coarse_part.hpp"
#include "pipeline/stages/fill/improve_stage.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"

namespace tessera::pipeline {
namespace {

using fill::KernelKind;

std::vector<KernelKind> all_of(KernelKind kernel) { return std::vector(4, kernel); }

// Two slabs of each of two materials.
struct PlanOfACube : ::testing::Test {
  const mesh::CoarseMesh cube = testing::two_material_cube(4);
  const mesh::Decomposition decomposition = testing::slabs(cube, 2);
  RunResult run{};

  // After the stages that make the subdomains.
  [[nodiscard]] std::string rest(KernelKind kernel, const PieceChoices& choices = {}) const
  {
    const subdomain::PartitionedMesh cut(cube, decomposition, 1);
    const auto files = subdomain::file_ranges(cut.num_subdomains(), 0);
    const std::string all =
        text_of(stages_of(run, outline_run(cut, all_of(kernel), files, choices)));
    const std::string last = "decompose, ";
    return all.substr(all.find(last) + last.size());
  }
};

TEST_F(PlanOfACube, FillsWriteFilesIfAllIsSubdivided)
{
  EXPECT_EQ(rest(KernelKind::subdivide), "plan, fill, verify, pictures");
}

TEST_F(PlanOfACube, RanksWriteWhatIsKnownOnlyAfterTheFills)
{
  EXPECT_EQ(rest(KernelKind::netgen, {.improves_seams = true}),
            "plan, fill, improve, verify, write, pictures");
  EXPECT_EQ(rest(KernelKind::subdivide, {.divides_corners = true}),
            "plan, fill, verify, write, pictures");
}

TEST_F(PlanOfACube, JobsWriteWhatIsSplitOrCurved)
{
  EXPECT_EQ(rest(KernelKind::netgen, {.splits = 1}),
            "plan, fill, verify, refine, verify, pictures");
  EXPECT_EQ(rest(KernelKind::subdivide, {.is_curved = true}),
            "plan, fill, verify, curve, verify, pictures");
}

TEST_F(PlanOfACube, NothingIsMadeOfFilesThatAreNotThere)
{
  run.resolved.periodic.resize(1);
  run.resolved.output.formats = {io::Format::pvtu, io::Format::msh};
  EXPECT_EQ(rest(KernelKind::subdivide, {.has_files = false}),
            "plan, fill, verify, hand over, pictures");
  EXPECT_EQ(rest(KernelKind::subdivide), "plan, fill, verify, partners, pictures, export");
}

TEST_F(PlanOfACube, PartsGetNeighboursUnlessFormatsDo)
{
  run.resolved.output.report_html = false;
  run.resolved.output.parts = 2;
  EXPECT_EQ(rest(KernelKind::subdivide), "plan, fill, verify, neighbours");
  run.resolved.output.formats = {io::Format::pvtu, io::Format::msh};
  EXPECT_EQ(rest(KernelKind::subdivide), "plan, fill, verify, export");
}

TEST_F(PlanOfACube, SeamsAreThoseBetweenSubdomainsOfAMaterialThatAreNotSubdivided)
{
  const subdomain::PartitionedMesh cut(cube, decomposition, 1);
  EXPECT_TRUE(have_seams_to_improve(cut, all_of(KernelKind::netgen)));
  EXPECT_FALSE(have_seams_to_improve(cut, all_of(KernelKind::subdivide)));
  const mesh::Decomposition whole = testing::one_subdomain_a_material(cube);
  const subdomain::PartitionedMesh one_each(cube, whole, 1);
  EXPECT_FALSE(have_seams_to_improve(one_each, all_of(KernelKind::netgen)));
}

TEST(CoarseStages, AreThoseThatTheCaseAsksFor)
{
  config::Case resolved;
  const auto stages = [&] { return text_of(coarse_stages(resolved, model::Format::csg)); };
  EXPECT_EQ(stages(), "model, coarse, decompose");
  resolved.size.target = 0.1;
  resolved.layers.resize(1);
  EXPECT_EQ(stages(), "model, coarse, layers, levels, decompose");
  resolved.size.regions.resize(1);
  resolved.periodic.resize(1);
  resolved.decompose.method = decompose::Method::geometry;
  EXPECT_EQ(stages(), "model, names, cut, coarse, levels, periodic, layers, levels, decompose");
  resolved.coarse.mesher = surface::Mesher::gmsh;
  EXPECT_EQ(stages(), "model, names, cut, coarse, periodic, layers, levels, decompose");
}

TEST(CoarseStages, SidesOfAMeshOfTheUserAreFoundWithoutNames)
{
  config::Case resolved;
  resolved.periodic.resize(1);
  EXPECT_EQ(text_of(coarse_stages(resolved, model::Format::own)),
            "model, coarse, periodic, decompose");
}

}  // namespace
}  // namespace tessera::pipeline
