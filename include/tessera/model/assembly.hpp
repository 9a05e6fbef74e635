// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/model/options.hpp"

namespace tessera::model {

/// @brief Two solids as the file has them, for people.
struct SolidPair {
  std::array<LocalIndex, 2> numbers{};  ///< From 1, ascending.
  std::array<std::string, 2> names{};   ///< Empty: the file has none.

  static auto fields(auto& self) { return std::tie(self.numbers, self.names); }
};

/// @brief Space that two solids have in common. File length unit.
struct CommonPart {
  SolidPair solids{};
  double volume = 0.0;
  Vec3 low{};  ///< Corners of its box.
  Vec3 high{};

  static auto fields(auto& self) { return std::tie(self.solids, self.volume, self.low, self.high); }
};

/// @brief A gap between two solids that was closed. File length unit.
struct ClosedGap {
  SolidPair solids{};
  double width = 0.0;  ///< The largest that was seen.
  Vec3 place{};        ///< Where that is.

  static auto fields(auto& self) { return std::tie(self.solids, self.width, self.place); }
};

/// @brief A face that was put into solids.
struct EmbeddedPart {
  std::string name{};        ///< Empty: the file has none.
  LocalIndex num_faces = 0;  ///< Pieces of it that solids have.
  double area = 0.0;         ///< Of these; file length unit squared.
  bool is_inside = false;    ///< One of them has one solid of the file on both sides.

  static auto fields(auto& self)
  {
    return std::tie(self.name, self.num_faces, self.area, self.is_inside);
  }
};

/// @brief A line that was put into solids.
struct EmbeddedLine {
  std::string name{};        ///< Empty: the file has none.
  LocalIndex num_edges = 0;  ///< Pieces of it in solids.
  double length = 0.0;       ///< Of these; file length unit.

  static auto fields(auto& self) { return std::tie(self.name, self.num_edges, self.length); }
};

/// @brief What was found where solids meet, and what was put into them.
struct Assembly {
  std::vector<CommonPart> overlaps{};
  std::vector<ClosedGap> gaps{};
  std::vector<EmbeddedPart> embedded{};
  std::vector<EmbeddedLine> lines{};
  double tolerance = 0.0;  ///< By which common faces, their edges and corners may be off; 0: none.

  static auto fields(auto& self)
  {
    return std::tie(self.overlaps, self.gaps, self.embedded, self.lines, self.tolerance);
  }

  /// @brief Whether faces or lines lie inside of solids.
  [[nodiscard]] bool has_inner_parts() const
  {
    return !lines.empty() || std::ranges::any_of(embedded, &EmbeddedPart::is_inside);
  }
};

/// @brief "solid 1 'shaft' and solid 2". Local.
[[nodiscard]] std::string words_of(const SolidPair& solids);

/// @brief For messages: both solids, the volume and the place. Local.
[[nodiscard]] std::string words_of(const CommonPart& part);

/// @brief For messages: both solids, the width and the place. Local.
[[nodiscard]] std::string words_of(const ClosedGap& gap);

}  // namespace tessera::model
