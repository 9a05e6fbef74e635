// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/coarse/coarse_surface.hpp"
#include "tessera/coarse/options.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::coarse {

/// @brief Makes the coarse mesh of one loaded model, in steps: the surface, then each domain in it.
/// @note Local; any step may crash, exit or hang inside third-party code: run it in a job.
class CoarseMesher {
 public:
  virtual ~CoarseMesher() = default;

  /// @brief One try with these options; the caller has the sequence of fallbacks.
  /// @throws NetgenError with NETGEN's own words if it gives up.
  /// @throws GeometryError if the model has no closed solid.
  [[nodiscard]] virtual CoarseSurface mesh_surface(const CoarseOptions& options) const = 0;

  /// @brief Fills one domain of such a surface. A pure function of the arguments.
  /// @throws NetgenError with NETGEN's own words if it gives up.
  [[nodiscard]] virtual DomainTets mesh_domain(const DomainSkin& skin,
                                               const CoarseOptions& options) const = 0;

  /// @brief All steps in turn. @throws MeshError also if the result is not a valid mesh.
  [[nodiscard]] mesh::CoarseMesh generate(const CoarseOptions& options) const;
};

}  // namespace tessera::coarse
