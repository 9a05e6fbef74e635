// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/improve/region_mesh.hpp"

#include "improve/owner_set.hpp"

namespace tessera::improve {

// Finds the owner of the old tet with the nearest centroid: a k-d tree, kept as an array.
//
// Own code, because of equally near tets the lowest owner must win. nanoflann's leaves pass on only
// what is strictly nearer than the worst distance.
class CentroidSearch {
 public:
  explicit CentroidSearch(const RegionMesh& mesh);

  // Among the tets of the allowed owners; of equally near ones the lowest owner. kNoIndex if the
  // allowed owners have no tets.
  [[nodiscard]] LocalIndex nearest_owner(const Vec3& point, OwnerSet allowed) const;

 private:
  struct Node {
    Vec3 centroid{};
    LocalIndex owner = kNoIndex;
  };
  struct Nearest {
    double distance2 = 0.0;
    LocalIndex owner = kNoIndex;
  };

  void sort_range(std::size_t first, std::size_t last, std::size_t axis);
  void visit(std::size_t first, std::size_t last, std::size_t axis, const Vec3& point,
             OwnerSet allowed, Nearest& nearest) const;

  std::vector<Node> nodes_{};  // The middle of a range splits it.
};

}  // namespace tessera::improve
