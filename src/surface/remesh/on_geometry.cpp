// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/surface/on_geometry.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/given_up.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/surface/overlap.hpp"

#include "surface/crossings.hpp"
#include "surface/editable_surface.hpp"
#include "surface/model_curve.hpp"
#include "surface/remesh/patch_folds.hpp"
#include "surface/remesh/periodic_rims.hpp"
#include "surface/remesh/remesh.hpp"

namespace tessera::surface {
namespace {

// A triangle whose normal turns by more than this cosine says was folded by the move.
constexpr double kLeastCosine = 0.5;

// In parts of its shortest edge: a vertex that would go farther stays, as its place may be on
// another branch. With 0.5, one vertex of TSM_104_01_L_DV_A.stp and one of SOT404.stp stayed off
// fillets.
constexpr double kMostOfEdge = 0.8;

// Each halves the edges where the surface cuts itself. Faces that lie in each other would be made
// finer and finer all over: they are given up when there are so many times more triangles.
constexpr std::size_t kMostGrowth = 3;
constexpr int kFinerRounds = 5;

// A vertex that another sheet holds back is tried again, as that sheet may have moved away since.
constexpr int kMostPasses = 4;

class Mover {
 public:
  Mover(PatchSurface& surface, const SurfaceReference& reference, const model::Model& model)
      : surface_(surface),
        reference_(reference),
        model_(model),
        guard_(surface),
        around_(surface.vertex_xyz.size()),
        curve_(surface.vertex_xyz.size(), kNoIndex)
  {
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
      for (const LocalIndex v : surface_.triangles[t])
        around_[at(v)].push_back(static_cast<LocalIndex>(t));
    }
    for (std::size_t e = 0; e < surface_.edges.size(); ++e) {
      for (const LocalIndex v : surface_.edges[e]) curve_[at(v)] = surface_.edge_curve[e];
    }
  }

  void run()
  {
    std::vector<std::size_t> left;
    for (std::size_t v = 0; v < around_.size(); ++v) {
      if (surface_.vertex_is_fixed[v] == 0 && !around_[v].empty()) left.push_back(v);
    }
    for (int pass = 0; pass < kMostPasses && !left.empty(); ++pass) {
      std::vector<std::size_t> held_back;
      for (const std::size_t v : left) {
        if (!move(v, target(v))) held_back.push_back(v);
      }
      left = std::move(held_back);
    }
  }

 private:
  [[nodiscard]] Vec3 target(std::size_t v) const
  {
    const Vec3& point = surface_.vertex_xyz[v];
    if (curve_[v] != kNoIndex) return on_model_curve(reference_, model_, curve_[v], point);
    const LocalIndex patch = surface_.triangle_patch[at(around_[v].front())];
    return model_.project_to_surface(patch, point, reference_.parameters(patch, point)).xyz;
  }

  // Whether that is all: false if another sheet is in the way.
  bool move(std::size_t v, const Vec3& target)
  {
    const Vec3 before = surface_.vertex_xyz[v];
    if (target == before) return true;
    double shortest = std::numeric_limits<double>::infinity();
    std::vector<Vec3> normals;
    for (const LocalIndex t : around_[v]) {
      normals.push_back(normal(at(t)));
      for (const Vec3& corner : surface_.corners(at(t))) {
        const double length = norm(corner - before);
        if (length > 0.0) shortest = std::min(shortest, length);
      }
    }
    if (norm(target - before) > kMostOfEdge * shortest) return true;
    surface_.vertex_xyz[v] = target;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Vec3 after = normal(at(around_[v][i]));
      if (dot(after, normals[i]) >= kLeastCosine * norm(after) * norm(normals[i])) continue;
      surface_.vertex_xyz[v] = before;
      return true;
    }
    if (keep(v)) return true;
    surface_.vertex_xyz[v] = before;
    return false;
  }

  // Unless the triangles around the vertex cut others where it is now.
  bool keep(std::size_t v)
  {
    std::vector<PlacedTriangle> made;
    for (const LocalIndex t : around_[v]) {
      made.push_back({surface_.triangles[at(t)], surface_.corners(at(t))});
    }
    if (!guard_.allows(around_[v], made)) return false;
    for (std::size_t i = 0; i < made.size(); ++i) guard_.change(around_[v][i], made[i]);
    return true;
  }

  [[nodiscard]] Vec3 normal(std::size_t t) const { return normal_of(surface_.corners(t)); }

  PatchSurface& surface_;
  const SurfaceReference& reference_;
  const model::Model& model_;
  CrossingGuard guard_;
  std::vector<std::vector<LocalIndex>> around_;  // Triangles of each vertex.
  std::vector<LocalIndex> curve_;                // Of each vertex that lies on one.
};

std::vector<std::size_t> triangles_of(const std::vector<Overlap>& overlaps)
{
  std::vector<std::size_t> triangles;
  for (const Overlap& overlap : overlaps) {
    triangles.push_back(overlap.first);
    triangles.push_back(overlap.second);
  }
  return triangles;
}

// Moving onto the geometry makes no cut, so that one without any is not searched again.
std::vector<Overlap> cuts_of(const Remeshed& one, Forbidden forbidden)
{
  return one.is_without_cuts ? std::vector<Overlap>{} : forbidden_overlaps(one.surface, forbidden);
}

// A surface on the geometry, with shorter edges where it would cut itself or fold.
class Finer {
 public:
  Finer(const SurfaceReference& reference, const model::Model& model, const CoarseOptions& options)
      : reference_(reference),
        model_(model),
        rims_(reference, model, options.periodic),
        sizes_(size_function_of(reference, options)),
        remeshed_(remesh(reference, reference.surface(), sizes_, &model))
  {
    if (!rims_.are_none()) match_sides();
    if (options.defeature > 0.0) merge({options.defeature, options.kept, std::cref(sizes_)});
    put_on_geometry(remeshed_.surface, reference_, model_);
    most_triangles_ = kMostGrowth * remeshed_.surface.triangles.size();
  }

  // Shorter edges at forbidden cuts.
  void mend_cuts(Forbidden forbidden)
  {
    for (int round = 0; round < kFinerRounds && may_grow(); ++round) {
      const std::vector<Overlap> cuts = cuts_of(remeshed_, forbidden);
      if (cuts.empty()) return;
      remeshed_ = finer_at(triangles_of(cuts));
      note_repair(Repair::finer_at_cuts);
    }
  }

  // Shorter edges at cuts that are allowed. Bodies that touch, as a ball and its race, cut each
  // other however short edges are there: that ends when it does not help.
  void lessen_allowed_cuts(Forbidden forbidden)
  {
    if (forbidden == Forbidden::all_cuts || !cuts_of(remeshed_, forbidden).empty()) return;
    std::vector<Overlap> cuts = cuts_of(remeshed_, Forbidden::all_cuts);
    for (int round = 0; round < kFinerRounds && !cuts.empty() && may_grow(); ++round) {
      try {
        Remeshed finer = finer_at(triangles_of(cuts));
        std::vector<Overlap> left = cuts_of(finer, Forbidden::all_cuts);
        if (left.size() >= cuts.size() || !cuts_of(finer, forbidden).empty()) return;
        remeshed_ = std::move(finer);
        cuts = std::move(left);
        note_repair(Repair::finer_at_cuts);
      } catch (const GeometryError& error) {
        return note_given_up("shorter edges where the surface cuts itself", error);
      }
    }
  }

  // Shorter edges where the surface would fold, as long as there are fewer such places then. A
  // projection that fails on the way loses nothing.
  void mend_folds()
  {
    std::vector<std::size_t> folding = folding_triangles(remeshed_.surface, reference_, model_);
    if (folding.empty() || is_left_out(Repair::finer_at_folds)) return;
    std::size_t num_cut = cuts_of(remeshed_, Forbidden::all_cuts).size();
    for (int round = 0; round < kFinerRounds && !folding.empty() && may_grow(); ++round) {
      try {
        Remeshed finer = finer_at(folding);
        std::vector<std::size_t> left = folding_triangles(finer.surface, reference_, model_);
        const std::size_t left_cut = cuts_of(finer, Forbidden::all_cuts).size();
        if (left.size() >= folding.size() || left_cut > num_cut) return;
        remeshed_ = std::move(finer);
        folding = std::move(left);
        note_repair(Repair::finer_at_folds);
        num_cut = left_cut;
      } catch (const GeometryError& error) {
        return note_given_up("shorter edges where the surface would fold", error);
      }
    }
  }

  [[nodiscard]] RemeshedSurface take() &&
  {
    rims_.copy_triangles(remeshed_.surface);
    return {std::move(remeshed_.surface), std::move(defeatured_)};
  }

 private:
  [[nodiscard]] bool may_grow() const
  {
    return remeshed_.surface.triangles.size() <= most_triangles_;
  }

  // That leaves bad triangles beside what is merged.
  void merge(const MergeLimits& limits)
  {
    defeatured_ = defeature(remeshed_.surface, reference_, model_, limits);
    if (defeatured_.is_any()) remeshed_ = remeshed();
  }

  [[nodiscard]] Remeshed remeshed() const
  {
    return remesh(reference_, remeshed_.surface, sizes_, &model_,
                  rims_.are_none() ? nullptr : &rims_);
  }

  // What one side wants, the other one gets as well.
  void match_sides()
  {
    sizes_.limit(rims_.sizes_of_images(remeshed_.surface, sizes_));
    remeshed_ = remeshed();
  }

  // Edges of half their length at some triangles, from now on.
  [[nodiscard]] Remeshed finer_at(const std::vector<std::size_t>& triangles)
  {
    std::vector<SizeSource> sources;
    for (const std::size_t t : triangles) {
      const std::array<Vec3, 3> p = remeshed_.surface.corners(t);
      sources.push_back({p, 0.5 * sizes_(middle_of(p))});
    }
    sizes_.limit(sources);
    Remeshed finer = remeshed();
    put_on_geometry(finer.surface, reference_, model_);
    return finer;
  }

  const SurfaceReference& reference_;
  const model::Model& model_;
  PeriodicRims rims_;
  SizeFunction sizes_;
  Remeshed remeshed_;
  Defeatured defeatured_{};
  std::size_t most_triangles_ = 0;
};

}  // namespace

void put_on_geometry(PatchSurface& surface, const SurfaceReference& reference,
                     const model::Model& model)
{
  Mover(surface, reference, model).run();
}

RemeshedSurface remesh_on_geometry(const SurfaceReference& reference, const model::Model& model,
                                   const CoarseOptions& options, Forbidden forbidden)
{
  Finer surface(reference, model, options);
  if (!is_left_out(Repair::finer_at_cuts)) {
    surface.mend_cuts(forbidden);
    surface.lessen_allowed_cuts(forbidden);
  }
  surface.mend_folds();
  return std::move(surface).take();
}

}  // namespace tessera::surface
