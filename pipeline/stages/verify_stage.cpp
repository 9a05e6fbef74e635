// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/verify_stage.hpp"

#include <cstddef>
#include <optional>
#include <string>

#include "tessera/base/error.hpp"
#include "tessera/verify/euler.hpp"
#include "tessera/verify/seams.hpp"

namespace tessera::pipeline {
namespace {

std::optional<std::string> first_defect(const mesh::CoarseMesh& coarse,
                                        const mesh::Decomposition& decomposition,
                                        const mesh::Skeleton& skeleton, const FilledPieces& filled)
{
  if (filled.pieces.size() != decomposition.subdomain_material.size()) {
    return std::to_string(filled.pieces.size()) + " pieces for "
           + std::to_string(decomposition.subdomain_material.size()) + " subdomains";
  }
  const std::vector<GlobalIndex> expected =
      verify::euler_characteristics(coarse.tet_vertices, decomposition.tet_subdomain);
  for (std::size_t s = 0; s < expected.size(); ++s) {
    const GlobalIndex found = filled.pieces[s].euler_characteristic;
    if (found == expected[s]) continue;
    return "piece " + std::to_string(s) + " has Euler characteristic " + std::to_string(found)
           + ", its coarse subdomain " + std::to_string(expected[s]);
  }
  return verify::first_open_seam(filled.seam_sums, skeleton);
}

}  // namespace

void run_verify_stage(const mesh::CoarseMesh& coarse, const mesh::Decomposition& decomposition,
                      const mesh::Skeleton& skeleton, const FilledPieces& filled,
                      RunContext& context)
{
  StageScope stage(context, "verify");
  context.comm.throw_if_any<MeshError>(first_defect(coarse, decomposition, skeleton, filled));
  stage.work_is_done();
  stage.finish("all seams close");
}

}  // namespace tessera::pipeline
