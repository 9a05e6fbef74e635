// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "tessera/coarse/fit_to_cad.hpp"
#include "tessera/coarse/model_figures.hpp"
#include "tessera/cut/cut_tree.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/description.hpp"
#include "tessera/model/model.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"
#include "tessera/surface/reference.hpp"

namespace tessera::geometry {

/// @brief A loaded model of any format: projection, and one try at a coarse surface.
class LoadedModel : public model::Model {
 public:
  /// @brief What the model holds, for people. @throws NetgenError
  [[nodiscard]] virtual model::ModelDescription describe(surface::SurfaceMesher mesher) const = 0;

  /// @brief Number and name of a curve.
  [[nodiscard]] virtual mesh::NamedCurve named_curve(LocalIndex curve) const
  {
    return {.curve = curve, .number = std::to_string(curve + 1)};
  }

  /// @brief How much there is to mesh; zeros if nothing is. @throws NetgenError
  [[nodiscard]] virtual coarse::ModelFigures figures() const { return {}; }

  /// @brief The surface of the model, or of the parts that `planes` cut it into, with small parts
  /// merged and mends: CoarseMesher::mesh_surface() by the options' surface mesher.
  [[nodiscard]] surface::CoarseSurface mesh_surface(const surface::CoarseOptions& options,
                                                    const cut::CutTree& planes) const;

  /// @brief The surface of the uncut model, without mends.
  [[nodiscard]] virtual surface::CoarseSurface mesh_whole(
      const surface::CoarseOptions& options) const = 0;

  /// @brief The surfaces of the parts that `tree` cuts the model into.
  /// @throws ConfigError if the model has no solids that could be cut.
  [[nodiscard]] virtual surface::CoarseSurface mesh_parts(const surface::CoarseOptions& options,
                                                          const cut::CutTree& tree) const;

  /// @brief Makes parameters of a coarse mesh exact that are good guesses, if the model has some.
  virtual void locate_parameters(mesh::CoarseMesh& /*mesh*/) const {}

  /// @brief The surface as triangles with edges of about that length, to fit a mesh to it.
  /// @throws NetgenError, ConfigError if the model is a mesh.
  [[nodiscard]] virtual coarse::CadSurface triangles_for_fit(double size) const = 0;

  /// @brief Writes the model as a BREP file, its faces in the order of their numbers.
  /// @throws ConfigError if it is none of OpenCASCADE's.
  virtual void write_brep(const std::filesystem::path& file) const;

  /// @brief Puts parameters into a mesh that fit_to_cad() made, if the model has some.
  /// @param[in] reference Of triangles_for_fit().
  virtual void add_parameters(const surface::SurfaceReference& /*reference*/,
                              mesh::CoarseMesh& /*mesh*/) const
  {
  }
};

/// @brief A model of load_model(), as what it is. Local. @throws MeshError if it is none.
[[nodiscard]] const LoadedModel& as_loaded(const model::Model& model);

/// @brief Fills in CoarseMesh::curves of a mesh of the model. Local. @throws As as_loaded().
void name_curves(const model::Model& model, mesh::CoarseMesh& mesh);

}  // namespace tessera::geometry
