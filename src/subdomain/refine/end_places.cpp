// SPDX-License-Identifier: BSD-3-Clause
#include "subdomain/refine/end_places.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "tessera/mesh/triangle_grading.hpp"
#include "tessera/subdomain/piece_surface.hpp"

namespace tessera::subdomain {
namespace {

namespace lattice = mesh::lattice;
using Part = lattice::PointPlace::Part;

// A simplex by the names of its vertices, in ascending order; which of them was where.
template <std::size_t N>
struct NamedSimplex {
  std::array<mesh::HostPoint, N> names{};
  std::array<std::size_t, N> was{};
};

template <std::size_t N>
NamedSimplex<N> sorted(const std::array<mesh::HostPoint, N>& names)
{
  NamedSimplex<N> simplex;
  std::iota(simplex.was.begin(), simplex.was.end(), 0U);
  std::ranges::sort(simplex.was, {}, [&](std::size_t i) { return names[i]; });
  for (std::size_t i = 0; i < N; ++i) simplex.names[i] = names[simplex.was[i]];
  return simplex;
}

template <class Key>
number::SimplexPlace place_in(const std::vector<Key>& keys,
                              const std::vector<number::SimplexPlace>& places, const Key& key)
{
  const auto found = std::ranges::lower_bound(keys, key);
  if (found == keys.end() || *found != key) return {};
  return places[static_cast<std::size_t>(found - keys.begin())];
}

}  // namespace

EndPlaces::EndPlaces(const PieceSurroundings& around, const LayerTables& tables)
    : places_(around.ends), tables_(tables)
{
  if (!places_.vertices.empty()) ends_ = ends_across_joints(around.surface.simplices, tables);
}

number::SimplexPlace EndPlaces::of(const std::array<mesh::HostPoint, 3>& corners, LocalIndex n,
                                   const lattice::TrianglePoint& p) const
{
  if (ends_.vertices.empty()) return {};
  const auto [part, row, k] = lattice::place_of(n, p);
  if (part == Part::corner) return place_in(ends_.vertices, places_.vertices, end(corners[row]));
  if (part == Part::side) {
    const auto [a, b] = mesh::kSideEnds[row];
    const auto side = sorted<2>({end(corners[a]), end(corners[b])});
    number::SimplexPlace place = place_in(ends_.edges, places_.edges, side.names);
    place.first += (side.was[0] == 0 ? k : n - k) - 1;
    return place;
  }
  const auto triangle = sorted<3>({end(corners[0]), end(corners[1]), end(corners[2])});
  number::SimplexPlace place = place_in(ends_.triangles, places_.triangles, triangle.names);
  const std::array<LocalIndex, 3> steps{n - p.i - p.j, p.i, p.j};
  place.first += lattice::inner_triangle_index(n, steps[triangle.was[1]], steps[triangle.was[2]]);
  return place;
}

}  // namespace tessera::subdomain
