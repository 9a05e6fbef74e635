// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/json/names_json.hpp"

#include <string>
#include <vector>

#include "tessera/base/sort_unique.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

namespace tessera::pipeline {
namespace {

// Sums of subdomains in their order, so the same for any number of ranks.
Json materials_json(const RunResult& run)
{
  Json materials = Json::array();
  for (const std::string& name : mesh::body_names(run.coarse.mesh)) {
    const auto id = static_cast<LocalIndex>(materials.size()) + 1;
    GlobalIndex num_tets = 0;
    double volume = 0.0;
    for (const subdomain::PieceSummary& piece : run.filled.pieces) {
      if (run.coarse.mesh.body(piece.material) != id) continue;
      num_tets += piece.num_all_tets();
      volume += piece.whole_volume();
    }
    materials.push_back({{"id", id}, {"name", name}, {"tets", num_tets}, {"volume", volume}});
  }
  return materials;
}

// The numbers in the list of faces of the model, ascending, of each row of the files.
std::vector<std::vector<LocalIndex>> faces_of_rows(const mesh::CoarseMesh& coarse,
                                                   std::size_t num_rows)
{
  std::vector<std::vector<LocalIndex>> faces(num_rows);
  for (std::size_t p = 0; p < coarse.patch_names.size(); ++p) {
    if (coarse.is_wake(static_cast<LocalIndex>(p))) continue;
    const std::size_t row = coarse.patch_row.empty() ? p : at(coarse.patch_row[p]);
    faces[row].push_back(coarse.patch_surface[p] + 1);
  }
  for (std::vector<LocalIndex>& numbers : faces) sort_unique(numbers);
  return faces;
}

// By row of the files; summed as materials are.
Json patches_json(const RunResult& run, const std::vector<std::string>& names)
{
  const FlatArray<LocalIndex>& row_of = run.coarse.mesh.patch_row;
  std::vector<subdomain::PatchArea> rows(names.size());
  for (const subdomain::PieceSummary& piece : run.filled.pieces) {
    for (const subdomain::PatchArea& part : piece.patches) {
      subdomain::PatchArea& row = rows[at(row_of.empty() ? part.patch : row_of[at(part.patch)])];
      row.num_triangles += part.num_triangles;
      row.area += part.area;
    }
  }
  Json patches = Json::array();
  const std::vector<std::vector<LocalIndex>> faces = faces_of_rows(run.coarse.mesh, names.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    patches.push_back({{"id", r},
                       {"name", names[r]},
                       {"triangles", rows[r].num_triangles},
                       {"area", rows[r].area},
                       {"faces", faces[r]}});
  }
  return patches;
}

// By row of line_names(); summed as materials are.
Json lines_json(const RunResult& run, const std::vector<std::string>& names)
{
  std::vector<subdomain::LineLength> rows(names.size());
  for (const subdomain::PieceSummary& piece : run.filled.pieces) {
    for (const subdomain::LineLength& part : piece.lines) {
      rows[at(part.line)].num_edges += part.num_edges;
      rows[at(part.line)].length += part.length;
    }
  }
  Json lines = Json::array();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    lines.push_back(
        {{"id", r}, {"name", names[r]}, {"edges", rows[r].num_edges}, {"length", rows[r].length}});
  }
  return lines;
}

}  // namespace

void add_names(Json& json, const RunResult& run)
{
  const std::vector<std::string> names = subdomain::names_of_rows(run.coarse.mesh);
  json["patch_names"] = names;
  json["patches"] = patches_json(run, names);
  json["materials"] = materials_json(run);
  const std::vector<std::string> lines = mesh::line_names(run.coarse.mesh);
  if (!lines.empty()) json["lines"] = lines_json(run, lines);
}

}  // namespace tessera::pipeline
