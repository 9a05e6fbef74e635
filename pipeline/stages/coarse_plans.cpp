// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse_plans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/jobs/run_program.hpp"
#include "tessera/model/options.hpp"

#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/stages/coarse_budget.hpp"

namespace tessera::pipeline {
namespace {

// Gmsh gets what OpenCASCADE has read.
bool is_for_gmsh(const config::Case& run_case)
{
  constexpr std::array<std::string_view, 5> kKinds{".step", ".stp", ".iges", ".igs", ".brep"};
  const std::string kind = model::lower_case_extension(run_case.geometry.file);
  return run_case.coarse.mesher == coarse::Mesher::netgen
         && std::ranges::find(kKinds, kind) != kKinds.end();
}

bool has_gmsh() { return jobs::is_on_path("gmsh"); }

// A mesh that the user brings is the coarse mesh; no other one could be made.
std::vector<coarse::CoarseOptions> tries_for(const config::Case& run_case)
{
  if (model::is_mesh_name(run_case.geometry.file)) return {run_case.coarse};
  const bool is_csg = model::lower_case_extension(run_case.geometry.file) == ".geo";
  const bool is_gmsh = run_case.coarse.mesher == coarse::Mesher::gmsh;
  if (is_csg || is_gmsh) return coarse_fallbacks(run_case.coarse);
  coarse::CoarseOptions ours = run_case.coarse;
  ours.surface_mesher = coarse::SurfaceMesher::remesh;
  coarse::CoarseOptions finer = ours;
  finer.max_size *= 0.5;
  coarse::CoarseOptions netgen = run_case.coarse;
  netgen.defeature = 0.0;
  return {ours, finer, netgen};
}

// Options, and whether the model is cut before.
struct Attempt {
  coarse::CoarseOptions options{};
  bool is_cut = false;
};

// Surfaces of parts are NETGEN's; what it cannot mesh once is tried finer once. What worked uncut
// must go on to work. Gmsh comes last, so that no mesh that Tessera can make depends on what is
// installed.
std::vector<Attempt> attempts_at(const config::Case& run_case, const cut::CutTree& planes,
                                 bool with_gmsh)
{
  constexpr std::size_t kTriesOfParts = 2;
  std::vector<Attempt> attempts;
  if (planes.num_parts > 0) {
    for (const coarse::CoarseOptions& options : coarse_fallbacks(run_case.coarse)) {
      if (attempts.size() < kTriesOfParts) attempts.push_back({options, true});
    }
  }
  for (const coarse::CoarseOptions& options : tries_for(run_case)) {
    attempts.push_back({options, false});
  }
  if (with_gmsh) {
    attempts.push_back({run_case.coarse, false});
    attempts.back().options.mesher = coarse::Mesher::gmsh;
    attempts.back().options.defeature = 0.0;
  }
  return attempts;
}

// What a try does that is not as asked; nothing for the first one.
std::optional<Repair> repair_of(const coarse::CoarseOptions& tried,
                                const coarse::CoarseOptions& asked)
{
  if (tried.mesher != asked.mesher) return Repair::gmsh_mesh;
  if (tried.surface_mesher != asked.surface_mesher) {
    const bool is_netgen = tried.surface_mesher == coarse::SurfaceMesher::netgen;
    return is_netgen ? Repair::netgen_surface : Repair::remeshed_triangles;
  }
  if (tried.curvature != asked.curvature) return Repair::more_curvature;
  if (tried.max_size != asked.max_size) return Repair::finer_coarse_size;
  return std::nullopt;
}

void drop_left_out(std::vector<CoarsePlan>& plans)
{
  std::erase_if(plans, [first = plans.front()](const CoarsePlan& plan) {
    const RepairCounts repairs = repairs_of(plan, first);
    return std::ranges::any_of(left_out_repairs(),
                               [&](Repair left_out) { return repairs[left_out] > 0; });
  });
}

constexpr jobs::JobLimits kFiguresLimits{.cpu_s = 20.0, .stall_s = 20.0, .memory_gib = 8.0};

// If they cannot be had: those of a model with many faces, so that nothing ends too early.
coarse::ModelFigures figures_of(const config::Case& run_case, RunContext& context)
{
  constexpr coarse::ModelFigures kUnknown{.num_faces = 2500};
  if (run_case.coarse.timeout_s > 0.0 || model::is_mesh_name(run_case.geometry.file))
    return kUnknown;
  const Bytes request = figures_request();
  jobs::JobOutcome outcome =
      run_job({"coarse: figures", request, kFiguresLimits}, wait_for_stop_signal(), context);
  throw_unless_of_the_job(outcome);
  const auto figures = read_result(outcome, from_bytes<coarse::ModelFigures>);
  return figures && std::isfinite(figures->area) ? *figures : kUnknown;
}

}  // namespace

std::vector<coarse::CoarseOptions> coarse_fallbacks(const coarse::CoarseOptions& asked)
{
  std::vector<coarse::CoarseOptions> fallbacks{asked};
  for (const double factor : {0.7, 0.5}) {
    coarse::CoarseOptions finer = asked;
    finer.max_size *= factor;
    finer.grading = std::min(finer.grading, 0.2);
    fallbacks.push_back(finer);
  }
  coarse::CoarseOptions rounder = asked;
  rounder.curvature *= 2.0;
  if (asked.mesher == coarse::Mesher::gmsh) {
    fallbacks.push_back(rounder);
    return fallbacks;
  }
  // Rounder meshes have been seen to take minutes and to have a million tets, and of some hundred
  // models none needed one that could be remeshed.
  coarse::CoarseOptions remeshed = asked;
  remeshed.surface_mesher = coarse::SurfaceMesher::remesh;
  coarse::CoarseOptions finer_remeshed = remeshed;
  finer_remeshed.max_size *= 0.5;
  fallbacks.insert(fallbacks.end(), {remeshed, rounder, finer_remeshed});
  return fallbacks;
}

RepairCounts repairs_of(const CoarsePlan& plan, const CoarsePlan& first)
{
  RepairCounts repairs;
  if (const auto repair = repair_of(plan.options, first.options)) repairs.add(*repair);
  if (plan.planes.num_parts != first.planes.num_parts) repairs.add(Repair::uncut_model);
  return repairs;
}

bool may_gmsh_help(const config::Case& run_case) { return is_for_gmsh(run_case) && !has_gmsh(); }

std::vector<CoarsePlan> plans_for(const config::Case& run_case, const cut::CutTree& planes,
                                  LocalIndex first_rung, RunContext& context)
{
  const auto figures = on_root(context.comm, [&] { return figures_of(run_case, context); });
  const bool with_gmsh = on_root(context.comm, [&] { return is_for_gmsh(run_case) && has_gmsh(); });
  std::vector<CoarsePlan> plans;
  for (const auto& [options, is_cut] : attempts_at(run_case, planes, with_gmsh)) {
    plans.push_back({.options = options,
                     .planes = is_cut ? planes : cut::CutTree{},
                     .rung = first_rung + static_cast<LocalIndex>(plans.size()),
                     .limits = surface_limits(options, figures, plans.empty())});
  }
  drop_left_out(plans);
  return plans;
}

CoarsePlan finer_plan(const CoarseResult& before, const mesh::SizePoints& sizes)
{
  CoarsePlan plan{.options = before.options, .rung = before.tries};
  plan.options.timeout_s = optional_timeout_s(before.options, before.cpu_s);
  mesh::SizePoints& points = plan.options.points;
  points.xyz.insert(points.xyz.end(), sizes.xyz.begin(), sizes.xyz.end());
  points.size.insert(points.size.end(), sizes.size.begin(), sizes.size.end());
  plan.limits = surface_limits(plan.options, coarse::ModelFigures{}, true);
  return plan;
}

}  // namespace tessera::pipeline
