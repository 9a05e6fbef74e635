// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/layers/options.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/model.hpp"

namespace tessera::layers {

/// @brief How much of the walls of one patch has layers, by the area of coarse triangles.
struct PatchCover {
  LocalIndex patch = 0;
  double area = 0.0;     ///< Output length unit squared.
  double covered = 0.0;  ///< Of that: layers of at least a tenth of their height everywhere.
  double full = 0.0;     ///< Of that: of at least nine tenths.

  static auto fields(auto& self)
  {
    return std::tie(self.patch, self.area, self.covered, self.full);
  }

  /// @brief Adds the areas of another patch.
  void add(const PatchCover& other)
  {
    area += other.area;
    covered += other.covered;
    full += other.full;
  }
};

/// @brief What grow_layers() has made.
struct LayerCover {
  std::vector<PatchCover> patches{};  ///< Those with layers, ascending.

  static auto fields(auto& self) { return std::tie(self.patches); }

  [[nodiscard]] PatchCover sum() const;
};

/// @brief Makes room for layers on the walls of a coarse mesh. Local.
///
/// Vertices on walls move into the material, step by step. At the rim of a wall they stay on the
/// patch, or on the curve, that goes on from there. No step may make a tet flat, turn a triangle of
/// the surface, or fold a column; where one would, its vertices go as far as they can, so layers
/// get thinner where there is no room. Between steps the tets are made better. A mesh of positive
/// tets cannot cut itself, so neither can the layers.
///
/// The result depends on the arguments alone. Periodic sides stay images of each other, and sides
/// of a split without layers stay at the same places.
/// @cite badoiu2008  The direction that sees all triangles around a vertex best.
/// @param[in] keep_tets  Tets stay who they are: none is flipped or merged.
/// @pre mesh::validate() accepts the mesh; it has no layers. @post mesh::validate() accepts it.
/// @throws ConfigError if an entry fits no patch that can be a wall: those between two materials
/// where the mesh is not open cannot, nor can periodic sides.
/// @throws ConfigError if several entries fit one patch, or if the layers are
/// thicker than the model.
/// @throws GeometryError if a projection fails.
[[nodiscard]] LayerCover grow_layers(mesh::CoarseMesh& mesh, std::span<const LayerOptions> options,
                                     const model::Model& model, bool keep_tets);

}  // namespace tessera::layers
