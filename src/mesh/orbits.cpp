// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/orbits.hpp"

#include <map>
#include <tuple>

#include "tessera/base/index_lists.hpp"

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

// Links of each row, both ways.
IndexLists links_of_rows(LocalIndex num_rows, std::span<const ImageLink> links)
{
  std::vector<LocalIndex> ends;
  for (const ImageLink& link : links) ends.insert(ends.end(), {link.from, link.to});
  return rows_by_key(ends, num_rows, 2);
}

}  // namespace

OrbitTable find_orbits(LocalIndex num_rows, std::span<const ImageLink> links,
                       std::span<const Affine> transforms, std::vector<Affine>& images)
{
  Products products(transforms, images);
  const IndexLists links_at = links_of_rows(num_rows, links);
  OrbitTable table;
  table.base.assign(at(num_rows), kNoIndex);
  table.image.assign(at(num_rows), 0);
  for (LocalIndex row = 0; row < num_rows; ++row) {
    if (table.base[at(row)] != kNoIndex) continue;
    table.base[at(row)] = row;
    std::vector<LocalIndex> reached{row};
    for (std::size_t next = 0; next < reached.size(); ++next) {
      const LocalIndex here = reached[next];
      for (const LocalIndex l : links_at[here]) {
        const ImageLink& link = links[at(l)];
        const bool is_forward = link.from == here;
        const LocalIndex there = is_forward ? link.to : link.from;
        if (table.base[at(there)] != kNoIndex) continue;
        table.base[at(there)] = row;
        table.image[at(there)] = products.after(table.image[at(here)], link.transform, is_forward);
        reached.push_back(there);
      }
    }
  }
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
