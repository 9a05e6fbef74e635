// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "tessera/check/report.hpp"

namespace tessera::check {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const QualityFigures& quality)
{
  Json json;
  json["num_tets"] = quality.num_tets;
  json["min_dihedral_deg"] = quality.min_dihedral_deg;
  json["max_dihedral_deg"] = quality.max_dihedral_deg;
  json["mean_ratio"] = {{"min", quality.mean_ratio_min},
                        {"p01", quality.mean_ratio_p01},
                        {"mean", quality.mean_ratio_mean},
                        {"histogram", quality.mean_ratio_histogram}};
  return json;
}

Json quality_to_json(const CheckReport& report)
{
  Json json = to_json(report.quality);
  json["edge_length"] = {{"p01", report.edge_length.p01},
                         {"median", report.edge_length.median},
                         {"p99", report.edge_length.p99}};
  json["seam"] = to_json(report.seam_quality);
  json["seam"]["ks_distance"] = report.seam_ks_distance;
  return json;
}

Json counts_to_json(const CheckReport& report)
{
  return {{"num_subdomains", report.subdomains.size()},
          {"num_tets", report.num_tets},
          {"num_vertices", report.num_vertices},
          {"num_edges", report.num_edges},
          {"num_triangles", report.num_triangles},
          {"num_boundary_triangles", report.num_boundary_triangles},
          {"num_interface_triangles", report.num_interface_triangles},
          {"num_seam_triangles", report.num_seam_triangles},
          {"num_open_seam_triangles", report.num_open_seam_triangles},
          {"num_nonmanifold_edges", report.num_nonmanifold_edges},
          {"euler_characteristic", report.euler_characteristic},
          {"num_components", report.num_components},
          {"num_boundary_components", report.num_boundary_components},
          {"has_global_ids", report.has_global_ids},
          {"matched_by_ids", report.matched_by_ids},
          {"volume", report.volume},
          {"boundary_area", report.boundary_area}};
}

Json offenders_to_json(const CheckReport& report)
{
  Json json = Json::array();
  for (const Defect& defect : report.defects)
    json.push_back({{"kind", defect.kind}, {"count", defect.count}, {"first", defect.offenders}});
  return json;
}

Json subdomains_to_json(const CheckReport& report)
{
  Json json = Json::array();
  for (const SubdomainFigures& subdomain : report.subdomains) {
    Json entry{{"id", subdomain.id},
               {"material", subdomain.material},
               {"tets", subdomain.num_tets},
               {"volume", subdomain.volume}};
    if (report.has_digest) entry["digest"] = to_hex(subdomain.digest);
    json.push_back(std::move(entry));
  }
  return json;
}

}  // namespace

std::string to_json(const CheckReport& report)
{
  Json json;
  json["schema"] = 1;
  json["conforms"] = report.conforms;
  json["partial"] = report.is_partial;
  json["offenders"] = offenders_to_json(report);
  json["notes"] = report.notes;
  json.update(counts_to_json(report));
  json["digest"] = report.has_digest ? Json(to_hex(report.digest)) : Json();
  json["quality"] = quality_to_json(report);
  if (report.order == 2) {
    json["second_order"] = {{"scaled_jacobian", {{"min", report.scaled_jacobian_min}}}};
  }
  json["subdomains"] = subdomains_to_json(report);
  return json.dump(2);
}

}  // namespace tessera::check
