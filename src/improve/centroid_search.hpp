// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/base/search_tree.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/improve/region_mesh.hpp"

#include "improve/owner_set.hpp"

namespace tessera::improve {

// Finds the owner of the old tet with the nearest centroid.
class CentroidSearch {
 public:
  explicit CentroidSearch(const RegionMesh& mesh);

  // Among the tets of the allowed owners; of equally near ones the lowest owner. kNoIndex if the
  // allowed owners have no tets.
  [[nodiscard]] LocalIndex nearest_owner(const Vec3& point, OwnerSet allowed) const;

 private:
  struct OldTet {
    Vec3 centroid{};
    LocalIndex owner = kNoIndex;
  };

  SearchTree tree_{};
  std::vector<OldTet> tets_{};  // In the order of the leaves.
};

}  // namespace tessera::improve
