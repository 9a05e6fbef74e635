// SPDX-License-Identifier: BSD-3-Clause
#include "formats/tag_groups.hpp"

#include <algorithm>
#include <map>

namespace tessera::formats {

TagGroups TagGroups::of_elements(const Outline& outline, std::span<const Shape> shapes)
{
  std::vector<std::vector<TagCount>> counts_of_pieces;
  for (const PieceCounts& piece : outline.pieces) {
    std::map<std::int32_t, GlobalIndex> sums;
    for (const Shape shape : shapes)
      for (const TagCount& count : piece.elements[shape]) sums[count.tag] += count.count;
    std::vector<TagCount>& counts = counts_of_pieces.emplace_back();
    for (const auto& [tag, count] : sums) counts.push_back({tag, count});
  }
  return {outline.names_of(shapes.front()), counts_of_pieces};
}

TagGroups TagGroups::of_points(const Outline& outline)
{
  std::vector<std::vector<TagCount>> counts_of_pieces;
  for (const PieceCounts& piece : outline.pieces) counts_of_pieces.push_back(piece.points_of_patch);
  return {outline.patch_names, counts_of_pieces};
}

TagGroups::TagGroups(const std::vector<std::string>& names,
                     const std::vector<std::vector<TagCount>>& counts_of_pieces)
    : num_tags_(static_cast<LocalIndex>(names.size()))
{
  std::vector<GlobalIndex> totals(names.size() + 1, 0);
  for (const std::vector<TagCount>& counts : counts_of_pieces) {
    std::vector<TagCount>& first = first_.emplace_back();
    for (const TagCount& entities : counts) {
      GlobalIndex& total = totals[at(entities.tag)];
      first.push_back({entities.tag, total});
      total += entities.count;
    }
  }
  for (std::size_t tag = 1; tag <= names.size(); ++tag) {
    if (totals[tag] == 0) continue;
    tags_.push_back(static_cast<std::int32_t>(tag));
    totals_.push_back(totals[tag]);
    names_.push_back(names[tag - 1]);
  }
}

void TagGroups::for_each_of(LocalIndex piece, std::span<const std::int32_t> tags,
                            const Visit& visit) const
{
  const IndexLists rows = rows_by_key(tags, num_tags_ + 1);  // Of tag 0 there is nothing.
  for (const TagCount& first : first_[at(piece)]) {
    const auto group = std::ranges::lower_bound(tags_, first.tag) - tags_.begin();
    visit(static_cast<std::size_t>(group), first.count, rows[first.tag]);
  }
}

ByShape<TagGroups> groups_by_shape(const Outline& outline)
{
  ByShape<TagGroups> groups;
  for (const Shape shape : kShapes)
    groups[shape] = TagGroups::of_elements(outline, std::span(&shape, 1));
  return groups;
}

std::vector<std::int32_t> patches_of_points(const Piece& piece)
{
  std::vector<std::int32_t> patches;
  for (const PatchPoint& point : piece.patch_points) patches.push_back(point.patch);
  return patches;
}

}  // namespace tessera::formats
