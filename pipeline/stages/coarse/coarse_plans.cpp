// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/coarse_plans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/jobs/run_program.hpp"
#include "tessera/model/options.hpp"

#include "pipeline/stages/coarse/coarse_budget.hpp"

namespace tessera::pipeline {
namespace {

// Gmsh gets what OpenCASCADE has read.
bool is_for_gmsh(const config::Case& run_case)
{
  constexpr std::array<std::string_view, 5> kKinds{".step", ".stp", ".iges", ".igs", ".brep"};
  const std::string kind = model::lower_case_extension(run_case.geometry.file);
  return run_case.coarse.mesher == surface::Mesher::netgen && run_case.periodic.empty()
         && !run_case.coarse.has_inner_parts && std::ranges::find(kKinds, kind) != kKinds.end();
}

bool has_gmsh() { return jobs::is_on_path("gmsh"); }

// What is merged may be what made a surface touch itself.
surface::CoarseOptions finer(surface::CoarseOptions options)
{
  options.max_size *= 0.5;
  options.defeature *= 0.5;
  return options;
}

// Options, and whether the model is cut before.
struct Attempt {
  surface::CoarseOptions options{};
  bool is_cut = false;
};

// Surfaces of parts are NETGEN's. What worked uncut must go on to work. Gmsh comes last, so that no
// mesh that Tessera can make depends on what is installed.
std::vector<Attempt> attempts_at(const config::Case& run_case, const cut::CutTree& planes,
                                 bool with_gmsh)
{
  std::vector<Attempt> attempts;
  if (planes.num_parts > 0) {
    attempts = {{run_case.coarse, true}, {finer(run_case.coarse), true}};
  }
  for (const surface::CoarseOptions& options : coarse_tries(run_case)) {
    attempts.push_back({options, false});
  }
  if (with_gmsh) {
    attempts.push_back({run_case.coarse, false});
    attempts.back().options.mesher = surface::Mesher::gmsh;
    attempts.back().options.defeature = 0.0;
  }
  return attempts;
}

void drop_left_out(std::vector<CoarsePlan>& plans)
{
  std::erase_if(plans, [first = plans.front()](const CoarsePlan& plan) {
    const RepairCounts repairs = repairs_of(plan, first);
    return std::ranges::any_of(left_out_repairs(),
                               [&](Repair left_out) { return repairs[left_out] > 0; });
  });
}

// If they are not known: those of a model with many faces, so that nothing ends too early.
coarse::ModelFigures known_or_many(const std::optional<coarse::ModelFigures>& figures)
{
  return figures && std::isfinite(figures->area) ? *figures
                                                 : coarse::ModelFigures{.num_faces = 2500};
}

// NETGEN and Gmsh have one thread. Surfaces of parts are NETGEN's.
bool uses_threads(const surface::CoarseOptions& options, bool is_cut)
{
  return !is_cut && options.mesher == surface::Mesher::netgen
         && options.surface_mesher == surface::SurfaceMesher::remesh;
}

}  // namespace

std::vector<surface::CoarseOptions> coarse_tries(const config::Case& run_case)
{
  const surface::CoarseOptions& asked = run_case.coarse;
  if (model::is_mesh_name(run_case.geometry.file)) return {asked};
  if (asked.mesher == surface::Mesher::gmsh) return {asked, finer(asked)};
  surface::CoarseOptions ours = asked;
  ours.surface_mesher = surface::SurfaceMesher::remesh;
  // NETGEN's sides are not alike, and it knows no faces inside of bodies.
  if (!asked.periodic.empty() || asked.has_inner_parts) return {ours, finer(ours)};
  surface::CoarseOptions netgen = asked;
  netgen.defeature = 0.0;
  return {ours, finer(ours), netgen};
}

RepairCounts repairs_of(const CoarsePlan& plan, const CoarsePlan& first)
{
  const surface::CoarseOptions& tried = plan.options;
  RepairCounts repairs;
  if (plan.planes.num_parts != first.planes.num_parts) repairs.add(Repair::uncut_model);
  if (tried.mesher != first.options.mesher) {
    repairs.add(Repair::gmsh_mesh);
  } else if (tried.surface_mesher == surface::SurfaceMesher::netgen
             && first.options.surface_mesher != tried.surface_mesher) {
    repairs.add(Repair::netgen_surface);
  }
  if (tried.max_size != first.options.max_size) repairs.add(Repair::finer_coarse_size);
  return repairs;
}

bool may_gmsh_help(const config::Case& run_case) { return is_for_gmsh(run_case) && !has_gmsh(); }

std::vector<CoarsePlan> plans_for(const config::Case& run_case,
                                  const std::optional<coarse::ModelFigures>& figures,
                                  const cut::CutTree& planes, LocalIndex first_rung,
                                  const RunContext& context)
{
  const bool with_gmsh = on_root(context.comm, [&] { return is_for_gmsh(run_case) && has_gmsh(); });
  std::vector<CoarsePlan> plans;
  for (const auto& [options, is_cut] : attempts_at(run_case, planes, with_gmsh)) {
    plans.push_back({.options = options,
                     .planes = is_cut ? planes : cut::CutTree{},
                     .rung = first_rung + static_cast<LocalIndex>(plans.size()),
                     .limits = surface_limits(options, known_or_many(figures), plans.empty())});
    plans.back().limits.is_alone = plans.size() == 1 && uses_threads(options, is_cut);
  }
  drop_left_out(plans);
  return plans;
}

}  // namespace tessera::pipeline
