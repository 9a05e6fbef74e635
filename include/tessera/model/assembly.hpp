// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::model {

/// @brief What becomes of space that two solids have in common.
enum class Overlap : int {
  error,  ///< The model is refused.
  first,  ///< The solid that comes first in the file has it.
  last,   ///< The solid that comes last has it.
  cut,    ///< It becomes a solid of its own, with the name of the first one.
};
[[nodiscard]] constexpr Overlap last_value(Overlap /*type*/) { return Overlap::cut; }

/// @brief Words of the rule in case files.
constexpr auto enum_words(Overlap /*type*/)
{
  return std::to_array<EnumWord<Overlap>>({
      {Overlap::error, "error"},
      {Overlap::first, "first"},
      {Overlap::last, "last"},
      {Overlap::cut, "cut"},
  });
}

/// @brief Solids that are kept apart where they touch: each has faces of its own there. Table
/// `[[geometry.contact]]` of a case file. Both are a number of `tessera info`, or a name in the
/// file, or a pattern of these, see matches_pattern().
struct Contact {
  std::string body{};
  std::string other{};

  static auto fields(auto& self) { return std::tie(self.body, self.other); }
  friend bool operator==(const Contact&, const Contact&) = default;
};

/// @brief How solids of a STEP, IGES or BREP file are put together.
struct AssemblyOptions {
  Overlap overlap = Overlap::error;
  /// Nearer solids touch, and thinner overlaps are none; >= 0. Less than 0: not given, then it is
  /// kThinnest of the diagonal of the model's box.
  double gap = -1.0;
  std::vector<Contact> contacts{};

  static auto fields(auto& self) { return std::tie(self.overlap, self.gap, self.contacts); }
  friend bool operator==(const AssemblyOptions&, const AssemblyOptions&) = default;
};

/// @brief Thinner is no more than the rounding between faces that were meant to be one; of the
/// diagonal of the model's box.
inline constexpr double kThinnest = 1e-6;

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

/// @brief What was found where solids meet.
struct Assembly {
  std::vector<CommonPart> overlaps{};
  std::vector<ClosedGap> gaps{};
  double tolerance = 0.0;  ///< By which common faces, their edges and corners may be off; 0: none.

  static auto fields(auto& self) { return std::tie(self.overlaps, self.gaps, self.tolerance); }
};

/// @brief "solid 1 'shaft' and solid 2". Local.
[[nodiscard]] std::string words_of(const SolidPair& solids);

/// @brief For messages: both solids, the volume and the place. Local.
[[nodiscard]] std::string words_of(const CommonPart& part);

/// @brief For messages: both solids, the width and the place. Local.
[[nodiscard]] std::string words_of(const ClosedGap& gap);

}  // namespace tessera::model
