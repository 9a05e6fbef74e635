// SPDX-License-Identifier: BSD-3-Clause
#include "check/piece/topology.hpp"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/union_find.hpp"

namespace tessera::check {
namespace {

// A side of a triangle whose lowest vertex is at hand.
struct Side {
  std::uint64_t upper = 0;  // The two other vertices, the middle one in the high half.
  std::uint32_t code = 0;   // (4 cell + corner) * 2 + parity.

  [[nodiscard]] LocalIndex cell() const { return static_cast<LocalIndex>(code >> 3); }
  [[nodiscard]] std::size_t corner() const { return (code >> 1) & 3U; }
  [[nodiscard]] bool is_odd() const { return (code & 1U) != 0; }

  friend auto operator<=>(const Side&, const Side&) = default;
};

std::array<LocalIndex, 3> outward_vertices(const PieceMesh& mesh, LocalIndex cell,
                                           std::size_t corner)
{
  const auto tet = mesh.cell(cell);
  const auto& corners = kOutwardCorners[corner];
  return {tet[corners[0]], tet[corners[1]], tet[corners[2]]};
}

// The vertices of a tet, without a branch that would be guessed wrong.
std::array<LocalIndex, 4> ascending(std::span<const LocalIndex, 4> tet)
{
  const auto [low, high] = std::pair(std::min(tet[0], tet[1]), std::max(tet[0], tet[1]));
  const auto [other_low, other_high] =
      std::pair(std::min(tet[2], tet[3]), std::max(tet[2], tet[3]));
  const LocalIndex a = std::max(low, other_low);
  const LocalIndex b = std::min(high, other_high);
  return {std::min(low, other_low), std::min(a, b), std::max(a, b), std::max(high, other_high)};
}

// The cells of each vertex that is among the `num_lowest` lowest ones of the cell, sorted by
// counting. A cell's sides are those of its two lowest vertices, its edges those of its three
// lowest: so every triangle and every edge is met at its lowest vertex, though nothing is kept of
// them.
class CellsByLowestVertices {
 public:
  CellsByLowestVertices(const PieceMesh& mesh, std::size_t num_lowest)
      : offsets_(static_cast<std::size_t>(mesh.num_points()) + 2, 0)
  {
    for_each(mesh, num_lowest, [&](std::size_t vertex, LocalIndex) { ++offsets_[vertex + 2]; });
    for (std::size_t v = 2; v < offsets_.size(); ++v) offsets_[v] += offsets_[v - 1];
    cells_.resize(offsets_.back());
    for_each(mesh, num_lowest,
             [&](std::size_t vertex, LocalIndex cell) { cells_[offsets_[vertex + 1]++] = cell; });
  }

  [[nodiscard]] LocalIndex num_vertices() const
  {
    return static_cast<LocalIndex>(offsets_.size()) - 2;
  }
  [[nodiscard]] std::span<const LocalIndex> operator[](LocalIndex vertex) const
  {
    const auto v = static_cast<std::size_t>(vertex);
    return std::span(cells_).subspan(offsets_[v], offsets_[v + 1] - offsets_[v]);
  }

 private:
  template <class Visit>
  static void for_each(const PieceMesh& mesh, std::size_t num_lowest, const Visit& visit)
  {
    for (LocalIndex cell = 0; cell < mesh.num_cells(); ++cell) {
      if (mesh.is_left_out(cell)) continue;
      const auto vertices = ascending(mesh.cell(cell).first<4>());
      for (std::size_t i = 0; i < num_lowest; ++i)
        visit(static_cast<std::size_t>(vertices[i]), cell);
    }
  }

  std::vector<std::size_t> offsets_;
  std::vector<LocalIndex> cells_{};
};

// Appends the sides of a cell whose lowest vertex this is, one of the cell's two lowest: either it
// has three of them, or the one that is opposite to the lowest of all.
void append_sides(const PieceMesh& mesh, LocalIndex lowest, LocalIndex cell,
                  std::vector<Side>& sides)
{
  const auto tet = mesh.cell(cell).first<4>();
  const LocalIndex lowest_of_all = std::min({tet[0], tet[1], tet[2], tet[3]});
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const bool is_opposite_to_lowest = tet[corner] == lowest_of_all;
    if (is_opposite_to_lowest == (lowest == lowest_of_all)) continue;
    const auto [a, b, c] = outward_vertices(mesh, cell, corner);
    const auto highest = static_cast<std::uint64_t>(std::max({a, b, c}));
    const auto middle = static_cast<std::uint64_t>(GlobalIndex{a} + b + c - lowest) - highest;
    const auto side = 4 * static_cast<std::uint32_t>(cell) + static_cast<std::uint32_t>(corner);
    sides.push_back({middle << 32 | highest, 2 * side + (is_odd(a, b, c) ? 1U : 0U)});
  }
}

class TriangleMatcher {
 public:
  TriangleMatcher(const PieceMesh& mesh, Findings& findings)
      : mesh_(mesh),
        findings_(findings),
        cells_(mesh, 2),
        components_(mesh.num_cells()),
        has_patches_inside_(!mesh.inside_patches().empty()),
        is_on_surface_(static_cast<std::size_t>(mesh.num_points()), false),
        is_between_(is_on_surface_)
  {
  }

  PieceTopology match()
  {
    for (LocalIndex v = 0; v < cells_.num_vertices(); ++v)
      for_each_triangle(v, [&](std::span<const Side> sides) { match_sides(v, sides); });
    for (LocalIndex v = 0; v < cells_.num_vertices(); ++v) {
      const auto i = static_cast<std::size_t>(v);
      if (is_on_surface_[i] || is_between_[i] || has_patches_inside_)
        for_each_triangle(v, [&](std::span<const Side> sides) { sort_out(sides); });
    }
    number_components();
    return std::move(topology_);
  }

 private:
  // Those whose lowest vertex is v.
  template <class Visit>
  void for_each_triangle(LocalIndex v, const Visit& visit)
  {
    bucket_.clear();
    for (const LocalIndex cell : cells_[v]) append_sides(mesh_, v, cell, bucket_);
    std::sort(bucket_.begin(), bucket_.end());
    const std::span<const Side> bucket = bucket_;
    for (std::size_t begin = 0, end = 0; begin < bucket.size(); begin = end) {
      while (end < bucket.size() && bucket[end].upper == bucket[begin].upper) ++end;
      visit(bucket.subspan(begin, end - begin));
    }
  }

  static bool is_matched(std::span<const Side> sides)
  {
    return sides.size() == 2 && sides[0].is_odd() != sides[1].is_odd();
  }

  [[nodiscard]] std::array<LocalIndex, 3> vertices(const Side& side) const
  {
    return outward_vertices(mesh_, side.cell(), side.corner());
  }

  void match_sides(LocalIndex lowest, std::span<const Side> sides)
  {
    ++topology_.num_inner_triangles;  // But for those that sort_out() finds to be shown.
    for (const Side& side : sides.subspan(1)) components_.join(sides[0].cell(), side.cell());
    if (sides.size() == 1) {
      for (const LocalIndex v : vertices(sides[0]))
        is_on_surface_[static_cast<std::size_t>(v)] = true;
    } else if (!is_matched(sides)) {
      report(sides);
    } else if (is_between_regions(sides)) {
      is_between_[static_cast<std::size_t>(lowest)] = true;
    }
  }

  // Decides whether other pieces must see the triangle.
  void sort_out(std::span<const Side> sides)
  {
    const bool is_shown =
        sides.size() == 1
        || (is_matched(sides)
            && (is_between_regions(sides) || has_patches_inside_ || is_chord(sides[0])));
    if (!is_shown) return;
    --topology_.num_inner_triangles;
    const bool is_open = sides.size() == 1;
    const bool is_seam = !is_open && is_between_regions(sides) && !is_interface(sides);
    for (const Side& side : sides) {
      topology_.surface.push_back(
          {vertices(side), side.cell(), components_.find(side.cell()), is_open, is_seam});
    }
  }

  [[nodiscard]] bool is_interface(std::span<const Side> sides) const
  {
    return mesh_.material(sides[0].cell()) != mesh_.material(sides[1].cell());
  }

  [[nodiscard]] bool is_between_regions(std::span<const Side> sides) const
  {
    const LocalIndex a = sides[0].cell();
    const LocalIndex b = sides[1].cell();
    return is_interface(sides) || mesh_.subdomain_of(a) != mesh_.subdomain_of(b);
  }

  [[nodiscard]] bool is_chord(const Side& side) const
  {
    const auto corners = vertices(side);
    return std::all_of(corners.begin(), corners.end(),
                       [&](LocalIndex v) { return is_on_surface_[static_cast<std::size_t>(v)]; });
  }

  void report(std::span<const Side> sides)
  {
    const LocalIndex piece = mesh_.name.piece;
    findings_.add(Kind::triangle, {piece, sides[0].cell()}, [&] {
      std::string text = "triangle of";
      for (const LocalIndex v : vertices(sides[0]))
        text += fmt::format(" [{}]", describe_point(mesh_, v));
      text += sides.size() == 2 ? " has two tets on one side:" : " has more than two tets:";
      for (const Side& side : sides) text += fmt::format(" {};", describe_cell(mesh_, side.cell()));
      return text;
    });
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t j = i + 1; j < sides.size(); ++j) report_duplicate(sides[i], sides[j]);
  }

  // Two equal tets meet at four triangles: they are reported at the one opposite to corner 0.
  void report_duplicate(const Side& first, const Side& second)
  {
    const auto a = mesh_.cell(first.cell());
    const auto b = mesh_.cell(second.cell());
    if (first.corner() != 0 || !std::is_permutation(a.begin(), a.end(), b.begin())) return;
    findings_.add(Kind::duplicate_tet, {mesh_.name.piece, second.cell()}, [&] {
      return fmt::format("{} and {}", describe_cell(mesh_, first.cell()),
                         describe_cell(mesh_, second.cell()));
    });
  }

  // Components are named by their lowest cell so far; surface triangles get their numbers.
  void number_components()
  {
    std::vector<LocalIndex> lowest_cells;
    for (LocalIndex c = 0; c < mesh_.num_cells(); ++c)
      if (!mesh_.is_left_out(c) && components_.find(c) == c) lowest_cells.push_back(c);
    topology_.num_components = static_cast<LocalIndex>(lowest_cells.size());
    for (SurfaceTriangle& triangle : topology_.surface) {
      const auto found = std::ranges::lower_bound(lowest_cells, triangle.component);
      triangle.component = static_cast<LocalIndex>(found - lowest_cells.begin());
    }
  }

  const PieceMesh& mesh_;
  Findings& findings_;
  CellsByLowestVertices cells_;
  std::vector<Side> bucket_{};  // Of the vertex at hand.
  UnionFind components_;
  bool has_patches_inside_;  // Any triangle may be on one: all are shown.
  std::vector<bool> is_on_surface_;
  std::vector<bool> is_between_;  // Lowest vertex of a triangle between two regions.
  PieceTopology topology_{};
};

GlobalIndex count_edges(const PieceMesh& mesh, EdgeLengths& lengths)
{
  const CellsByLowestVertices cells(mesh, 3);
  std::vector<LocalIndex> last_seen_from(static_cast<std::size_t>(mesh.num_points()), kNoIndex);
  GlobalIndex num_edges = 0;
  for (LocalIndex v = 0; v < cells.num_vertices(); ++v) {
    for (const LocalIndex cell : cells[v]) {
      for (const LocalIndex upper : mesh.cell(cell)) {
        LocalIndex& seen = last_seen_from[static_cast<std::size_t>(upper)];
        if (upper <= v || seen == v) continue;
        seen = v;
        ++num_edges;
        lengths.add(norm(mesh.position(upper) - mesh.position(v)));
      }
    }
  }
  return num_edges;
}

// An edge on the surface of a subdomain.
struct SubdomainEdge {
  LocalIndex lower = 0;
  LocalIndex upper = 0;
  std::int32_t subdomain = 0;

  friend auto operator<=>(const SubdomainEdge&, const SubdomainEdge&) = default;
};

// Adds the length of an edge once for each further subdomain of the piece that has it. Every
// subdomain at such an edge has triangles there that are shown.
void add_lengths_of_further_subdomains(const PieceMesh& mesh, const PieceTopology& topology,
                                       EdgeLengths& lengths)
{
  std::vector<SubdomainEdge> edges;
  for (const SurfaceTriangle& triangle : topology.surface) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [lower, upper] = std::minmax(triangle.vertices[i], triangle.vertices[(i + 1) % 3]);
      edges.push_back({lower, upper, mesh.subdomain_of(triangle.cell)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i].lower == edges[i - 1].lower && edges[i].upper == edges[i - 1].upper)
      lengths.add(norm(mesh.position(edges[i].upper) - mesh.position(edges[i].lower)));
  }
}

}  // namespace

PieceTopology analyse_topology(const PieceMesh& mesh, EdgeLengths& lengths, Findings& findings)
{
  PieceTopology topology = TriangleMatcher(mesh, findings).match();
  topology.num_edges = count_edges(mesh, lengths);
  if (!mesh.subdomain.is_constant()) add_lengths_of_further_subdomains(mesh, topology, lengths);
  return topology;
}

}  // namespace tessera::check
