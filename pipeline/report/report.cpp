// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tessera/base/box.hpp"
#include "tessera/base/enum_words.hpp"
#include "tessera/base/version.hpp"
#include "tessera/comm/mpi_version.hpp"
#include "tessera/decompose/graph_partitioner.hpp"
#include "tessera/formats/export_mesh.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/netgen/factory.hpp"

#include "pipeline/report/json/assembly_json.hpp"
#include "pipeline/report/json/cuts_json.hpp"
#include "pipeline/report/json/defeature_json.hpp"
#include "pipeline/report/json/layers_json.hpp"
#include "pipeline/report/json/names_json.hpp"
#include "pipeline/report/json/quality_json.hpp"
#include "pipeline/report/json/repairs_json.hpp"
#include "pipeline/report/json/sharp_json.hpp"
#include "pipeline/report/json/wrap_json.hpp"
#include "pipeline/stages/coarse/coarse_warnings.hpp"
#include "pipeline/stages/coarse/cut_stage.hpp"
#include "pipeline/stages/coarse/decompose_stage.hpp"

namespace tessera::pipeline {
namespace {

// What a solver may expect of output.parts without a word; 1.06 was measured with 16 subdomains a
// part.
constexpr double kMostBalance = 1.1;

double largest(const std::vector<subdomain::PieceSummary>& pieces,
               double subdomain::PieceSummary::*member)
{
  double largest = 0.0;
  for (const subdomain::PieceSummary& piece : pieces) largest = std::max(largest, piece.*member);
  return largest;
}

double sum(const std::vector<subdomain::PieceSummary>& pieces,
           double subdomain::PieceSummary::*member)
{
  double sum = 0.0;
  for (const subdomain::PieceSummary& piece : pieces) sum += piece.*member;
  return sum;
}

Json second_order_json(const RunResult& run)
{
  double least = 1.0;
  for (const subdomain::PieceSummary& piece : run.filled.pieces) {
    least = std::min(least, piece.min_scaled_jacobian);
  }
  return {{"num_straightened", run.num_straightened}, {"scaled_jacobian", {{"min", least}}}};
}

Json subdomains_json(const RunResult& run)
{
  Json subdomains = Json::array();
  const std::vector<subdomain::FailedTries>& failures = run.filled.failures;
  for (const subdomain::PieceSummary& piece : run.filled.pieces) {
    subdomains.push_back({{"id", piece.subdomain},
                          {"material", run.coarse.mesh.body(piece.material)},
                          {"tets", piece.num_all_tets()},
                          {"kernel", word_of(piece.kernel)},
                          {"tries", piece.tries},
                          {"seconds", piece.cpu_s},
                          {"digest", to_hex(piece.digest)}});
    const auto failed = std::find_if(failures.begin(), failures.end(), [&](const auto& tries) {
      return tries.subdomain == piece.subdomain;
    });
    if (failed != failures.end()) subdomains.back()["failures"] = failed->messages;
  }
  return subdomains;
}

// What was made, and of which mesh if that is not all of it.
void add_counts(Json& json, const RunResult& run)
{
  json["num_subdomains"] = run.filled.pieces.size();
  json["only_subdomains"] = run.only_subdomains;
  json["num_subdomains_requested"] = run.resolved.decompose.subdomains;
  json["num_tets"] = run.filled.num_tets();
  json["num_cells"] = run.filled.num_cells();
  if (run.only_subdomains.empty()) {
    json["num_vertices"] = run.num_vertices;
    return;
  }
  json["whole_mesh"] = {{"num_subdomains", run.decomposition.decomposition.num_subdomains()},
                        {"num_tets", run.num_tets},
                        {"num_vertices", run.num_vertices}};
}

std::vector<GlobalIndex> tets_of_parts(const RunResult& run)
{
  const std::vector<LocalIndex>& offsets = run.decomposition.decomposition.part_offsets;
  std::vector<GlobalIndex> tets;
  for (std::size_t part = 0; part + 1 < offsets.size(); ++part) {
    GlobalIndex& sum = tets.emplace_back(0);
    for (LocalIndex s = offsets[part]; s < offsets[part + 1]; ++s) {
      sum += run.filled.pieces[at(s)].num_all_tets();
    }
  }
  return tets;
}

// Of the largest part of the output over the average; 1 without parts.
double balance_of_parts(const RunResult& run)
{
  const std::vector<GlobalIndex> tets = tets_of_parts(run);
  if (tets.empty()) return 1.0;
  const double average = static_cast<double>(run.num_tets) / static_cast<double>(tets.size());
  return static_cast<double>(*std::ranges::max_element(tets)) / average;
}

std::optional<std::string> made_by_gmsh(const RunResult& run)
{
  if (run.coarse.options.mesher == run.resolved.coarse.mesher) return std::nullopt;
  return "Gmsh has made the coarse mesh, after all other tries had failed. Without it, or with "
         "another version of it, the same case ends otherwise.";
}

Json warnings_json(const RunResult& run)
{
  Json warnings = Json::array();
  for (const auto& warning :
       {too_many_subdomains(run.resolved, run.coarse.mesh), unbalanced_parts(run),
        parts_not_meshed(run), made_by_gmsh(run), sharp_warning(run.sharp),
        misses_sizes(run.coarse) ? std::nullopt : size_warning(run.coarse)}) {
    if (warning) warnings.push_back(*warning);
  }
  return warnings;
}

Json model_json(const RunResult& run)
{
  const model::ModelSource& model = run.model;
  Json json{{"repairs", model.repairs},
            {"length_unit", model.length_unit},
            {"assembly", assembly_json(model.assembly)},
            {"digest", to_hex(hash_bytes(model.content))}};
  if (model.wrap.is_any()) json["wrap"] = wrap_json(model.wrap, run.resolved.geometry.scale);
  return json;
}

Json decompose_json(const RunResult& run)
{
  const decompose::DecomposeReport& report = run.decomposition.report;
  return {{"method", word_of(run.resolved.decompose.method)},
          {"seam_area", report.seam_area},
          {"min_seam_dihedral_deg", report.min_seam_dihedral_deg},
          {"heaviest_over_average", report.max_weight / report.mean_weight},
          {"merges", report.num_merges},
          {"splits", report.num_splits},
          {"moves", report.num_moves}};
}

// Who is beside whom, with the area they share: what a solver's partitioner can start from.
Json graph_json(const mesh::Decomposition& decomposition)
{
  Json edges = Json::array();
  for (LocalIndex s = 0; s < decomposition.num_subdomains(); ++s) {
    const auto first = decomposition.neighbour_offsets[static_cast<std::size_t>(s)];
    const auto last = decomposition.neighbour_offsets[static_cast<std::size_t>(s) + 1];
    for (auto e = static_cast<std::size_t>(first); e < static_cast<std::size_t>(last); ++e) {
      if (decomposition.neighbours[e] < s) continue;
      edges.push_back({s, decomposition.neighbours[e], decomposition.neighbour_triangles[e],
                       decomposition.neighbour_area[e]});
    }
  }
  return {{"vertex_weight", decomposition.subdomain_weight},
          {"edges_as_a_b_coarse_triangles_area", std::move(edges)}};
}

Json stages_json(const std::vector<StageTime>& times)
{
  Json stages = Json::array();
  for (const StageTime& time : times) {
    stages.push_back({{"name", time.name},
                      {"wall_time_s", time.wall_s},
                      {"rank_min_s", time.rank_min_s},
                      {"rank_max_s", time.rank_max_s},
                      {"cpu_s", time.cpu_s}});
  }
  return stages;
}

Json prediction_json(const std::vector<PredictedFigure>& figures)
{
  Json json = Json::object();
  for (const PredictedFigure& figure : figures) {
    json[figure.name] = {{"predicted", figure.predicted}, {"actual", figure.actual}};
    if (figure.actual > 0.0) {
      json[figure.name]["error"] = figure.predicted / figure.actual - 1.0;
    }
  }
  return json;
}

Json libraries_json()
{
  return {{"netgen", netgen::netgen_version()},
          {"metis", decompose::metis_version()},
          {"vtk", io::vtk_version()},
          {"mpi", comm::mpi_version()}};
}

// [file, other file, points that both have], each pair once.
Json file_neighbours_json(const std::vector<formats::PieceCounts>& files)
{
  Json pairs = Json::array();
  for (const auto& [file, other, num_points] : formats::shared_points(files)) {
    pairs.push_back({file, other, num_points});
  }
  return pairs;
}

// Names from CAD files are in any encoding: what is not UTF-8 is replaced, not refused.
std::string text_of(const Json& json)
{
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json head_json(ExitCode exit_code, const std::string& reason, const RunFigures& figures)
{
  return {{"schema", 1},
          {"version", version()},
          {"status", status_name(exit_code)},
          {"exit_code", static_cast<int>(exit_code)},
          {"reason", reason},
          {"case", figures.case_name},
          {"num_ranks", figures.num_ranks}};
}

void add_figures(Json& json, const RunFigures& figures)
{
  json["wall_time_s"] = figures.wall_time_s;
  json["peak_rss_bytes_max"] = figures.peak_rss_bytes_max;
}

bool is_reproducible(const RunResult& run)
{
  const std::vector<subdomain::PieceSummary>& pieces = run.filled.pieces;
  return !run.coarse.was_limited && run.filled.improvement.num_limited == 0
         && std::none_of(pieces.begin(), pieces.end(),
                         [](const subdomain::PieceSummary& piece) { return piece.was_limited; });
}

Json improvement_json(const Improvement& improvement)
{
  return {{"regions", improvement.num_regions},
          {"improved", improvement.num_improved},
          {"failed", improvement.num_failed}};
}

Json coarse_json(const RunResult& run)
{
  const bool is_own = model::is_mesh_name(run.resolved.geometry.file);
  Json json{{"num_tets", run.coarse.mesh.num_tets()},
            {"mesher", is_own ? std::string_view("own") : word_of(run.coarse.options.mesher)},
            {"max_size", run.coarse.options.max_size},
            {"surface_mesher", word_of(run.coarse.options.surface_mesher)},
            {"tries", run.coarse.tries},
            {"failures", run.coarse.failures},
            {"sharp", sharp_json(run.sharp, run.coarse.mesh)},
            {"levels", run.levels.largest()},
            {"edges_by_level", run.levels.histogram()}};
  if (run.coarse.defeatured.is_any()) json["defeatured"] = defeatured_json(run.coarse);
  return json;
}

double whole_volume(const std::vector<subdomain::PieceSummary>& pieces)
{
  double volume = 0.0;
  for (const subdomain::PieceSummary& piece : pieces) volume += piece.whole_volume();
  return volume;
}

Hash128 digest_of(const std::vector<subdomain::PieceSummary>& pieces)
{
  Hash128 digest;
  for (const subdomain::PieceSummary& piece : pieces) digest += piece.digest;
  return digest;
}

std::string reason_of(const Verdict& verdict)
{
  return fmt::format("{}", fmt::join(verdict.reasons, "; "));
}

// Where the tries ended at another kernel than the case wants.
std::vector<LocalIndex> substituted_subdomains(const RunResult& run)
{
  std::vector<LocalIndex> substituted;
  for (const subdomain::PieceSummary& piece : run.filled.pieces) {
    if (piece.kernel != run.kernels[at(piece.subdomain)]) substituted.push_back(piece.subdomain);
  }
  return substituted;
}

std::vector<std::string> missed_qualities(const RunResult& run)
{
  std::vector<std::string> missed;
  const quality::TetStatistics tets = statistics_of_tets(run.filled.pieces);
  const quality::QualityTargets& targets = run.resolved.quality;
  if (tets.min_dihedral_deg < targets.min_dihedral_deg) {
    missed.push_back(fmt::format("smallest dihedral angle {:.4g} deg < wanted {:.4g} deg",
                                 tets.min_dihedral_deg, targets.min_dihedral_deg));
  }
  if (tets.min_mean_ratio < targets.min_mean_ratio) {
    missed.push_back(fmt::format("smallest mean ratio {:.4g} < wanted {:.4g}", tets.min_mean_ratio,
                                 targets.min_mean_ratio));
  }
  return missed;
}

}  // namespace

std::optional<std::string> unbalanced_parts(const RunResult& run)
{
  const double balance = balance_of_parts(run);
  if (balance <= kMostBalance) return std::nullopt;
  return fmt::format(
      "the largest part has {:.3g} times the average of tets; more decompose.subdomains make "
      "smaller "
      "units to share out",
      balance);
}

Verdict judge(const RunResult& run)
{
  Verdict verdict{.reasons = missed_qualities(run)};
  const double held_back = largest(run.filled.pieces, &subdomain::PieceSummary::held_back_distance);
  // On a plane, points may be held back and still be on it, but for rounding.
  const bool is_off = held_back > 1e-9 * box_diagonal(run.coarse.mesh.vertex_xyz);
  if (const std::size_t num = run.limiter.entries().size() - run.num_straightened;
      num > 0 && is_off) {
    verdict.reasons.push_back(fmt::format(
        "{} points were kept off the geometry because the surface would have folded, by "
        "at most {:.3g}; a smaller coarse.max_size may help",
        num, held_back));
  }
  if (run.num_straightened > 0) {
    verdict.reasons.push_back(fmt::format(
        "{} nodes of second order stayed in the middle of their edges, where curved tets would not "
        "have been valid, and are off the geometry by at most {:.3g}; one more of refine.levels "
        "may "
        "help",
        run.num_straightened, held_back));
  }
  if (run.model.wrap.is_any()) {
    verdict.reasons.push_back(wrap_reason(run.model.wrap, run.resolved.geometry.scale));
  }
  if (misses_sizes(run.coarse)) verdict.reasons.push_back(*size_warning(run.coarse));
  if (const coarse::VertexDistance& off = run.coarse.distance; off.num_off > 0) {
    verdict.reasons.push_back(
        fmt::format("{} vertices of the coarse mesh could not be put on the geometry; the farthest "
                    "is off it by {:.3g}, at ({:g})",
                    off.num_off, off.largest_off, fmt::join(off.farthest_off, ", ")));
  }
  if (const auto substituted = substituted_subdomains(run); !substituted.empty()) {
    verdict.reasons.push_back(
        fmt::format("NETGEN could not fill {} subdomains, they were subdivided: {}",
                    substituted.size(), fmt::join(substituted, ", ")));
  }
  if (!verdict.reasons.empty()) verdict.exit_code = ExitCode::degraded;
  return verdict;
}

MeshResult result_of(const RunResult& run, const Verdict& verdict)
{
  const std::vector<subdomain::PieceSummary>& pieces = run.filled.pieces;
  return {.status = verdict.exit_code == ExitCode::ok ? MeshStatus::ok : MeshStatus::degraded,
          .reason = reason_of(verdict),
          .num_vertices = run.num_vertices,
          .num_tets = run.filled.num_tets(),
          .num_subdomains = static_cast<LocalIndex>(pieces.size()),
          .volume = whole_volume(pieces),
          .digest = to_hex(digest_of(pieces)),
          .folder = run.resolved.output.directory};
}

std::string report_json(const RunResult& run, const Verdict& verdict, const RunFigures& figures,
                        const std::vector<StageTime>& times)
{
  const std::vector<subdomain::PieceSummary>& pieces = run.filled.pieces;
  Json json = head_json(verdict.exit_code, reason_of(verdict), figures);
  json["reasons"] = verdict.reasons;
  json["warnings"] = warnings_json(run);
  add_counts(json, run);
  json["volume"] = whole_volume(pieces);
  json["boundary_area"] = sum(pieces, &subdomain::PieceSummary::boundary_area);
  json["model_distance_max"] = std::max(largest(pieces, &subdomain::PieceSummary::model_distance),
                                        run.coarse.distance.largest);
  json["num_points_off_geometry"] =
      run.limiter.entries().size() + static_cast<std::size_t>(run.coarse.distance.num_off);
  json["points_within_tolerance"] = {{"num", run.coarse.distance.num_within},
                                     {"distance_max", run.coarse.distance.largest_within}};
  json["reproducible"] = is_reproducible(run);
  json["digest"] = to_hex(digest_of(pieces));
  add_figures(json, figures);
  json["resumed"] = figures.is_resumed;
  json["tets_per_second"] = static_cast<double>(run.filled.num_tets()) / figures.wall_time_s;
  json["stages"] = stages_json(times);
  if (!figures.predicted.empty()) json["prediction"] = prediction_json(figures.predicted);
  json["quality"] = quality_json(run.filled);
  if (!run.cover.patches.empty()) json["layers"] = layers_json(run);
  for (const auto& [plus, minus] : mesh::split_patch_names(run.coarse.mesh)) {
    json["splits"].push_back({{"plus", plus}, {"minus", minus}});
  }
  for (const mesh::PeriodicPair& pair : mesh::periodic_pairs(run.coarse.mesh)) {
    json["periodic"].push_back({{"from", pair.from}, {"to", pair.to}});
  }
  if (run.resolved.output.order == 2) json["second_order"] = second_order_json(run);
  json["model"] = model_json(run);
  if (!run.resolved.size.field.empty()) json["size_field_digest"] = to_hex(run.field_content);
  add_names(json, run);
  json["coarse"] = coarse_json(run);
  json.update(repairs_json(run));
  json["decompose"] = decompose_json(run);
  if (is_cut(run)) json["decompose"].update(cuts_json(run));
  json["improve"] = improvement_json(run.filled.improvement);
  if (run.resolved.output.parts > 0) {
    json["parts"] = {{"tets", tets_of_parts(run)}, {"balance", balance_of_parts(run)}};
  }
  if (!run.files.empty()) json["file_neighbours"] = file_neighbours_json(run.files);
  json["subdomains"] = subdomains_json(run);
  json["subdomain_graph"] = graph_json(run.decomposition.decomposition);
  json["libraries"] = libraries_json();
  return text_of(json);
}

std::string failure_json(ExitCode exit_code, const std::string& reason, const RunFigures& figures,
                         const std::vector<StageTime>& times)
{
  Json json = head_json(exit_code, reason, figures);
  add_figures(json, figures);
  json["stages"] = stages_json(times);
  json["libraries"] = libraries_json();
  return text_of(json);
}

}  // namespace tessera::pipeline
