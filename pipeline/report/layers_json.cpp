// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/layers_json.hpp"

#include "tessera/layers/options.hpp"

namespace tessera::pipeline {

Json layers_json(const RunResult& run)
{
  Json patches = Json::array();
  for (const layers::PatchCover& cover : run.cover.patches) {
    patches.push_back({{"name", run.coarse.mesh.patch_names[at(cover.patch)]},
                       {"area", cover.area},
                       {"covered", cover.covered / cover.area},
                       {"full_height", cover.full / cover.area}});
  }
  GlobalIndex num_tets = 0;
  double volume = 0.0;
  for (const subdomain::PieceSummary& piece : run.filled.pieces) {
    num_tets += piece.layers.num_tets;
    volume += piece.layers.volume;
  }
  const layers::PatchCover sum = run.cover.sum();
  return {{"count", run.coarse.mesh.layers.num_layers()},
          {"num_tets", num_tets},
          {"volume", volume},
          {"covered", sum.covered / sum.area},
          {"full_height", sum.full / sum.area},
          {"patches", std::move(patches)}};
}

}  // namespace tessera::pipeline
