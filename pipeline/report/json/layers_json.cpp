// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/json/layers_json.hpp"

#include <map>

namespace tessera::pipeline {
namespace {

// Patches of one row of the files are one patch.
std::map<LocalIndex, layers::PatchCover> covers_of_rows(const RunResult& run)
{
  const FlatArray<LocalIndex>& row_of = run.coarse.mesh.patch_row;
  std::map<LocalIndex, layers::PatchCover> rows;
  for (const layers::PatchCover& cover : run.cover.patches) {
    layers::PatchCover& row = rows[row_of.empty() ? cover.patch : row_of[at(cover.patch)]];
    row.patch = cover.patch;
    row.add(cover);
  }
  return rows;
}

}  // namespace

Json layers_json(const RunResult& run)
{
  Json patches = Json::array();
  for (const auto& [row, cover] : covers_of_rows(run)) {
    patches.push_back({{"name", run.coarse.mesh.patch_names[at(cover.patch)]},
                       {"area", cover.area},
                       {"covered", cover.covered / cover.area},
                       {"full_height", cover.full / cover.area}});
  }
  GlobalIndex num_tets = 0;
  GlobalIndex num_cells = 0;
  double volume = 0.0;
  for (const subdomain::PieceSummary& piece : run.filled.pieces) {
    num_tets += piece.layers.num_tets;
    num_cells += piece.layers.num_cells;
    volume += piece.layers.volume;
  }
  const layers::PatchCover sum = run.cover.sum();
  return {{"count", run.coarse.mesh.layers.most_layers},
          {"num_tets", num_tets},
          {"num_cells", num_cells},
          {"volume", volume},
          {"covered", sum.covered / sum.area},
          {"full_height", sum.full / sum.area},
          {"patches", std::move(patches)}};
}

}  // namespace tessera::pipeline
