// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tessera/base/given_up.hpp"
#include "tessera/surface/reference.hpp"
#include "tessera/surface/size_function.hpp"

#include "surface/crossings.hpp"
#include "surface/editable_surface.hpp"

namespace tessera::surface {

/// Of angle_shape(): the smallest angle is 18 degrees.
inline constexpr double kFairShape = 0.35;

/// A step that is to make a shape better does so by this at least, against steps back and forth.
inline constexpr double kGain = 1e-3;

/// A number of changes: before the first.
inline constexpr int kNever = -1;

/// @brief A surface that follows a reference while it is edited: the steps that change it, each of
/// which is taken only if no triangle turns over, cuts another one, or gets a worse shape than the
/// caller allows. Local.
class SurfaceEditor {
 public:
  using Edge = PatchSurface::Edge;
  using Triangle = PatchSurface::Triangle;

  /// @param[in] sizes  Wanted edge lengths; must live on.
  /// @param[in] model  If given, vertices on curves lie on its curves, not on the reference's:
  /// there the chords of the reference may be off by more than a strip beside them is wide.
  /// @param[in] guarded  Where no step may make triangles cut others. Elsewhere they are quicker,
  /// and most of all without any such place.
  SurfaceEditor(const SurfaceReference& reference, const PatchSurface& start,
                const SizeFunction& sizes, const model::Model* model, std::vector<Box> guarded);

  [[nodiscard]] const EditableSurface& surface() const { return surface_; }
  [[nodiscard]] const SurfaceReference& reference() const { return reference_; }
  /// @brief The wanted length at any place.
  [[nodiscard]] double size_at(const Vec3& place) const { return sizes_(place); }

  /// @brief Begins a pass; returns its number. What changes from now on has changed in it.
  int begin_pass() { return ++pass_; }
  /// @brief Whether a triangle around the vertex changed in this pass or later.
  [[nodiscard]] bool has_changed(LocalIndex v, int pass) const { return changed_[at(v)] >= pass; }
  /// @brief Nothing counts as changed at the vertex until something changes there.
  void settle(LocalIndex v) { changed_[at(v)] = kNever; }
  /// @brief How many changes there have been.
  [[nodiscard]] int num_changes() const { return num_changes_; }
  /// @brief Whether a step at the vertex would come to what it came to when there had been so many
  /// changes: those since then were elsewhere. Where steps are guarded, it is unknown.
  [[nodiscard]] bool is_as_it_was(LocalIndex v, int num_changes) const
  {
    return touched_[at(v)] <= num_changes && !is_guarded(v);
  }
  /// @brief Edges both of whose ends have changed in this pass or later, ascending.
  [[nodiscard]] std::vector<Edge> changed_edges(int pass) const;

  /// @brief Length over the wanted one.
  [[nodiscard]] double relative_length(const Edge& edge) const;
  /// @brief angle_shape() of a triangle; below 0 if it does not look the reference's way.
  [[nodiscard]] double shape(LocalIndex t);
  [[nodiscard]] double worst_shape(std::span<const LocalIndex> triangles);

  /// @brief The part of a vector that does not lead off the patch or curve of a vertex.
  [[nodiscard]] Vec3 along(LocalIndex v, const Vec3& vector);

  /// @brief What a step around a vertex that is not meant to make shapes better may leave: a fair
  /// shape, or the worst one there if that is not fair.
  [[nodiscard]] double fair_shape(LocalIndex v);

  /// @brief Flips an edge if the worse of its triangles gets better.
  bool flip_if_better(const Edge& edge);
  /// @brief Flips an edge if both triangles are better than `least` then.
  bool flip(const Edge& edge, double least);

  /// @brief Puts a vertex into an edge, at this part of it; returns the vertex. Where that would
  /// lie beyond another sheet, it stays on the chord, where it changes nothing.
  LocalIndex split(const Edge& edge, double part = 0.5);

  /// @brief Joins `gone` with `kept` if all triangles that change are better than `least` then, and
  /// no edge becomes much too long.
  bool collapse(LocalIndex gone, LocalIndex kept, double least);

  /// @brief Moves a vertex that is not fixed, if all triangles around are better than `least` then.
  /// It goes to the place on its patch or curve that is nearest to `wanted`; in a flat patch, to
  /// `wanted` itself.
  bool move(LocalIndex v, const Vec3& wanted, double least);

  /// @brief Moves a vertex to a place on its patch or curve, whatever comes of it.
  void put_at(LocalIndex v, const Vec3& place);

  /// @brief The vertex stays where it is from now on.
  void fix(LocalIndex v) { surface_.fix(v); }

  /// @brief What there is now.
  [[nodiscard]] PatchSurface take() const { return surface_.take(reference_.surface()); }

 private:
  using Candidates = std::vector<PlacedTriangle>;  // What a step would make.

  struct PlacedNormal {
    Vec3 place = kNoPoint;
    Vec3 normal{};
  };

  // What is known of the normal at a vertex. The one that came with a place counts until another
  // place is asked for. Between two triangles of the reference it may not be the one that is asked
  // for there.
  struct KnownNormal {
    LocalIndex patch = kNoIndex;
    PlacedNormal asked{};
    PlacedNormal came{};
    bool came_last = false;

    [[nodiscard]] bool came_at(const Vec3& place) const { return came_last && came.place == place; }
  };

  [[nodiscard]] bool is_guarded(LocalIndex v) const;
  [[nodiscard]] PlacedTriangle placed(const Triangle& v, LocalIndex patch) const;
  [[nodiscard]] Candidates ring_of(LocalIndex v) const;
  [[nodiscard]] bool all_better(std::span<const PlacedTriangle> candidates, double least);
  bool flip(const EditableSurface::Flip& flip, double least);
  [[nodiscard]] bool cuts_nothing(std::span<const LocalIndex> old,
                                  std::span<const PlacedTriangle> made, bool is_inside);
  void guard_changed(std::span<const LocalIndex> made, LocalIndex beside);
  [[nodiscard]] bool is_upright(const PlacedTriangle& one);
  [[nodiscard]] const Vec3& normal_at(LocalIndex v, LocalIndex patch, const Vec3& place);
  [[nodiscard]] KnownNormal& known_normal(LocalIndex v, LocalIndex patch);
  [[nodiscard]] Vec3 place_for(LocalIndex v, const Vec3& wanted);
  [[nodiscard]] Vec3 on_reference(const Edge& edge, const Vec3& point) const;
  [[nodiscard]] Vec3 on_curve(LocalIndex curve, const Vec3& point, double size) const;
  [[nodiscard]] std::vector<PlacedTriangle> halves(std::span<const LocalIndex> triangles,
                                                   const Edge& edge, const Vec3& middle) const;
  [[nodiscard]] double off_curve(LocalIndex curve, const Vec3& point) const;
  [[nodiscard]] double bow(LocalIndex curve, const Vec3& a, const Vec3& b) const;
  [[nodiscard]] bool keeps_curve(LocalIndex gone, LocalIndex kept) const;
  [[nodiscard]] bool keeps_curve(LocalIndex v, const Vec3& before, const Vec3& after) const;
  [[nodiscard]] bool keeps_lengths(LocalIndex gone, LocalIndex kept) const;
  void note_change(std::span<const LocalIndex> triangles);
  void touch(std::span<const LocalIndex> triangles);
  void put(LocalIndex t, const PlacedTriangle& one);

  const SurfaceReference& reference_;
  EditableSurface surface_;
  const SizeFunction& sizes_;
  const model::Model* model_;
  mutable Attempts projections_{"places on curves of the model"};
  std::optional<CrossingGuard> guard_{};
  int pass_ = 0;
  std::vector<int> changed_;  // Of each vertex: the last pass with a change there.
  int num_changes_ = 0;
  std::vector<int> touched_;      // Of each vertex: the last change of what steps there ask for.
  std::vector<double> shapes_{};  // Of the triangles.
  std::vector<std::vector<KnownNormal>> normals_;  // Of each vertex, one a patch there.
};

}  // namespace tessera::surface
