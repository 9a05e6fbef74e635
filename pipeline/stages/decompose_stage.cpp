// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/decompose_stage.hpp"

#include <string>
#include <utility>

#include "tessera/decompose/graph_partitioner.hpp"
#include "tessera/decompose/predicted_fine_tets.hpp"

#include "pipeline/exit_code.hpp"

namespace tessera::pipeline {

decompose::DecomposeResult run_decompose_stage(const config::Case& run_case,
                                               const mesh::CoarseMesh& coarse, RunContext& context)
{
  StageScope stage(context, "decompose");
  const Bytes bytes = on_root(context.comm, [&] {
    const auto partitioner = decompose::make_metis_partitioner();
    const decompose::DecomposeResult result = decompose::decompose(
        coarse, run_case.decompose, decompose::predicted_fine_tets(coarse, run_case.refine.levels),
        *partitioner);
    decompose::validate(coarse, result.decomposition);
    ByteWriter out;
    out.put(mesh::to_bytes(result.decomposition));
    out.put(result.report);
    return std::move(out).take();
  });
  ByteReader in(bytes);
  decompose::DecomposeResult result;
  result.decomposition = mesh::decomposition_from_bytes(in.get_vector<std::byte>());
  result.report = in.get<decompose::DecomposeReport>();
  stage.work_is_done();
  stage.finish(std::to_string(result.report.num_subdomains) + " subdomains");
  return result;
}

}  // namespace tessera::pipeline
