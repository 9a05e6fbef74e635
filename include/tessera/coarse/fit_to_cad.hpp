// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tessera/coarse/own_mesh.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/model.hpp"
#include "tessera/surface/patch_surface.hpp"
#include "tessera/surface/reference.hpp"

namespace tessera::coarse {

/// @brief The surface of a CAD model as triangles, and what the model calls its parts.
struct CadSurface {
  surface::PatchSurface triangles{};        ///< Without patches that have no triangle.
  double size = 0.0;                        ///< Edge length that the triangles were made for, > 0.
  std::vector<LocalIndex> patch_surface{};  ///< Shape (num_patches); the Model's surface number.
  std::vector<LocalIndex> curve_number{};   ///< The Model's number of each curve.
  std::vector<std::string> patch_names{};   ///< Shape (num_patches); empty: no name.
  std::vector<std::string> solid_names{};   ///< Entry m-1 names the CAD's material m.
};

/// @brief Edge length for which a CAD model should be triangulated to fit a mesh to it. Local.
[[nodiscard]] double size_for_fit(const mesh::CoarseMesh& mesh);

/// @brief Puts a mesh to the CAD model that it is a mesh of. Local; a pure function.
///
/// - A boundary triangle goes to the face that has its corners. If several have, the tag of the
///   file decides, if all tags fit; else the nearest one, with the most alike normal.
/// - An edge between triangles of two faces is a segment of the nearest curve of both.
/// - A vertex where segments of several curves end goes onto the nearest end of a curve.
///
/// Patches are the CAD's faces, divided by the tags of the file. One that the file names keeps that
/// name, another one has the CAD's. Materials likewise. The result has no parameters.
/// @param[in] reference Of `cad.triangles`.
/// @param[in] name What messages call the mesh.
/// @throws InputError if the mesh is not one of this model: a vertex is farther off than a tenth of
/// its shortest edge (says the largest distance, and where), a face has no triangles, an edge
/// between two faces lies on no curve of theirs.
[[nodiscard]] mesh::CoarseMesh fit_to_cad(const OwnMesh& own, const CadSurface& cad,
                                          const surface::SurfaceReference& reference,
                                          const model::Model& model, const std::string& name);

}  // namespace tessera::coarse
