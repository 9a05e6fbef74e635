// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/fields.hpp"
#include "tessera/base/types.hpp"
#include "tessera/check/report.hpp"

namespace tessera::check {

/// @brief Kinds of defects, in the order of the report.
enum class Kind {
  no_tets,
  arrays,
  cell_points,
  non_finite_point,
  non_positive_volume,
  non_positive_jacobian,
  edge_node,
  unused_point,
  duplicate_point,
  split_point,
  periodic_point,
  duplicate_tet,
  point_position,
  point_id_twice,
  point_id_hole,
  cell_id_twice,
  cell_id_hole,
  triangle,
  boundary_edge,
  folded_boundary,
  boundary_missing,
  boundary_extra,
  boundary_twice,
  boundary_tet,
  boundary_orientation,
  boundary_subdomain,
  boundary_point,
  num_kinds
};
inline constexpr auto kNumKinds = static_cast<std::size_t>(Kind::num_kinds);

/// @brief Names of the kinds in the report; stable, for scripts.
constexpr auto enum_words(Kind /*tag*/)
{
  return std::to_array<EnumWord<Kind>>({
      {Kind::no_tets, "no_tets"},
      {Kind::arrays, "arrays"},
      {Kind::cell_points, "cell_points"},
      {Kind::non_finite_point, "non_finite_point"},
      {Kind::non_positive_volume, "non_positive_volume"},
      {Kind::non_positive_jacobian, "non_positive_jacobian"},
      {Kind::edge_node, "edge_node"},
      {Kind::unused_point, "unused_point"},
      {Kind::duplicate_point, "duplicate_point"},
      {Kind::split_point, "split_point"},
      {Kind::periodic_point, "periodic_point"},
      {Kind::duplicate_tet, "duplicate_tet"},
      {Kind::point_position, "point_position"},
      {Kind::point_id_twice, "point_id_twice"},
      {Kind::point_id_hole, "point_id_hole"},
      {Kind::cell_id_twice, "cell_id_twice"},
      {Kind::cell_id_hole, "cell_id_hole"},
      {Kind::triangle, "triangle"},
      {Kind::boundary_edge, "boundary_edge"},
      {Kind::folded_boundary, "folded_boundary"},
      {Kind::boundary_missing, "boundary_missing"},
      {Kind::boundary_extra, "boundary_extra"},
      {Kind::boundary_twice, "boundary_twice"},
      {Kind::boundary_tet, "boundary_tet"},
      {Kind::boundary_orientation, "boundary_orientation"},
      {Kind::boundary_subdomain, "boundary_subdomain"},
      {Kind::boundary_point, "boundary_point"},
  });
}
static_assert(kWords<Kind>.size() == kNumKinds);

/// @brief Order of the offenders of one kind; independent of the rank that finds them.
struct Place {
  GlobalIndex piece = 0;   ///< -1: not of one piece.
  GlobalIndex entity = 0;  ///< Cell, point or id.

  static auto fields(auto& self) { return std::tie(self.piece, self.entity); }

  friend auto operator<=>(const Place&, const Place&) = default;
};

/// @brief Counts defects and keeps the first few of each kind; texts are made only for those.
class Findings {
 public:
  static constexpr std::size_t kNumKept = 10;

  /// @brief Counts a defect; `describe()` returns its text and is called only if it may be kept.
  template <class Describe>
  void add(Kind kind, Place place, Describe&& describe)
  {
    Entry& entry = entries_[static_cast<std::size_t>(kind)];
    ++entry.count;
    if (entry.kept.size() == kNumKept && entry.kept.back().place < place) return;
    keep(entry, {place, describe()});
  }

  /// @brief Counts defects of which enough were described already.
  void add_uncited(Kind kind, GlobalIndex num_more)
  {
    entries_[static_cast<std::size_t>(kind)].count += num_more;
  }

  [[nodiscard]] GlobalIndex count(Kind kind) const
  {
    return entries_[static_cast<std::size_t>(kind)].count;
  }

  /// @brief Adds what another rank or pass found, but only the kinds given.
  void merge(const Findings& other, std::span<const Kind> kinds);
  /// @brief Adds all that another rank found.
  void merge(const Findings& other);

  [[nodiscard]] std::vector<Defect> to_defects() const;

 private:
  friend FieldAccess;

  struct Finding {
    Place place{};
    std::string text{};

    static auto fields(auto& self) { return std::tie(self.place, self.text); }

    friend auto operator<=>(const Finding&, const Finding&) = default;
  };
  struct Entry {
    GlobalIndex count = 0;
    std::vector<Finding> kept{};  // ascending

    static auto fields(auto& self) { return std::tie(self.count, self.kept); }
  };
  static auto fields(auto& self) { return std::tie(self.entries_); }

  static void keep(Entry& entry, Finding finding);
  static void merge(Entry& into, const Entry& from);

  std::array<Entry, kNumKinds> entries_{};
};

/// @brief "(x, y, z)" with the digits that tell two doubles apart.
[[nodiscard]] std::string to_text(std::span<const double, 3> position);

}  // namespace tessera::check
