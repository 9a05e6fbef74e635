// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/remesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "tessera/base/repair.hpp"
#include "tessera/base/threads.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/surface/overlap.hpp"

#include "surface/editor.hpp"
#include "surface/remesh/divide_curves.hpp"
#include "surface/remesh/patch_parts.hpp"
#include "surface/remesh/periodic_rims.hpp"
#include "surface/remesh/polish.hpp"
#include "surface/remesh/valence.hpp"
#include "surface/sizes/strip_sizes.hpp"
#include "surface/sizes/surface_sizes.hpp"
#include "surface/sizes/wall_sizes.hpp"

namespace tessera::surface {
namespace {

using Edge = PatchSurface::Edge;

// In parts of the wanted length: longer edges are split, shorter ones collapsed.
constexpr double kTooLong = 1.4;
constexpr double kTooShort = 0.7;

// Where walls are looked for, only what is shorter than this part of kTooShort is collapsed.
// Without a limit chords left a hollow ball of radius 1 by more than its wall of 0.04 was thick.
constexpr double kNeedle = 0.3;

// Curves are divided before, into whole numbers of edges. These are not undone.
constexpr double kTooLongOfCurve = 1.6;
constexpr double kTooShortOfCurve = 0.6;

// On the corpus five rounds give the same figures as three, and take a tenth longer on
// linkrods.step. More sweeps of flips flatten what bends: plate_with_hole.stl then has 3,000 tets,
// not 2,000.
constexpr int kRounds = 3;
constexpr int kLastRounds = 4;
constexpr int kMostSweeps = 30;  // Of one kind within a round; each halves the longest edges.
constexpr int kFlipSweeps = 4;
constexpr int kSmoothSweeps = 3;

// Among triangles better than this (31 degrees), smoothing need not make the worst better.
constexpr double kGoodShape = 0.6;

// A flip for the sake of valences may make a shape worse by this factor, and a fair one no worse
// than fair.
constexpr double kMostLoss = 0.7;

// So much is fair where a vertex goes from a curve: 12.5 degrees. Rings of needles between two
// curves have too many vertices, and the first of them that goes makes a needle longer: part1.stl
// at size 0.332 kept all of them, and its 1st percentile was 14.8 degrees where it is 35.8 now.
constexpr double kFairOnCurve = 0.25;

// The sum of the squares of excess_valence() falls by twice the gain less four.
constexpr double kLeastGainOfValences = 2.5;

// In parts of the wanted length: a vertex so near to its best place stays.
constexpr double kSettled = 0.005;

// The same on a curve, along which edges are equally long already. With 0.1, lever.stl of the
// corpus kept a vertex of a strip where it folds.
constexpr double kSettledOnCurve = 0.05;

// In squares of the wanted length. With 500, Ball.brep of the corpus lost 3 % of its 1st
// percentile. With patches of any size G of the corpus is 1 % larger: small ones lie mostly beside
// curves.
constexpr double kLargePatch = 1000.0;

class Remesher {
 public:
  Remesher(const SurfaceReference& reference, const PatchSurface& start, const SizeFunction& sizes,
           const model::Model* model, std::vector<Box> guarded)
      : editor_(reference, start, sizes, model, std::move(guarded)), surface_(editor_.surface())
  {
  }

  // The surface as it is, but edges of its curves are hardly longer than is wanted.
  const EditableSurface& with_short_curves()
  {
    split_long_edges([this](const Edge& edge) { return is_on_curve(edge); });
    return surface_;
  }

  // The surface as it is, but with edges that are hardly longer than is wanted, and few needles:
  // triangles of the reference may be as large and as narrow as its faces.
  const EditableSurface& with_short_edges()
  {
    collapse_short_edges(kNeedle);
    split_long_edges();
    return surface_;
  }

  void divide_curves_for(const PeriodicRims* rims)
  {
    divide_curves(editor_);
    if (rims != nullptr) rims->match(editor_);
  }

  [[nodiscard]] PatchSurface take() const { return editor_.take(); }

  // The area of each patch in squares of the wanted length.
  [[nodiscard]] std::vector<double> squares_of_patches() const
  {
    std::vector<double> squares(at(editor_.reference().surface().num_patches()));
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      if (!surface_.is_triangle(t)) continue;
      const std::array<Vec3, 3> corners = surface_.corners(t);
      const double size = editor_.size_at(middle_of(corners));
      squares[at(surface_.patch(t))] += triangle_area(corners) / (size * size);
    }
    return squares;
  }

  // Edges of curves stay as they are.
  void keep_curves() { keeps_curves_ = true; }

  // Only what is beside a curve, or in a patch that was not edited, is to be improved.
  void settle(const std::vector<char>& is_edited)
  {
    std::vector<char> is_settled(at(surface_.num_vertices()), 1);
    for (LocalIndex t = 0; t < surface_.num_triangles(); ++t) {
      const PatchSurface::Triangle& v = surface_.triangle(t);
      const bool is_inside = std::ranges::all_of(
          v, [this](LocalIndex corner) { return surface_.freedom(corner) == Freedom::patch; });
      if (is_inside && is_edited[at(surface_.patch(t))] != 0) continue;
      for (const LocalIndex corner : v) is_settled[at(corner)] = 0;
    }
    for (LocalIndex v = 0; v < surface_.num_vertices(); ++v) {
      if (is_settled[at(v)] != 0) editor_.settle(v);
    }
  }

  PatchSurface run()
  {
    for (int round = 0; round < kRounds; ++round) {
      collapse_short_edges();
      flip_edges();
      split_long_edges();
      flip_edges();
      even_out_valences();
      smooth();
    }
    for (int round = 0; round < kLastRounds; ++round) {
      flip_edges();
      smooth();
    }
    flip_edges();
    smooth();
    if (!keeps_curves_) polish_surface(editor_);
    return editor_.take();
  }

 private:
  // Step by step over the edges around which something has changed since the last sweep of this
  // kind, until no more changes.
  template <class Sweep>
  void sweep(int most, int& since, const Sweep& step)
  {
    for (int i = 0; i < most; ++i) {
      const std::vector<Edge> edges = editor_.changed_edges(since);
      since = editor_.begin_pass();
      if (step(edges) == 0) return;
    }
  }

  void flip_edges()
  {
    sweep(kFlipSweeps, flipped_since_, [this](const std::vector<Edge>& edges) {
      return std::ranges::count_if(
          edges, [this](const Edge& edge) { return editor_.flip_if_better(edge); });
    });
  }

  void even_out_valences()
  {
    sweep(kFlipSweeps, evened_since_, [this](const std::vector<Edge>& edges) {
      return std::ranges::count_if(edges, [this](const Edge& edge) { return even_out(edge); });
    });
  }

  // If that brings the numbers of triangles at the vertices there nearer to what fits.
  bool even_out(const Edge& edge)
  {
    const std::vector<LocalIndex> two = surface_.triangles_at(edge);
    if (two.size() != 2 || surface_.curve(edge[0], edge[1]) != kNoIndex) return false;
    const LocalIndex patch = surface_.patch(two[0]);
    const LocalIndex c = opposite(surface_.triangle(two[0]), edge);
    const LocalIndex d = opposite(surface_.triangle(two[1]), edge);
    const auto too_many = [&](LocalIndex v) { return excess_valence(surface_, v, patch); };
    const double gain = too_many(edge[0]) + too_many(edge[1]) - too_many(c) - too_many(d);
    if (gain <= kLeastGainOfValences) return false;
    const double before = std::max(editor_.worst_shape(two), 0.0);
    return editor_.flip(edge, std::min(kMostLoss * before, kFairShape));
  }

  [[nodiscard]] bool is_on_curve(const Edge& edge) const
  {
    return surface_.curve(edge[0], edge[1]) != kNoIndex;
  }

  void split_long_edges()
  {
    split_long_edges([this](const Edge& edge) { return !keeps_curves_ || !is_on_curve(edge); });
  }

  // Longest first. A triangle is split once a sweep: its other edges may be short enough once
  // those around have been flipped.
  template <class MaySplit>
  void split_long_edges(const MaySplit& may_split)
  {
    sweep(kMostSweeps, split_since_, [&](const std::vector<Edge>& edges) {
      std::vector<std::pair<double, Edge>> longest;
      for (const Edge& edge : edges) {
        if (!may_split(edge)) continue;
        const double relative = editor_.relative_length(edge);
        if (relative <= (is_on_curve(edge) ? kTooLongOfCurve : kTooLong)) continue;
        longest.emplace_back(-relative, edge);
      }
      std::ranges::sort(longest);
      const LocalIndex first_new = surface_.num_vertices();
      for (const auto& [relative, edge] : longest) {
        const bool is_first = std::ranges::all_of(surface_.triangles_at(edge), [&](LocalIndex t) {
          return std::ranges::max(surface_.triangle(t)) < first_new;
        });
        if (is_first) editor_.split(edge);
      }
      if (!longest.empty()) flip_edges();
      return longest.size();
    });
  }

  // @param[in] part  Of what is too short; longer edges stay.
  void collapse_short_edges(double part = 1.0)
  {
    sweep(kMostSweeps, collapsed_since_, [this, part](const std::vector<Edge>& edges) {
      std::vector<std::pair<double, Edge>> shortest;
      for (const Edge& edge : edges) {
        const double relative = editor_.relative_length(edge);
        if (relative >= part * (is_on_curve(edge) ? kTooShortOfCurve : kTooShort)) continue;
        shortest.emplace_back(relative, edge);
      }
      std::ranges::sort(shortest);
      return std::ranges::count_if(shortest, [this](const auto& one) {
        const auto [a, b] = one.second;
        if (!surface_.is_vertex(a) || !surface_.is_vertex(b) || !surface_.has_edge(a, b))
          return false;
        return collapse(a, b) || collapse(b, a);
      });
    });
  }

  bool collapse(LocalIndex gone, LocalIndex kept)
  {
    const double fair = surface_.freedom(gone) == Freedom::curve ? kFairOnCurve : kFairShape;
    return editor_.collapse(gone, kept, std::min(editor_.fair_shape(gone), fair));
  }

  void smooth()
  {
    for (int i = 0; i < kSmoothSweeps; ++i) {
      const int before = std::exchange(smoothed_since_, editor_.begin_pass());
      for (LocalIndex v = 0; v < surface_.num_vertices(); ++v) {
        if (surface_.is_vertex(v) && editor_.has_changed(v, before)) smooth(v);
      }
    }
  }

  // A vertex that did not move does not move now if nothing has changed around it.
  void smooth(LocalIndex v)
  {
    stayed_at_.resize(at(surface_.num_vertices()), kNever);
    if (surface_.freedom(v) == Freedom::none || editor_.is_as_it_was(v, stayed_at_[at(v)])) return;
    const int now = editor_.num_changes();
    if (!move_to_middle(v)) stayed_at_[at(v)] = now;
  }

  bool move_to_middle(LocalIndex v)
  {
    const Freedom freedom = surface_.freedom(v);
    const Vec3 before = surface_.xyz(v);
    const Vec3 step = editor_.along(v, surface_.middle_of_neighbours(v) - before);
    const double settled = freedom == Freedom::curve ? kSettledOnCurve : kSettled;
    if (norm(step) < settled * surface_.size(v)) return false;
    const double least = std::clamp(editor_.worst_shape(surface_.triangles_of(v)), 0.0, kGoodShape);
    for (const double part : {1.0, 0.5, 0.25}) {
      if (editor_.move(v, before + part * step, least)) return true;
    }
    return false;
  }

  SurfaceEditor editor_;
  const EditableSurface& surface_;
  bool keeps_curves_ = false;
  // The last sweep of each kind.
  int flipped_since_ = 0;
  int evened_since_ = 0;
  int split_since_ = 0;
  int collapsed_since_ = 0;
  int smoothed_since_ = 0;
  std::vector<int> stayed_at_{};  // Of each vertex: number of changes when it did not move.
};

// Normals of the model tell its curvature better than those of triangles, which may be needles.
CoarseOptions for_bends_of_triangles(const PatchSurface& surface, CoarseOptions options)
{
  constexpr double kNoCurvature = std::numeric_limits<double>::min();
  if (!surface.triangle_max_size.empty()) options.curvature = kNoCurvature;
  return options;
}

std::vector<SizeSource> sizes_of_model(const PatchSurface& surface)
{
  std::vector<SizeSource> sources;
  for (std::size_t t = 0; t < surface.triangle_max_size.size(); ++t) {
    sources.push_back({surface.corners(t), surface.triangle_max_size[t]});
  }
  return sources;
}

// Where steps can have made these cuts.
std::vector<Box> around(const std::vector<Overlap>& cuts, const PatchSurface& surface)
{
  std::vector<Box> boxes;
  for (const Overlap& cut : cuts) {
    Box box = box_of(surface.corners(cut.first));
    box.include(box_of(surface.corners(cut.second)));
    boxes.push_back(box.widened(box.diagonal()));
  }
  return boxes;
}

// Parts that are edited by themselves, the heaviest first.
std::vector<std::size_t> large_ones_of(const std::vector<PatchPart>& parts,
                                       const std::vector<double>& squares_of_patches)
{
  std::vector<std::pair<double, std::size_t>> large;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double squares = squares_of_patches[at(parts[i].surface.triangle_patch.front())];
    if (squares >= kLargePatch) large.emplace_back(-squares, i);
  }
  std::ranges::sort(large);
  std::vector<std::size_t> numbers;
  for (const auto& [squares, i] : large) numbers.push_back(i);
  return numbers;
}

// Each of these parts by itself; nothing for the others.
std::vector<std::optional<PatchSurface>> edited_alone(const SurfaceReference& reference,
                                                      const std::vector<PatchPart>& parts,
                                                      const std::vector<std::size_t>& large,
                                                      const SizeFunction& sizes)
{
  std::vector<std::optional<PatchSurface>> edited(parts.size());
  for_each_in_threads(large.size(), [&](std::size_t i) {
    Remesher remesher(reference, parts[large[i]].surface, sizes, nullptr, {});
    remesher.keep_curves();
    edited[large[i]] = remesher.run();
  });
  return edited;
}

// Large patches first by themselves, then all along their curves.
PatchSurface remesh_unguarded(const SurfaceReference& reference, const PatchSurface& start,
                              const SizeFunction& sizes, const model::Model* model,
                              const PeriodicRims* rims)
{
  Remesher remesher(reference, start, sizes, model, {});
  remesher.divide_curves_for(rims);
  const std::vector<double> squares = remesher.squares_of_patches();
  if (std::ranges::none_of(squares, [](double of_patch) { return of_patch >= kLargePatch; })) {
    return remesher.run();
  }
  const PatchSurface divided = remesher.take();
  const std::vector<PatchPart> parts = patch_parts_of(divided);
  const std::vector<std::size_t> large = large_ones_of(parts, squares);
  const auto [surface, is_edited] =
      join_patches(divided, parts, edited_alone(reference, parts, large, sizes));
  Remesher beside(reference, surface, sizes, model, {});
  beside.settle(is_edited);
  return beside.run();
}

}  // namespace

SizeFunction size_function_of(const SurfaceReference& reference, const CoarseOptions& options)
{
  const PatchSurface& start = reference.surface();
  SizeFunction sizes(options);
  sizes.limit(bent_places_of(start, for_bends_of_triangles(start, options)));
  Remesher with_strips(reference, start, sizes, nullptr, {});
  std::vector<SizeSource> sources = narrow_strips_of(with_strips.with_short_curves(), options);
  if (!is_left_out(Repair::wall_sizes)) {
    Remesher with_walls(reference, start, sizes, nullptr, {});
    const auto walls =
        thin_walls_of(with_walls.with_short_edges(), start.patch_materials, options.max_size);
    sources.insert(sources.end(), walls.begin(), walls.end());
  }
  const std::vector<SizeSource> of_model = sizes_of_model(start);
  sources.insert(sources.end(), of_model.begin(), of_model.end());
  sizes.limit(sources);
  return sizes;
}

Remeshed remesh(const SurfaceReference& reference, const PatchSurface& start,
                const SizeFunction& sizes, const model::Model* model, const PeriodicRims* rims)
{
  const auto guarded_at = [&](const std::vector<Box>& places) {
    Remesher remesher(reference, start, sizes, model, places);
    remesher.divide_curves_for(rims);
    return remesher.run();
  };
  PatchSurface surface = remesh_unguarded(reference, start, sizes, model, rims);
  const std::vector<Overlap> cuts = find_overlaps(surface);
  if (cuts.empty()) return {std::move(surface), true};
  const std::vector<Box> places = around(cuts, surface);
  surface = guarded_at(places);
  const std::vector<Overlap> left = find_overlaps(surface);
  if (left.empty()) return {std::move(surface), true};
  const bool are_guarded = std::ranges::all_of(left, [&](const Overlap& cut) {
    return std::ranges::any_of(places, [&](const Box& box) { return box.holds(cut.place); });
  });
  if (are_guarded) return {std::move(surface), false};
  return {guarded_at({kEverywhere}), false};
}

PatchSurface remesh(const SurfaceReference& reference, const CoarseOptions& options)
{
  const PatchSurface& start = reference.surface();
  return remesh(reference, start, size_function_of(reference, options)).surface;
}

}  // namespace tessera::surface
