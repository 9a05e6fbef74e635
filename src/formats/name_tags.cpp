// SPDX-License-Identifier: BSD-3-Clause
#include "formats/name_tags.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

namespace tessera::formats {
namespace {

// Tags by value, for every value that has a name or a cell.
class Tagger {
 public:
  // @param first_value The value that the first name belongs to.
  Tagger(const std::vector<std::string>& names, std::int32_t first_value, const char* kind)
      : names_(names), first_value_(first_value), kind_(kind)
  {
    for (std::size_t i = 0; i < names.size(); ++i) add(first_value + static_cast<std::int32_t>(i));
  }

  void add(const std::vector<TagCount>& counts)
  {
    for (const TagCount& count : counts) add(count.tag);
  }

  // Materials that have one name stay two; patches of one name are one.
  void set_tags(bool joins_equal_names, std::map<std::int32_t, std::int32_t>& tag_of,
                std::vector<std::string>& tag_names)
  {
    for (auto& [value, tag] : tag_of_) {
      std::string name = name_of(value);
      const auto same = std::ranges::find(tag_names, name);
      if (same != tag_names.end() && joins_equal_names) {
        tag = static_cast<std::int32_t>(same - tag_names.begin()) + 1;
        continue;
      }
      if (same != tag_names.end()) name += fmt::format("_{}", value);
      tag_names.push_back(name);
      tag = static_cast<std::int32_t>(tag_names.size());
    }
    tag_of = tag_of_;
  }

 private:
  void add(std::int32_t value) { tag_of_.emplace(value, 0); }

  [[nodiscard]] std::string name_of(std::int32_t value) const
  {
    const auto row = static_cast<std::int64_t>(value) - first_value_;
    const bool is_named = row >= 0 && row < static_cast<std::int64_t>(names_.size())
                          && !names_[static_cast<std::size_t>(row)].empty();
    return is_named ? names_[static_cast<std::size_t>(row)] : fmt::format("{}_{}", kind_, row + 1);
  }

  const std::vector<std::string>& names_;
  std::int32_t first_value_;
  const char* kind_;
  std::map<std::int32_t, std::int32_t> tag_of_{};
};

std::vector<TagCount> tagged(const std::vector<TagCount>& values,
                             const std::map<std::int32_t, std::int32_t>& tag_of)
{
  std::map<std::int32_t, GlobalIndex> sums;
  for (const TagCount& value : values) sums[tag_of.at(value.tag)] += value.count;
  std::vector<TagCount> counts;
  for (const auto& [tag, count] : sums) counts.push_back({tag, count});
  return counts;
}

}  // namespace

Tags name_tags(const FileNames& names, Outline& outline)
{
  Tagger materials(names.materials, 1, "material");
  Tagger patches(names.patches, 0, "patch");
  Tagger lines(names.lines, 0, "line");
  for (const PieceCounts& piece : outline.pieces) {
    for (const Shape shape : kShapes)
      (is_cell(shape) ? materials : patches).add(piece.elements[shape]);
    lines.add(piece.elements[Shape::line]);
  }
  Tags tags;
  materials.set_tags(false, tags.tag_of_material, outline.material_names);
  patches.set_tags(true, tags.tag_of_patch, outline.patch_names);
  lines.set_tags(true, tags.tag_of_line, outline.line_names);
  for (PieceCounts& piece : outline.pieces) {
    piece.elements[Shape::line] = tagged(piece.elements[Shape::line], tags.tag_of_line);
    for (const Shape shape : kShapes) {
      piece.elements[shape] =
          tagged(piece.elements[shape], is_cell(shape) ? tags.tag_of_material : tags.tag_of_patch);
    }
    piece.outer_triangles_of_patch = tagged(piece.outer_triangles_of_patch, tags.tag_of_patch);
  }
  outline.length_unit = names.length_unit;
  return tags;
}

}  // namespace tessera::formats
