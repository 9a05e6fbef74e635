// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/json/cuts_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "tessera/base/enum_words.hpp"

namespace tessera::pipeline {
namespace {

Json planes_json(const cut::CutChoice& cuts, double scale)
{
  Json planes = Json::array();
  for (const cut::PlaneJudgement& plane : cuts.report.planes) {
    const cut::Plane& at_node = cuts.tree.nodes[at(plane.node)].plane;
    planes.push_back({{"normal", at_node.normal},
                      {"offset", scale * at_node.offset},
                      {"solid", plane.solid + 1},
                      {"is_given", plane.is_given},
                      {"fraction_below", plane.fraction_below},
                      {"area", scale * scale * plane.area},
                      {"clearance_in_coarse_sizes", plane.clearance},
                      {"shortest_edge_in_coarse_sizes", plane.shortest_edge},
                      {"min_angle_deg", plane.angle_deg}});
  }
  return planes;
}

Json parts_json(const RunResult& run)
{
  std::vector<LocalIndex> num_tets(at(run.planes.tree.num_parts), 0);
  for (const LocalIndex part : run.coarse.tet_part) ++num_tets[at(part)];
  const double scale = run.resolved.geometry.scale;
  Json parts = Json::array();
  for (std::size_t p = 0; p < num_tets.size(); ++p) {
    const cut::CutPart& part = run.planes.report.parts[p];
    parts.push_back({{"solid", part.solid + 1},
                     {"volume", std::pow(scale, 3.0) * part.volume},
                     {"coarse_tets", num_tets[p]},
                     {"num_wanted", part.num_wanted}});
    if (!part.whole_because.empty()) parts.back()["whole_because"] = part.whole_because;
  }
  return parts;
}

}  // namespace

Json cuts_json(const RunResult& run)
{
  return {{"planes_rule", word_of(run.resolved.planes.rule)},
          {"num_parts_wanted", run.planes.report.num_wanted},
          {"num_parts", run.planes.tree.num_parts},
          {"parts_are_meshed", !run.coarse.tet_part.empty()},
          {"part_volume_balance", run.planes.report.balance},
          {"parts", parts_json(run)},
          {"planes", planes_json(run.planes, run.resolved.geometry.scale)}};
}

}  // namespace tessera::pipeline
