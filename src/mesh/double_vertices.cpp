// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/double_vertices.hpp"

#include <array>
#include <map>
#include <span>

namespace tessera::mesh {
namespace {

// Of each vertex of the skeleton the lowest coarse vertex that it is a copy of, or itself.
std::vector<LocalIndex> originals(const Skeleton& skeleton, const CoarseMesh& coarse)
{
  std::vector<LocalIndex> original(at(coarse.num_vertices()));
  for (LocalIndex v = 0; v < coarse.num_vertices(); ++v) {
    const bool is_copy = v > 0 && coarse.position(v) == coarse.position(v - 1);
    original[at(v)] = is_copy ? original[at(v) - 1] : v;
  }
  std::vector<LocalIndex> of_skeleton;
  for (const LocalIndex v : skeleton.vertex_coarse) of_skeleton.push_back(original[at(v)]);
  return of_skeleton;
}

// Rows of edges (width 2) or triangles (3), by the originals of their vertices.
template <std::size_t width>
class Sides {
 public:
  Sides(const FlatArray<LocalIndex>& vertices, std::span<const LocalIndex> original)
      : vertices_(vertices), original_(original)
  {
    const auto num_rows = static_cast<LocalIndex>(vertices.size() / width);
    for (LocalIndex row = 0; row < num_rows; ++row) rows_[key(row)].push_back(row);
  }

  [[nodiscard]] const std::vector<LocalIndex>& of(LocalIndex row) const
  {
    return rows_.at(key(row));
  }

 private:
  using Key = std::array<LocalIndex, width>;

  [[nodiscard]] Key key(LocalIndex row) const
  {
    Key key{};
    for (std::size_t i = 0; i < width; ++i) key[i] = original_[at(vertices_[width * at(row) + i])];
    return key;
  }

  const FlatArray<LocalIndex>& vertices_;
  std::span<const LocalIndex> original_;
  std::map<Key, std::vector<LocalIndex>> rows_{};
};

}  // namespace

std::vector<PointLimit> on_all_sides(std::vector<PointLimit> limits, const Skeleton& skeleton,
                                     const CoarseMesh& coarse)
{
  if (limits.empty() || coarse.patch_other_side.empty()) return limits;
  const std::vector<LocalIndex> original = originals(skeleton, coarse);
  const Sides<2> edges(skeleton.edge_vertices, original);
  const Sides<3> triangles(skeleton.triangle_vertices, original);
  std::vector<PointLimit> all;
  for (const PointLimit& limit : limits) {
    const bool is_on_edge = limit.key.carrier == LatticeCarrier::edge;
    for (const LocalIndex row :
         is_on_edge ? edges.of(limit.key.entity) : triangles.of(limit.key.entity)) {
      all.push_back({{limit.key.carrier, row, limit.key.index}, limit.factor});
    }
  }
  return all;
}

}  // namespace tessera::mesh
