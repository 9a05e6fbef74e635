// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/triangle.hpp"
#include "tessera/surface/patch_surface.hpp"

#include "surface/short_list.hpp"

namespace tessera::surface {

/// @brief Where a vertex may go, from most to least.
enum class Freedom : char { patch, curve, none };

[[nodiscard]] inline bool holds(const PatchSurface::Triangle& triangle, LocalIndex v)
{
  return std::ranges::find(triangle, v) != triangle.end();
}

[[nodiscard]] inline PatchSurface::Triangle replaced(PatchSurface::Triangle triangle,
                                                     LocalIndex old, LocalIndex by)
{
  std::ranges::replace(triangle, old, by);
  return triangle;
}

/// @brief Among the few edges from row `first` on, which ascend. Most edges come twice.
inline void insert_if_new(const PatchSurface::Edge& edge, std::size_t first,
                          std::vector<PatchSurface::Edge>& edges)
{
  std::size_t row = edges.size();
  while (row > first && edges[row - 1][1] > edge[1]) --row;
  if (row > first && edges[row - 1][1] == edge[1]) return;
  edges.insert(edges.begin() + static_cast<std::ptrdiff_t>(row), edge);
}

/// @brief For a few values, among which most come twice.
inline void add_if_new(LocalIndex value, std::vector<LocalIndex>& values)
{
  if (std::ranges::find(values, value) == values.end()) values.push_back(value);
}

/// @brief The four triangles that refinement makes of one, the one in the middle last.
/// @param m New vertices; m[i] is that of the side from p[i] to the next corner.
[[nodiscard]] inline std::array<std::array<Vec3, 3>, 4> children_of(const std::array<Vec3, 3>& p,
                                                                    const std::array<Vec3, 3>& m)
{
  return {{{p[0], m[0], m[2]}, {m[0], p[1], m[1]}, {m[2], m[1], p[2]}, m}};
}

/// @brief The corner that is not on the edge.
[[nodiscard]] inline LocalIndex opposite(const PatchSurface::Triangle& triangle,
                                         const PatchSurface::Edge& edge)
{
  return *std::ranges::find_if(triangle,
                               [&](LocalIndex v) { return v != edge[0] && v != edge[1]; });
}

/// @brief A PatchSurface that can be changed, one edge at a time: its topology, and no judgement of
/// shapes. Numbers of vertices and triangles stay; what was removed leaves a gap.
class EditableSurface {
 public:
  using Edge = PatchSurface::Edge;
  using Triangle = PatchSurface::Triangle;

  /// @param[in] sizes  Wanted edge length at each vertex.
  EditableSurface(const PatchSurface& surface, std::vector<double> sizes);

  /// @brief Those between vertices that `counts` says yes to, ascending.
  template <class Counts>
  [[nodiscard]] std::vector<Edge> edges(const Counts& counts) const;
  [[nodiscard]] std::vector<Edge> edges() const  ///< Ascending.
  {
    return edges([](LocalIndex /*v*/) { return true; });
  }
  [[nodiscard]] LocalIndex num_vertices() const { return static_cast<LocalIndex>(xyz_.size()); }
  [[nodiscard]] bool is_vertex(LocalIndex v) const { return !around_[at(v)].is_empty(); }
  [[nodiscard]] const Vec3& xyz(LocalIndex v) const { return xyz_[at(v)]; }
  [[nodiscard]] double size(LocalIndex v) const { return sizes_[at(v)]; }
  [[nodiscard]] Freedom freedom(LocalIndex v) const { return freedom_[at(v)]; }
  [[nodiscard]] const Triangle& triangle(LocalIndex t) const { return triangles_[at(t)]; }
  [[nodiscard]] LocalIndex patch(LocalIndex t) const { return patch_[at(t)]; }
  /// @brief With those that were removed.
  [[nodiscard]] LocalIndex num_triangles() const
  {
    return static_cast<LocalIndex>(triangles_.size());
  }
  [[nodiscard]] bool is_triangle(LocalIndex t) const { return triangles_[at(t)][0] != kNoIndex; }
  [[nodiscard]] std::array<Vec3, 3> corners(LocalIndex t) const
  {
    const Triangle& v = triangles_[at(t)];
    return {xyz(v[0]), xyz(v[1]), xyz(v[2])};
  }
  /// @brief Its corners, beginning with `first`.
  [[nodiscard]] std::array<Vec3, 3> corners_from(LocalIndex t, LocalIndex first) const;
  /// @brief In the order in which they came to it.
  [[nodiscard]] std::span<const LocalIndex> triangles_of(LocalIndex v) const
  {
    return around_[at(v)].values();
  }
  /// @brief The same; they stay what they are when the surface changes.
  [[nodiscard]] std::vector<LocalIndex> copied_triangles_of(LocalIndex v) const
  {
    return {triangles_of(v).begin(), triangles_of(v).end()};
  }
  [[nodiscard]] std::vector<LocalIndex> triangles_at(const Edge& edge) const;
  [[nodiscard]] std::vector<LocalIndex> neighbours(LocalIndex v) const;  ///< Ascending.
  [[nodiscard]] bool has_edge(LocalIndex a, LocalIndex b) const;
  /// @brief Curve of an edge, kNoIndex if it is on none.
  [[nodiscard]] LocalIndex curve(LocalIndex a, LocalIndex b) const;
  /// @brief Edges on curves, ascending, each with its curve.
  [[nodiscard]] std::vector<std::pair<Edge, LocalIndex>> curves() const;
  /// @brief The ends of the curve edges at a vertex, ascending: before and after one that lies
  /// within a curve.
  [[nodiscard]] std::vector<LocalIndex> curve_neighbours(LocalIndex v) const;

  /// @brief The mean of the neighbours of a vertex, for one on a curve of those along it.
  [[nodiscard]] Vec3 middle_of_neighbours(LocalIndex v) const;

  void set_size(LocalIndex v, double size) { sizes_[at(v)] = size; }
  void move(LocalIndex v, const Vec3& xyz) { xyz_[at(v)] = xyz; }
  /// @brief The vertex stays where it is from now on.
  void fix(LocalIndex v) { freedom_[at(v)] = Freedom::none; }

  /// @brief Puts a vertex at `xyz` into an edge; returns it.
  LocalIndex split(const Edge& edge, const Vec3& xyz);

  /// @brief Whether `gone` may be joined with `kept` without tearing or pinching the surface.
  [[nodiscard]] bool can_collapse(LocalIndex gone, LocalIndex kept) const;
  /// @brief Joins them. Of two edges that become one, each on a curve, the lower curve counts.
  /// @pre can_collapse(gone, kept), or another proof that nothing is torn.
  void collapse(LocalIndex gone, LocalIndex kept);

  /// @brief What takes the place of two triangles when the edge between them is flipped.
  struct Flip {
    std::array<LocalIndex, 2> triangles{};  ///< In the order of triangles_at().
    std::array<Triangle, 2> made{};
  };
  /// @brief The flip of an edge on no curve; nothing if the other diagonal exists already.
  [[nodiscard]] std::optional<Flip> flipped(const Edge& edge) const;
  /// @pre The surface has not changed since flipped().
  void flip(const Flip& flip);

  /// @brief What there is now, without gaps; the materials are the given surface's.
  [[nodiscard]] PatchSurface take(const PatchSurface& given) const;

 private:
  // Half of an edge on a curve.
  struct CurveEnd {
    LocalIndex vertex = kNoIndex;  // Where it ends.
    LocalIndex curve = kNoIndex;
    auto operator<=>(const CurveEnd&) const = default;
  };

  void detach(LocalIndex t, LocalIndex v);
  void replace(LocalIndex t, LocalIndex old, LocalIndex by);
  void put_on_curve(LocalIndex a, LocalIndex b, LocalIndex curve);
  void take_off_curve(LocalIndex a, LocalIndex b);

  std::vector<Vec3> xyz_;
  std::vector<double> sizes_;
  std::vector<Freedom> freedom_{};
  std::vector<Triangle> triangles_;  // Corner 0 of a removed one is kNoIndex.
  std::vector<LocalIndex> patch_;
  std::vector<ShortList> around_{};                // Triangles of each vertex.
  std::vector<std::vector<CurveEnd>> curve_ends_;  // At each vertex, ascending.
};

template <class Counts>
std::vector<EditableSurface::Edge> EditableSurface::edges(const Counts& counts) const
{
  std::vector<Edge> all;
  for (LocalIndex a = 0; a < num_vertices(); ++a) {
    if (!is_vertex(a) || !counts(a)) continue;
    const std::size_t first = all.size();
    for (const LocalIndex t : triangles_of(a)) {
      for (const LocalIndex b : triangles_[at(t)]) {
        if (b > a && counts(b)) insert_if_new({a, b}, first, all);
      }
    }
  }
  return all;
}

}  // namespace tessera::surface
