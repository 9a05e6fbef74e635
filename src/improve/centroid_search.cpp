// SPDX-License-Identifier: BSD-3-Clause
#include "improve/centroid_search.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "tessera/base/tet.hpp"

namespace tessera::improve {

CentroidSearch::CentroidSearch(const RegionMesh& mesh)
{
  std::vector<OldTet> tets;
  tets.reserve(at(mesh.num_tets()));
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    tets.push_back({tet_centroid(corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t)),
                    mesh.tet_owner[at(t)]});
  }
  tree_ = SearchTree(
      mesh.num_tets(),
      [&](LocalIndex t) {
        const Vec3& centroid = tets[at(t)].centroid;
        return Box{centroid, centroid};
      },
      [&](LocalIndex t, std::size_t axis) { return std::pair(tets[at(t)].centroid[axis], t); });
  tets_.reserve(tets.size());
  for (const LocalIndex t : tree_.order()) tets_.push_back(tets[at(t)]);
}

LocalIndex CentroidSearch::nearest_owner(const Vec3& point, OwnerSet allowed) const
{
  std::pair nearest(std::numeric_limits<double>::infinity(), kNoIndex);  // And its owner.
  tree_.search([&](LocalIndex node) { return tree_.nodes()[at(node)].box.squared_distance(point); },
               [&](double squared_distance) { return !(squared_distance > nearest.first); },
               [&](LocalIndex row) {
                 const OldTet& tet = tets_[at(row)];
                 if (!contains(allowed, tet.owner)) return;
                 const Vec3 offset = tet.centroid - point;
                 nearest = std::min(nearest, std::pair(dot(offset, offset), tet.owner));
               });
  return nearest.second;
}

}  // namespace tessera::improve
