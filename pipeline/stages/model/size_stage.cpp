// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/model/size_stage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tessera/base/bytes.hpp"
#include "tessera/comm/all_or_none.hpp"

#include "pipeline/jobs/mesh_worker.hpp"
#include "pipeline/jobs/require_job.hpp"

namespace tessera::pipeline {
namespace {

constexpr jobs::JobLimits kQueryLimits{.cpu_s = 600.0, .stall_s = 60.0, .memory_gib = 8.0};

// NETGEN's largest size is more of a middle. On a brick, edges had a median of 1.18 and a 99th
// percentile of 1.94 times it, after refinement too.
constexpr double kSizeForEdge = 0.83;

double measure_box(const config::Case& given, RunContext& context)
{
  const Bytes request = box_request();
  return require_job({"box", request, kQueryLimits}, box_diagonal_from_bytes,
                     given.geometry.file.string() + ": size of the model", context);
}

std::optional<coarse::ModelFigures> ask_for_figures(RunContext& context)
{
  const Bytes request = figures_request();
  const auto [figures, end, cpu_s] =
      attempt_job({"figures", request, kQueryLimits}, from_bytes<coarse::ModelFigures>,
                  wait_for_stop_signal(), context);
  throw_unless_of_the_job(end);
  return figures;
}

// A volume that the box cannot hold is none. Then a part fills about a third of a cube with the
// box's diagonal.
double volume_of(const config::Case& given, const std::optional<coarse::ModelFigures>& figures,
                 RunContext& context)
{
  const double cube = std::pow(measure_box(given, context) / std::sqrt(3.0), 3.0);
  const double volume = figures ? figures->volume : 0.0;
  return volume > 0.0 && volume <= cube ? volume : cube / 3.0;
}

// Gmsh makes its surface by itself. A target that is larger than the model says only that as few
// tets as possible are wanted.
double least_feature(const config::Case& resolved, double volume, double noise)
{
  constexpr double kPartOfTarget = 0.05;
  constexpr double kMostOfMaxSize = 0.5;  // What is larger is no detail of the mesh.
  if (resolved.coarse.mesher == surface::Mesher::gmsh) return 0.0;
  const double wanted =
      resolved.size.min >= 0.0
          ? resolved.size.min
          : std::max(noise, kPartOfTarget * std::min(resolved.size.target, std::cbrt(volume)));
  return std::min(wanted, kMostOfMaxSize * resolved.coarse.max_size);
}

}  // namespace

double estimated_tets(double volume, double target)
{
  constexpr double kRegularTets = 6.0 * std::numbers::sqrt2;  // In a cube of their edge.
  return kRegularTets * volume / (target * target * target);
}

int levels_for(double num_fine_tets)
{
  if (num_fine_tets < 5e5) return 1;
  if (num_fine_tets < 4e6) return 2;
  return num_fine_tets < 1e8 ? 3 : 4;
}

std::optional<coarse::ModelFigures> measure_model(const config::Case& given, RunContext& context)
{
  if (model::is_mesh_name(given.geometry.file)) return std::nullopt;
  return on_root(context.comm, [&] { return ask_for_figures(context); });
}

config::Case run_size_stage(const config::Case& given,
                            const std::optional<coarse::ModelFigures>& figures, double noise,
                            RunContext& context)
{
  if (model::is_mesh_name(given.geometry.file)) return given;
  config::Case resolved = given;
  const bool wants_max_size = given.size.target > 0.0 && given.coarse.max_size == 0.0;
  const bool wants_least = given.size.target > 0.0 && given.size.min < 0.0;
  double volume = 0.0;
  if (wants_max_size || wants_least) {
    volume = on_root(context.comm, [&] { return volume_of(given, figures, context); });
  }
  if (wants_max_size) {
    const int levels = levels_for(estimated_tets(volume, given.size.target));
    resolved.coarse.max_size = kSizeForEdge * std::ldexp(given.size.target, levels);
    context.log.info(fmt::format("size.target {}: coarse.max_size = {}", given.size.target,
                                 resolved.coarse.max_size));
  }
  resolved.coarse.defeature = least_feature(resolved, volume, noise);
  return resolved;
}

}  // namespace tessera::pipeline
