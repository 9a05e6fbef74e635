// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/export_stage.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "tessera/formats/export_mesh.hpp"

#include "pipeline/runtime/stop_signal.hpp"

namespace tessera::pipeline {

void run_export_stage(const config::Case& run_case, RunContext& context)
{
  std::vector<io::Format> others = run_case.output.formats;
  std::erase(others, io::Format::pvtu);
  if (others.empty()) return;
  StageScope stage(context, "export");
  const formats::Outline mesh =
      formats::export_mesh({context.folder / "mesh.pvtu", others, context.folder}, context.comm,
                           throw_if_stop_requested);
  stage.work_is_done();
  stage.finish(fmt::format("{} formats, {} tets", others.size(), mesh.num_tets()));
}

}  // namespace tessera::pipeline
