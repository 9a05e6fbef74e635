// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/sort_along_curve.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "tessera/base/flat_array.hpp"
#include "tessera/base/morton_order.hpp"
#include "tessera/base/tet.hpp"

namespace tessera::mesh {
namespace {

// Rows of `width` values, in this order.
template <class T>
void reorder(const std::vector<LocalIndex>& order, std::size_t width, FlatArray<T>& rows)
{
  FlatArray<T> sorted;
  sorted.reserve(rows.size());
  for (const LocalIndex row : order) {
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(width * at(row));
    sorted.insert(sorted.end(), first, first + static_cast<std::ptrdiff_t>(width));
  }
  rows = std::move(sorted);
}

void sort_vertices(CoarseMesh& mesh)
{
  const std::vector<LocalIndex> order = morton_order(mesh.vertex_xyz);
  std::vector<LocalIndex> number(order.size());
  for (std::size_t place = 0; place < order.size(); ++place) {
    number[at(order[place])] = static_cast<LocalIndex>(place);
  }
  reorder(order, 3, mesh.vertex_xyz);
  for (auto* const vertices : {&mesh.tet_vertices, &mesh.face_vertices, &mesh.segment_vertices}) {
    for (LocalIndex& v : *vertices) v = number[at(v)];
  }
}

}  // namespace

void sort_along_curve(CoarseMesh& mesh)
{
  sort_vertices(mesh);
  std::vector<double> centroids;
  centroids.reserve(3 * at(mesh.num_tets()));
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const Vec3 centroid = tet_centroid(corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t));
    centroids.insert(centroids.end(), centroid.begin(), centroid.end());
  }
  const std::vector<LocalIndex> order = morton_order(centroids);
  reorder(order, 4, mesh.tet_vertices);
  reorder(order, 1, mesh.tet_material);
}

}  // namespace tessera::mesh
