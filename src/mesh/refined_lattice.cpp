// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/refined_lattice.hpp"

#include <utility>

namespace tessera::mesh {

RefinedLattice::RefinedLattice(LatticeLevels levels) : levels_(std::move(levels))
{
  std::size_t num_points = 0;
  for (const std::int8_t level : levels_.edges) {
    first_of_edge_.push_back(num_points);
    num_points += at(lattice::intervals(level)) + 1;
  }
  edge_points_.resize(num_points);
  num_points = 0;
  for (const std::int8_t level : levels_.triangles) {
    first_of_triangle_.push_back(num_points);
    num_points += at(lattice::num_triangle_points(lattice::intervals(level)));
  }
  triangle_points_.resize(num_points);
}

void RefinedLattice::append_triangles(const RefinedLattice& other)
{
  const std::size_t first = triangle_points_.size();
  for (const std::size_t place : other.first_of_triangle_) {
    first_of_triangle_.push_back(first + place);
  }
  levels_.triangles.insert(levels_.triangles.end(), other.levels_.triangles.begin(),
                           other.levels_.triangles.end());
  triangle_points_.insert(triangle_points_.end(), other.triangle_points_.begin(),
                          other.triangle_points_.end());
}

}  // namespace tessera::mesh
