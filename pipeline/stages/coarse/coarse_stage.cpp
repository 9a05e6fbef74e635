// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/coarse_stage.hpp"

#include <algorithm>
#include <map>
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

#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/jobs/run_job.hpp"
#include "pipeline/stages/coarse/coarse_ladder.hpp"
#include "pipeline/stages/coarse/coarse_plans.hpp"
#include "pipeline/stages/coarse/coarse_try.hpp"

namespace tessera::pipeline {
namespace {

// Seconds after which other tries begin. Most tries that work have ended by then, and nobody has
// worked in vain. One that has the cores of all ranks gets a part of its limit, within bounds: the
// limit may be the user's.
double head_start_s(const jobs::JobLimits& first)
{
  constexpr double kLeast_s = 3.0;
  constexpr double kMost_s = 60.0;
  constexpr double kOfLimit = 0.05;
  return first.is_alone ? std::clamp(kOfLimit * first.cpu_s, kLeast_s, kMost_s) : kLeast_s;
}

// The model will not get better in another try.
bool is_final(const jobs::JobEnd& end)
{
  return end.error == ErrorKind::geometry || end.error == ErrorKind::input
         || end.error == ErrorKind::config || end.loads_are_lost;
}

std::string name_of(const surface::CoarseOptions& options)
{
  const bool is_remesh = options.surface_mesher == surface::SurfaceMesher::remesh;
  std::string_view who = is_remesh ? "remeshed triangles, " : "NETGEN's surface, ";
  if (options.mesher == surface::Mesher::gmsh) who = "Gmsh, ";
  return fmt::format("{}max_size {:g}", who, options.max_size);
}

[[noreturn]] void throw_no_mesh(const CoarseResult& result, const config::Case& run_case)
{
  std::string failures;
  for (const std::string& failure : result.failures) failures += "\n  " + failure;
  throw MeshError(fmt::format(
      "{}: no coarse mesh could be made; try another coarse.max_size, a longer "
      "coarse.timeout_s, or repair the model{}{}",
      run_case.geometry.file.string(),
      may_gmsh_help(run_case) ? "; if Gmsh is installed (Debian: apt install gmsh), it is tried as "
                                "well"
                              : "",
      failures));
}

void throw_if_hopeless(const jobs::JobEnd& end, const std::string& file)
{
  // Another try would be another mesh, and nothing is wrong with this one.
  if (was_killed_from_outside(end)) require_ok(end, "coarse");
  if (is_final(end)) require_ok(end, file);
}

bool is_cut(const CoarsePlan& plan) { return plan.planes.num_parts > 0; }

// How a rung has ended, the same on every rank. Nothing goes with it but words and counts.
struct RungOutcome {
  LocalIndex rung = 0;
  jobs::JobEnd end{};
  RepairCounts repairs{};  // In its surface.

  static auto fields(auto& self) { return std::tie(self.rung, self.end, self.repairs); }
};

// The tries at the coarse mesh. Their surfaces are made side by side: the rank that made one keeps
// it until it is known whether it counts.
class CoarseTries {
 public:
  CoarseTries(const config::Case& run_case, std::vector<CoarsePlan> plans, StageScope& stage,
              RunContext& context)
      : file_(run_case.geometry.file.string()),
        plans_(std::move(plans)),
        ladder_(plans_.size(), seconds_now, head_start_s(plans_.front().limits)),
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
      CoarseAttempt made = fill_coarse_surface(plan, take_surface(*rung), stage_, context_);
      if (made.end.status == jobs::JobStatus::ok) {
        ++result_.tries;
        result_.repairs = repairs_of(plan, plans_.front());
        result_.repairs += repairs_[*rung];
        result_.repairs += made.repairs;
        if (made.made) take(std::move(*made.made));
        break;
      }
      all_or_none(context_.comm, [&] { throw_if_hopeless(made.end, file_); });
      ladder_.fill_has_failed(*rung);
      ends_[*rung] = std::move(made.end);
      note_failures();
    }
    return std::move(result_);
  }

  // What was tried, if run() has thrown `error`.
  CoarseResult ended_by(const Error& error)
  {
    ++result_.tries;
    result_.failures.emplace_back(error.what());
    return std::move(result_);
  }

 private:
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
    all_or_none(context_.comm, [&] { throw_if_hopeless(ends_[*front], file_); });
    return front;
  }

  Bytes attempt(LocalIndex rung, const jobs::JobRunner::WaitCallback& on_wait)
  {
    const CoarsePlan& plan = plans_[at(rung)];
    context_.log.debug(fmt::format("coarse: try {} begins: {}", rung + 1, name_of(plan.options)));
    SurfaceTry made = try_coarse_surface(plan, on_wait, context_);
    if (made.end.loads_are_lost) throw_if_hopeless(made.end, file_);
    RungEnd end = RungEnd::failed;
    if (made.surface) end = RungEnd::surface;
    if (is_final(made.end) || was_killed_from_outside(made.end)) end = RungEnd::final;
    // Rank 0 has found Gmsh; this rank's machine may be without.
    const bool was_gmsh_asked = plans_.front().options.mesher == surface::Mesher::gmsh;
    if (plan.options.mesher == surface::Mesher::gmsh && !was_gmsh_asked
        && made.end.error == ErrorKind::config) {
      end = RungEnd::failed;
    }
    if (made.surface) surfaces_[rung] = std::move(*made.surface);
    ended_here_.push_back({rung, std::move(made.end), made.repairs});
    return to_bytes(end);
  }

  // After it all ranks know what rank 0 knows.
  void share_outcomes()
  {
    for (RungOutcome& one : context_.comm.all_gather_rows(ended_here_)) {
      ends_[one.rung] = std::move(one.end);
      repairs_[one.rung] = one.repairs;
    }
    ended_here_.clear();
    ladder_.restore(on_root(context_.comm, [&] { return ladder_.snapshot(); }));
  }

  surface::CoarseSurface take_surface(LocalIndex rung)
  {
    const auto own = surfaces_.find(rung);
    Bytes bytes = own == surfaces_.end() ? Bytes{} : to_bytes(own->second);
    return from_bytes<surface::CoarseSurface>(
        context_.comm.broadcast(std::move(bytes), ladder_.holder(rung)));
  }

  // As if they had been tried in turn.
  void note_failures()
  {
    const std::vector<LocalIndex> failed = ladder_.failed();
    for (std::size_t i = result_.failures.size(); i < failed.size(); ++i) {
      const CoarsePlan& plan = plans_[at(failed[i])];
      const jobs::JobEnd& end = ends_[failed[i]];
      ++result_.tries;
      result_.options = plan.options;
      result_.failures.push_back(fmt::format("{}{}: {}", is_cut(plan) ? "in parts, " : "",
                                             name_of(plan.options), end.message));
      context_.log.warn(
          fmt::format("coarse: try {} failed: {}", result_.tries, result_.failures.back()));
      result_.was_limited = result_.was_limited || depends_on_machine(end);
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
  std::map<LocalIndex, surface::CoarseSurface> surfaces_{};  // Made by this rank.
  std::vector<RungOutcome> ended_here_{};
  std::map<LocalIndex, jobs::JobEnd> ends_{};
  std::map<LocalIndex, RepairCounts> repairs_{};
};

void warn_of_other_ways(const CoarseResult& result, const config::Case& run_case,
                        RunContext& context)
{
  if (result.options.mesher != run_case.coarse.mesher) {
    context.log.warn(
        "coarse: Gmsh has made the mesh, after all other tries had failed; without it, or with "
        "another version of it, this run ends otherwise");
  }
}

}  // namespace

CoarseResult run_coarse_stage(const config::Case& run_case,
                              const std::optional<coarse::ModelFigures>& figures,
                              const cut::CutTree& planes, RunContext& context)
{
  StageScope stage(context, Stage::coarse);
  CoarseResult result =
      CoarseTries(run_case, plans_for(run_case, figures, planes, 0, context), stage, context).run();
  result = on_root_of_nodes(context.comm, [&] {
    if (result.mesh.num_tets() == 0) throw_no_mesh(result, run_case);
    return std::move(result);
  });
  warn_of_other_ways(result, run_case, context);
  stage.work_is_done();
  stage.finish(fmt::format("{} tets, {} patches, {} materials", result.mesh.num_tets(),
                           result.mesh.num_patches(), mesh::body_names(result.mesh).size()));
  return result;
}

CoarseResult run_second_coarse_stage(const config::Case& run_case,
                                     const std::optional<coarse::ModelFigures>& figures,
                                     const CoarseResult& before, const cut::CutTree& planes,
                                     RunContext& context)
{
  StageScope stage(context, Stage::coarse);
  CoarseTries tries(run_case, plans_for(run_case, figures, planes, before.tries, context), stage,
                    context);
  CoarseResult result;
  try {
    result = tries.run();
  } catch (const GeometryError& error) {  // On all ranks; of the model at these sizes only.
    result = tries.ended_by(error);
  }
  result = on_root_of_nodes(context.comm, [&] { return std::move(result); });
  if (result.mesh.num_tets() > 0) warn_of_other_ways(result, run_case, context);
  stage.work_is_done();
  stage.finish(result.mesh.num_tets() == 0 ? std::string("failed")
                                           : fmt::format("{} tets", result.mesh.num_tets()));
  return result;
}

}  // namespace tessera::pipeline
