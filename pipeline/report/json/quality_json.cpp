// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/json/quality_json.hpp"

#include <cmath>

namespace tessera::pipeline {
namespace {

constexpr std::size_t kReportBins = 20;
constexpr std::size_t kAngleBins = 36;  // Of five degrees.

quality::TetStatistics statistics_of(const std::vector<subdomain::PieceSummary>& pieces,
                                     quality::TetStatistics subdomain::PieceSummary::*part)
{
  quality::TetStatistics all;
  for (const subdomain::PieceSummary& piece : pieces) all.add(piece.*part);
  return all;
}

Json mean_ratio_json(const quality::TetStatistics& tets, const quality::Histogram& histogram)
{
  return {{"min", tets.min_mean_ratio},
          {"p01", histogram.percentile(0.01)},
          {"mean", tets.mean_mean_ratio()},
          {"histogram", histogram.coarsened(kReportBins)}};
}

Json worst_json(const quality::WorstTets& worst)
{
  Json tets = Json::array();
  for (const quality::WorstTet& tet : worst.tets()) {
    tets.push_back({{"mean_ratio", tet.mean_ratio},
                    {"min_dihedral_deg", tet.min_dihedral_deg},
                    {"max_dihedral_deg", tet.max_dihedral_deg},
                    {"subdomain", tet.subdomain},
                    {"centre", tet.centre}});
  }
  return tets;
}

}  // namespace

quality::TetStatistics statistics_of_tets(const std::vector<subdomain::PieceSummary>& pieces)
{
  return statistics_of(pieces, &subdomain::PieceSummary::tets);
}

Json quality_json(const FilledPieces& filled)
{
  const quality::TetStatistics tets = statistics_of_tets(filled.pieces);
  const auto seam = statistics_of(filled.pieces, &subdomain::PieceSummary::seam_tets);
  const quality::Histogram& edges = filled.histograms.log2_edge_length;
  const auto edge_length = [&](double share) { return std::exp2(edges.percentile(share)); };
  Json json{
      {"min_dihedral_deg", tets.min_dihedral_deg},
      {"max_dihedral_deg", tets.max_dihedral_deg},
      {"dihedral_deg_histogram",
       {{"smallest_of_tet", filled.histograms.min_dihedral_deg.coarsened(kAngleBins)},
        {"largest_of_tet", filled.histograms.max_dihedral_deg.coarsened(kAngleBins)}}},
      {"edge_length",
       {{"p01", edge_length(0.01)}, {"median", edge_length(0.5)}, {"p99", edge_length(0.99)}}},
      {"mean_ratio", mean_ratio_json(tets, filled.histograms.mean_ratio)},
      {"seam", {{"num_tets", seam.num_tets}}}};
  if (seam.num_tets > 0) {
    json["seam"]["min_dihedral_deg"] = seam.min_dihedral_deg;
    json["seam"]["mean_ratio"] = mean_ratio_json(seam, filled.histograms.seam_mean_ratio);
    json["seam"]["ks_distance"] =
        quality::ks_distance(filled.histograms.seam_mean_ratio, filled.histograms.mean_ratio);
  }
  json["worst"] = worst_json(filled.worst);
  return json;
}

}  // namespace tessera::pipeline
