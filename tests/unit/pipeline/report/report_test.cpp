// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/report.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace tessera::pipeline {
namespace {

using Json = nlohmann::json;

subdomain::PieceSummary piece(LocalIndex subdomain, double min_dihedral_deg, double min_mean_ratio)
{
  subdomain::PieceSummary summary;
  summary.subdomain = subdomain;
  summary.material = 1;
  summary.tries = 1;
  summary.num_tets = 10;
  summary.volume = 0.25 * (subdomain + 1);
  summary.boundary_area = 2.0;
  summary.model_distance = 1e-12 * (subdomain + 1);
  summary.tets = {10, min_dihedral_deg, 150.0, min_mean_ratio, 8.0};
  return summary;
}

RunResult run_of_two_pieces()
{
  RunResult run;
  run.filled.pieces = {piece(0, 20.0, 0.4), piece(1, 8.0, 0.3)};
  run.filled.histograms.mean_ratio.add(0.8);
  run.filled.histograms.log2_edge_length.add(std::log2(2.0));
  run.filled.pieces[0].digest = {1, 2};
  run.filled.pieces[1].digest = {10, 20};
  run.kernels = {fill::KernelKind::netgen, fill::KernelKind::netgen};
  run.num_tets = 20;
  run.num_vertices = 11;
  run.decomposition.decomposition.subdomain_weight = {9.0, 11.0};
  run.decomposition.decomposition.subdomain_material = {1, 1};
  run.decomposition.decomposition.neighbour_offsets = {0, 1, 2};
  run.decomposition.decomposition.neighbours = {1, 0};
  run.decomposition.decomposition.neighbour_triangles = {4, 4};
  run.decomposition.decomposition.neighbour_area = {0.5, 0.5};
  return run;
}

Json report_of(const RunResult& run)
{
  return Json::parse(report_json(
      run, judge(run),
      {.case_name = "shaft.toml", .num_ranks = 2, .wall_time_s = 10.0, .peak_rss_bytes_max = 1000},
      {}));
}

TEST(Report, SizesThatWereMissedForWantOfAFinerMeshDegradeOnlyIfByFar)
{
  RunResult run = run_of_two_pieces();
  run.coarse.missed_size = {1.9, 0.25, {1.0, 2.0, 3.0}};
  EXPECT_EQ(judge(run).exit_code, ExitCode::ok);
  const std::string words = "near (1, 2, 3) edges of 0.25 are wanted, and they are up to 1.9 times";
  EXPECT_NE(report_of(run)["warnings"].dump().find(words), std::string::npos);
  run.coarse.missed_size.in_sizes = 2.1;
  EXPECT_EQ(judge(run).exit_code, ExitCode::degraded);
  EXPECT_NE(judge(run).reasons.at(0).find("2.1 times"), std::string::npos);
  EXPECT_EQ(report_of(run)["warnings"].dump().find("2.1 times"), std::string::npos);
}

TEST(Report, NamesTheSubdomainsOfAPartOfAMesh)
{
  RunResult run = run_of_two_pieces();
  EXPECT_EQ(report_of(run)["only_subdomains"], Json::array());
  run.filled.pieces.erase(run.filled.pieces.begin());
  run.only_subdomains = {1};
  const Json report = report_of(run);
  EXPECT_EQ(report["only_subdomains"], Json::array({1}));
  EXPECT_EQ(report["num_tets"], 10);
  EXPECT_EQ(report["whole_mesh"]["num_tets"], 20);
}

TEST(Report, NamesCoarseTetsWithSmallAngles)
{
  RunResult run = run_of_two_pieces();
  EXPECT_EQ(report_of(run)["coarse"]["sharp"]["num_tets"], 0);
  EXPECT_TRUE(report_of(run)["warnings"].empty());
  run.coarse.mesh.patch_names = {"in", "out"};
  run.coarse.mesh.patch_surface = {0, 1};
  run.sharp = {.num_forced = 3, .num_others = 1, .worst = {{1.5, 0.25, {1.0, 2.0, 3.0}, {1}}}};
  const Json sharp = report_of(run)["coarse"]["sharp"];
  EXPECT_EQ(sharp["num_forced"], 3);
  EXPECT_EQ(sharp["worst"][0]["patches"], Json({"out"}));
  EXPECT_EQ(sharp["worst"][0]["shortest_edge"], 0.25);
  EXPECT_EQ(sharp["worst"][0]["centre"], Json({1.0, 2.0, 3.0}));
  ASSERT_EQ(report_of(run)["warnings"].size(), 1);
  EXPECT_NE(report_of(run)["warnings"][0].get<std::string>().find("1.5 at (1, 2, 3)"),
            std::string::npos);
}

TEST(Report, IsNotReproducibleIfALimitEndedATry)
{
  EXPECT_EQ(report_of(run_of_two_pieces())["reproducible"], true);
  RunResult coarse = run_of_two_pieces();
  coarse.coarse.was_limited = true;
  EXPECT_EQ(report_of(coarse)["reproducible"], false);
  RunResult piece = run_of_two_pieces();
  piece.filled.pieces[1].was_limited = true;
  EXPECT_EQ(report_of(piece)["reproducible"], false);
}

TEST(Judge, ARunWithoutTargetsIsOk)
{
  const Verdict verdict = judge(run_of_two_pieces());
  EXPECT_EQ(verdict.exit_code, ExitCode::ok);
  EXPECT_TRUE(verdict.reasons.empty());
}

TEST(Judge, TargetsThatAreJustMetAreMet)
{
  RunResult run = run_of_two_pieces();
  run.resolved.quality = {8.0, 0.3};
  EXPECT_EQ(judge(run).exit_code, ExitCode::ok);
}

TEST(Judge, EveryMissedTargetIsAReasonWithBothFigures)
{
  RunResult run = run_of_two_pieces();
  run.resolved.quality.min_dihedral_deg = 8.5;
  ASSERT_EQ(judge(run).reasons.size(), 1U);
  EXPECT_NE(judge(run).reasons[0].find("dihedral angle 8 deg < wanted 8.5 deg"), std::string::npos);

  run.resolved.quality.min_mean_ratio = 0.35;
  const Verdict verdict = judge(run);
  EXPECT_EQ(verdict.exit_code, ExitCode::degraded);
  ASSERT_EQ(verdict.reasons.size(), 2U);
  EXPECT_NE(verdict.reasons[1].find("mean ratio 0.3 < wanted 0.35"), std::string::npos);
}

TEST(Judge, PointsOffTheGeometryDegrade)
{
  RunResult run = run_of_two_pieces();
  run.limiter = mesh::ProjectionLimiter({{mesh::LatticePointKey::on_edge(1, 2, 1), 0.5},
                                         {mesh::LatticePointKey::on_edge(2, 2, 1), 0.0}});
  run.filled.pieces[1].held_back_distance = 0.125;
  const Verdict verdict = judge(run);
  EXPECT_EQ(verdict.exit_code, ExitCode::degraded);
  ASSERT_EQ(verdict.reasons.size(), 1U);
  EXPECT_EQ(verdict.reasons[0].find("2 points were kept off the geometry"), 0U);
  EXPECT_NE(verdict.reasons[0].find("0.125"), std::string::npos);
}

TEST(Report, SumsAndExtremesAreOverAllPieces)
{
  const Json report = report_of(run_of_two_pieces());
  EXPECT_EQ(report["schema"], 1);
  EXPECT_EQ(report["status"], "ok");
  EXPECT_EQ(report["exit_code"], 0);
  EXPECT_EQ(report["reason"], "");
  EXPECT_EQ(report["case"], "shaft.toml");
  EXPECT_EQ(report["num_ranks"], 2);
  EXPECT_EQ(report["num_subdomains"], 2);
  EXPECT_EQ(report["num_tets"], 20);
  EXPECT_EQ(report["num_vertices"], 11);
  EXPECT_EQ(report["volume"], 0.75);
  EXPECT_EQ(report["boundary_area"], 4.0);
  EXPECT_EQ(report["model_distance_max"], 2e-12);
  EXPECT_EQ(report["tets_per_second"], 2.0);
  EXPECT_EQ(report["digest"], to_hex({11, 22}));
  EXPECT_EQ(report["subdomains"][1]["digest"], to_hex({10, 20}));
  EXPECT_EQ(report["quality"]["min_dihedral_deg"], 8.0);
  EXPECT_EQ(report["quality"]["mean_ratio"]["min"], 0.3);
  EXPECT_EQ(report["quality"]["mean_ratio"]["mean"], 0.8);
  EXPECT_EQ(report["quality"]["mean_ratio"]["histogram"].size(), 20U);
  EXPECT_NEAR(report["quality"]["edge_length"]["median"].get<double>(), 2.0, 0.02);
}

TEST(Report, PatchesOfARowAreSummed)
{
  RunResult run = run_of_two_pieces();
  run.coarse.mesh.patch_names = {"wall", "inlet", "wall"};
  run.coarse.mesh.patch_row = {0, 1, 0};
  run.coarse.mesh.patch_surface = {4, 2, 1};
  run.filled.pieces[0].patches = {{0, 2, 0.5}, {2, 1, 0.25}};
  run.filled.pieces[1].patches = {{1, 3, 1.5}, {2, 1, 0.25}};
  EXPECT_EQ(report_of(run)["patches"],
            Json::parse(R"([{"id": 0, "name": "wall", "triangles": 4, "area": 1.0,
                             "faces": [2, 5]},
                            {"id": 1, "name": "inlet", "triangles": 3, "area": 1.5, "faces": [3]}])"));
  run.coarse.mesh.patch_row = {};
  EXPECT_EQ(report_of(run)["patches"][2],
            Json::parse(R"({"id": 2, "name": "wall", "triangles": 2, "area": 0.5, "faces": [2]})"));
}

TEST(Report, HasEveryKeyOfTheSchema)
{
  const Json report = report_of(run_of_two_pieces());
  for (const char* key : {"schema",
                          "version",
                          "status",
                          "exit_code",
                          "reason",
                          "case",
                          "num_ranks",
                          "num_subdomains",
                          "num_tets",
                          "num_vertices",
                          "volume",
                          "boundary_area",
                          "model_distance_max",
                          "points_within_tolerance",
                          "reproducible",
                          "digest",
                          "wall_time_s",
                          "tets_per_second",
                          "peak_rss_bytes_max",
                          "stages",
                          "quality",
                          "subdomains",
                          "libraries"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  for (const char* key : {"id", "material", "tets", "kernel", "tries", "seconds"}) {
    EXPECT_TRUE(report["subdomains"][0].contains(key)) << key;
  }
  for (const char* key : {"netgen", "metis", "vtk", "mpi"}) {
    EXPECT_FALSE(report["libraries"][key].get<std::string>().empty()) << key;
  }
}

TEST(Report, EveryEdgeOfTheGraphStandsOnce)
{
  const Json graph = report_of(run_of_two_pieces())["subdomain_graph"];
  EXPECT_EQ(graph["edges_as_a_b_coarse_triangles_area"], Json::parse("[[0, 1, 4, 0.5]]"));
}

TEST(Report, SeamFiguresStandOnlyIfThereAreSeamTets)
{
  RunResult run = run_of_two_pieces();
  EXPECT_EQ(report_of(run)["quality"]["seam"], Json::parse(R"({"num_tets": 0})"));
  run.filled.pieces[0].seam_tets = {4, 12.0, 140.0, 0.5, 3.0};
  const Json seam = report_of(run)["quality"]["seam"];
  EXPECT_EQ(seam["num_tets"], 4);
  EXPECT_EQ(seam["min_dihedral_deg"], 12.0);
  EXPECT_EQ(seam["mean_ratio"]["mean"], 0.75);
}

TEST(Report, NamesStatusAndReasonsOfADegradedRun)
{
  RunResult run = run_of_two_pieces();
  run.resolved.quality = {30.0, 0.9};
  const Json report = report_of(run);
  EXPECT_EQ(report["status"], "degraded");
  EXPECT_EQ(report["exit_code"], 3);
  EXPECT_NE(report["reason"].get<std::string>().find("; "), std::string::npos);
}

// Names in CAD files are in any encoding; they must not cost a finished run.
TEST(Report, TextThatIsNotUnicodeDoesNoHarm)
{
  RunResult run = run_of_two_pieces();
  run.model.repairs = {"solid W\xE4lle: closed a gap"};
  run.model.length_unit = "\xB5m";
  EXPECT_NE(report_of(run)["model"]["repairs"][0].get<std::string>().find("lle"),
            std::string::npos);
}

TEST(Report, OfAFailureSaysWhy)
{
  const Json report = Json::parse(failure_json(
      ExitCode::stopped, "stopped \xE4 by a signal",
      {.case_name = "a.toml", .num_ranks = 3, .wall_time_s = 1.5, .peak_rss_bytes_max = 7},
      {{"model", 0.5, 0.1, 0.4}}));
  EXPECT_EQ(report["status"], "stopped");
  EXPECT_EQ(report["exit_code"], 75);
  EXPECT_EQ(report["num_ranks"], 3);
  EXPECT_EQ(report["peak_rss_bytes_max"], 7);
  EXPECT_EQ(report["stages"][0]["name"], "model");
  EXPECT_EQ(report["stages"][0]["rank_max_s"], 0.4);
  EXPECT_NE(report["reason"].get<std::string>().find("by a signal"), std::string::npos);
  EXPECT_EQ(Json::parse(failure_json(ExitCode::wrong_input, "", {}, {}))["status"], "failed");
}

}  // namespace
}  // namespace tessera::pipeline
