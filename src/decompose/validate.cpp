// SPDX-License-Identifier: BSD-3-Clause
// Shares no code with the stages that make a decomposition, not even their union-find: it works on
// the skins as surfaces, from the triangles alone.
#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/index_lists.hpp"
#include "tessera/decompose/decompose.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::decompose {
namespace {

[[noreturn]] void fail(const std::string& what) { throw MeshError("decomposition: " + what); }

[[noreturn]] void fail_at(LocalIndex subdomain, LocalIndex vertex, const std::string& what)
{
  fail(fmt::format("subdomain {} at vertex {}: {}", subdomain, vertex, what));
}

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size)
  {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  LocalIndex root(LocalIndex node)
  {
    while (parent_[at(node)] != node) {
      node = parent_[at(node)] = parent_[at(parent_[at(node)])];
    }
    return node;
  }
  void join(LocalIndex a, LocalIndex b) { parent_[at(root(a))] = root(b); }

 private:
  std::vector<LocalIndex> parent_;
};

// A set of connected corners (of tets or of skin triangles) at one vertex in one subdomain.
struct Fan {
  LocalIndex subdomain;
  LocalIndex root;
  friend auto operator<=>(const Fan&, const Fan&) = default;
};

// Cells, each with its vertices and the subdomain that it is of.
struct Cells {
  std::span<const LocalIndex> vertices;  // Shape (num_cells, width).
  LocalIndex width;
  std::span<const LocalIndex> subdomain;
};

// Corners of one subdomain that meet in a vertex must be one set.
void require_one_fan(const Cells& cells, LocalIndex num_vertices, DisjointSets& corners,
                     const std::string& what)
{
  const IndexLists cells_at = rows_by_key(cells.vertices, num_vertices, at(cells.width));
  std::vector<Fan> fans;
  for (LocalIndex v = 0; v < num_vertices; ++v) {
    fans.clear();
    for (const LocalIndex cell : cells_at[v]) {
      LocalIndex corner = cells.width * cell;
      while (cells.vertices[at(corner)] != v) ++corner;
      fans.push_back({cells.subdomain[at(cell)], corners.root(corner)});
    }
    std::ranges::sort(fans);
    fans.erase(std::unique(fans.begin(), fans.end()), fans.end());
    const auto second = std::ranges::adjacent_find(fans, {}, &Fan::subdomain);
    if (second != fans.end()) fail_at(second->subdomain, v, what);
  }
}

class Validator {
 public:
  Validator(const mesh::CoarseMesh& mesh, const mesh::Decomposition& decomposition)
      : mesh_(mesh),
        decomposition_(decomposition),
        triangles_(mesh::triangles_of_tets(mesh.tet_vertices))
  {
  }

  void check_interiors() const
  {
    DisjointSets tets(num_tets());
    DisjointSets corners(4 * num_tets());
    for (const mesh::TriangleTets& triangle : triangles_) {
      if (triangle.tets[1] == kNoIndex || subdomain(triangle, 0) != subdomain(triangle, 1))
        continue;
      const auto& [a, b] = triangle.tets;
      tets.join(a, b);
      for (const LocalIndex v : triangle.vertices) corners.join(corner(a, v), corner(b, v));
    }
    std::vector<LocalIndex> known(num_subdomains(), kNoIndex);
    for (LocalIndex t = 0; at(t) < num_tets(); ++t) {
      const LocalIndex s = decomposition_.tet_subdomain[at(t)];
      LocalIndex& first = known[at(s)];
      if (first == kNoIndex) first = tets.root(t);
      if (first != tets.root(t)) {
        fail_at(s, mesh_.tet_vertices[4 * at(t)], "it is not face-connected");
      }
    }
    require_one_fan({mesh_.tet_vertices, 4, decomposition_.tet_subdomain}, mesh_.num_vertices(),
                    corners, "its tets here are not face-connected");
  }

  void check_skins() const
  {
    const Skins skins = collect_skins();
    std::vector<SkinEdge> edges;
    for (LocalIndex i = 0; at(i) < skins.subdomain.size(); ++i) {
      const LocalIndex* v = &skins.vertices[3 * at(i)];
      const LocalIndex s = skins.subdomain[at(i)];
      edges.insert(edges.end(), {{s, {v[0], v[1]}, {3 * i, 3 * i + 1}},
                                 {s, {v[0], v[2]}, {3 * i, 3 * i + 2}},
                                 {s, {v[1], v[2]}, {3 * i + 1, 3 * i + 2}}});
    }
    std::sort(edges.begin(), edges.end(), [](const SkinEdge& x, const SkinEdge& y) {
      return x.subdomain != y.subdomain ? x.subdomain < y.subdomain : x.ends < y.ends;
    });
    DisjointSets corners(skins.vertices.size());
    DisjointSets surfaces(skins.subdomain.size());
    for (std::size_t i = 0; i < edges.size(); i += 2) {
      const SkinEdge& edge = edges[i];
      if (i + 1 == edges.size() || !edge.is_same(edges[i + 1])) fail_edge(edge, "an odd number of");
      if (i + 2 < edges.size() && edge.is_same(edges[i + 2])) fail_edge(edge, "more than two");
      for (std::size_t end = 0; end < 2; ++end) {
        corners.join(edge.corners[end], edges[i + 1].corners[end]);
      }
      surfaces.join(edge.corners[0] / 3, edges[i + 1].corners[0] / 3);
    }
    check_surfaces(skins, surfaces);
    require_one_fan({skins.vertices, 3, skins.subdomain}, mesh_.num_vertices(), corners,
                    "its skin touches itself");
  }

  void check_sizes() const
  {
    const std::size_t size = num_subdomains();
    const auto& d = decomposition_;
    if (d.tet_subdomain.size() != num_tets()) fail("tet_subdomain has a wrong length");
    if (d.subdomain_weight.size() != size) fail("subdomain_weight has a wrong length");
    if (d.neighbour_offsets.size() != size + 1) fail("neighbour_offsets has a wrong length");
    const auto num_entries = static_cast<std::size_t>(d.neighbour_offsets.back());
    if (d.neighbours.size() != num_entries || d.neighbour_triangles.size() != num_entries
        || d.neighbour_area.size() != num_entries) {
      fail("the arrays of the graph have different lengths");
    }
  }

  void check_materials() const
  {
    std::vector<bool> has_tet(num_subdomains(), false);
    for (std::size_t t = 0; t < num_tets(); ++t) {
      const LocalIndex s = decomposition_.tet_subdomain[t];
      if (s < 0 || static_cast<std::size_t>(s) >= num_subdomains()) {
        fail(fmt::format("tet {} is in subdomain {} of {}", t, s, num_subdomains()));
      }
      has_tet[static_cast<std::size_t>(s)] = true;
      if (decomposition_.subdomain_material[static_cast<std::size_t>(s)] != mesh_.tet_material[t]) {
        fail_at(s, mesh_.tet_vertices[4 * t], "a tet of another material");
      }
    }
    const auto empty = std::find(has_tet.begin(), has_tet.end(), false);
    if (empty != has_tet.end()) {
      fail(fmt::format("subdomain {} is empty", empty - has_tet.begin()));
    }
  }

  // Counts both directions of every shared triangle off the graph's own numbers.
  void check_graph() const
  {
    std::vector<LocalIndex> left = decomposition_.neighbour_triangles;
    for (const mesh::TriangleTets& triangle : triangles_) {
      if (triangle.tets[1] == kNoIndex) continue;
      const LocalIndex a = subdomain(triangle, 0);
      const LocalIndex b = subdomain(triangle, 1);
      if (a == b) continue;
      const std::size_t there = entry(a, b);
      const std::size_t back = entry(b, a);
      --left[there];
      --left[back];
      if (decomposition_.neighbour_area[there] != decomposition_.neighbour_area[back]) {
        fail(fmt::format("the area between subdomains {} and {} is not symmetric", a, b));
      }
    }
    if (std::any_of(left.begin(), left.end(), [](LocalIndex n) { return n != 0; })) {
      fail("the graph counts other triangles than the subdomains share");
    }
  }

 private:
  // The triangles of all skins.
  struct Skins {
    std::vector<LocalIndex> vertices{};   // Shape (num_triangles, 3): each ascends.
    std::vector<LocalIndex> subdomain{};  // Shape (num_triangles).
  };
  struct SkinEdge {
    LocalIndex subdomain;
    std::array<LocalIndex, 2> ends;
    std::array<LocalIndex, 2> corners;  // of a skin triangle, at either end
    [[nodiscard]] bool is_same(const SkinEdge& other) const
    {
      return subdomain == other.subdomain && ends == other.ends;
    }
  };

  [[nodiscard]] std::size_t num_tets() const { return mesh_.tet_material.size(); }
  [[nodiscard]] std::size_t num_subdomains() const
  {
    return decomposition_.subdomain_material.size();
  }
  [[nodiscard]] LocalIndex subdomain(const mesh::TriangleTets& triangle, std::size_t side) const
  {
    return decomposition_.tet_subdomain[static_cast<std::size_t>(triangle.tets[side])];
  }
  [[nodiscard]] LocalIndex corner(LocalIndex tet, LocalIndex vertex) const
  {
    LocalIndex corner = 4 * tet;
    while (mesh_.tet_vertices[at(corner)] != vertex) ++corner;
    return corner;
  }

  [[nodiscard]] Skins collect_skins() const
  {
    Skins skins;
    for (const mesh::TriangleTets& triangle : triangles_) {
      const bool is_outer = triangle.tets[1] == kNoIndex;
      if (!is_outer && subdomain(triangle, 0) == subdomain(triangle, 1)) continue;
      for (std::size_t side = 0; side < (is_outer ? 1 : 2); ++side) {
        skins.subdomain.push_back(subdomain(triangle, side));
        skins.vertices.insert(skins.vertices.end(), triangle.vertices.begin(),
                              triangle.vertices.end());
      }
    }
    return skins;
  }

  void check_surfaces(const Skins& skins, DisjointSets& surfaces) const
  {
    std::vector<LocalIndex> known(num_subdomains(), kNoIndex);
    for (LocalIndex i = 0; at(i) < skins.subdomain.size(); ++i) {
      const LocalIndex s = skins.subdomain[at(i)];
      if (known[at(s)] == kNoIndex) known[at(s)] = surfaces.root(i);
      if (known[at(s)] != surfaces.root(i)) {
        fail_at(s, skins.vertices[3 * at(i)], "its skin is more than one surface");
      }
    }
  }

  [[noreturn]] static void fail_edge(const SkinEdge& edge, const std::string& how_many)
  {
    fail_at(edge.subdomain, edge.ends[0],
            fmt::format("{} skin triangles at the edge to vertex {}", how_many, edge.ends[1]));
  }

  [[nodiscard]] std::size_t entry(LocalIndex from, LocalIndex to) const
  {
    const auto& offsets = decomposition_.neighbour_offsets;
    const auto begin = decomposition_.neighbours.begin();
    const auto first = begin + offsets[static_cast<std::size_t>(from)];
    const auto last = begin + offsets[static_cast<std::size_t>(from) + 1];
    const auto found = std::lower_bound(first, last, to);
    if (found == last || *found != to) {
      fail(fmt::format("subdomains {} and {} share a triangle, but not in the graph", from, to));
    }
    return static_cast<std::size_t>(found - begin);
  }

  const mesh::CoarseMesh& mesh_;
  const mesh::Decomposition& decomposition_;
  std::vector<mesh::TriangleTets> triangles_;
};

}  // namespace

void validate(const mesh::CoarseMesh& mesh, const mesh::Decomposition& decomposition)
{
  const Validator validator(mesh, decomposition);
  validator.check_sizes();
  validator.check_materials();
  validator.check_interiors();
  validator.check_skins();
  validator.check_graph();
}

}  // namespace tessera::decompose
