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

/// @brief What formats list by tag.
enum class Grouped {
  tets,       ///< By material.
  triangles,  ///< By patch.
  points,     ///< By patch: Piece::patch_points.
};

/// @brief Where entities of a piece stand if those of one tag stand together, piece after piece.
/// Has a group for each tag that the mesh has entities of, in the order of the tags.
class TagGroups {
 public:
  /// @param[in] outline Must outlive this.
  TagGroups(const Outline& outline, Grouped what);

  [[nodiscard]] std::size_t size() const { return tags_.size(); }
  [[nodiscard]] std::int32_t tag(std::size_t group) const { return tags_[group]; }
  [[nodiscard]] GlobalIndex total(std::size_t group) const { return totals_[group]; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  /// @brief Called with a group, how many of it are in pieces before this one, and the rows that
  /// this piece has of it: ascending, at least one.
  using Visit =
      std::function<void(std::size_t group, GlobalIndex first, std::span<const LocalIndex> rows)>;

  /// @brief Visits the groups that the piece has, in their order. Local.
  void for_each_of(const Piece& piece, const Visit& visit) const;

 private:
  [[nodiscard]] IndexLists rows_by_tag(const Piece& piece) const;

  Grouped what_;
  std::vector<std::int32_t> tags_{};
  std::vector<GlobalIndex> totals_{};
  std::vector<std::string> names_{};
  std::vector<std::vector<TagCount>> first_{};  // By piece: tag and first place.
  std::size_t num_tags_;                        // With those that have nothing.
};

}  // namespace tessera::formats
