// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "tessera/base/affine.hpp"
#include "tessera/base/enum_words.hpp"
#include "tessera/base/types.hpp"
#include "tessera/mesh/size_points.hpp"

namespace tessera::surface {

/// @brief Who makes the coarse surface. Not a key of a case file: the sequence of fallbacks
/// decides.
enum class SurfaceMesher : int {
  netgen,  ///< NETGEN, on the geometry itself.
  remesh,  ///< remesh(), on OpenCASCADE's triangles or those of the STL file.
};
[[nodiscard]] constexpr SurfaceMesher last_value(SurfaceMesher /*type*/)
{
  return SurfaceMesher::remesh;
}

/// @brief Words of `coarse.surface_mesher` of the report.
constexpr auto enum_words(SurfaceMesher /*tag*/)
{
  return std::to_array<EnumWord<SurfaceMesher>>({
      {SurfaceMesher::netgen, "netgen"},
      {SurfaceMesher::remesh, "remesh"},
  });
}

/// @brief The program that makes the coarse mesh.
enum class Mesher : int {
  netgen,  ///< NETGEN, linked.
  gmsh,    ///< Gmsh, run as a program.
};
[[nodiscard]] constexpr Mesher last_value(Mesher /*type*/) { return Mesher::gmsh; }

/// @brief Words of `coarse.mesher`.
constexpr auto enum_words(Mesher /*tag*/)
{
  return std::to_array<EnumWord<Mesher>>({
      {Mesher::netgen, "netgen"},
      {Mesher::gmsh, "gmsh"},
  });
}

/// @brief Patches and curves that a case names, so that it counts on them. The model's numbers,
/// ascending.
struct KeptParts {
  std::vector<LocalIndex> patches{};
  std::vector<LocalIndex> curves{};

  [[nodiscard]] bool has_patch(LocalIndex patch) const
  {
    return std::ranges::binary_search(patches, patch);
  }
  [[nodiscard]] bool has_curve(LocalIndex curve) const
  {
    return std::ranges::binary_search(curves, curve);
  }

  static auto fields(auto& self) { return std::tie(self.patches, self.curves); }

  friend bool operator==(const KeptParts&, const KeptParts&) = default;
};

/// @brief Patches whose triangles are to be images of those of others. The model's numbers.
struct PeriodicPatches {
  std::vector<LocalIndex> from{};
  std::vector<LocalIndex> to{};
  Affine there{};  ///< From the ones to the others.

  static auto fields(auto& self) { return std::tie(self.from, self.to, self.there); }

  friend bool operator==(const PeriodicPatches&, const PeriodicPatches&) = default;
};

/// @brief Options of the coarse mesh; table `[coarse]` of a case file.
struct CoarseOptions {
  Mesher mesher = Mesher::netgen;
  double max_size = 0.0;   ///< Largest edge that the mesher aims at (some come out longer), output
                           ///< length unit, > 0; 0: size.target says it.
  double grading = 0.3;    ///< Growth of the size away from small features, in (0, 1].
  double curvature = 2.0;  ///< Elements per curvature radius, > 0.
  /// STL: dihedral angle from which an edge is a feature, degrees, in (0, 180).
  double feature_angle_deg = 30.0;

  /// Shorter edges are merged, and narrower faces; output length unit, >= 0; 0: none.
  double defeature = 0.0;
  KeptParts kept{};                         ///< These are not merged, however small.
  std::vector<PeriodicPatches> periodic{};  ///< Found from the model; lengths as of max_size.
  bool has_inner_parts = false;             ///< Faces or lines; only remesh() knows them.

  bool optimize = false;  ///< Whether optimize_interior() follows.

  SurfaceMesher surface_mesher = SurfaceMesher::netgen;

  double timeout_s = 0.0;  ///< CPU seconds of each job of a try; 0: from what the model has.

  /// Largest edges at some places, made from the sizes of the case.
  mesh::SizePoints points{};

  static auto fields(auto& self)
  {
    return std::tie(self.mesher, self.max_size, self.grading, self.curvature,
                    self.feature_angle_deg, self.defeature, self.kept, self.periodic,
                    self.has_inner_parts, self.optimize, self.surface_mesher, self.timeout_s,
                    self.points);
  }

  friend bool operator==(const CoarseOptions&, const CoarseOptions&) = default;
};

}  // namespace tessera::surface
