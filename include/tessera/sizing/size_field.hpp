// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/point_field.hpp"
#include "tessera/sizing/options.hpp"

namespace tessera::sizing {

/// @brief Which edge length is wanted where. A pure function of what it is made of.
///
/// It is the smallest of these, clamped to [size.min, size.max]:
/// - `size.target`, if given;
/// - of every region its size, and outside of it that plus its growth times the distance. The
///   distance to a patch is that to its triangles in the coarse mesh, to a curve that to its
///   segments;
/// - the field, interpolated between its points. First the value of each point is lowered so that
///   along no edge of the field's cells it grows faster than `size.grading`. Outside of the cells
///   it is the value of the nearest point of them, plus `size.grading` times the distance.
///
/// If none of these is given, it is infinite, or size.max.
class SizeField {
 public:
  /// @param[in] options Their field_array has been read from their field.
  /// @param[in] field What stands in `options.field`; null if that is empty.
  /// @throws ConfigError if a region has no sense, meets nothing of the coarse mesh, or names a
  /// patch, material or curve that is not there (with the names that are, nearest first).
  /// @throws InputError if the field has a value that is not positive and finite, no cell with a
  /// volume, or a box that does not meet the model's. Local.
  SizeField(const SizeOptions& options, const mesh::CoarseMesh& coarse,
            const mesh::PointField* field = nullptr);
  ~SizeField();
  SizeField(SizeField&&) noexcept;
  SizeField& operator=(SizeField&&) noexcept;

  /// @brief The wanted edge lengths at many points, output length unit. Local.
  /// @param[in] xyz Shape (num_points, 3). @return Shape (num_points).
  [[nodiscard]] std::vector<double> at(std::span<const double> xyz) const;

  /// @brief Largest growth of the size per length; 0 if it is the same everywhere. In cells of the
  /// field with sharp angles it may grow faster. Local.
  [[nodiscard]] double steepest() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

/// @brief For each edge of a coarse mesh, the integral of 1 / (wanted edge length) along it: the
/// number of edges that it should become. Local; an edge's value does not depend on the other
/// edges, or on its direction.
///
/// Every edge is halved in bulk rounds until no interval is longer than the sizes at its ends, and
/// the size changes along none by more than a third: a small region in the middle of a long edge is
/// seen because the size falls towards it. 2^12 intervals are the most. On every interval the size
/// is taken as linear, and Simpson's rule integrates its inverse: at that growth, with an error
/// below 0.1 %.
/// @param[in] edge_vertices Shape (num_edges, 2). @return Shape (num_edges).
[[nodiscard]] std::vector<double> edge_size_integrals(const mesh::CoarseMesh& coarse,
                                                      std::span<const LocalIndex> edge_vertices,
                                                      const SizeField& sizes);

}  // namespace tessera::sizing
