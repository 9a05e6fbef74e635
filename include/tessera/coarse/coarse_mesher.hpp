// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "tessera/cut/cut_mesh.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"

namespace tessera::coarse {

/// @brief Makes the coarse mesh of one loaded model, in steps: the surface, then the tets of each
/// domain in it.
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
  [[nodiscard]] virtual surface::CoarseSurface mesh_surface(const surface::CoarseOptions& options,
                                                            const cut::CutTree& planes) const = 0;

  /// @brief Fills one domain of such a surface, or a hole in one, without a lattice. A pure
  /// function of the arguments. Gives up on a hole early.
  /// @throws NetgenError with NETGEN's own words if it gives up.
  [[nodiscard]] virtual surface::DomainTets fill_domain(
      const surface::DomainSkin& skin, const surface::CoarseOptions& options) const = 0;

  /// @brief Tets of one domain of such a surface: with a lattice inside, where that can be done.
  [[nodiscard]] virtual surface::DomainTets mesh_domain(
      const surface::DomainSkin& skin, const surface::CoarseOptions& options) const;

  /// @brief All steps in turn. @throws MeshError also if the result is not a valid mesh.
  [[nodiscard]] cut::CutMesh generate_parts(const surface::CoarseOptions& options,
                                            const cut::CutTree& planes) const;
  [[nodiscard]] mesh::CoarseMesh generate(const surface::CoarseOptions& options) const
  {
    return generate_parts(options, {}).mesh;
  }

 protected:
  /// @brief mesh_domain() of all domains. Shape (num_domains).
  [[nodiscard]] std::vector<surface::DomainTets> mesh_domains(
      const surface::CoarseSurface& surface, const surface::CoarseOptions& options) const;
};

}  // namespace tessera::coarse
