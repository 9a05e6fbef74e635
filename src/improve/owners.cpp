// SPDX-License-Identifier: BSD-3-Clause
#include "improve/owners.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "improve/centroid_search.hpp"
#include "improve/owner_set.hpp"

namespace tessera::improve {
namespace {

std::vector<LocalIndex> owners_of_nearest(const RegionMesh& mesh, const TetMesh& tets,
                                          const std::vector<OwnerSet>& allowed)
{
  const CentroidSearch search(mesh);
  std::vector<LocalIndex> owners(allowed.size());
  for (std::size_t t = 0; t < owners.size(); ++t) {
    if (std::has_single_bit(allowed[t])) {
      owners[t] = std::countr_zero(allowed[t]);
      continue;
    }
    const Vec3 centroid = tet_centroid(corners_at<4>(tets.vertex_xyz, tets.tet_vertices, t));
    owners[t] = search.nearest_owner(centroid, allowed[t]);
    if (owners[t] == kNoIndex) owners[t] = std::countr_zero(allowed[t]);
  }
  return owners;
}

// Tets are *anchored* if they hang together with their owner's tets outside the region. If the
// owner has none there, its largest component is anchored. The other tets are given away.
class Components {
 public:
  Components(const TetMesh& tets, std::vector<LocalIndex>& owners)
      : owners_(owners), is_anchored_(owners.size(), 0), neighbours_(4 * owners.size(), kNoIndex)
  {
    for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(tets.tet_vertices)) {
      if (triangle.tets[1] == kNoIndex) continue;
      for (std::size_t side = 0; side < 2; ++side) {
        neighbours_[4 * at(triangle.tets[side]) + at(triangle.corners[side])] =
            triangle.tets[1 - side];
      }
    }
  }

  void run(const RegionMesh& mesh, const std::vector<LocalIndex>& triangle_tet,
           const std::vector<OwnerSet>& allowed)
  {
    anchor(mesh, triangle_tet);
    while (give_some_away(allowed)) {
    }
  }

 private:
  void anchor(const RegionMesh& mesh, const std::vector<LocalIndex>& triangle_tet)
  {
    std::vector<char> has_outside(at(mesh.num_owners()), 0);
    for (std::size_t i = 0; i < triangle_tet.size(); ++i) {
      const LocalIndex tet = triangle_tet[i];
      if (mesh.triangle_outside[i] != owners_[at(tet)]) continue;
      has_outside[at(owners_[at(tet)])] = 1;
      spread(tet, is_anchored_);
    }
    anchor_largest(has_outside);
  }

  void anchor_largest(const std::vector<char>& has_outside)
  {
    std::vector<std::size_t> most(has_outside.size(), 0);
    std::vector<LocalIndex> first_tet(has_outside.size(), kNoIndex);
    std::vector<char> is_seen(owners_.size(), 0);
    for (std::size_t t = 0; t < owners_.size(); ++t) {
      const std::size_t owner = at(owners_[t]);
      if (has_outside[owner] != 0 || is_seen[t] != 0) continue;
      const std::size_t size = spread(static_cast<LocalIndex>(t), is_seen);
      if (size <= most[owner]) continue;
      most[owner] = size;
      first_tet[owner] = static_cast<LocalIndex>(t);
    }
    for (const LocalIndex t : first_tet) {
      if (t != kNoIndex) spread(t, is_anchored_);
    }
  }

  // Marks the component of a tet that is not marked yet; returns its size.
  std::size_t spread(LocalIndex tet, std::vector<char>& is_marked)
  {
    if (is_marked[at(tet)] != 0) return 0;
    is_marked[at(tet)] = 1;
    std::vector<LocalIndex> component{tet};
    for (std::size_t next = 0; next < component.size(); ++next) {
      for (std::size_t c = 0; c < 4; ++c) {
        const LocalIndex beside = neighbours_[4 * at(component[next]) + c];
        if (beside == kNoIndex || is_marked[at(beside)] != 0) continue;
        if (owners_[at(beside)] != owners_[at(tet)]) continue;
        is_marked[at(beside)] = 1;
        component.push_back(beside);
      }
    }
    return component.size();
  }

  // Every tet that is given away is anchored from then on, so this comes to an end.
  bool give_some_away(const std::vector<OwnerSet>& allowed)
  {
    bool gave = false;
    for (std::size_t t = 0; t < owners_.size(); ++t) {
      for (std::size_t c = 0; c < 4 && is_anchored_[t] == 0; ++c) {
        const LocalIndex beside = neighbours_[4 * t + c];
        if (beside == kNoIndex || is_anchored_[at(beside)] == 0) continue;
        if (!contains(allowed[t], owners_[at(beside)])) continue;
        owners_[t] = owners_[at(beside)];
        spread(static_cast<LocalIndex>(t), is_anchored_);
        gave = true;
      }
    }
    return gave;
  }

  std::vector<LocalIndex>& owners_;
  std::vector<char> is_anchored_;
  std::vector<LocalIndex> neighbours_;  // Shape (num_tets, 4): across the face opposite a corner.
};

void require_all_owners_kept(const RegionMesh& mesh, const std::vector<LocalIndex>& owners)
{
  OwnerSet had = 0;
  OwnerSet has = 0;
  for (const LocalIndex owner : mesh.tet_owner) had |= only(owner);
  for (const LocalIndex owner : owners) has |= only(owner);
  if ((had & ~has) == 0) return;
  throw MeshError(
      fmt::format("subdomain {} would lose all of its tets in the region",
                  mesh.subdomains[static_cast<std::size_t>(std::countr_zero(had & ~has))]));
}

}  // namespace

std::vector<LocalIndex> give_to_owners(const RegionMesh& mesh, const TetMesh& tets,
                                       const std::vector<LocalIndex>& triangle_tet)
{
  const std::vector<OwnerSet> allowed = allowed_owners(mesh, tets, triangle_tet);
  std::vector<LocalIndex> owners = owners_of_nearest(mesh, tets, allowed);
  Components(tets, owners).run(mesh, triangle_tet, allowed);
  require_all_owners_kept(mesh, owners);
  return owners;
}

}  // namespace tessera::improve
