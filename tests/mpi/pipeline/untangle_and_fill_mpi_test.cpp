// SPDX-License-Identifier: BSD-3-Clause
// The loop of plan and fill under MPI, on the very workers of the program: forked before MPI_Init.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/fill/fallbacks.hpp"
#include "tessera/io/files.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/runtime/log.hpp"
#include "pipeline/stages/coarse/coarse_stage.hpp"
#include "pipeline/stages/coarse/decompose_stage.hpp"
#include "pipeline/stages/fill/load_stage.hpp"
#include "pipeline/stages/fill/share_stage.hpp"
#include "pipeline/stages/fill/untangle_and_fill.hpp"
#include "pipeline/stages/model/model_stage.hpp"
#include "support/mpi_tests.hpp"

namespace tessera::pipeline {
namespace {

using fill::KernelKind;

jobs::JobRunner* runner_of_this_rank = nullptr;

// A cube in a folder of its own, cut into subdomains.
struct UntangleAndFill : ::testing::Test {
  const comm::Communicator comm{MPI_COMM_WORLD};
  const std::filesystem::path folder =
      std::filesystem::current_path() / ("untangle_and_fill.np" + std::to_string(comm.size()));
  std::shared_ptr<spdlog::logger> log = make_log("", Verbosity::quiet);
  Progress progress{Progress::Style::silent, log};
  RunContext context{comm, *runner_of_this_rank, progress, *log, folder};
  config::Case cube{};
  CoarseResult coarse{};
  decompose::DecomposeResult cut{};

  UntangleAndFill()
  {
    if (comm.rank() == 0) {
      std::filesystem::remove_all(folder);
      std::filesystem::create_directory(folder);
      std::ofstream(folder / "cube.geo") << "algebraic3d\n"
                                            "solid cube = orthobrick (0, 0, 0; 1, 1, 1);\n"
                                            "tlo cube;\n";
    }
    comm.barrier();
    cube.geometry.file = folder / "cube.geo";
    cube.coarse.max_size = 0.4;
    cube.refine.levels = 1;
    cube.decompose.subdomains = 3;
    static_cast<void>(run_model_stage(cube, context));
    RunResult run;
    run.resolved = cube;
    run.coarse = run_coarse_stage(cube, {}, {}, context);
    run.levels = cube.refine.levels;
    cut = run_decompose_stage(run, context);
    coarse = std::move(run.coarse);
  }

  ~UntangleAndFill() override
  {
    comm.barrier();
    std::error_code ignored;
    if (comm.rank() == 0) std::filesystem::remove_all(folder, ignored);
  }

  // The mesh is loaded as it is now.
  LimitedPieces run(KernelKind kernel, const RunState* state = nullptr)
  {
    const subdomain::PartitionedMesh mesh(coarse.mesh, cut.decomposition, cube.refine.levels);
    const std::vector<KernelKind> kernels(at(mesh.num_subdomains()), kernel);
    const auto ranges = subdomain::file_ranges(mesh.num_subdomains(), 0);
    load_mesh(share_message(mesh, context), context);
    return untangle_and_fill(cube, {mesh, kernels, ranges, state}, context);
  }

  // A vertex inside of the cube leaves it: the tets around it are inverted, whatever is held back.
  void pull_out_a_vertex()
  {
    const FlatArray<LocalIndex>& outside = coarse.mesh.face_vertices;
    const std::set<LocalIndex> on_faces(outside.begin(), outside.end());
    LocalIndex inside = 0;
    while (on_faces.contains(inside)) ++inside;
    ASSERT_LT(inside, coarse.mesh.num_vertices());
    FlatArray<double> moved = coarse.mesh.vertex_xyz;  // That of the mesh is not to be written.
    moved[3 * at(inside)] = 5.0;
    coarse.mesh.vertex_xyz = std::move(moved);
  }
};

TEST_F(UntangleAndFill, FillsEverySubdomainInOneRoundIfNothingIsFolded)
{
  const LimitedPieces made = run(KernelKind::netgen);
  EXPECT_EQ(made.filled.pieces.size(), at(cut.decomposition.num_subdomains()));
  EXPECT_TRUE(made.filled.folded.empty());
  EXPECT_TRUE(made.limiter.entries().empty());
  for (const subdomain::PieceSummary& piece : made.filled.pieces) {
    EXPECT_EQ(piece.kernel, KernelKind::netgen);
  }
}

TEST_F(UntangleAndFill, EndsIfNothingIsLeftToHoldBack)
{
  pull_out_a_vertex();
  try {
    static_cast<void>(run(KernelKind::subdivide));
    ADD_FAILURE() << "inverted coarse tets were subdivided";
  } catch (const MeshError& error) {
    EXPECT_NE(std::string(error.what()).find("too flat to be subdivided"), std::string::npos)
        << error.what();
  }
}

TEST_F(UntangleAndFill, GoesOnWithThePlanThatAStoppedRunHasLeft)
{
  const RunState state(folder, {}, true);
  const Plan left{
      .kernels = std::vector(at(cut.decomposition.num_subdomains()), KernelKind::subdivide),
      .limited = {1},
      .failures = {{1, {"out of memory"}}}};
  if (comm.rank() == 0) state.keep_plan(left);
  const LimitedPieces made = run(KernelKind::netgen, &state);
  for (const subdomain::PieceSummary& piece : made.filled.pieces) {
    EXPECT_EQ(piece.kernel, KernelKind::subdivide);
    EXPECT_EQ(piece.was_limited, piece.subdomain == 1);
  }
  ASSERT_EQ(made.filled.failures.size(), 1U);
  EXPECT_EQ(made.filled.failures.front().messages, left.failures.front().messages);
}

}  // namespace
}  // namespace tessera::pipeline

int main(int argc, char** argv)
{
  auto runner = std::make_unique<tessera::jobs::JobRunner>(tessera::pipeline::make_mesh_worker);
  tessera::pipeline::runner_of_this_rank = runner.get();

  MPI_Init(&argc, &argv);
  const int failed = tessera::testing::run_tests_on_all_ranks(argc, argv);
  runner.reset();
  MPI_Finalize();
  return failed;
}
