// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/partner_stage.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "tessera/subdomain/periodic_partners.hpp"

#include "pipeline/runtime/stop_signal.hpp"
#include "pipeline/stages/write_stage.hpp"

namespace tessera::pipeline {

void run_partner_stage(const RunResult& run, const std::vector<subdomain::SubdomainRange>& files,
                       RunContext& context)
{
  if (run.resolved.periodic.empty()) return;
  StageScope stage(context, "partners");
  std::vector<std::filesystem::path> boundary = boundary_files(files, run.filled.pieces);
  for (std::filesystem::path& file : boundary) file = context.folder / file;
  subdomain::add_periodic_partners(boundary, run.resolved.output.compression, context.comm,
                                   throw_if_stop_requested);
  stage.work_is_done();
  stage.finish(fmt::format("{} files", boundary.size()));
}

}  // namespace tessera::pipeline
