// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/model/model.hpp"
#include "tessera/surface/options.hpp"
#include "tessera/surface/patch_surface.hpp"

namespace tessera::surface {

/// @brief A curve or patch of the model that is in the mesh no more.
struct MergedPart {
  LocalIndex number = kNoIndex;  ///< The Model's, of the curve or surface.
  Vec3 centre{};
  double measure = 0.0;  ///< Length of a curve, area of a patch.

  static auto fields(auto& self) { return std::tie(self.number, self.centre, self.measure); }

  friend bool operator==(const MergedPart&, const MergedPart&) = default;
};

/// @brief What was merged because it is smaller than `coarse.defeature`.
struct Defeatured {
  double tolerance = 0.0;
  std::vector<MergedPart> curves{};   ///< Ascending by number.
  std::vector<MergedPart> patches{};  ///< Ascending by number.
  std::vector<Vec3> places{};         ///< Vertices into which others were merged.

  static auto fields(auto& self)
  {
    return std::tie(self.tolerance, self.curves, self.patches, self.places);
  }

  /// @brief With lengths times `factor`.
  [[nodiscard]] Defeatured scaled(double factor) const;

  [[nodiscard]] bool is_any() const { return !places.empty(); }
};

/// @brief The same parts under other numbers, ascending. Parts that get one number are one part,
/// which is merged if nothing that is left has its number. Local.
/// @param[in] new_number Of each number; kNoIndex: such parts are left out.
/// @param[in] left       Old numbers of what is left, in any order.
[[nodiscard]] std::vector<MergedPart> renumbered(const std::vector<MergedPart>& merged,
                                                 const std::vector<LocalIndex>& new_number,
                                                 const std::vector<LocalIndex>& left);

/// @brief What may be merged.
struct MergeLimits {
  double tolerance = 0.0;  ///< > 0, the surface's unit.
  KeptParts kept{};        ///< No triangle of these patches goes, and no edge of these curves.
  /// Wanted edge length at a place. What is longer than half of it is no small part of the model,
  /// but an edge as it should be. Empty: only the tolerance counts.
  std::function<double(const Vec3&)> size_at{};

  /// @brief What is longer is not small. Of a wall that is as thick as the tolerance, rounding
  /// would merge some places only.
  [[nodiscard]] double most() const { return (1.0 - 1e-6) * tolerance; }
};

/// @brief The point of a curve nearest to a point. `near`: a vertex on the curve and not far away.
/// kNoPoint if the curve is none of the model.
using OnCurve = std::function<Vec3(LocalIndex curve, LocalIndex near, const Vec3& point)>;

/// @brief Merges what is smaller than a tolerance in a surface that follows a model. Local.
///
/// Shorter edges are collapsed, shortest first, onto the end that is bound most: ends
/// of curves, then points of curves, then others. A vertex that is nearer to a curve whose
/// edge is opposite to it goes into this edge. So narrow patches vanish, and of two curves that
/// become one the lower counts. No vertex is moved by more than the tolerance in all. A step is
/// taken if every domain stays bounded by a closed surface, nothing crosses, and nothing folds.
///
/// If something was merged, parameters on curves and patches are dropped. The same arguments give
/// the same bits.
[[nodiscard]] Defeatured defeature(PatchSurface& surface, const OnCurve& on_curve,
                                   const MergeLimits& limits);

/// @brief In coarse_surface.hpp.
struct CoarseSurface;
/// @brief In surface_reference.hpp.
class SurfaceReference;

/// @brief The same of triangles of a model, whose numbers are the surface's. Local.
/// @param[in] reference  Of the same triangles.
/// @throws GeometryError if a projection fails.
[[nodiscard]] Defeatured defeature(PatchSurface& surface, const SurfaceReference& reference,
                                   const model::Model& model, const MergeLimits& limits);

/// @brief The same of a coarse surface, into whose block `defeatured` goes what was merged. Local.
///
/// Parameters of what has changed are good guesses. Vertices keep their numbers, and some are of no
/// face any more.
/// @return Whether anything was merged. @throws GeometryError if a projection fails.
bool defeature(CoarseSurface& surface, const model::Model& model, const MergeLimits& limits);

}  // namespace tessera::surface
