// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/refine/choose_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include "tessera/mesh/image_edges.hpp"
#include "tessera/mesh/sorted_rows.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::refine {
namespace {

constexpr double kLongestPart = 1.4;  // In wanted lengths, of an edge that is split straight.

std::int8_t level_for(double num_wanted, int most)
{
  int level = 0;
  while (level < most && std::ldexp(kLongestPart, level) < num_wanted) ++level;
  return static_cast<std::int8_t>(level);
}

constexpr std::size_t kEdgesOfTet = mesh::kTetEdgeCorners.size();

// Shape (num_tets, 6).
std::vector<LocalIndex> edges_of_tets(const mesh::CoarseMesh& coarse,
                                      const std::vector<LocalIndex>& edges)
{
  std::vector<LocalIndex> rows;
  rows.reserve(kEdgesOfTet * at(coarse.num_tets()));
  for (LocalIndex t = 0; t < coarse.num_tets(); ++t) {
    const auto tet = coarse.tet(t);
    for (const auto& [a, b] : mesh::kTetEdgeCorners)
      rows.push_back(mesh::find_edge_row(edges, tet[a], tet[b]));
  }
  return rows;
}

// Of the triangles on the geometry. Shape (num_faces, 3).
std::vector<LocalIndex> edges_of_faces(const mesh::CoarseMesh& coarse,
                                       const std::vector<LocalIndex>& edges)
{
  std::vector<LocalIndex> rows;
  rows.reserve(3 * at(coarse.num_faces()));
  for (LocalIndex f = 0; f < coarse.num_faces(); ++f) {
    const LocalIndex* v = &coarse.face_vertices[3 * at(f)];
    for (const auto& [a, b] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
      rows.push_back(mesh::find_edge_row(edges, v[a], v[b]));
    }
  }
  return rows;
}

// Rows of edges that are images of each other. Shape (num_pairs, 2).
std::vector<LocalIndex> pairs_of_images(const mesh::CoarseMesh& coarse,
                                        const std::vector<LocalIndex>& edges)
{
  std::vector<LocalIndex> pairs;
  for (const mesh::ImageEdge& edge : mesh::image_edges(coarse)) {
    pairs.push_back(mesh::find_edge_row(edges, edge.from[0], edge.from[1]));
    pairs.push_back(mesh::find_edge_row(edges, edge.to[0], edge.to[1]));
  }
  return pairs;
}

// Edges are raised where a rule asks for it, and never lowered. So the order of tets and triangles
// does not matter.
class Raiser {
 public:
  explicit Raiser(std::vector<std::int8_t>& levels) : levels_(levels) {}

  // In no tet do levels differ by more than one.
  void even_out(std::span<const LocalIndex> of_tets)
  {
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (std::size_t first = 0; first < of_tets.size(); first += kEdgesOfTet) {
        const auto edges = of_tets.subspan(first, kEdgesOfTet);
        has_changed = raise(edges, largest(edges) - 1) || has_changed;
      }
    }
  }

  // No triangle has two finer sides: its children there would be slender, and no kernel betters the
  // surface.
  // @return Whether any edge was raised; as join_images().
  bool complete(std::span<const LocalIndex> of_faces)
  {
    bool has_changed = false;
    for (std::size_t first = 0; first < of_faces.size(); first += 3) {
      const auto sides = of_faces.subspan(first, 3);
      const int most = largest(sides);
      const auto num_finer =
          std::ranges::count_if(sides, [&](LocalIndex e) { return levels_[at(e)] == most; });
      if (num_finer == 2) has_changed = raise(sides, most) || has_changed;
    }
    return has_changed;
  }

  // Images of each other have one level.
  bool join_images(std::span<const LocalIndex> pairs)
  {
    bool has_changed = false;
    for (std::size_t first = 0; first < pairs.size(); first += 2) {
      const auto both = pairs.subspan(first, 2);
      has_changed = raise(both, largest(both)) || has_changed;
    }
    return has_changed;
  }

 private:
  [[nodiscard]] int largest(std::span<const LocalIndex> edges) const
  {
    int most = 0;
    for (const LocalIndex e : edges) most = std::max<int>(most, levels_[at(e)]);
    return most;
  }

  bool raise(std::span<const LocalIndex> edges, int least)
  {
    bool has_changed = false;
    for (const LocalIndex e : edges) {
      if (levels_[at(e)] >= least) continue;
      levels_[at(e)] = static_cast<std::int8_t>(least);
      has_changed = true;
    }
    return has_changed;
  }

  std::vector<std::int8_t>& levels_;
};

}  // namespace

mesh::EdgeLevels choose_levels(const mesh::CoarseMesh& coarse, std::vector<LocalIndex> edges,
                               const std::vector<double>& num_wanted, int most)
{
  std::vector<std::int8_t> levels;
  levels.reserve(num_wanted.size());
  for (const double num : num_wanted) levels.push_back(level_for(num, most));
  const std::vector<LocalIndex> of_tets = edges_of_tets(coarse, edges);
  const std::vector<LocalIndex> of_faces = edges_of_faces(coarse, edges);
  const std::vector<LocalIndex> of_images = pairs_of_images(coarse, edges);
  Raiser raiser(levels);
  do {
    raiser.even_out(of_tets);
  } while (raiser.complete(of_faces) || raiser.join_images(of_images));
  return {std::move(edges), std::move(levels)};
}

}  // namespace tessera::refine
