// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tessera/base/vec3.hpp"

namespace tessera::sizing {

// Shapes of a region; all lengths in the output length unit. Defaults stand for "not given".

/// @brief A box along the axes, its corners included.
struct Box {
  Vec3 min = kNoPoint;
  Vec3 max = kNoPoint;  ///< Not below `min` in any coordinate.

  friend bool operator==(const Box&, const Box&) = default;
};

/// @brief A ball, its surface included.
struct Ball {
  Vec3 centre = kNoPoint;
  double radius = 0.0;  ///< > 0.

  friend bool operator==(const Ball&, const Ball&) = default;
};

/// @brief A straight cylinder with flat ends.
struct Cylinder {
  Vec3 start = kNoPoint;  ///< Middle of one end.
  Vec3 end = kNoPoint;    ///< Middle of the other end, not the same point.
  double radius = 0.0;    ///< > 0.

  friend bool operator==(const Cylinder&, const Cylinder&) = default;
};

/// @brief All on one side of a plane.
struct HalfSpace {
  Vec3 point = kNoPoint;   ///< On the plane.
  Vec3 normal = kNoPoint;  ///< Out of the half-space, as that of a `plane` in a .geo file; of any
                           ///< length but 0.

  friend bool operator==(const HalfSpace&, const HalfSpace&) = default;
};

/// @brief The triangles of all patches with that name, or whose names match it as a pattern of the
/// shell: `*` stands for any characters, `?` for one, `[ab]` for one of these.
struct PatchPattern {
  std::string pattern{};

  friend bool operator==(const PatchPattern&, const PatchPattern&) = default;
};

/// @brief The tets of all materials whose names match; as of PatchPattern.
struct MaterialPattern {
  std::string pattern{};

  friend bool operator==(const MaterialPattern&, const MaterialPattern&) = default;
};

/// @brief The segments of all curves whose number in `tessera info`, or whose name in the file
/// matches; as of PatchPattern.
struct CurvePattern {
  std::string pattern{};

  friend bool operator==(const CurvePattern&, const CurvePattern&) = default;
};

using Shape =
    std::variant<Box, Ball, Cylinder, HalfSpace, PatchPattern, MaterialPattern, CurvePattern>;

/// @brief A size in a part of space; table `[[size.region]]` of a case file.
struct SizeRegion {
  Shape shape{};
  double size = 0.0;    ///< Wanted edge length inside, output length unit, > 0.
  double growth = 0.0;  ///< Growth of the size per length outside, in (0, 1]; 0: size.grading.

  friend bool operator==(const SizeRegion&, const SizeRegion&) = default;
};

/// @brief Which edge length is wanted where; table `[size]` of a case file.
struct SizeOptions {
  /// Wanted edge length, output length unit, > 0; 0: not given, then coarse.max_size and
  /// refine.levels say it.
  double target = 0.0;
  /// No size below this is wanted, and smaller features of the model are merged; output length
  /// unit, >= 0; 0: nothing is. Less than 0: not given; then a twentieth of the target counts for
  /// features, and sizes have no bound.
  double min = -1.0;
  double max = 0.0;        ///< No size above this is wanted, output length unit; 0: no bound.
  double grading = 0.3;    ///< Largest growth of the size per length, in (0, 1].
  double curvature = 0.0;  ///< Edges per radius of curvature that the surface has at least; 0: as
                           ///< the coarse mesh makes them.

  std::filesystem::path field{};      ///< File with sizes at points; empty: none.
  std::string field_array = "size";   ///< Its point array.
  std::vector<SizeRegion> regions{};  ///< The smallest size wins.

  friend bool operator==(const SizeOptions&, const SizeOptions&) = default;
};

/// @brief Whether different sizes may be wanted at different places. Local.
[[nodiscard]] inline bool is_graded(const SizeOptions& options)
{
  return !options.regions.empty() || !options.field.empty();
}

/// @brief Whether the case says which size is wanted, if only at some places. Else all coarse edges
/// are split alike. Local.
[[nodiscard]] inline bool are_wanted(const SizeOptions& options)
{
  return options.target > 0.0 || options.max > 0.0 || options.curvature > 0.0 || is_graded(options);
}

/// @brief The shape's word in a case file: "box", "ball", "cylinder", "halfspace", "patch",
/// "material" or "curve". Local.
[[nodiscard]] std::string_view word_of(const Shape& shape);

/// @brief What is wrong with a region whose keys have values that are right one by one; empty if
/// nothing is. Local.
[[nodiscard]] std::string defect_of(const SizeRegion& region);

}  // namespace tessera::sizing
