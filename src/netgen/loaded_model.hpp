// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "tessera/coarse/coarse_mesher.hpp"
#include "tessera/coarse/fit_to_cad.hpp"
#include "tessera/coarse/model_figures.hpp"
#include "tessera/model/description.hpp"
#include "tessera/model/model.hpp"
#include "tessera/netgen/factory.hpp"
#include "tessera/surface/reference.hpp"

namespace netgen {
class Mesh;
class NetgenGeometry;
}  // namespace netgen

namespace tessera::netgen {

/// @brief What is done with NETGEN's own form of a mesh, while its geometry still lives.
using NetgenMeshUser = std::function<void(const ::netgen::NetgenGeometry&, ::netgen::Mesh&)>;

/// @brief The same of a surface. NETGEN's lengths are `scale` times those of `ours`.
using NetgenSurfaceUser = std::function<void(const ::netgen::NetgenGeometry&, ::netgen::Mesh&,
                                             double scale, const surface::CoarseSurface& ours)>;

/// @brief A loaded model of any format: projection, and one try at a coarse mesh.
class LoadedModel : public model::Model, public coarse::CoarseMesher {
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

  [[nodiscard]] surface::CoarseSurface mesh_surface(const surface::CoarseOptions& options,
                                                    const cut::CutTree& planes) const final;

  /// @brief The surface of the uncut model. Lets `use` go on with it in NETGEN, if NETGEN made it.
  /// @throws Also what `use` throws.
  [[nodiscard]] virtual surface::CoarseSurface mesh_surface(const surface::CoarseOptions& options,
                                                            const NetgenSurfaceUser& use) const = 0;

  /// @brief The surfaces of the parts that `tree` cuts the model into.
  /// @throws ConfigError if the model has no solids that could be cut.
  [[nodiscard]] virtual surface::CoarseSurface mesh_parts(const surface::CoarseOptions& options,
                                                          const cut::CutTree& tree) const;

  [[nodiscard]] surface::DomainTets fill_domain(const surface::DomainSkin& skin,
                                                const surface::CoarseOptions& options) const final;
  [[nodiscard]] surface::DomainTets improve_domain(const surface::DomainSkin& skin,
                                                   surface::DomainTets tets) const final;

  /// @brief Makes parameters of a coarse mesh exact that are good guesses, if the model has some.
  virtual void locate_parameters(mesh::CoarseMesh& /*mesh*/) const {}

  /// @brief As generate(options), and lets `use` go on with the mesh in NETGEN. There NETGEN can do
  /// what Tessera does otherwise (refine it), so the two can be compared on one coarse mesh.
  /// @throws Also what `use` throws.
  [[nodiscard]] mesh::CoarseMesh generate(const surface::CoarseOptions& options,
                                          const NetgenMeshUser& use) const;
  using CoarseMesher::generate;

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

/// @brief load_model(), as what it is. @throws As load_model().
[[nodiscard]] std::unique_ptr<LoadedModel> load_any_model(const model::ModelSource& source);

// One pair of functions a format; the contracts are those of import_model() and load_model().
[[nodiscard]] model::ModelSource import_csg(const std::filesystem::path& file);
[[nodiscard]] std::unique_ptr<LoadedModel> load_csg(const model::ModelSource& source);

[[nodiscard]] model::ModelSource import_stl(const std::filesystem::path& file,
                                            const model::ImportOptions& options,
                                            StepReader reader = StepReader::with_names);
[[nodiscard]] std::unique_ptr<LoadedModel> load_stl(const model::ModelSource& source);

[[nodiscard]] model::ModelSource import_own_mesh(const std::filesystem::path& file,
                                                 const model::ImportOptions& options,
                                                 StepReader reader);
[[nodiscard]] std::unique_ptr<LoadedModel> load_own_mesh(const model::ModelSource& source);

[[nodiscard]] model::ModelSource import_occ(const std::filesystem::path& file,
                                            const model::ImportOptions& options, StepReader reader);
[[nodiscard]] std::unique_ptr<LoadedModel> load_occ(const model::ModelSource& source);

}  // namespace tessera::netgen
