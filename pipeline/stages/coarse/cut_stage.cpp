// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/cut_stage.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

#include "pipeline/runtime/with_file_context.hpp"
#include "pipeline/stages/model/name_stage.hpp"

namespace tessera::pipeline {
namespace {

// NETGEN takes a quarter of a second for so many: enough for a job.
constexpr double kAutoPartTets = 2000.0;
constexpr double kMostAutoParts = 64.0;

cut::CutOptions options_of(const config::Case& resolved, const model::ModelDescription& model)
{
  const double scale = resolved.geometry.scale;
  cut::CutOptions options;
  options.rule = resolved.planes.rule;
  options.parts = num_parts_for(resolved, model);
  options.coarse_size = resolved.coarse.max_size / scale;
  for (const cut::GivenPlane& plane : resolved.planes.given) {
    options.given.push_back({plane.normal, dot(plane.normal, plane.point) / scale});
  }
  return options;
}

cut::CutChoice choose(const config::Case& resolved, RunContext& context)
{
  const model::ModelDescription model = describe_model(resolved, context);
  try {
    return cut::choose_planes(model, options_of(resolved, model));
  } catch (const InputError& error) {
    throw ConfigError(error.what());
  }
}

void require_solids(const RunResult& run)
{
  const model::Format format = run.model.format;
  if (format != model::Format::stl && format != model::Format::own) return;
  throw ConfigError(fmt::format(
      "{}: decompose.method = \"geometry\" needs a solid model: CSG, STEP, IGES or BREP",
      run.resolved.geometry.file.string()));
}

}  // namespace

std::optional<std::string> parts_not_meshed(const RunResult& run)
{
  if (!is_cut(run) || !run.coarse.tet_part.empty()) return std::nullopt;
  return fmt::format(
      "the model is cut into {} parts, but these could not be meshed; it was meshed as a whole, as "
      "with decompose.method = \"mesh\"",
      run.planes.tree.num_parts);
}

LocalIndex num_parts_for(const config::Case& resolved, const model::ModelDescription& model)
{
  if (resolved.decompose.subdomains > 0) return resolved.decompose.subdomains;
  if (!resolved.planes.given.empty()) return 1;
  double volume = 0.0;
  for (const model::SolidDescription& solid : model.solids) volume += solid.volume;
  const double size = resolved.coarse.max_size / resolved.geometry.scale;
  const double num_tets = volume * 6.0 * std::sqrt(2.0) / std::pow(size, 3.0);
  return static_cast<LocalIndex>(std::clamp(num_tets / kAutoPartTets, 1.0, kMostAutoParts));
}

cut::CutChoice run_cut_stage(const RunResult& run, RunContext& context)
{
  StageScope stage(context, Stage::cut);
  cut::CutChoice choice = comm::on_root(context.comm, [&] {
    require_solids(run);
    return with_file_context(run.resolved, [&] { return choose(run.resolved, context); });
  });
  stage.work_is_done();
  const auto num_whole = std::ranges::count_if(
      choice.report.parts, [](const cut::CutPart& part) { return !part.whole_because.empty(); });
  stage.finish(fmt::format("{} parts of {}, {} of them could not be cut well",
                           choice.tree.num_parts, choice.report.num_wanted, num_whole));
  return choice;
}

}  // namespace tessera::pipeline
