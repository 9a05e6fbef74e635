// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/mesh_arrays.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

#include "pipeline/drawing/canvas.hpp"

namespace tessera::pipeline {

/// @brief A picture of the mesh as a PNG file.
struct MeshPicture {
  std::string name{};  ///< "subdomains", "patches" or "cut".
  Bytes png{};
};

/// @brief Colours of tets in the cut, by tenths of the mean ratio: red is bad, blue is good.
[[nodiscard]] const std::vector<Colour>& quality_colours();

/// @brief The plane that cuts the mesh open, across the shortest side of its box and near the
/// middle. What is on the eye's side of it is not drawn.
struct CutPlane {
  std::size_t axis = 0;
  double towards_eye = 1.0;  ///< Along the axis: 1 or -1.
  double position = 0.0;     ///< On the axis, output length unit.

  /// @brief Distance on the eye's side; what is not positive stays.
  [[nodiscard]] double height(const Vec3& p) const { return towards_eye * (p[axis] - position); }
};

/// @brief Three pictures of a mesh in the making: by subdomain, by patch, and cut open with the
/// quality of its tets. Each rank draws what it has; then the canvases are put together. All
/// functions are Local.
class MeshScene {
 public:
  /// @param[in] xyz Shape (num_points, 3): the points that the pictures must have room for.
  explicit MeshScene(std::span<const double> xyz);

  /// @brief Draws triangles of the geometry from a boundary file, of either order.
  void draw_boundary(const mesh::MeshArrays& boundary);

  /// @brief Draws the outside of some subdomains with the triangles of the coarse mesh.
  /// @param[in] is_made By subdomain.
  void draw_coarse_boundary(const subdomain::PartitionedMesh& cut,
                            const std::vector<char>& is_made);

  /// @brief Draws the tets of a file that the plane cuts, of either order.
  void draw_cut_tets(const mesh::MeshArrays& tets);

  /// @brief Draws the coarse tets of a subdomain that the plane cuts, all with one mean ratio.
  void draw_coarse_cut(const subdomain::PartitionedMesh& cut, LocalIndex subdomain,
                       double mean_ratio);

  /// @brief Whether the plane may cut tets of a subdomain. Its tets may bulge from its coarse tets
  /// where the geometry is curved.
  [[nodiscard]] bool is_cut(const subdomain::PartitionedMesh& cut, LocalIndex subdomain) const;

  /// @brief To be put together with those of the other ranks, before the pictures are made.
  [[nodiscard]] std::array<Canvas*, 3> canvases() { return {&subdomains_, &patches_, &cut_}; }

  [[nodiscard]] std::vector<MeshPicture> pictures() const;

 private:
  using Triangle = std::array<Vec3, 3>;

  void draw_surface(const Triangle& corners, LocalIndex subdomain, LocalIndex patch, Sides sides);
  void draw_cut_tet(const std::array<Vec3, 4>& corners, double mean_ratio);

  CutPlane plane_;
  Canvas subdomains_;
  Canvas patches_;
  Canvas cut_;
};

}  // namespace tessera::pipeline
