// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/mesh/orbits.hpp"
#include "tessera/model/model.hpp"
#include "tessera/surface/options.hpp"
#include "tessera/surface/reference.hpp"
#include "tessera/surface/size_function.hpp"

#include "surface/editor.hpp"

namespace tessera::surface {

/// @brief Keeps sides of a surface alike that are images of each other: first their curves, then,
/// once all else is done, their triangles. Local.
class PeriodicRims {
 public:
  /// @param[in] reference Must live on.
  /// @throws GeometryError if a projection fails.
  PeriodicRims(const SurfaceReference& reference, const model::Model& model,
               std::vector<PeriodicPatches> sides);

  [[nodiscard]] bool are_none() const { return sides_.empty(); }

  /// @brief What the triangles of each side want, at the other one.
  [[nodiscard]] std::vector<SizeSource> sizes_of_images(const PatchSurface& surface,
                                                        const SizeFunction& sizes) const;

  /// @brief Gives curves that are images of each other vertices that are, which stay from then on.
  void match(SurfaceEditor& editor) const;

  /// @brief Puts images of the triangles of sides in place of those of their partners.
  /// @throws GeometryError if the rims do not match, with the place.
  void copy_triangles(PatchSurface& surface) const;

 private:
  [[nodiscard]] std::vector<LocalIndex> curves_of(const std::vector<LocalIndex>& patches) const;
  /// Curves of the one side, and their images on the other one.
  [[nodiscard]] std::vector<std::array<LocalIndex, 2>> image_curves(
      const PeriodicPatches& side) const;
  [[nodiscard]] LocalIndex image_of_curve(LocalIndex curve, const Affine& there,
                                          const std::vector<LocalIndex>& candidates) const;
  [[nodiscard]] LocalIndex image_of_patch(LocalIndex patch, const PeriodicPatches& side) const;

  const SurfaceReference& reference_;
  std::vector<PeriodicPatches> sides_;
  std::vector<Affine> images_{Affine{}};
  mesh::OrbitTable curves_{};
};

}  // namespace tessera::surface
