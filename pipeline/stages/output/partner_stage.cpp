// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/output/partner_stage.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/subdomain/periodic_partners.hpp"

#include "pipeline/runtime/stop_signal.hpp"
#include "pipeline/stages/output/write_stage.hpp"

namespace tessera::pipeline {

void run_partner_stage(const RunResult& run, const std::vector<subdomain::SubdomainRange>& files,
                       RunContext& context)
{
  StageScope stage(context, Stage::partners);
  std::vector<std::filesystem::path> boundary = boundary_files(files, run.filled.pieces);
  for (std::filesystem::path& file : boundary) file = context.folder / file;
  const GlobalIndex num_missing = subdomain::add_periodic_partners(
      boundary, run.resolved.output.compression, context.comm, throw_if_stop_requested);
  if (num_missing > 0) {
    throw comm::Collective<MeshError>(fmt::format(
        "[[periodic]]: {} points are the image of none; `tessera check` lists them", num_missing));
  }
  stage.work_is_done();
  stage.finish(fmt::format("{} files", boundary.size()));
}

}  // namespace tessera::pipeline
