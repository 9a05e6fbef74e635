// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/complex.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "tessera/base/sort_unique.hpp"
#include "tessera/mesh/sorted_rows.hpp"
#include "tessera/mesh/tet_topology.hpp"

namespace tessera::mesh {
namespace {

using Edge = std::array<LocalIndex, 2>;
using Triangle = std::array<LocalIndex, 3>;

LocalIndex index_in(std::span<const LocalIndex> sorted, LocalIndex value)
{
  const auto place = std::lower_bound(sorted.begin(), sorted.end(), value);
  return place != sorted.end() && *place == value ? static_cast<LocalIndex>(place - sorted.begin())
                                                  : kNoIndex;
}

template <std::size_t N>
std::vector<LocalIndex> flat_of(const std::vector<std::array<LocalIndex, N>>& rows)
{
  std::vector<LocalIndex> flat;
  flat.reserve(N * rows.size());
  for (const auto& row : rows) flat.insert(flat.end(), row.begin(), row.end());
  return flat;
}

std::array<Edge, 3> sides_of(const Triangle& v)
{
  return {Edge{v[0], v[1]}, Edge{v[0], v[2]}, Edge{v[1], v[2]}};
}

// Edges of the triangles, numbered in ascending order.
void add_edges(const std::vector<Triangle>& triangles, Complex& out)
{
  std::vector<Edge> sides;
  sides.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    for (const Edge& side : sides_of(triangle)) sides.push_back(side);
  }
  NumberedRows<2> edges = number_rows(sides);
  out.triangle_edges = std::move(edges.row_of);
  out.edge_vertices = flat_of(edges.rows);
}

}  // namespace

LocalIndex find_edge(const Complex& complex, const std::array<LocalIndex, 2>& v)
{
  return find_row<2>(complex.edge_vertices, v);
}

LocalIndex find_triangle(const Complex& complex, const std::array<LocalIndex, 3>& v)
{
  return find_row<3>(complex.triangle_vertices, v);
}

Complex edge_complex(const Skeleton& skeleton, std::span<const LocalIndex> edges)
{
  Complex out;
  out.edge_skeleton.assign(edges.begin(), edges.end());
  for (const LocalIndex e : edges) {
    const LocalIndex* v = &skeleton.edge_vertices[2 * at(e)];
    out.vertex_skeleton.insert(out.vertex_skeleton.end(), v, v + 2);
  }
  const std::vector<LocalIndex> ends = out.vertex_skeleton;
  sort_unique(out.vertex_skeleton);
  for (const LocalIndex v : ends) out.edge_vertices.push_back(index_in(out.vertex_skeleton, v));
  for (const LocalIndex v : out.vertex_skeleton) {
    out.vertex_coarse.push_back(skeleton.vertex_coarse[at(v)]);
  }
  return out;
}

Complex skeleton_complex(const Skeleton& skeleton, std::span<const LocalIndex> triangles)
{
  std::vector<LocalIndex> edges;
  for (const LocalIndex t : triangles) {
    const LocalIndex* e = &skeleton.triangle_edges[3 * at(t)];
    edges.insert(edges.end(), e, e + 3);
  }
  sort_unique(edges);
  Complex out = edge_complex(skeleton, edges);
  out.triangle_skeleton.assign(triangles.begin(), triangles.end());
  for (const LocalIndex t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      out.triangle_vertices.push_back(
          index_in(out.vertex_skeleton, skeleton.triangle_vertices[3 * at(t) + c]));
      out.triangle_edges.push_back(index_in(edges, skeleton.triangle_edges[3 * at(t) + c]));
    }
  }
  return out;
}

Complex skin_complex(const Skeleton& skeleton, LocalIndex subdomain)
{
  return skeleton_complex(skeleton, skeleton.triangles_of(subdomain));
}

namespace {

// Rows of the skeleton by its vertices; kNoIndex for rows with a vertex off it.
template <std::size_t N>
std::vector<LocalIndex> find_rows(std::span<const LocalIndex> flat,
                                  const std::vector<LocalIndex>& vertex_skeleton,
                                  std::span<const LocalIndex> skeleton)
{
  std::vector<LocalIndex> found;
  found.reserve(flat.size() / N);
  for (std::size_t r = 0; N * r < flat.size(); ++r) {
    std::array<LocalIndex, N> row;
    for (std::size_t c = 0; c < N; ++c) row[c] = vertex_skeleton[at(flat[N * r + c])];
    const bool is_off = std::ranges::find(row, kNoIndex) != row.end();
    found.push_back(is_off ? kNoIndex : find_row<N>(skeleton, row));
  }
  return found;
}

void tie_to_skeleton(const Skeleton& skeleton, Complex& complex)
{
  for (const LocalIndex v : complex.vertex_coarse) {
    complex.vertex_skeleton.push_back(index_in(skeleton.vertex_coarse, v));
  }
  const std::vector<LocalIndex>& vertices = complex.vertex_skeleton;
  complex.edge_skeleton = find_rows<2>(complex.edge_vertices, vertices, skeleton.edge_vertices);
  complex.triangle_skeleton =
      find_rows<3>(complex.triangle_vertices, vertices, skeleton.triangle_vertices);
}

}  // namespace

std::array<LocalIndex, 6> edges_of_tet(const TetComplex& complex, LocalIndex tet)
{
  const LocalIndex* corners = &complex.tet_vertices[4 * at(tet)];
  std::array<LocalIndex, 6> edges{};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = kTetEdgeCorners[e];
    const std::size_t off = kTetEdgeCorners[edges.size() - 1 - e][0];  // On the opposite edge.
    const LocalIndex t = complex.tet_triangles[4 * at(tet) + off];
    const LocalIndex lower = std::min(corners[a], corners[b]);
    const LocalIndex upper = std::max(corners[a], corners[b]);
    const LocalIndex* v = &complex.faces.triangle_vertices[3 * at(t)];
    const std::size_t side = lower != v[0] ? 2 : upper == v[1] ? 0 : 1;
    edges[e] = complex.faces.triangle_edges[3 * at(t) + side];
  }
  return edges;
}

namespace {

// Gives each value its rank among the different ones, and returns these, ascending.
// @param[in] bound Above all values.
std::vector<LocalIndex> rank_values(std::vector<LocalIndex>& values, LocalIndex bound)
{
  std::vector<LocalIndex> different;
  if (at(bound) > values.size()) {  // To go through what is not there would take longer.
    different = values;
    sort_unique(different);
    for (LocalIndex& value : values) value = index_in(different, value);
    return different;
  }
  std::vector<LocalIndex> rank(at(bound), kNoIndex);
  for (const LocalIndex value : values) rank[at(value)] = 0;
  for (LocalIndex value = 0; value < bound; ++value) {
    if (rank[at(value)] == kNoIndex) continue;
    rank[at(value)] = static_cast<LocalIndex>(different.size());
    different.push_back(value);
  }
  for (LocalIndex& value : values) value = rank[at(value)];
  return different;
}

}  // namespace

TetComplex tet_complex(const CoarseMesh& coarse, const Skeleton& skeleton,
                       std::span<const LocalIndex> tets)
{
  TetComplex out;
  Complex& faces = out.faces;
  out.tets.assign(tets.begin(), tets.end());
  out.tet_vertices.reserve(4 * tets.size());
  for (const LocalIndex t : tets) {
    const auto tet = coarse.tet(t);
    out.tet_vertices.insert(out.tet_vertices.end(), tet.begin(), tet.end());
  }
  faces.vertex_coarse = rank_values(out.tet_vertices, coarse.num_vertices());
  NumberedRows<3> triangles = number_rows(faces_of_tets(out.tet_vertices));
  out.tet_triangles = std::move(triangles.row_of);
  faces.triangle_vertices = flat_of(triangles.rows);
  add_edges(triangles.rows, faces);
  tie_to_skeleton(skeleton, faces);
  return out;
}

}  // namespace tessera::mesh
