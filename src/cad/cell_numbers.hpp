// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"

#include "cad/content.hpp"
#include "cad/cut.hpp"

namespace tessera::cad {

/// @brief Between the numbers of a model and those of the cells that cells_of() makes of it.
class CellNumbers {
 public:
  explicit CellNumbers(CutShape cells);

  /// @brief The cells as a model of their own, with the names of what they are pieces of.
  [[nodiscard]] OccContent content_from(const OccContent& model) const;

  /// @brief Options whose patches and curves are the cells'.
  [[nodiscard]] surface::CoarseOptions options_from(surface::CoarseOptions options) const;

  /// @brief Throws NetgenError with the place where an edge that only parts cells lies on one of
  /// two periodic sides and has no image on the other one. @param[in] options options_from().
  void require_images(const surface::CoarseOptions& options) const;

  /// @brief Gives the patches and curves of the cells' surface the model's numbers. Faces that only
  /// part cells become those of cuts, as CoarseSurface has them. Materials stay the cells'.
  /// @param[in] face_names The model's.
  void number_as_model(const std::vector<std::string>& face_names,
                       surface::CoarseSurface& surface) const;

 private:
  [[nodiscard]] std::vector<Vec3> middles_of_cuts(const std::vector<LocalIndex>& faces) const;
  void renumber_merged(surface::CoarseSurface& surface) const;

  CutShape cells_;
  std::vector<LocalIndex> face_{};  ///< Of each face of the cells: the model's, or kNoIndex.
  std::vector<LocalIndex> edge_{};  ///< The same of edges.
};

}  // namespace tessera::cad
