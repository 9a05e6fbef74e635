// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "tessera/coarse/coarse_mesher.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/surface/coarse_surface.hpp"
#include "tessera/surface/options.hpp"

#include "geometry/loaded_model.hpp"

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

/// @brief A model whose surface NETGEN can mesh.
class MeshedByNetgen {
 public:
  virtual ~MeshedByNetgen() = default;

  /// @brief LoadedModel::mesh_whole(). Lets `use` go on with it in NETGEN, if NETGEN made it.
  /// @throws Also what `use` throws.
  [[nodiscard]] virtual surface::CoarseSurface mesh_whole(const surface::CoarseOptions& options,
                                                          const NetgenSurfaceUser& use) const = 0;
};

/// @brief A model of some format whose surface NETGEN can mesh.
/// @tparam Loaded A LoadedModel.
template <class Loaded>
class NetgenModel : public Loaded, public MeshedByNetgen {
 public:
  using Loaded::Loaded;
  using MeshedByNetgen::mesh_whole;

  [[nodiscard]] surface::CoarseSurface mesh_whole(
      const surface::CoarseOptions& options) const override
  {
    return mesh_whole(options, [](const auto&...) {});
  }
};

/// @brief What load_model() made, seen as a mesher; the model stays the caller's.
class ModelMesher final : public coarse::CoarseMesher {
 public:
  explicit ModelMesher(const geometry::LoadedModel& model) : model_(model) {}

  [[nodiscard]] surface::CoarseSurface mesh_surface(const surface::CoarseOptions& options,
                                                    const cut::CutTree& planes) const override;
  [[nodiscard]] surface::DomainTets fill_domain(
      const surface::DomainSkin& skin, const surface::CoarseOptions& options) const override;

  /// @brief As generate(options), and lets `use` go on with the mesh in NETGEN. There NETGEN can do
  /// what Tessera does otherwise (refine it), so the two can be compared on one coarse mesh.
  /// @throws Also what `use` throws; MeshError if the model is not MeshedByNetgen.
  [[nodiscard]] mesh::CoarseMesh generate(const surface::CoarseOptions& options,
                                          const NetgenMeshUser& use) const;
  using CoarseMesher::generate;

 private:
  const geometry::LoadedModel& model_;
};

}  // namespace tessera::netgen
