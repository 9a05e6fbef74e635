// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tessera/coarse/own_mesh.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/surface/options.hpp"

#include "geometry/loaded_model.hpp"

namespace tessera::geometry {

/// @brief A coarse mesh by Gmsh, run as a program of its own: its licence then does not reach ours.
///
/// It gets the model as a BREP file, so that it sees what was healed and numbers faces alike, and
/// one thread, so that the same model gives the same mesh. Its mesh is then fitted to the model as
/// one that a user brings.
/// @throws ConfigError if there is no program gmsh, or if the model has no BREP.
/// @throws NetgenError with Gmsh's own words if it gives up, dies or takes too long.
[[nodiscard]] mesh::CoarseMesh mesh_with_gmsh(const LoadedModel& model,
                                              const surface::CoarseOptions& options);

/// @brief Fits a mesh to the CAD model that it is of, with parameters. @throws As fit_to_cad().
[[nodiscard]] mesh::CoarseMesh fitted_mesh(const coarse::OwnMesh& own, const LoadedModel& cad,
                                           const std::string& name);

}  // namespace tessera::geometry
