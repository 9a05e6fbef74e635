// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse_stage.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/share_on_node.hpp"
#include "tessera/jobs/run_program.hpp"

#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/stages/coarse_budget.hpp"
#include "pipeline/stages/coarse_ladder.hpp"
#include "pipeline/stages/coarse_try.hpp"

namespace tessera::pipeline {
namespace {

// The model will not get better in another try.
bool is_final(const jobs::JobOutcome& outcome)
{
  return outcome.error == ErrorKind::geometry || outcome.error == ErrorKind::input
         || outcome.error == ErrorKind::config || outcome.loads_are_lost;
}

bool is_endless(const jobs::JobOutcome& outcome)
{
  return outcome.status == jobs::JobStatus::out_of_time
         || outcome.status == jobs::JobStatus::stalled;
}

std::string name_of(const coarse::CoarseOptions& options)
{
  const bool is_remesh = options.surface_mesher == coarse::SurfaceMesher::remesh;
  std::string_view who = is_remesh ? "remeshed triangles, " : "";
  if (options.mesher == coarse::Mesher::gmsh) who = "Gmsh, ";
  return fmt::format("{}max_size {:g}", who, options.max_size);
}

// Gmsh gets what OpenCASCADE has read.
bool is_for_gmsh(const config::Case& run_case)
{
  constexpr std::array<std::string_view, 5> kKinds{".step", ".stp", ".iges", ".igs", ".brep"};
  std::string kind = run_case.geometry.file.extension().string();
  std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return std::tolower(c); });
  return run_case.coarse.mesher == coarse::Mesher::netgen
         && std::ranges::find(kKinds, kind) != kKinds.end();
}

bool has_gmsh() { return jobs::is_on_path("gmsh"); }

[[noreturn]] void throw_no_mesh(const CoarseResult& result, const config::Case& run_case)
{
  const bool may_gmsh_help = is_for_gmsh(run_case) && !has_gmsh();
  std::string failures;
  for (const std::string& failure : result.failures) failures += "\n  " + failure;
  throw MeshError(fmt::format(
      "{}: no coarse mesh could be made; try another coarse.max_size, a longer "
      "coarse.timeout_s, or repair the model{}{}",
      run_case.geometry.file.string(),
      may_gmsh_help ? "; if Gmsh is installed (Debian: apt install gmsh), it is tried as "
                      "well"
                    : "",
      failures));
}

void throw_if_hopeless(const jobs::JobOutcome& outcome, const std::string& file)
{
  // Another try would be another mesh, and nothing is wrong with this one.
  if (was_killed_from_outside(outcome)) {
    throw MeshError(fmt::format("coarse: {}{}", outcome.message, way_on(outcome)));
  }
  if (is_final(outcome)) jobs::throw_unless_ok(outcome, file);
}

// A mesh that the user brings is the coarse mesh; no other one could be made.
std::vector<coarse::CoarseOptions> tries_for(const config::Case& run_case)
{
  if (model::is_mesh_name(run_case.geometry.file)) return {run_case.coarse};
  return coarse_fallbacks(run_case.coarse);
}

// Options, and whether the model is cut before.
struct Attempt {
  coarse::CoarseOptions options{};
  bool is_cut = false;
};

// Parts that NETGEN cannot mesh once are tried finer once. What worked uncut must go on to work.
// Gmsh comes last, so that no mesh that Tessera can make depends on what is installed.
std::vector<Attempt> attempts_at(const config::Case& run_case, const cut::CutTree& planes,
                                 bool with_gmsh)
{
  constexpr std::size_t kTriesOfParts = 2;
  const std::vector<coarse::CoarseOptions> fallbacks = tries_for(run_case);
  std::vector<Attempt> attempts;
  if (planes.num_parts > 0) {
    for (std::size_t i = 0; i < std::min(kTriesOfParts, fallbacks.size()); ++i) {
      attempts.push_back({fallbacks[i], true});
    }
  }
  for (const coarse::CoarseOptions& options : fallbacks) attempts.push_back({options, false});
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
  if (tried.defeature != asked.defeature) return Repair::without_defeature;
  if (tried.surface_mesher != asked.surface_mesher) return Repair::remeshed_triangles;
  if (tried.curvature != asked.curvature) return Repair::more_curvature;
  if (tried.max_size != asked.max_size) return Repair::finer_coarse_size;
  return std::nullopt;
}

RepairCounts repairs_of(const CoarsePlan& plan, const CoarsePlan& first)
{
  RepairCounts repairs;
  if (const auto repair = repair_of(plan.options, first.options)) repairs.add(*repair);
  if (plan.planes.num_parts != first.planes.num_parts) repairs.add(Repair::uncut_model);
  return repairs;
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

// @param first_rung Number of the first of these tries.
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

bool is_cut(const CoarsePlan& plan) { return plan.planes.num_parts > 0; }

std::vector<RungKind> kinds_of(const std::vector<CoarsePlan>& plans)
{
  std::vector<RungKind> kinds;
  for (const CoarsePlan& plan : plans) {
    const coarse::CoarseOptions& options = plan.options;
    const coarse::CoarseOptions& first = plans.front().options;
    kinds.push_back({.is_netgen = options.surface_mesher == coarse::SurfaceMesher::netgen
                                  && options.mesher == first.mesher
                                  && options.defeature == first.defeature,
                     .is_cut = is_cut(plan)});
  }
  return kinds;
}

// How a rung has ended, the same on every rank. Nothing goes with it but words and counts.
struct RungOutcome {
  LocalIndex rung = 0;
  jobs::JobOutcome outcome{};
  RepairCounts repairs{};  // In its surface.

  static auto fields(auto& self) { return std::tie(self.rung, self.outcome, self.repairs); }
};

// The tries at the coarse mesh. Their surfaces are made side by side: the rank that made one keeps
// it until it is known whether it counts.
class CoarseTries {
 public:
  CoarseTries(const config::Case& run_case, std::vector<CoarsePlan> plans, StageScope& stage,
              RunContext& context)
      : file_(run_case.geometry.file.string()),
        plans_(std::move(plans)),
        ladder_(kinds_of(plans_), seconds_now),
        stage_(stage),
        context_(context)
  {
  }

  // The mesh is that of rank 0 only; it has no tets if no try worked.
  CoarseResult run()
  {
    while (const auto rung = next_surface()) {
      const CoarsePlan& plan = plans_[at(*rung)];
      result_.options = plan.options;
      const double before_s = context_.jobs.usage().cpu_s;
      CoarseAttempt made = fill_coarse_surface(plan, take_surface(*rung), stage_, context_);
      if (made.outcome.status == jobs::JobStatus::ok) {
        ++result_.tries;
        result_.cpu_s =
            outcomes_[*rung].cpu_s + cpu_of_all_ranks(context_.jobs.usage().cpu_s - before_s);
        result_.was_limited = result_.was_limited || made.was_limited;
        result_.repairs = repairs_of(plan, plans_.front());
        result_.repairs += repairs_[*rung];
        result_.repairs += made.repairs;
        if (made.made) take(std::move(*made.made));
        break;
      }
      all_or_none(context_.comm, [&] { throw_if_hopeless(made.outcome, file_); });
      ladder_.fill_has_failed(*rung, is_endless(made.outcome) ? RungEnd::endless : RungEnd::failed);
      outcomes_[*rung] = std::move(made.outcome);
      note_failures();
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] double cpu_of_all_ranks(double own_s) const
  {
    const std::vector<double> all = context_.comm.all_gather_values(own_s);
    return std::accumulate(all.begin(), all.end(), 0.0);
  }

  void take(CoarseTry made)
  {
    result_.mesh = std::move(made.mesh);
    result_.tet_part = std::move(made.tet_part);
    result_.distance = made.distance;
    result_.defeatured = std::move(made.defeatured);
  }

  // The first rung with a surface, on every rank; nothing if all have failed.
  std::optional<LocalIndex> next_surface()
  {
    run_tasks(
        ladder_,
        [this](const comm::Task& task, const auto& on_wait) { return attempt(task.item, on_wait); },
        stage_, context_);
    share_outcomes();
    note_failures();
    const auto front = ladder_.front();
    if (!front) return front;
    all_or_none(context_.comm, [&] { throw_if_hopeless(outcomes_[*front], file_); });
    return front;
  }

  Bytes attempt(LocalIndex rung, const jobs::JobRunner::WaitCallback& on_wait)
  {
    const CoarsePlan& plan = plans_[at(rung)];
    context_.log.debug("coarse: try {} begins: {}", rung + 1, name_of(plan.options));
    SurfaceTry made = try_coarse_surface(plan, on_wait, context_);
    if (made.outcome.loads_are_lost) throw_if_hopeless(made.outcome, file_);
    RungEnd end = RungEnd::failed;
    if (made.surface) end = RungEnd::surface;
    if (is_endless(made.outcome)) end = RungEnd::endless;
    if (is_final(made.outcome) || was_killed_from_outside(made.outcome)) end = RungEnd::final;
    // Rank 0 has found Gmsh; this rank's machine may be without.
    const bool was_gmsh_asked = plans_.front().options.mesher == coarse::Mesher::gmsh;
    if (plan.options.mesher == coarse::Mesher::gmsh && !was_gmsh_asked
        && made.outcome.error == ErrorKind::config) {
      end = RungEnd::failed;
    }
    if (made.surface) surfaces_[rung] = std::move(*made.surface);
    ended_here_.push_back({rung, std::move(made.outcome), made.repairs});
    return to_bytes(end);
  }

  // After it all ranks know what rank 0 knows.
  void share_outcomes()
  {
    for (RungOutcome& one : context_.comm.all_gather_rows(ended_here_)) {
      outcomes_[one.rung] = std::move(one.outcome);
      repairs_[one.rung] = one.repairs;
    }
    ended_here_.clear();
    ladder_.restore(on_root(context_.comm, [&] { return ladder_.snapshot(); }));
  }

  coarse::CoarseSurface take_surface(LocalIndex rung)
  {
    const auto own = surfaces_.find(rung);
    Bytes bytes = own == surfaces_.end() ? Bytes{} : to_bytes(own->second);
    return from_bytes<coarse::CoarseSurface>(
        context_.comm.broadcast(std::move(bytes), ladder_.holder(rung)));
  }

  // As if they had been tried in turn.
  void note_failures()
  {
    const std::vector<LocalIndex> failed = ladder_.failed();
    for (std::size_t i = result_.failures.size(); i < failed.size(); ++i) {
      const CoarsePlan& plan = plans_[at(failed[i])];
      const jobs::JobOutcome& outcome = outcomes_[failed[i]];
      ++result_.tries;
      result_.options = plan.options;
      result_.failures.push_back(fmt::format("{}{}: {}", is_cut(plan) ? "in parts, " : "",
                                             name_of(plan.options), outcome.message));
      context_.log.warn("coarse: try {} failed: {}", result_.tries, result_.failures.back());
      result_.was_limited = result_.was_limited || depends_on_machine(outcome);
    }
    const auto front = ladder_.front();
    if (!is_in_parts_ || !front || is_cut(plans_[at(*front)])) return;
    is_in_parts_ = false;
    context_.log.warn("coarse: the parts of the model cannot be meshed; it is meshed as a whole");
  }

  std::string file_;
  std::vector<CoarsePlan> plans_;
  CoarseLadder ladder_;
  StageScope& stage_;
  RunContext& context_;
  bool is_in_parts_ = is_cut(plans_.front());
  CoarseResult result_{};
  std::map<LocalIndex, coarse::CoarseSurface> surfaces_{};  // Made by this rank.
  std::vector<RungOutcome> ended_here_{};
  std::map<LocalIndex, jobs::JobOutcome> outcomes_{};
  std::map<LocalIndex, RepairCounts> repairs_{};
};

// Of a run that has a mesh: no tets if none of these can be made.
CoarseResult try_once_more(const config::Case& run_case, std::vector<CoarsePlan> plans,
                           StageScope& stage, RunContext& context)
{
  CoarseResult result;
  try {
    result = CoarseTries(run_case, std::move(plans), stage, context).run();
  } catch (const GeometryError& error) {  // On all ranks; of the model at these sizes only.
    result.tries = 1;
    result.failures.emplace_back(error.what());
  }
  return on_root_of_nodes(context.comm, [&] { return std::move(result); });
}

void finish_more_tries(const CoarseResult& result, StageScope& stage)
{
  stage.work_is_done();
  stage.finish(result.mesh.num_tets() == 0 ? std::string("failed")
                                           : fmt::format("{} tets", result.mesh.num_tets()));
}

void warn_of_other_ways(const CoarseResult& result, const config::Case& run_case,
                        RunContext& context)
{
  if (result.options.mesher != run_case.coarse.mesher) {
    context.log.warn(
        "coarse: Gmsh has made the mesh, after all other tries had failed; without it, or with "
        "another version of it, this run ends otherwise");
  }
  if (result.options.defeature != run_case.coarse.defeature) {
    context.log.warn(
        "coarse: all tries with coarse.defeature = {} had failed; the mesh is made without it",
        run_case.coarse.defeature);
  }
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
  if (asked.defeature > 0.0) {
    fallbacks.push_back(asked);
    fallbacks.back().defeature = 0.0;
  }
  return fallbacks;
}

CoarseResult run_coarse_stage(const config::Case& run_case, const cut::CutTree& planes,
                              RunContext& context)
{
  StageScope stage(context, "coarse");
  CoarseResult result =
      CoarseTries(run_case, plans_for(run_case, planes, 0, context), stage, context).run();
  result = on_root_of_nodes(context.comm, [&] {
    if (result.mesh.num_tets() == 0) throw_no_mesh(result, run_case);
    return std::move(result);
  });
  warn_of_other_ways(result, run_case, context);
  stage.work_is_done();
  stage.finish(fmt::format("{} tets, {} patches, {} materials", result.mesh.num_tets(),
                           result.mesh.num_patches(), result.mesh.num_materials()));
  return result;
}

CoarseResult run_second_coarse_stage(const config::Case& run_case, const CoarseResult& before,
                                     const cut::CutTree& planes, RunContext& context)
{
  StageScope stage(context, "coarse");
  CoarseResult result =
      try_once_more(run_case, plans_for(run_case, planes, before.tries, context), stage, context);
  if (result.mesh.num_tets() > 0) warn_of_other_ways(result, run_case, context);
  finish_more_tries(result, stage);
  return result;
}

CoarseResult run_finer_try(const config::Case& run_case, const CoarseResult& before,
                           const mesh::SizePoints& sizes, RunContext& context)
{
  StageScope stage(context, "coarse");
  CoarseResult result = try_once_more(run_case, {finer_plan(before, sizes)}, stage, context);
  result.options.timeout_s = before.options.timeout_s;
  finish_more_tries(result, stage);
  return result;
}

}  // namespace tessera::pipeline
