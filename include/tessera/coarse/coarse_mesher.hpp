// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tessera/coarse/coarse_surface.hpp"
#include "tessera/coarse/options.hpp"
#include "tessera/cut/cut_mesh.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/mesh/coarse_mesh.hpp"

namespace tessera::coarse {

/// @brief Makes the coarse mesh of one loaded model, in steps: the surface, then each domain in it.
/// @note Local; any step may crash, exit or hang inside third-party code: run it in a job.
class CoarseMesher {
 public:
  virtual ~CoarseMesher() = default;

  /// @brief One try with these options; the caller has the sequence of fallbacks.
  /// @param[in] planes Into which parts the model is cut before; without nodes: not at all. The
  /// result is in the numbers of the uncut model all the same.
  /// @throws NetgenError with NETGEN's own words if it gives up, or cannot make a part.
  /// @throws GeometryError if the model has no closed solid.
  /// @throws ConfigError if there are planes, but no solids that could be cut: an STL file.
  [[nodiscard]] virtual CoarseSurface mesh_surface(const CoarseOptions& options,
                                                   const cut::CutTree& planes) const = 0;

  /// @brief Fills one domain of such a surface. A pure function of the arguments.
  /// @throws NetgenError with NETGEN's own words if it gives up.
  [[nodiscard]] virtual DomainTets mesh_domain(const DomainSkin& skin,
                                               const CoarseOptions& options) const = 0;

  /// @brief All steps in turn. @throws MeshError also if the result is not a valid mesh.
  [[nodiscard]] cut::CutMesh generate_parts(const CoarseOptions& options,
                                            const cut::CutTree& planes) const;
  [[nodiscard]] mesh::CoarseMesh generate(const CoarseOptions& options) const
  {
    return generate_parts(options, {}).mesh;
  }
};

}  // namespace tessera::coarse
