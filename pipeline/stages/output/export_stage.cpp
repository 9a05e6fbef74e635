// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/output/export_stage.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "tessera/formats/export_mesh.hpp"

#include "pipeline/runtime/stop_signal.hpp"

namespace tessera::pipeline {

std::vector<io::Format> other_formats(const io::OutputOptions& options)
{
  std::vector<io::Format> others = options.formats;
  std::erase(others, io::Format::pvtu);
  return others;
}

std::vector<formats::PieceCounts> run_export_stage(const config::Case& run_case,
                                                   RunContext& context)
{
  const std::vector<io::Format> others = other_formats(run_case.output);
  StageScope stage(context, others.empty() ? Stage::neighbours : Stage::export_formats);
  const std::filesystem::path index = context.folder / "mesh.pvtu";
  formats::Outline mesh =
      others.empty() ? formats::outline_of(index, context.comm, throw_if_stop_requested)
                     : formats::export_mesh({index, others, context.folder, run_case.output.layers},
                                            context.comm, throw_if_stop_requested);
  stage.work_is_done();
  stage.finish(fmt::format("{} pieces in {} more formats", mesh.num_pieces(), others.size()));
  return std::move(mesh.pieces);
}

}  // namespace tessera::pipeline
