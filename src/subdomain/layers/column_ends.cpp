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
    const double length = norm(coarse.position(of_mesh) - layers_.wall(of_mesh));
    corners_.push_back({layers_.vertex_stack[at(of_mesh)], length});
  }
  // A corner without a column has no say.
  common_stack_ = std::ranges::max_element(corners_, {}, &Corner::length)->stack;
  are_alike_ = std::ranges::all_of(corners_, [&](const Corner& corner) {
    return corner.length == 0.0 || corner.stack == common_stack_;
  });
}

std::array<double, 3> ColumnEnds::weights(LocalIndex index) const
{
  const LocalIndex n = intervals_;
  if (kind_ == mesh::HostKind::edge) {
    return {static_cast<double>(n - 1 - index), static_cast<double>(index + 1), 0.0};
  }
  const auto [i, j] = mesh::lattice::inner_triangle_point(n, index);
  return {static_cast<double>(n - i - j), static_cast<double>(i), static_cast<double>(j)};
}

std::span<const double> ColumnEnds::at_point(LocalIndex index)
{
  if (are_alike_) return layers_.ends_of(common_stack_);
  const std::array<double, 3> weight = weights(index);
  double length = 0.0;
  for (std::size_t c = 0; c < corners_.size(); ++c) length += weight[c] * corners_[c].length;
  mixed_.clear();
  for (LocalIndex layer = 0; layer < layers_.most_layers; ++layer) {
    double height = 0.0;  // Of the end above the wall.
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      const double end = layers_.ends_of(corners_[c].stack)[at(layer)];
      height += weight[c] * corners_[c].length * (1.0 - end);
    }
    mixed_.push_back(1.0 - height / length);
  }
  return mixed_;
}

}  // namespace tessera::subdomain
