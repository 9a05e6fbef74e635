// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/block_merge.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "tessera/base/rows.hpp"

namespace tessera::migrate {
namespace {

// All different ids of ascending lists, ascending; two by two, so that each is looked at as often
// as a merge sort would.
std::vector<GlobalIndex> union_of(std::vector<std::span<const GlobalIndex>> lists)
{
  std::vector<std::vector<GlobalIndex>> made;
  made.reserve(lists.size());
  std::size_t next = 0;
  for (; next + 1 < lists.size(); next += 2) {
    std::vector<GlobalIndex>& both = made.emplace_back();
    both.reserve(lists[next].size() + lists[next + 1].size());
    std::ranges::set_union(lists[next], lists[next + 1], std::back_inserter(both));
    lists.emplace_back(both);
  }
  if (!made.empty()) return std::move(made.back());
  if (lists.empty()) return {};
  return {lists.front().begin(), lists.front().end()};
}

template <class Member>
std::vector<GlobalIndex> union_of_ids(std::span<const MeshBlock> blocks, Member ids)
{
  std::vector<std::span<const GlobalIndex>> lists;
  for (const MeshBlock& block : blocks) lists.emplace_back(block.*ids);
  return union_of(std::move(lists));
}

void allocate(std::span<const MeshBlock> blocks, MeshBlock& merged)
{
  const std::size_t num_tets = merged.tet_ids.size();
  merged.vertex_xyz.resize(3 * merged.vertex_ids.size());
  merged.tet_vertices.resize(4 * num_tets);
  merged.tet_material.resize(num_tets);
  merged.tet_part.resize(num_tets);
  std::size_t num_columns = 0;
  for (const MeshBlock& block : blocks) {
    num_columns = std::max(num_columns, block.tet_columns.size());
  }
  merged.tet_columns.assign(num_columns, std::vector<std::uint64_t>(num_tets));
  merged.boundary_tet.resize(merged.boundary_ids.size());
  merged.boundary_corner.resize(merged.boundary_ids.size());
  merged.boundary_patch.resize(merged.boundary_ids.size());
}

void copy_into(const MeshBlock& block, MeshBlock& merged)
{
  const auto vertex_place = places_of(block.vertex_ids, merged.vertex_ids);
  put_rows<3>(block.vertex_xyz, vertex_place, merged.vertex_xyz);

  const auto tet_place = places_of(block.tet_ids, merged.tet_ids);
  for (std::size_t t = 0; t < tet_place.size(); ++t) {
    const LocalIndex* from = &block.tet_vertices[4 * t];
    LocalIndex* to = &merged.tet_vertices[4 * at(tet_place[t])];
    for (std::size_t c = 0; c < 4; ++c) to[c] = vertex_place[at(from[c])];
  }
  put_rows(block.tet_material, tet_place, merged.tet_material);
  put_rows(block.tet_part, tet_place, merged.tet_part);
  for (std::size_t c = 0; c < block.tet_columns.size(); ++c) {
    put_rows(block.tet_columns[c], tet_place, merged.tet_columns[c]);
  }

  const auto boundary_place = places_of(block.boundary_ids, merged.boundary_ids);
  for (std::size_t b = 0; b < boundary_place.size(); ++b) {
    merged.boundary_tet[at(boundary_place[b])] = tet_place[at(block.boundary_tet[b])];
  }
  put_rows(block.boundary_corner, boundary_place, merged.boundary_corner);
  put_rows(block.boundary_patch, boundary_place, merged.boundary_patch);
}

}  // namespace

std::vector<LocalIndex> places_of(std::span<const GlobalIndex> some,
                                  std::span<const GlobalIndex> all)
{
  std::vector<LocalIndex> places;
  places.reserve(some.size());
  std::size_t begin = 0;
  for (const GlobalIndex id : some) {
    // In steps that double, since the next one is mostly near.
    std::size_t step = 1;
    while (begin + step < all.size() && all[begin + step] <= id) {
      begin += step;
      step *= 2;
    }
    const std::size_t end = std::min(begin + step, all.size());
    const auto found = std::lower_bound(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                        all.begin() + static_cast<std::ptrdiff_t>(end), id);
    begin = static_cast<std::size_t>(found - all.begin());
    places.push_back(static_cast<LocalIndex>(begin));
  }
  return places;
}

MeshBlock merge_blocks(std::span<const MeshBlock> blocks)
{
  MeshBlock merged;
  merged.vertex_ids = union_of_ids(blocks, &MeshBlock::vertex_ids);
  merged.tet_ids = union_of_ids(blocks, &MeshBlock::tet_ids);
  merged.boundary_ids = union_of_ids(blocks, &MeshBlock::boundary_ids);
  allocate(blocks, merged);
  for (const MeshBlock& block : blocks) copy_into(block, merged);
  return merged;
}

}  // namespace tessera::migrate
