// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/fill/verify_stage.hpp"

#include <optional>
#include <string>

#include "tessera/base/error.hpp"
#include "tessera/subdomain/verify_pieces.hpp"

namespace tessera::pipeline {

void run_verify_stage(const subdomain::PartitionedMesh& cut,
                      const std::vector<subdomain::SubdomainRange>& ranges,
                      const FilledPieces& filled, RunContext& context)
{
  StageScope stage(context, Stage::verify);
  subdomain::PieceFacts facts{filled.pieces, filled.seam_sums};
  const bool is_exchanged = filled.improvement.pieces != nullptr;
  facts.have_surfaces = is_exchanged || filled.are_refined;
  if (is_exchanged && !filled.are_refined) {
    facts.volume_before = filled.improvement.volume_before;
  }
  // All ranks know the same of the pieces, and the tables for it are as large as the skeleton.
  std::optional<std::string> defect;
  if (context.comm.rank() == 0) defect = subdomain::verify_pieces(cut, ranges, facts);
  context.comm.throw_if_any<MeshError>(defect);
  stage.work_is_done();
  stage.finish("all seams close");
}

}  // namespace tessera::pipeline
