// SPDX-License-Identifier: BSD-3-Clause
#include "formats/tag_groups.hpp"

#include <algorithm>

namespace tessera::formats {
namespace {

const std::vector<TagCount>& counts_of(const PieceCounts& piece, Grouped what)
{
  switch (what) {
    case Grouped::tets:
      return piece.tets_of_material;
    case Grouped::triangles:
      return piece.triangles_of_patch;
    case Grouped::points:
      return piece.points_of_patch;
  }
  return piece.tets_of_material;
}

}  // namespace

TagGroups::TagGroups(const Outline& outline, Grouped what) : what_(what)
{
  const auto& names = what == Grouped::tets ? outline.material_names : outline.patch_names;
  num_tags_ = names.size();
  std::vector<GlobalIndex> totals(num_tags_ + 1, 0);
  for (const PieceCounts& piece : outline.pieces) {
    std::vector<TagCount>& first = first_.emplace_back();
    for (const TagCount& entities : counts_of(piece, what)) {
      GlobalIndex& total = totals[at(entities.tag)];
      first.push_back({entities.tag, total});
      total += entities.count;
    }
  }
  for (std::size_t tag = 1; tag <= num_tags_; ++tag) {
    if (totals[tag] == 0) continue;
    tags_.push_back(static_cast<std::int32_t>(tag));
    totals_.push_back(totals[tag]);
    names_.push_back(names[tag - 1]);
  }
}

void TagGroups::for_each_of(const Piece& piece, const Visit& visit) const
{
  const IndexLists rows = rows_by_tag(piece);
  for (const TagCount& first : first_[at(piece.number)]) {
    const auto group = std::ranges::lower_bound(tags_, first.tag) - tags_.begin();
    visit(static_cast<std::size_t>(group), first.count, rows[first.tag]);
  }
}

IndexLists TagGroups::rows_by_tag(const Piece& piece) const
{
  const auto num_lists = static_cast<LocalIndex>(num_tags_) + 1;  // Of tag 0 there is nothing.
  if (what_ == Grouped::tets) return rows_by_key(piece.tet_material, num_lists);
  if (what_ == Grouped::triangles) return rows_by_key(piece.triangle_patch, num_lists);
  std::vector<std::int32_t> patches;
  for (const PatchPoint& point : piece.patch_points) patches.push_back(point.patch);
  IndexLists rows = rows_by_key(patches, num_lists);
  for (LocalIndex& row : rows.values) row = piece.patch_points[at(row)].point;
  return rows;
}

}  // namespace tessera::formats
