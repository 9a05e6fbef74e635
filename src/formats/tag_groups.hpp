// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tessera/formats/piece.hpp"

namespace tessera::formats {

/// @brief Where entities of a piece stand if those of one tag stand together, piece after piece.
/// Has a group for each tag that the mesh has entities of, in the order of the tags.
class TagGroups {
 public:
  TagGroups() = default;

  /// @brief Of elements of some shapes: of cells by material, of faces by patch.
  [[nodiscard]] static TagGroups of_elements(const Outline& outline, std::span<const Shape> shapes);

  /// @brief Of points by patch: Piece::patch_points.
  [[nodiscard]] static TagGroups of_points(const Outline& outline);

  [[nodiscard]] std::size_t size() const { return tags_.size(); }
  [[nodiscard]] std::int32_t tag(std::size_t group) const { return tags_[group]; }
  [[nodiscard]] GlobalIndex total(std::size_t group) const { return totals_[group]; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  /// @brief Called with a group, how many of it are in pieces before this one, and the rows that
  /// this piece has of it: ascending, at least one.
  using Visit =
      std::function<void(std::size_t group, GlobalIndex first, std::span<const LocalIndex> rows)>;

  /// @brief Visits the groups that a piece has, in their order. Local.
  /// @param[in] tags Of its entities, row by row.
  void for_each_of(LocalIndex piece, std::span<const std::int32_t> tags, const Visit& visit) const;

 private:
  TagGroups(const std::vector<std::string>& names,
            const std::vector<std::vector<TagCount>>& counts_of_pieces);

  std::vector<std::int32_t> tags_{};
  std::vector<GlobalIndex> totals_{};
  std::vector<std::string> names_{};
  std::vector<std::vector<TagCount>> first_{};  // By piece: tag and first place.
  LocalIndex num_tags_ = 0;                     // With those that have nothing.
};

/// @brief Groups of the elements of each shape. Local.
[[nodiscard]] ByShape<TagGroups> groups_by_shape(const Outline& outline);

/// @brief The patches of Piece::patch_points. Local.
[[nodiscard]] std::vector<std::int32_t> patches_of_points(const Piece& piece);

}  // namespace tessera::formats
