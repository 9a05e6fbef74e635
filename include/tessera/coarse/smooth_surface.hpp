// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <vector>

#include "tessera/coarse/gregory_patch.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/model.hpp"

namespace tessera::coarse {

/// @brief A curved surface through the boundary vertices of a tet mesh, with its sharp edges.
///
/// Every face has a curved patch, and faces meet with one tangent plane along edges that are not
/// sharp. Normals at corners are means over the faces around that no sharp edge separates, at right
/// angles to the sharp edges between which these lie. A sharp edge is a cubic whose tangents are
/// means over its neighbours along the same curve. An edge is sharp by the angle between its faces;
/// one with more than two faces counts as sharp as well. On a circle and a sphere, handles have the
/// length of the circle's arc.
///
/// Parameters say which face or segment is meant: corners of face f are (2f, 0), (2f + 1, 0) and
/// (2f, 1), ends of segment s are 2s and 2s + 1. In between, they are linear. So points are pure
/// functions of parameters, and midpoints of parameters are exact.
class SmoothSurface {
 public:
  /// @param[in] mesh Without segments and parameters.
  /// @param[in] feature_angle_deg Angle between normals from which an edge is sharp, in (0, 180).
  SmoothSurface(const mesh::CoarseMesh& mesh, double feature_angle_deg);

  /// @brief The point with these parameters. Local.
  [[nodiscard]] Vec3 on_face(const model::SurfaceParameters& uv) const;
  [[nodiscard]] Vec3 on_segment(double t) const;

  /// @brief Puts segments, on curve 0 all, and parameters into the mesh of the constructor. Local.
  void add_parameters(mesh::CoarseMesh& mesh) const;

 private:
  using Edge = std::array<LocalIndex, 2>;  // Lower vertex first.

  struct Segment {
    Edge vertices{};
    std::array<Vec3, 4> points{};  // Bezier's, from the first vertex on.
  };

  void find_sharp_edges(double feature_angle_deg);
  void find_normals(double feature_angle_deg);
  void spread_normal(LocalIndex vertex, std::size_t first, std::vector<char>& is_done,
                     double least_cosine);
  [[nodiscard]] Vec3 across_sharp_edges(const Vec3& normal, LocalIndex vertex,
                                        const std::vector<std::size_t>& corners) const;
  void make_segments(double feature_angle_deg);
  void make_patches();
  [[nodiscard]] std::array<Vec3, 2> side_points(LocalIndex face, std::size_t side) const;
  [[nodiscard]] double turn(LocalIndex face, LocalIndex other, const Edge& edge) const;
  [[nodiscard]] Vec3 tangent(LocalIndex vertex, std::size_t segment, double least_cosine) const;

  const mesh::CoarseMesh* mesh_;  // While it is built.
  std::map<Edge, std::vector<LocalIndex>> edge_faces_{};
  std::map<Edge, std::size_t> sharp_{};                        // Row of segments_.
  std::map<LocalIndex, std::vector<std::size_t>> sharp_at_{};  // Segments at a vertex.
  std::vector<Vec3> face_normals_{};
  std::vector<Vec3> corner_normals_{};  // Shape (num_faces, 3).
  std::vector<Segment> segments_{};
  std::vector<GregoryPatch> patches_{};
};

}  // namespace tessera::coarse
