// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/orbits.hpp"

#include <map>
#include <numeric>
#include <tuple>

#include "tessera/base/index_lists.hpp"
#include "tessera/mesh/orbit_walk.hpp"

namespace tessera::mesh {
namespace {

// Products of transforms, each made once.
class Products {
 public:
  Products(std::span<const Affine> transforms, std::vector<Affine>& images)
      : transforms_(transforms), images_(images)
  {
  }

  // The row of an image after a transform, or after what leads back.
  LocalIndex after(LocalIndex image, LocalIndex transform, bool is_forward)
  {
    if (transform == 0) return image;
    const auto next = static_cast<LocalIndex>(images_.size());
    const auto [found, is_new] = known_.try_emplace(std::tuple(image, transform, is_forward), next);
    if (is_new) {
      const Affine& there = transforms_[at(transform)];
      images_.push_back(product(is_forward ? there : there.inverse(), images_[at(image)]));
    }
    return found->second;
  }

 private:
  std::span<const Affine> transforms_;
  std::vector<Affine>& images_;
  std::map<std::tuple<LocalIndex, LocalIndex, bool>, LocalIndex> known_{};
};

}  // namespace

OrbitTable find_orbits(LocalIndex num_rows, std::span<const ImageLink> links,
                       std::span<const Affine> transforms, std::vector<Affine>& images)
{
  Products products(transforms, images);
  OrbitTable table;
  table.base.resize(at(num_rows));
  std::iota(table.base.begin(), table.base.end(), 0);
  table.image.assign(at(num_rows), 0);
  walk_orbits(num_rows, links, [&](LocalIndex here, LocalIndex there, const ImageLink& link) {
    table.base[at(there)] = LocalIndex{table.base[at(here)]};
    table.image[at(there)] =
        products.after(table.image[at(here)], link.transform, link.from == here);
  });
  return table;
}

std::vector<PointLimit> on_whole_orbits(std::vector<PointLimit> limits, const Orbits& orbits)
{
  if (limits.empty() || orbits.are_none()) return limits;
  const auto members_of = [](const OrbitTable& table) {
    return rows_by_key(table.base, static_cast<LocalIndex>(table.base.size()));
  };
  const IndexLists edges = members_of(orbits.edges);
  const IndexLists triangles = members_of(orbits.triangles);
  std::vector<PointLimit> all;
  for (const PointLimit& limit : limits) {
    const LocalIndex row = limit.key.entity;
    const bool is_on_edge = limit.key.carrier == LatticeCarrier::edge;
    for (const LocalIndex member :
         is_on_edge ? edges[orbits.edges.base_of(row)] : triangles[orbits.triangles.base_of(row)]) {
      all.push_back({{limit.key.carrier, member, limit.key.index}, limit.factor});
    }
  }
  return all;
}

}  // namespace tessera::mesh
