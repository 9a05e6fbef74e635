// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::model {

// What faces or solids must have to get a name. All that is given must hold; defaults stand for
// "not given". Lengths are in the output length unit.

/// @brief Faces by what `tessera info` lists of them.
struct FaceCriteria {
  std::vector<LocalIndex> faces{};  ///< FaceDescription::number.
  std::string pattern{};            ///< Of the name in the file, see matches_pattern().
  std::string colour{};             ///< "#RRGGBB".
  Vec3 normal = kNoPoint;           ///< Of all triangles, out of the solid; of any length but 0.
  double tolerance_deg = 0.0;       ///< Of the normal, in (0, 90]; 0: kNormalTolerance_deg.
  Vec3 box_min = kNoPoint;          ///< All triangles lie in that box.
  Vec3 box_max = kNoPoint;

  friend bool operator==(const FaceCriteria&, const FaceCriteria&) = default;
};

/// @brief Solids by what `tessera info` lists of them.
struct SolidCriteria {
  std::vector<LocalIndex> solids{};  ///< From 1.
  std::string pattern{};             ///< Of the name in the file, see matches_pattern().
  Vec3 box_min = kNoPoint;           ///< All triangles lie in that box.
  Vec3 box_max = kNoPoint;

  friend bool operator==(const SolidCriteria&, const SolidCriteria&) = default;
};

/// @brief A plane's triangles are off its normal by rounding only, and neighbours of a face that
/// was chosen are most often off by much more.
inline constexpr double kNormalTolerance_deg = 5.0;

/// @brief A name for faces (patches of the mesh) or solids (its materials); table
/// `[[geometry.name]]` of a case file.
struct PartName {
  std::string name{};
  std::variant<FaceCriteria, SolidCriteria> of{};

  friend bool operator==(const PartName&, const PartName&) = default;
};

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

/// @brief What becomes of faces or curves that a file has beside its solids.
enum class LooseParts : int {
  embed,  ///< The mesh has them where they lie inside of a solid.
  drop,   ///< They are left out.
};
[[nodiscard]] constexpr LooseParts last_value(LooseParts /*type*/) { return LooseParts::drop; }

/// @brief Words of it in case files.
constexpr auto enum_words(LooseParts /*type*/)
{
  return std::to_array<EnumWord<LooseParts>>({
      {LooseParts::embed, "embed"},
      {LooseParts::drop, "drop"},
  });
}

/// @brief A plane piece by its corners, in turn; at least three, in one plane.
struct Polygon {
  std::vector<Vec3> corners{};

  /// @brief Across it, by the right-hand rule; twice its area long.
  [[nodiscard]] Vec3 normal() const;

  static auto fields(auto& self) { return std::tie(self.corners); }
  friend bool operator==(const Polygon&, const Polygon&) = default;
};

/// @brief A plane piece with a round rim.
struct Disk {
  Vec3 centre = kNoPoint;
  Vec3 normal = kNoPoint;  ///< Of any length but 0.
  double radius = 0.0;     ///< > 0.

  static auto fields(auto& self) { return std::tie(self.centre, self.normal, self.radius); }
  friend bool operator==(const Disk&, const Disk&) = default;
};

/// @brief A line of straight pieces, as a well; its points in turn, at least two.
struct Polyline {
  std::vector<Vec3> points{};

  static auto fields(auto& self) { return std::tie(self.points); }
  friend bool operator==(const Polyline&, const Polyline&) = default;
};

/// @brief A face or a line that is put into the solids of a model; table `[[embed]]` of a case
/// file. Lengths are in the output length unit.
struct EmbeddedShape {
  std::string name{};  ///< Of its patch, or of its curve.
  std::variant<Polygon, Disk, Polyline> shape{};

  [[nodiscard]] bool is_line() const { return std::holds_alternative<Polyline>(shape); }

  static auto fields(auto& self) { return std::tie(self.name, self.shape); }
  friend bool operator==(const EmbeddedShape&, const EmbeddedShape&) = default;
};

/// @brief What is wrong with a shape whose values are right one by one; empty if nothing is. Local.
[[nodiscard]] std::string defect_of(const EmbeddedShape& embedded);

/// @brief How solids of a STEP, IGES or BREP file are put together, and what is put into them.
struct AssemblyOptions {
  Overlap overlap = Overlap::error;
  /// Nearer solids touch, and thinner overlaps are none; >= 0. Less than 0: not given, then it is
  /// kThinnest of the diagonal of the model's box.
  double gap = -1.0;
  LooseParts loose_faces = LooseParts::embed;
  LooseParts loose_curves = LooseParts::drop;
  std::vector<EmbeddedShape> embedded{};

  static auto fields(auto& self)
  {
    return std::tie(self.overlap, self.gap, self.loose_faces, self.loose_curves, self.embedded);
  }
  friend bool operator==(const AssemblyOptions&, const AssemblyOptions&) = default;

  /// @brief With lengths times `factor`; a gap that is not given stays so. Local.
  [[nodiscard]] AssemblyOptions scaled(double factor) const;
};

/// @brief Thinner is no more than the rounding between faces that were meant to be one; of the
/// diagonal of the model's box.
inline constexpr double kThinnest = 1e-6;

/// @brief What is done about an STL file whose triangles bound no body: the surface is open, or has
/// edges with more than two triangles, or cuts itself.
enum class StlRepair : int {
  mend,  ///< What invents nothing: points are joined, triangles turned or dropped. Then it is
         ///< refused.
  wrap,  ///< A closed surface is made around the triangles.
};
[[nodiscard]] constexpr StlRepair last_value(StlRepair /*type*/) { return StlRepair::wrap; }

/// @brief Words of it in case files.
constexpr auto enum_words(StlRepair /*type*/)
{
  return std::to_array<EnumWord<StlRepair>>({
      {StlRepair::mend, "mend"},
      {StlRepair::wrap, "wrap"},
  });
}

/// @brief How an STL file is read.
struct StlOptions {
  StlRepair repair = StlRepair::mend;
  /// What a wrap may be off the file, > 0; 0: not given, then it follows from the box.
  double wrap_tolerance = 0.0;

  static auto fields(auto& self) { return std::tie(self.repair, self.wrap_tolerance); }
  friend bool operator==(const StlOptions&, const StlOptions&) = default;
};

/// @brief What a wrap has made of an STL file.
struct Wrap {
  std::string reason{};            ///< Why the file bounds no body; empty: nothing was wrapped.
  LocalIndex num_triangles = 0;    ///< Of the wrap.
  double tolerance = 0.0;          ///< File length unit, as those below.
  double distance_max = 0.0;       ///< From the wrap to the triangles of the file.
  double file_distance_max = 0.0;  ///< From these to the wrap.

  static auto fields(auto& self)
  {
    return std::tie(self.reason, self.num_triangles, self.tolerance, self.distance_max,
                    self.file_distance_max);
  }
  [[nodiscard]] bool is_any() const { return !reason.empty(); }
};

/// @brief With its dot, in lower case. Local.
[[nodiscard]] std::string lower_case_extension(const std::filesystem::path& file);

/// @brief Whether a file's name is that of a tet mesh, which then is the coarse mesh: .msh, .vol or
/// .vtu, in lower or upper case. The file need not exist. Local.
[[nodiscard]] bool is_mesh_name(const std::filesystem::path& file);

/// @brief What is wrong with criteria whose values are right one by one; empty if nothing is.
/// Local.
[[nodiscard]] std::string defect_of(const PartName& name);

/// @brief Readers of STEP and STL.
enum class StepReader : int {
  with_names,  ///< Names, colours, assemblies: goes through most of a file. Joins what touches.
  plain,       ///< Shapes only, and these as they are in the file: for what kills the other one.
};
[[nodiscard]] constexpr StepReader last_value(StepReader /*type*/) { return StepReader::plain; }

}  // namespace tessera::model
