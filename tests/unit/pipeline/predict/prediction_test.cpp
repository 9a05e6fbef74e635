// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/predict/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tessera/io/files.hpp"

#include "pipeline/predict/calibrate.hpp"
#include "pipeline/predict/prediction_file.hpp"
#include "support/decompositions.hpp"
#include "support/filled_cube.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::pipeline {
namespace {

using fill::KernelKind;

// `count` subdomains of one kernel; subdomain s has (s + 1) thousand tets and 100 triangles on the
// geometry.
RunOutline outline_of(LocalIndex count, KernelKind kernel)
{
  RunOutline outline{
      .levels = 2, .fill_levels = 2, .num_coarse_tets = 4000, .num_skeleton_vertices = 500};
  outline.kernels.assign(at(count), kernel);
  outline.is_one_pass = kernel == KernelKind::subdivide;
  for (LocalIndex s = 0; s < count; ++s) {
    outline.pieces.push_back({100 * (s + 1), 1000 * (s + 1), 100});
    outline.jobs.push_back({s, s, s + 1});
  }
  outline.files = subdomain::file_ranges(count, outline.is_one_pass ? 0 : 2);
  if (outline.is_one_pass) outline.jobs = outline.files;
  return outline;
}

PredictionBasis basis_of(LocalIndex count, KernelKind kernel, int num_ranks)
{
  PredictionBasis basis{.outline = outline_of(count, kernel),
                        .memory = {.process = 50e6, .loaded = 10e6, .jobs_peak = 12e6},
                        .serial_stages = {{.name = "coarse", .cpu_s = 3.0, .rank_max_cpu_s = 3.0}},
                        .num_ranks = num_ranks};
  basis.rates.of(kernel) = {.fill_cpu_s_per_tet = 1e-3,
                            .plan_cpu_s_per_tet = 1e-4,
                            .write_cpu_s_per_tet = 1e-5,
                            .job_bytes_per_tet = 1000.0,
                            .file_bytes_per_tet = 20.0,
                            .store_bytes_per_tet = 30.0};
  basis.rates.file_bytes_per_boundary_triangle = 40.0;
  basis.rates.file_header_bytes = 1000.0;
  return basis;
}

const StagePrediction& stage(const Prediction& prediction, const std::string& name)
{
  for (const StagePrediction& candidate : prediction.stages) {
    if (candidate.name == name) return candidate;
  }
  throw std::out_of_range(name);
}

TEST(Predict, AddsUpTheOutline)
{
  const Prediction prediction = predict(basis_of(4, KernelKind::netgen, 1));
  EXPECT_EQ(prediction.num_subdomains, 4);
  EXPECT_EQ(prediction.num_tets, 10'000);
  EXPECT_EQ(prediction.num_vertices, 500 + 1000);
  EXPECT_EQ(prediction.num_boundary_triangles, 400);
  EXPECT_EQ(prediction.num_files, 4);
  EXPECT_DOUBLE_EQ(prediction.disk_bytes, 10'000 * 20.0 + 400 * 40.0 + 4 * 1000.0);
  EXPECT_DOUBLE_EQ(prediction.disk_peak_bytes, prediction.disk_bytes + 10'000 * 30.0);
}

TEST(Predict, OnOneRankTimesAddUp)
{
  const Prediction prediction = predict(basis_of(4, KernelKind::netgen, 1));
  EXPECT_DOUBLE_EQ(stage(prediction, "fill").cpu_s, 10.0);
  EXPECT_NEAR(stage(prediction, "fill").wall_s, 10.0, 0.1);
  EXPECT_DOUBLE_EQ(stage(prediction, "plan").cpu_s, 1.0);
  EXPECT_DOUBLE_EQ(stage(prediction, "write").cpu_s, 0.1);
  EXPECT_NEAR(prediction.wall_s, 14.1, 0.1);
  EXPECT_NEAR(prediction.serial_share, 3.0 / 14.1, 0.01);
  EXPECT_NEAR(prediction.busy_share, 1.0, 1e-12);
}

TEST(Predict, ManyRanksTakeTheSerialPartAndTheLargestJobs)
{
  const Prediction prediction = predict(basis_of(4, KernelKind::netgen, 100'000));
  EXPECT_NEAR(stage(prediction, "fill").wall_s, 4.0, 0.1);
  EXPECT_DOUBLE_EQ(stage(prediction, "fill").cpu_s, 10.0);
  EXPECT_DOUBLE_EQ(stage(prediction, "coarse").wall_s, 3.0);
  EXPECT_GT(prediction.serial_share, 0.4);
  EXPECT_LT(prediction.busy_share, 1e-4);
}

TEST(Predict, OnePassHasNoStoreAndNoWriteStage)
{
  const Prediction prediction = predict(basis_of(4, KernelKind::subdivide, 2));
  EXPECT_EQ(prediction.disk_peak_bytes, prediction.disk_bytes);
  EXPECT_EQ(prediction.num_files, 8);
  EXPECT_THROW(static_cast<void>(stage(prediction, "write")), std::out_of_range);
}

TEST(Predict, MemoryIsThatOfTheLargestJobAndTheLargestFile)
{
  PredictionBasis basis = basis_of(4, KernelKind::netgen, 1);
  // Files of subdomains 0, 1 and 2, 3: the second has 7000 tets; the largest job has 4000.
  const double job = kJobBytes + 4000 * 1000.0;
  EXPECT_DOUBLE_EQ(predict(basis).memory_per_rank_bytes,
                   50e6 + 7000 * kWriterBytesPerTet + 10e6 + job);
  EXPECT_DOUBLE_EQ(predict(basis).largest_job_bytes, 10e6 + job);
  basis.memory.jobs_peak = 300e6;  // The coarse mesher needed more.
  EXPECT_DOUBLE_EQ(predict(basis).memory_per_rank_bytes, 50e6 + 7000 * kWriterBytesPerTet + 300e6);
}

TEST(Predict, HundredThousandSubdomainsOnAsManyRanks)
{
  const Prediction prediction = predict(basis_of(100'000, KernelKind::subdivide, 100'000));
  EXPECT_EQ(prediction.num_tets, GlobalIndex{1000} * 100'000 * 100'001 / 2);
  EXPECT_NEAR(stage(prediction, "fill").wall_s, 100'000.0, 1.0);
}

TEST(Advise, SaysNothingWhereAllIsWell)
{
  const Prediction prediction = predict(basis_of(64, KernelKind::netgen, 4));
  const Advice advice = advise(prediction, {1e12, 1e12, 4, 4.0});
  EXPECT_TRUE(advice.must.empty());
  EXPECT_TRUE(advice.should.empty());
}

TEST(Advise, NamesWhatDoesNotFitAndWhatToChange)
{
  const Prediction prediction = predict(basis_of(64, KernelKind::netgen, 4));
  const auto only = [](const Advice& advice) {
    EXPECT_EQ(advice.must.size(), 1U);
    return advice.must.empty() ? std::string() : advice.must.front();
  };
  EXPECT_NE(only(advise(prediction, {prediction.disk_peak_bytes - 1.0, 1e12, 4, 4.0}))
                .find("output.directory"),
            std::string::npos);
  EXPECT_NE(only(advise(prediction, {1e12, 3.9 * prediction.memory_per_rank_bytes, 4, 4.0}))
                .find("fewer ranks"),
            std::string::npos);
  // On a machine with two cores only two of the four ranks will run.
  EXPECT_TRUE(
      advise(prediction, {1e12, 3.9 * prediction.memory_per_rank_bytes, 2, 4.0}).must.empty());
  EXPECT_NE(only(advise(prediction, {1e12, 1e12, 4, 1e-3})).find("fill.memory_gib"),
            std::string::npos);
}

TEST(Advise, CountsOnceWhatRanksOfANodeShare)
{
  PredictionBasis basis = basis_of(64, KernelKind::netgen, 4);
  basis.memory.shared = 0.5 * basis.memory.process;
  const Prediction prediction = predict(basis);
  const double once = basis.memory.shared + basis.memory.loaded;
  const double all = 4 * prediction.memory_per_rank_bytes - 3 * once;
  EXPECT_TRUE(advise(prediction, {1e12, all + 1.0, 4, 4.0}).must.empty());
  EXPECT_EQ(advise(prediction, {1e12, all - 1.0, 4, 4.0}).must.size(), 1U);
}

TEST(Advise, TooManyRanksAreTold)
{
  const auto advice_for = [](int ranks) {
    const Prediction prediction = predict(basis_of(64, KernelKind::netgen, ranks));
    return advise(prediction, {1e12, 1e15, 4, 4.0}).should;
  };
  // 256 subdomains for 64 ranks are possible, 400 000 for 100 000 ranks are not.
  ASSERT_FALSE(advice_for(128).empty());
  EXPECT_NE(advice_for(128).back().find("512 decompose.subdomains"), std::string::npos)
      << advice_for(128).back();
  EXPECT_NE(advice_for(100'000).back().find("4000 coarse tets are too few"), std::string::npos)
      << advice_for(100'000).back();
  PredictionBasis serial = basis_of(64, KernelKind::netgen, 16);
  serial.serial_stages[0].rank_max_cpu_s = 1e4;
  EXPECT_NE(advise(predict(serial), {1e12, 1e15, 4, 4.0}).should.front().find("coarse.max_size"),
            std::string::npos);
}

subdomain::PieceSummary summary_of(LocalIndex subdomain, GlobalIndex tets, GlobalIndex interior)
{
  subdomain::PieceSummary piece;
  piece.subdomain = subdomain;
  piece.num_tets = tets;
  piece.num_interior_vertices = interior;
  return piece;
}

TEST(Corrected, TakesCountedPiecesAndScalesTheOthers)
{
  Calibration calibration;
  calibration.rates.netgen = {.tets_per_expected = 1.5, .interior_vertices_per_tet = 0.2};
  calibration.samples = {{.levels = 2, .pieces = {summary_of(1, 2222, 333)}}};
  const RunOutline outline = corrected(outline_of(3, KernelKind::netgen), calibration);
  EXPECT_EQ(outline.pieces[0].tets, 1500);
  EXPECT_EQ(outline.pieces[0].interior_vertices, 300);
  EXPECT_EQ(outline.pieces[1].tets, 2222);
  EXPECT_EQ(outline.pieces[1].interior_vertices, 333);
  EXPECT_EQ(outline.pieces[2].tets, 4500);
  EXPECT_EQ(outline.pieces[2].boundary_triangles, 100);
}

TEST(Corrected, PiecesOfFewerLevelsTellOnlyTheRate)
{
  Calibration calibration;
  calibration.rates.netgen = {.tets_per_expected = 1.5, .interior_vertices_per_tet = 0.2};
  calibration.samples = {{.levels = 1, .pieces = {summary_of(1, 250, 30)}}};
  EXPECT_EQ(corrected(outline_of(3, KernelKind::netgen), calibration).pieces[1].tets, 3000);
}

TEST(Corrected, LeavesWhatIsKnownExactly)
{
  Calibration calibration;
  calibration.rates.netgen.tets_per_expected = 2.0;
  EXPECT_EQ(corrected(outline_of(3, KernelKind::subdivide), calibration).pieces[2].tets, 3000);
}

struct OutlineOfACube : ::testing::Test {
  const mesh::CoarseMesh cube = testing::two_material_cube(4);
  const mesh::Decomposition decomposition = testing::slabs(cube, 2);
  [[nodiscard]] RunOutline outline(const std::vector<KernelKind>& kernels, int levels,
                                   const PieceChoices& choices = {}) const
  {
    const subdomain::PartitionedMesh cut(cube, decomposition, levels);
    return outline_run(cut, kernels, subdomain::file_ranges(cut.num_subdomains(), 0), choices);
  }
};

TEST_F(OutlineOfACube, OfSubdivisionIsExact)
{
  const RunOutline outline = this->outline(std::vector(4, KernelKind::subdivide), 2);
  EXPECT_TRUE(outline.is_one_pass);
  GlobalIndex tets = 0;
  GlobalIndex vertices = outline.num_skeleton_vertices;
  for (const number::PieceCounts& piece : outline.pieces) {
    tets += piece.tets;
    vertices += piece.interior_vertices;
  }
  EXPECT_EQ(tets, 6 * 64 * 64);
  EXPECT_EQ(vertices, 17 * 17 * 17);
}

TEST_F(OutlineOfACube, PiecesThatWaitInTheStoreAreMadeOneByOne)
{
  const std::vector<KernelKind> all(4, KernelKind::subdivide);
  for (const PieceChoices& choices :
       {PieceChoices{.divides_corners = true}, PieceChoices{.has_files = false},
        PieceChoices{.is_curved = true}}) {
    const RunOutline outline = this->outline(all, 2, choices);
    EXPECT_FALSE(outline.is_one_pass);
    EXPECT_EQ(outline.are_counts_exact, !choices.divides_corners);
    EXPECT_EQ(outline.jobs.size(), 4U);
    EXPECT_EQ(outline.writes_from_store(), choices.divides_corners);
  }
}

TEST_F(OutlineOfACube, SeamsCountOnlyIfTheyAreImproved)
{
  const std::vector<KernelKind> netgen(4, KernelKind::netgen);
  EXPECT_EQ(this->outline(netgen, 1).seam_triangles, std::vector<GlobalIndex>(4, 0));
  const RunOutline improved = this->outline(netgen, 1, {.improves_seams = true});
  EXPECT_EQ(std::ranges::count(improved.seam_triangles, 0), 0);
}

TEST_F(OutlineOfACube, OfAFillIsNearTheTruth)
{
  using testing::fill_of;
  const std::vector<KernelKind> netgen(4, KernelKind::netgen);
  const RunOutline outline = this->outline(netgen, 1);
  EXPECT_FALSE(outline.is_one_pass);
  EXPECT_EQ(outline.jobs.size(), 4U);
  const testing::Body body(cube, decomposition);
  for (LocalIndex s = 0; s < 4; ++s) {
    const auto expected = static_cast<double>(outline.pieces[at(s)].tets);
    const subdomain::FilledPiece filled = fill_of(body, 1, s);
    EXPECT_NEAR(expected / static_cast<double>(filled.result.summary.num_tets), 1.0, 0.1);
    EXPECT_EQ(outline.pieces[at(s)].boundary_triangles, filled.result.summary.num_boundary);
  }
}

struct PredictionFile : ::testing::Test {
  const testing::TemporaryFolder folder{};
  config::Case run_case{};
  RunResult run{};
  ActualRun actual{.num_ranks = 2,
                   .tets = 11'000.0,
                   .vertices = 1400.0,
                   .boundary_triangles = 400.0,
                   .files = 4.0,
                   .disk_bytes = 2e5,
                   .memory_per_rank_bytes = 7e7,
                   .wall_time_s = 15.0,
                   .stages = {{.name = "coarse", .wall_s = 3.5, .cpu_s = 3.4},
                              {.name = "plan", .wall_s = 0.6, .cpu_s = 1.0},
                              {.name = "fill", .wall_s = 6.0, .cpu_s = 9.0},
                              {.name = "write", .wall_s = 0.1, .cpu_s = 0.1}}};

  void SetUp() override
  {
    DryRun dry_run{.prediction = predict(basis_of(4, KernelKind::netgen, 2))};
    dry_run.advice.must = {"more disk"};
    io::write_text_atomically(folder.path() / "prediction.json",
                              prediction_json(dry_run, PredictedRun(run_case, run)));
  }

  [[nodiscard]] std::vector<PredictedFigure> compare() const
  {
    return compare_with_prediction(folder.path(), PredictedRun(run_case, run), actual);
  }
};

const PredictedFigure* find(const std::vector<PredictedFigure>& figures, const std::string& name)
{
  for (const PredictedFigure& figure : figures) {
    if (figure.name == name) return &figure;
  }
  return nullptr;
}

TEST_F(PredictionFile, IsHeldAgainstTheRun)
{
  const auto figures = compare();
  const std::vector<std::tuple<std::string, double, double>> expected{
      {"tets", 10'000.0, 11'000.0},
      {"files", 4.0, 4.0},
      {"fill_cpu_s", 10.0, 9.0},
      {"cpu_s", 11.1, 10.1},
      {"coarse_wall_time_s", 3, 3.5}};
  for (const auto& [name, predicted, seen] : expected) {
    const PredictedFigure* figure = find(figures, name);
    ASSERT_NE(figure, nullptr) << name;
    EXPECT_DOUBLE_EQ(figure->predicted, predicted) << name;
    EXPECT_DOUBLE_EQ(figure->actual, seen) << name;
  }
}

TEST_F(PredictionFile, WallTimesCountForAsManyRanksOnly)
{
  EXPECT_NE(find(compare(), "wall_time_s"), nullptr);
  actual.num_ranks = 3;
  EXPECT_EQ(find(compare(), "wall_time_s"), nullptr);
  EXPECT_EQ(find(compare(), "fill_wall_time_s"), nullptr);
  EXPECT_NE(find(compare(), "fill_cpu_s"), nullptr);
}

TEST_F(PredictionFile, OfAnotherRunSaysNothing)
{
  run_case.fill.memory_gib = 7.0;
  EXPECT_FALSE(compare().empty()) << "a limit makes no other mesh";
  run_case.refine.levels += 1;
  EXPECT_TRUE(compare().empty());
  run_case.refine.levels -= 1;
  run.only_subdomains = {3};
  EXPECT_TRUE(compare().empty());
  run.only_subdomains = {};
  run.field_content.low = 1;
  EXPECT_TRUE(compare().empty());
  run.field_content = {};
  EXPECT_FALSE(compare().empty());
  run.model.content.push_back(std::byte{1});
  EXPECT_TRUE(compare().empty());
}

TEST_F(PredictionFile, ThatIsBrokenOrMissingSaysNothing)
{
  io::write_text_atomically(folder.path() / "prediction.json", "{\"schema\": 1");
  EXPECT_TRUE(compare().empty());
  std::filesystem::remove(folder.path() / "prediction.json");
  EXPECT_TRUE(compare().empty());
}

TEST(PredictionTable, TellsPeopleWhatWillNotFit)
{
  DryRun dry_run{.prediction = predict(basis_of(4, KernelKind::netgen, 100'000))};
  dry_run.advice = {{"more disk"}, {"fewer ranks"}};
  const std::string table = prediction_table(dry_run);
  for (const char* words : {"100000 ranks", "10000\n", "WILL NOT FIT: more disk",
                            "advice: fewer ranks", "fill", "serial"}) {
    EXPECT_NE(table.find(words), std::string::npos) << words << '\n' << table;
  }
}

}  // namespace
}  // namespace tessera::pipeline
