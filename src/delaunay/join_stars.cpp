// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/join_stars.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::delaunay {
namespace {

// A face of stars whose corners all have tets beside the stars too.
struct Wall {
  std::array<LocalIndex, 3> key{};
  bool is_even = false;  // As seen from the tet of the star.

  friend auto operator<=>(const Wall&, const Wall&) = default;
};

Wall wall_at(const std::array<LocalIndex, 4>& tet, std::size_t corner)
{
  const auto& [a, b, c] = mesh::kTetFaceCorners[corner];
  return {mesh::sorted_triangle(tet[a], tet[b], tet[c]),
          mesh::is_even_triangle(tet[a], tet[b], tet[c])};
}

// A face is one if the corner opposite to it is the only one of its tet that is closed.
std::vector<Wall> walls_of(const LatticeStars& stars)
{
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < stars.tet_vertices.size(); i += 4) {
    const LocalIndex* v = &stars.tet_vertices[i];
    const std::array<LocalIndex, 4> tet{v[0], v[1], v[2], v[3]};
    const auto is_closed = [&stars](LocalIndex row) { return stars.is_closed[at(row)] != 0; };
    if (std::ranges::count_if(tet, is_closed) != 1) continue;
    const auto corner = std::ranges::find_if(tet, is_closed) - tet.begin();
    walls.push_back(wall_at(tet, static_cast<std::size_t>(corner)));
  }
  std::ranges::sort(walls);
  return walls;
}

class Joiner {
 public:
  // `order[v]` is the row of vertex v.
  Joiner(const Triangulation& triangulation, std::span<const LocalIndex> order,
         const LatticeStars& stars)
      : triangulation_(triangulation),
        order_(order),
        walls_(walls_of(stars)),
        tet_vertices_(stars.tet_vertices),
        is_at_wall_(stars.is_closed.size(), 0),
        is_wall_(4 * at(triangulation.num_slots()), 0),
        is_in_stars_(at(triangulation.num_slots()), 0)
  {
  }

  // Shape (num_tets, 4): rows.
  std::vector<LocalIndex> run()
  {
    if (!walls_.empty()) find_inner();
    for (LocalIndex slot = 0; slot < triangulation_.num_slots(); ++slot) {
      if (!triangulation_.has_tet(slot) || is_in_stars_[at(slot)] != 0) continue;
      const auto tet = rows_of(slot);
      tet_vertices_.insert(tet_vertices_.end(), tet.begin(), tet.end());
    }
    return std::move(tet_vertices_);
  }

 private:
  [[nodiscard]] std::array<LocalIndex, 4> rows_of(LocalIndex slot) const
  {
    const auto v = triangulation_.vertices(slot);
    return {order_[at(v[0])], order_[at(v[1])], order_[at(v[2])], order_[at(v[3])]};
  }

  void find_inner()
  {
    for (const Wall& wall : walls_) {
      for (const LocalIndex row : wall.key) is_at_wall_[at(row)] = 1;
    }
    std::vector<LocalIndex> inner;
    for (LocalIndex slot = 0; slot < triangulation_.num_slots(); ++slot) {
      if (triangulation_.has_tet(slot) && find_walls(slot)) inner.push_back(slot);
    }
    flood(std::move(inner));
  }

  // Marks the faces of a tet behind which stars end; whether there are some.
  bool find_walls(LocalIndex slot)
  {
    const std::array<LocalIndex, 4> tet = rows_of(slot);
    std::size_t num_at_wall = 0;
    for (const LocalIndex row : tet) num_at_wall += is_at_wall_[at(row)] != 0 ? 1U : 0U;
    if (num_at_wall < 3) return false;
    bool is_inner = false;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      if (!std::ranges::binary_search(walls_, wall_at(tet, corner))) continue;
      is_wall_[4 * at(slot) + corner] = 1;
      is_inner = true;
    }
    return is_inner;
  }

  void flood(std::vector<LocalIndex> inner)
  {
    for (const LocalIndex slot : inner) is_in_stars_[at(slot)] = 1;
    while (!inner.empty()) {
      const LocalIndex slot = inner.back();
      inner.pop_back();
      for (Corner corner = 4 * slot; tet_of(corner) == slot; ++corner) {
        const LocalIndex next = tet_of(triangulation_.across(corner));
        if (is_wall_[at(corner)] != 0 || is_in_stars_[at(next)] != 0) continue;
        is_in_stars_[at(next)] = 1;
        inner.push_back(next);
      }
    }
  }

  const Triangulation& triangulation_;
  std::span<const LocalIndex> order_;
  std::vector<Wall> walls_;  // Ascending.
  std::vector<LocalIndex> tet_vertices_;
  std::vector<char> is_at_wall_;   // Shape (num_points).
  std::vector<char> is_wall_;      // Shape (num_slots, 4).
  std::vector<char> is_in_stars_;  // Shape (num_slots).
};

}  // namespace

std::vector<LocalIndex> join_stars(const Triangulation& triangulation,
                                   std::span<const LocalIndex> order, const LatticeStars& stars)
{
  return Joiner(triangulation, order, stars).run();
}

}  // namespace tessera::delaunay
