// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "tessera/surface/defeature.hpp"

#include "surface/crossings.hpp"
#include "surface/editable_surface.hpp"

namespace tessera::surface {

/// @brief Over its longest side; 0 if it has none.
[[nodiscard]] inline double height_of(const std::array<Vec3, 3>& p)
{
  const double longest = longest_side(p);
  return longest > 0.0 ? norm(normal_of(p)) / longest : 0.0;
}

/// @brief From the line of an edge to a point, across.
[[nodiscard]] inline Vec3 wing(const Vec3& a, const Vec3& b, const Vec3& point)
{
  const Vec3 along = b - a;
  return (point - a) - (dot(point - a, along) / dot(along, along)) * along;
}

/// @brief A vertex that went into another one, or into an edge: then both are the same.
struct Merge {
  LocalIndex gone = kNoIndex;
  LocalIndex kept = kNoIndex;
  LocalIndex curve_end = kNoIndex;  ///< Of that edge: an end that is on the edge's curve.
};

/// @brief Merges what is small in a surface, step by step: see defeature(). Local.
class Defeaturer {
 public:
  /// @param[in] start  It, `on_curve` and `limits` must outlive this.
  Defeaturer(const PatchSurface& start, const OnCurve& on_curve, const MergeLimits& limits);

  void run();

  [[nodiscard]] const EditableSurface& surface() const { return surface_; }
  [[nodiscard]] const std::vector<Merge>& merges() const { return merges_; }  ///< In their order.
  /// @brief Vertices into which others went.
  [[nodiscard]] std::vector<Vec3> places() const;

 private:
  using Edge = EditableSurface::Edge;
  using Triangle = EditableSurface::Triangle;
  using Triangles = std::vector<LocalIndex>;
  using Wings = std::map<Edge, std::vector<Vec3>>;

  // The triangles of a step: those that it takes away, and those that it makes of them.
  struct Step {
    LocalIndex at = kNoIndex;  // Where it brings some together: the vertex that stays.
    Triangles old{};
    std::vector<PlacedTriangle> made{};
    Triangles from{};  // The triangle that each of `made` was.
  };

  // A vertex that lies on the curve of the edge that is opposite to it.
  struct Cap {
    double distance = 0.0;
    Edge edge{};
    LocalIndex v = kNoIndex;
  };

  int collapse_short_edges();
  [[nodiscard]] bool may_vanish(LocalIndex t, const Edge& edge) const;
  [[nodiscard]] Edge gone_and_kept(const Edge& edge) const;
  bool collapse(LocalIndex gone, LocalIndex kept);

  int put_into_edges();
  [[nodiscard]] std::vector<Cap> find_caps() const;
  bool put_into_edge(const Cap& cap);
  [[nodiscard]] bool moves_onto(LocalIndex v, LocalIndex curve) const;
  [[nodiscard]] bool is_between(const Edge& edge, const Vec3& point) const;
  [[nodiscard]] bool is_tied(const Edge& edge, LocalIndex cap) const;
  [[nodiscard]] Step step_into(const Edge& edge, LocalIndex cap, const Vec3& point) const;
  void split(const Edge& edge, LocalIndex v, const Vec3& point);

  int shorten_diagonals();
  bool shorten(const Edge& edge);

  [[nodiscard]] double small_at(LocalIndex v) const;
  [[nodiscard]] double length(const Edge& edge) const;
  [[nodiscard]] LocalIndex opposite(LocalIndex t, const Edge& edge) const;
  [[nodiscard]] bool is_thin(LocalIndex t) const;
  void add(const Triangle& v, LocalIndex from, Step& step) const;
  [[nodiscard]] bool may_go(LocalIndex v, const Vec3& point) const;
  void note(const Merge& merge);

  [[nodiscard]] Triangles in_domain(std::span<const LocalIndex> triangles, LocalIndex domain) const;
  [[nodiscard]] std::vector<LocalIndex> link_of(LocalIndex v, const Triangles& triangles) const;
  [[nodiscard]] bool keeps_domains_closed(LocalIndex gone, LocalIndex kept) const;
  [[nodiscard]] bool keeps_closed(LocalIndex domain, LocalIndex gone, LocalIndex kept) const;
  [[nodiscard]] bool makes_twins(LocalIndex gone, LocalIndex kept, const Triangles& of_gone) const;

  [[nodiscard]] bool is_sound(const Step& step);
  [[nodiscard]] bool lays_sheets_together(const Step& step) const;
  [[nodiscard]] bool folds(const Step& step) const;
  [[nodiscard]] bool has_fold(std::span<const PlacedTriangle> some, const Triangles& old) const;
  void add_wings_beside(const Triangles& old, Wings& wings) const;
  void update_guard(const Triangles& triangles);

  const PatchSurface& start_;
  const OnCurve& on_curve_;
  double tolerance_;
  const KeptParts& kept_;
  EditableSurface surface_;
  CrossingGuard guard_;
  std::vector<Merge> merges_{};
  std::map<LocalIndex, std::vector<Vec3>> origins_{};  // Of vertices into which others went.
};

}  // namespace tessera::surface
