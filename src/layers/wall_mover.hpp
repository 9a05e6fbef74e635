// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/model.hpp"

#include "layers/wall_surface.hpp"

namespace tessera::layers {

/// @brief Moves the vertices on walls along their columns, as far as nothing gets bad.
class WallMover {
 public:
  /// @param[in] mesh, model, layers Borrowed; of the layers, the stacks. @param[in] walls Of the
  /// mesh.
  WallMover(mesh::CoarseMesh& mesh, const model::Model& model, WallSurface walls,
            const mesh::WallLayers& layers);

  /// @brief Moves every vertex to that part of its column, or as far as it can go.
  /// @throws GeometryError if a projection fails.
  void move_to(double part);

  /// @brief The mesh has other numbers now: improve_interior().
  void renumber(const std::vector<LocalIndex>& number);

  /// @brief The parameters of vertices on patches and curves without layers become those of their
  /// places now. @throws GeometryError if a projection fails.
  void update_parameters();

  [[nodiscard]] const WallSurface& walls() const { return walls_; }

 private:
  [[nodiscard]] Vec3 place_of(const WallVertex& vertex, double part) const;
  [[nodiscard]] Vec3 place_of_image(const WallVertex& vertex, double part) const;
  [[nodiscard]] Vec3 column_point(const WallVertex& vertex, LocalIndex layer) const;
  /// The point on the curve or patch without layers, if there is one.
  [[nodiscard]] Vec3 beside_wall(const WallVertex& vertex, const Vec3& point) const;
  void place(std::span<const double> parts);
  void find_tets();
  [[nodiscard]] bool has_moved(const WallVertex& vertex) const;
  void update_segments_at(const WallVertex& vertex);
  void update_face(LocalIndex face);
  /// Of the vertices of all that is bad, or of those that these go along with.
  [[nodiscard]] std::vector<LocalIndex> rows_of_bad() const;
  [[nodiscard]] bool is_bad_triangle(const SurfaceTriangle& triangle) const;
  [[nodiscard]] bool is_bad_column(const SurfaceTriangle& triangle) const;

  mesh::CoarseMesh& mesh_;
  const model::Model& model_;
  WallSurface walls_;
  const mesh::WallLayers& layers_;
  std::vector<double> part_{};         ///< By row of walls_.vertices: how far along its column;
                                       ///< counts where a vertex is its own origin.
  std::vector<LocalIndex> tets_{};     ///< With a vertex on a wall.
  std::vector<double> least_ratio_{};  ///< Of these tets, that they must keep.
};

}  // namespace tessera::layers
