// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tessera/improve/optimizer.hpp"
#include "tessera/improve/region_mesh.hpp"
#include "tessera/improve/region_update.hpp"

namespace tessera::improve {

/// @brief Shapes of some tets, as they are compared before and after.
struct ShapeSummary {
  double min_dihedral_deg = 180.0;
  double min_mean_ratio = 1.0;
  double mean_mean_ratio = 0.0;
};

/// @brief Measures tets; the measure itself is another module's (quality).
using MeasureShapes = std::function<ShapeSummary(const TetMesh&)>;

/// @brief What became of a region.
struct RegionOutcome {
  bool is_accepted = false;
  std::string reason{};       ///< Why the region keeps its old tets; empty if accepted.
  LocalIndex num_splits = 0;  ///< Vertices put in because tets could not be given to a subdomain.
  ShapeSummary before{};
  ShapeSummary after{};                ///< Of the optimised tets, accepted or not.
  std::vector<PieceUpdate> updates{};  ///< By owner; empty unless accepted.
};

/// @brief Why the new tets are not better than the old ones, in words; empty if they are.
///
/// The mean of the mean ratio must rise. The worst tet may not become worse, in smallest dihedral
/// angle and smallest mean ratio, unless it stays better than 15 degrees and 0.4.
[[nodiscard]] std::string refusal(const ShapeSummary& before, const ShapeSummary& after);

/// @brief Optimises a region's tets, gives them back to its subdomains, checks and judges them.
///
/// A tet goes to the subdomain of the nearest old tet among those that hold all of its fixed
/// vertices. So no vertex outside the region changes its identity. Some triangles of the region's
/// boundary face none of its pieces. A tet behind such a triangle stays where it was, so triangles
/// on the geometry stay in their pieces. Where no subdomain may have a tet, it is split.
/// @note Local; a pure function of its arguments. The optimiser takes a while: call it in a job.
/// @throws MeshError if the optimiser gives up or breaks a promise. It promises that
/// the boundary is the old one, fixed vertices have not moved, all tets are positive, the volume is
/// the same (rel. 1e-9), and every subdomain keeps tets in the region. After an error the region
/// keeps its old tets.
[[nodiscard]] RegionOutcome improve_region(const RegionMesh& mesh, const Optimizer& optimizer,
                                           int rounds, const MeasureShapes& measure);

}  // namespace tessera::improve
