// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/layers/column_ends.hpp"

#include <algorithm>

#include "tessera/mesh/lattice.hpp"

namespace tessera::subdomain {
namespace {

std::span<const LocalIndex> vertices_of(const mesh::Skeleton& skeleton, mesh::HostKind kind,
                                        const LocalIndex& row)
{
  switch (kind) {
    case mesh::HostKind::edge:
      return std::span(skeleton.edge_vertices).subspan(2 * at(row), 2);
    case mesh::HostKind::triangle:
      return std::span(skeleton.triangle_vertices).subspan(3 * at(row), 3);
    default:
      return {&row, 1};
  }
}

}  // namespace

ColumnEnds::ColumnEnds(const mesh::CoarseMesh& coarse, const mesh::Skeleton& skeleton,
                       mesh::HostKind kind, LocalIndex row, LocalIndex intervals)
    : layers_(coarse.layers), kind_(kind), intervals_(intervals)
{
  for (const LocalIndex v : vertices_of(skeleton, kind, row)) {
    const LocalIndex of_mesh = skeleton.vertex_coarse[at(v)];
    corners_.push_back(
        {layers_.vertex_stack[at(of_mesh)], coarse.position(of_mesh) - layers_.wall(of_mesh)});
  }
  // A corner without a column has no say.
  const auto has_column = [](const Corner& corner) { return corner.column != Vec3{}; };
  const LocalIndex stack = std::ranges::find_if(corners_, has_column)->stack;
  are_alike_ = std::ranges::all_of(
      corners_, [&](const Corner& corner) { return !has_column(corner) || corner.stack == stack; });
  for (const double end : layers_.ends_of(stack)) ends_.push_back({.part = end});
}

std::array<double, 3> ColumnEnds::weights(LocalIndex index) const
{
  const double n = intervals_;
  if (kind_ == mesh::HostKind::edge) return {(n - 1 - index) / n, (index + 1) / n, 0.0};
  const auto [i, j] = mesh::lattice::inner_triangle_point(intervals_, index);
  return {(n - i - j) / n, i / n, j / n};
}

std::span<const LayerEnd> ColumnEnds::at_point(LocalIndex index)
{
  if (are_alike_) return ends_;
  const std::array<double, 3> weight = weights(index);
  for (LocalIndex layer = 0; layer < layers_.most_layers; ++layer) {
    ends_[at(layer)] = mixed_end(weight, layer);
  }
  return ends_;
}

// On a column that is the mean of those of the corners, the layer ends at their mean height, by
// length. It ends aside of it where corners with other heights have other directions.
LayerEnd ColumnEnds::mixed_end(const std::array<double, 3>& weight, LocalIndex layer) const
{
  const auto part_of_height = [&](const Corner& corner) {
    return 1.0 - layers_.ends_of(corner.stack)[at(layer)];
  };
  double length = 0.0;
  double height = 0.0;
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const double of_corner = weight[c] * norm(corners_[c].column);
    length += of_corner;
    height += of_corner * part_of_height(corners_[c]);
  }
  const double mean = height / length;
  Vec3 aside{};
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    aside = aside + (weight[c] * (part_of_height(corners_[c]) - mean)) * corners_[c].column;
  }
  return {.part = 1.0 - mean, .aside = aside};
}

}  // namespace tessera::subdomain
