// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tuple>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/model/model.hpp"
#include "tessera/surface/defeature.hpp"

namespace tessera::coarse {

/// @brief How far the vertices of a coarse mesh are from the surfaces and curves they belong to.
struct VertexDistance {
  double largest = 0.0;      ///< Over all vertices on the geometry.
  LocalIndex num_off = 0;    ///< Vertices farther off than what counts as within tolerance.
  double largest_off = 0.0;  ///< Over these.
  Vec3 farthest_off{};       ///< Where that one is.
  /// Vertices farther off than the tolerance of their surface or curve, but within that of a CAD
  /// vertex there, or by less than kMostOfEdgeOff of an edge.
  LocalIndex num_within = 0;
  double largest_within = 0.0;  ///< Over these.
  /// Vertices farther off than the tolerance of their surface or curve because others were merged
  /// into them.
  LocalIndex num_merged = 0;
  double largest_merged = 0.0;  ///< Over these.

  /// @brief The same of a mesh whose lengths are `factor` times as long.
  [[nodiscard]] VertexDistance scaled(double factor) const;

  static auto fields(auto& self)
  {
    return std::tie(self.largest, self.num_off, self.largest_off, self.farthest_off,
                    self.num_within, self.largest_within, self.num_merged, self.largest_merged);
  }
};

/// @brief A vertex that is off by this part of its shortest edge changes nothing that a mesh is
/// for: faces turn by 0.006 degrees. An edge of length h is off a surface of radius R by h² / 8R in
/// its middle, ten times as much already for 125 edges a radius.
inline constexpr double kMostOfEdgeOff = 1e-4;

/// @brief Moves vertices that are off their patch or curve by more than its tolerance onto it, and
/// measures what is left. Local.
///
/// A vertex moves only as far as the tets around it stay sound. A vertex between patches or at the
/// end of curves is measured only: no single projection says where it belongs.
/// @param[in] merged  What was merged: a vertex at such a place may be off by the tolerance.
/// @throws GeometryError if a projection fails.
VertexDistance snap_vertices(mesh::CoarseMesh& mesh, const model::Model& model,
                             const surface::Defeatured& merged = {});

}  // namespace tessera::coarse
