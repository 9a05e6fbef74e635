// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/check/report.hpp"
#include "tessera/cut/choose_planes.hpp"
#include "tessera/improve/region_band.hpp"
#include "tessera/io/record_log.hpp"
#include "tessera/migrate/assemble.hpp"
#include "tessera/model/triangle_surface.hpp"
#include "tessera/number/shared_vertices.hpp"
#include "tessera/subdomain/core_figures.hpp"
#include "tessera/subdomain/improve_seam_region.hpp"

#include "pipeline/jobs/worker_messages.hpp"
#include "pipeline/stages/coarse/coarse_stage.hpp"
#include "pipeline/stages/coarse/decompose_stage.hpp"
#include "pipeline/store/fill_record.hpp"
#include "pipeline/store/filled_pieces.hpp"
#include "pipeline/store/run_state.hpp"
#include "support/byte_image.hpp"

// Values for the classes that do not take any.
namespace tessera {

namespace mesh {

static void set_sample(EdgeLevels& levels) { levels = EdgeLevels({0, 1, 0, 2, 1, 2}, {3, 2, 3}); }

static void set_sample(ProjectionLimiter& limiter)
{
  limiter = ProjectionLimiter(
      {{{LatticeCarrier::edge, 4, 5}, 0.5}, {{LatticeCarrier::triangle, 6, 7}, 0.25}});
}

}  // namespace mesh

namespace model {

static void set_sample(TriangleSurface& surface)
{
  surface = {.vertex_xyz = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0},
             .triangle_vertices = {0, 1, 2},
             .triangle_solid = {0},
             .triangle_material = {1},
             .solid_names = {"solid"},
             .material_names = {"material"}};
}

}  // namespace model

namespace cut {

static void set_sample(CutTree& tree)
{
  tree.solid_root = {0};
  tree.nodes = {
      {.plane = {{0.0, 1.0, 0.0}, 2.5}, .below = 1, .above = 2}, {.part = 0}, {.part = 1}};
  tree.num_parts = 2;
}

}  // namespace cut

namespace quality {

static void set_sample(Histogram& histogram)
{
  for (const double value : {-3.0, 0.25, 0.5}) histogram.add(value);
}

}  // namespace quality

namespace pipeline {
namespace {

template <class T>
T sample()
{
  T value{};
  testing::Sampler().fill(value);
  return value;
}

template <class T>
class ByteImage : public ::testing::Test {
};

using Types = ::testing::Types<
    // The library's.
    Hash128, model::ImportOptions, model::ModelSource, model::TriangleSurface, mesh::Piece,
    mesh::CoarseMesh, mesh::Decomposition, mesh::EdgeLevels, mesh::LatticePointKey,
    mesh::PointLimit, mesh::ProjectionLimiter, improve::Band, improve::PiecePart,
    improve::PieceUpdate, improve::ImproveOptions, subdomain::RegionRecord, subdomain::PieceSummary,
    subdomain::FillResult, subdomain::CoreFigures, subdomain::FailedTries, verify::SeamHash,
    quality::TetStatistics, quality::QualityHistograms, fill::FillTry, surface::CoarseOptions,
    coarse::VertexDistance, decompose::DecomposeReport, decompose::DecomposeResult,
    number::PieceCounts, mesh::HostPoint, number::VertexList, io::LogPlace, check::SubdomainFigures,
    migrate::MeshBlock, migrate::TetColumn, IndexLists, cut::CutReport, cut::CutChoice,
    // The program's.
    CoarseTry, UntangleTest, FillTask, SkinMesh, CoarseResult, WrittenFile, FillRecord,
    FoldedSubdomain, Plan, ModelLoad, MeshLoad, SegmentLoad, LimiterLoad, NumbersLoad,
    ImprovementLoad, ImportRequest, CoarseSurfaceRequest, CoarseDomainRequest, CoarseMeshRequest,
    UntangleRequest, ImproveRequest, SkinRequest>;
TYPED_TEST_SUITE(ByteImage, Types);

TYPED_TEST(ByteImage, BringsBackTheValueAndNothingOfAPartOfIt)
{
  const auto value = sample<TypeParam>();
  // On the stack, GCC 12 thinks that members of some might be read before they are made.
  EXPECT_NE(to_bytes(value), to_bytes(*std::make_unique<TypeParam>()));
  testing::expect_different_fields(value);
  testing::expect_round_trip(value);
}

TYPED_TEST(ByteImage, OfGarbageIsRefusedOrAnotherValue)
{
  testing::expect_garbage_is_harmless(sample<TypeParam>());
}

TEST(WorkerMessage, IsReadAsTheKindThatItIs)
{
  const auto load = from_bytes<Load>(load_limiter_message({}));
  EXPECT_TRUE(std::holds_alternative<LimiterLoad>(load));
  EXPECT_TRUE(std::holds_alternative<BoxRequest>(from_bytes<Request>(box_request())));
  const auto fill = from_bytes<Request>(fill_request({.batch = 3, .failures = {"one"}}));
  ASSERT_TRUE(std::holds_alternative<FillTask>(fill));
  EXPECT_EQ(std::get<FillTask>(fill).batch, 3);
  EXPECT_EQ(std::get<FillTask>(fill).failures, std::vector<std::string>{"one"});
}

}  // namespace
}  // namespace pipeline
}  // namespace tessera
