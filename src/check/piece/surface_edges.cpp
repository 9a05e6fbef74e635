// SPDX-License-Identifier: BSD-3-Clause
#include "check/piece/surface_edges.hpp"

#include <algorithm>
#include <compare>

#include "tessera/base/union_find.hpp"

namespace tessera::check {
namespace {

// One corner of a surface triangle seen as the edge opposite to it.
struct TriangleEdge {
  LocalIndex lower = 0;
  LocalIndex upper = 0;
  LocalIndex triangle = 0;
  LocalIndex corner = 0;

  friend auto operator<=>(const TriangleEdge&, const TriangleEdge&) = default;
};

std::vector<TriangleEdge> sorted_open_edges(const PieceSurface& surface)
{
  std::vector<TriangleEdge> edges;
  edges.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& v = surface.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      if ((static_cast<unsigned>(surface.closed_edges[t]) >> i & 1U) != 0) continue;
      const auto [lower, upper] = std::minmax(v[(i + 1) % 3], v[(i + 2) % 3]);
      edges.push_back({lower, upper, static_cast<LocalIndex>(t), static_cast<LocalIndex>(i)});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Calls back with the triangles at each edge.
template <class Visit>
void for_each_edge(std::span<const TriangleEdge> edges, const Visit& visit)
{
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].lower == edges[begin].lower
           && edges[end].upper == edges[begin].upper)
      ++end;
    visit(edges.subspan(begin, end - begin));
  }
}

// The triangles at one edge of a surface.
class EdgeFan {
 public:
  EdgeFan(PieceSurface& surface, std::span<const TriangleEdge> triangles)
      : surface_(surface), triangles_(triangles)
  {
  }

  [[nodiscard]] bool is_known() const
  {
    return std::all_of(triangles_.begin(), triangles_.end(), [&](const TriangleEdge& edge) {
      return role(edge) != TriangleRole::unknown;
    });
  }

  // Whether another piece has the two triangles, and they are all.
  [[nodiscard]] bool is_half() const
  {
    return triangles_.size() == 2 && has_partner(triangles_[0]) && has_partner(triangles_[1])
           && partner(triangles_[0]) == partner(triangles_[1]);
  }

  void close()
  {
    for (const TriangleEdge& edge : triangles_)
      surface_.closed_edges[static_cast<std::size_t>(edge.triangle)] |=
          static_cast<std::uint8_t>(1U << static_cast<unsigned>(edge.corner));
  }

  // One record for each triangle, or for all if nothing depends on how many there are.
  // `flags` of vertices may be empty if no triangle is open.
  void append_records(std::span<const LocalIndex> boundary_component,
                      std::span<const VertexFlags> flags, std::vector<EdgeRecord>& records) const
  {
    const bool is_inner =
        std::none_of(triangles_.begin(), triangles_.end(),
                     [&](const TriangleEdge& edge) { return is_open(role(edge)); });
    const auto counted = is_inner && triangles_.size() <= 2 ? triangles_.first(1) : triangles_;
    for (const TriangleEdge& edge : counted) {
      EdgeRecord& record = records.emplace_back(record_of(edge));
      record.twin = triangles_.size() > 2 ? twin_of(edge) : kNoPiece;
      if (!is_open(role(edge))) continue;
      record.inward = inward_of(edge);
      record.is_on_split =
          !flags.empty() && flags[static_cast<std::size_t>(apex_of(edge))].is_on_split;
      record.boundary_component = boundary_component[static_cast<std::size_t>(edge.triangle)];
      record.is_on_boundary = true;
    }
  }

  [[nodiscard]] bool has_end_that_is_not_shared(std::span<const VertexFlags> flags) const
  {
    return !flags[static_cast<std::size_t>(triangles_[0].lower)].is_shared
           || !flags[static_cast<std::size_t>(triangles_[0].upper)].is_shared;
  }

 private:
  [[nodiscard]] TriangleRole role(const TriangleEdge& edge) const
  {
    return surface_.roles[static_cast<std::size_t>(edge.triangle)];
  }
  [[nodiscard]] LocalIndex partner(const TriangleEdge& edge) const
  {
    return surface_.partners[static_cast<std::size_t>(edge.triangle)];
  }
  [[nodiscard]] bool has_partner(const TriangleEdge& edge) const
  {
    return role(edge) != TriangleRole::faulty && partner(edge) != kNoPiece;
  }

  // The other piece, if the triangle is the first of exactly two towards it.
  [[nodiscard]] LocalIndex twin_of(const TriangleEdge& edge) const
  {
    if (!has_partner(edge)) return kNoPiece;
    const auto is_same = [&](const TriangleEdge& other) {
      return has_partner(other) && partner(other) == partner(edge);
    };
    const auto first = std::find_if(triangles_.begin(), triangles_.end(), is_same);
    const bool is_first_of_two =
        *first == edge && std::count_if(triangles_.begin(), triangles_.end(), is_same) == 2;
    return is_first_of_two ? partner(edge) : kNoPiece;
  }

  [[nodiscard]] LocalIndex apex_of(const TriangleEdge& edge) const
  {
    return surface_
        .triangles[static_cast<std::size_t>(edge.triangle)][static_cast<std::size_t>(edge.corner)];
  }

  // Unit vector from the edge to the apex, normal to the edge; zero if they are on one line.
  [[nodiscard]] std::array<float, 3> inward_of(const TriangleEdge& edge) const
  {
    const Vec3 along = surface_.position(edge.upper) - surface_.position(edge.lower);
    const Vec3 to_apex = surface_.position(apex_of(edge)) - surface_.position(edge.lower);
    const Vec3 across = to_apex - (dot(to_apex, along) / dot(along, along)) * along;
    const double length = norm(across);
    std::array<float, 3> inward{};
    if (!(length > 0.0)) return inward;
    for (std::size_t i = 0; i < 3; ++i) inward[i] = static_cast<float>(across[i] / length);
    return inward;
  }

  [[nodiscard]] EdgeRecord record_of(const TriangleEdge& edge) const
  {
    EdgeRecord record;
    std::array<VertexKey, 2> ends{surface_.key(edge.lower), surface_.key(edge.upper)};
    std::sort(ends.begin(), ends.end());
    record.key = key_of_vertices(ends);
    const Vec3 middle = midpoint(surface_.position(edge.lower), surface_.position(edge.upper));
    for (std::size_t i = 0; i < 3; ++i) record.middle[i] = static_cast<float>(middle[i]);
    record.piece = surface_.name.piece;
    record.cell = surface_.cells[static_cast<std::size_t>(edge.triangle)];
    return record;
  }

  PieceSurface& surface_;
  std::span<const TriangleEdge> triangles_;
};

// Number of the set of boundary triangles each boundary triangle is in; other triangles: -1.
std::vector<LocalIndex> boundary_components(const PieceSurface& surface,
                                            std::span<const TriangleEdge> edges,
                                            GlobalIndex& num_boundary_components)
{
  const auto is_outside = [&](LocalIndex t) {
    return is_open(surface.roles[static_cast<std::size_t>(t)]);
  };
  const auto num_triangles = static_cast<LocalIndex>(surface.triangles.size());
  UnionFind sets(num_triangles);
  for_each_edge(edges, [&](std::span<const TriangleEdge> triangles) {
    LocalIndex first = kNoIndex;
    for (const TriangleEdge& edge : triangles) {
      if (!is_outside(edge.triangle)) continue;
      if (first == kNoIndex) first = edge.triangle;
      sets.join(first, edge.triangle);
    }
  });
  std::vector<LocalIndex> component(surface.triangles.size(), kNoIndex);
  LocalIndex num_components = 0;
  for (LocalIndex t = 0; t < num_triangles; ++t) {
    if (!is_outside(t)) continue;
    const LocalIndex root = sets.find(t);  // The lowest of its set, so it has its number by now.
    component[static_cast<std::size_t>(t)] =
        root == t ? num_components++ : component[static_cast<std::size_t>(root)];
  }
  num_boundary_components += num_components;
  return component;
}

}  // namespace

void close_edges(PieceSurface& surface, SurfaceEdges& edges)
{
  const std::vector<TriangleEdge> open = sorted_open_edges(surface);
  for_each_edge(open, [&](std::span<const TriangleEdge> triangles) {
    EdgeFan fan(surface, triangles);
    if (!fan.is_known()) return;
    ++edges.num_edges;
    if (fan.is_half())
      ++edges.num_halves;
    else
      fan.append_records({}, {}, edges.shared);
    fan.close();
  });
}

std::vector<EdgeRecord> close_last_edges(PieceSurface& surface, std::span<const VertexFlags> flags,
                                         SurfaceEdges& edges)
{
  const std::vector<TriangleEdge> open = sorted_open_edges(surface);
  const auto component = boundary_components(surface, open, edges.num_boundary_components);
  std::vector<EdgeRecord> own;
  for_each_edge(open, [&](std::span<const TriangleEdge> triangles) {
    EdgeFan fan(surface, triangles);
    ++edges.num_edges;
    if (fan.is_half())
      ++edges.num_halves;
    else
      fan.append_records(component, flags,
                         fan.has_end_that_is_not_shared(flags) ? own : edges.shared);
    fan.close();
  });
  return own;
}

}  // namespace tessera::check
