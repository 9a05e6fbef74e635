// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/refine/split_names.hpp"

namespace tessera::subdomain {

namespace lattice = mesh::lattice;
using Part = lattice::PointPlace::Part;

SplitNames::SplitNames(const SplitSurface& surface, const mesh::Skeleton& skeleton)
    : surface_(surface), skeleton_(skeleton), hosts_(skeleton)
{
}

mesh::HostEntity SplitNames::host_of(const SkeletonPoint& point) const
{
  const LocalIndex n = surface_.intervals_of_triangle(point.triangle);
  const auto [part, row, k] = lattice::place_of(n, point.p);
  const std::size_t place = 3 * at(point.triangle) + row;
  if (part == Part::corner) return hosts_.vertex(skeleton_.triangle_vertices[place]);
  if (part == Part::side) return hosts_.edge(skeleton_.triangle_edges[place]);
  return hosts_.triangle(point.triangle);
}

mesh::HostPoint SplitNames::of(const SkeletonPoint& point)
{
  const mesh::HostEntity host = host_of(point);
  const LocalIndex n = surface_.intervals_of_triangle(point.triangle);
  const LocalIndex k = lattice::place_of(n, point.p).steps;
  switch (hosts_.kind_of(host)) {
    case mesh::HostKind::vertex:
      return {host, 0};
    case mesh::HostKind::edge:
      return {host, k * surface_.intervals_of_skeleton_edge(hosts_.row_of(host)) / n - 1};
    default:
      return {host, numbers_of(point.triangle).of(point.p)};
  }
}

mesh::HostPoint SplitNames::of(const mesh::HostPoint& before)
{
  const LocalIndex row = hosts_.row_of(before.host);
  switch (hosts_.kind_of(before.host)) {
    case mesh::HostKind::edge:
      return {before.host, (before.index + 1) * surface_.intervals() - 1};
    case mesh::HostKind::triangle: {
      const LocalIndex own = lattice::intervals(surface_.grading_of(row).level);
      const LocalIndex step = surface_.intervals_of_triangle(row) / own;
      const auto [i, j] = lattice::inner_triangle_point(own, before.index);
      return {before.host, numbers_of(row).of({i * step, j * step})};
    }
    default:
      return before;
  }
}

const mesh::SplitPointNumbers& SplitNames::numbers_of(LocalIndex triangle)
{
  const auto found = numbers_.find(triangle);
  if (found != numbers_.end()) return found->second;
  const mesh::SplitPointNumbers numbers(surface_.grading_of(triangle), surface_.intervals());
  return numbers_.emplace(triangle, numbers).first->second;
}

}  // namespace tessera::subdomain
