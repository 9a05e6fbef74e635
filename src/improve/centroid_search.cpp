// SPDX-License-Identifier: BSD-3-Clause
#include "improve/centroid_search.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace tessera::improve {

CentroidSearch::CentroidSearch(const RegionMesh& mesh)
{
  const std::span<const double> xyz(mesh.vertex_xyz);
  nodes_.reserve(at(mesh.num_tets()));
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const LocalIndex* v = &mesh.tet_vertices[4 * at(t)];
    const Vec3 sum =
        point_at(xyz, v[0]) + point_at(xyz, v[1]) + point_at(xyz, v[2]) + point_at(xyz, v[3]);
    nodes_.push_back({0.25 * sum, mesh.tet_owner[at(t)]});
  }
  sort_range(0, nodes_.size(), 0);
}

LocalIndex CentroidSearch::nearest_owner(const Vec3& point, OwnerSet allowed) const
{
  Nearest nearest{std::numeric_limits<double>::infinity(), kNoIndex};
  visit(0, nodes_.size(), 0, point, allowed, nearest);
  return nearest.owner;
}

void CentroidSearch::sort_range(std::size_t first, std::size_t last, std::size_t axis)
{
  if (last - first < 2) return;
  const std::size_t middle = first + (last - first) / 2;
  const auto node = [&](std::size_t i) { return nodes_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(node(first), node(middle), node(last), [&](const Node& a, const Node& b) {
    return a.centroid[axis] < b.centroid[axis];
  });
  sort_range(first, middle, (axis + 1) % 3);
  sort_range(middle + 1, last, (axis + 1) % 3);
}

void CentroidSearch::visit(std::size_t first, std::size_t last, std::size_t axis, const Vec3& point,
                           OwnerSet allowed, Nearest& nearest) const
{
  if (first == last) return;
  const std::size_t middle = first + (last - first) / 2;
  const Node& node = nodes_[middle];
  if (contains(allowed, node.owner)) {
    const Vec3 offset = node.centroid - point;
    const double distance2 = dot(offset, offset);
    if (distance2 < nearest.distance2
        || (distance2 == nearest.distance2 && node.owner < nearest.owner)) {
      nearest = {distance2, node.owner};
    }
  }
  const double beyond = point[axis] - node.centroid[axis];
  const std::size_t next = (axis + 1) % 3;
  if (beyond < 0.0) {
    visit(first, middle, next, point, allowed, nearest);
    if (beyond * beyond <= nearest.distance2)
      visit(middle + 1, last, next, point, allowed, nearest);
  } else {
    visit(middle + 1, last, next, point, allowed, nearest);
    if (beyond * beyond <= nearest.distance2) visit(first, middle, next, point, allowed, nearest);
  }
}

}  // namespace tessera::improve
