// SPDX-License-Identifier: BSD-3-Clause
#include "decompose/partition/tet_graph.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tessera/base/tet.hpp"
#include "tessera/base/vec3.hpp"

namespace tessera::decompose {
namespace {

// Price of making this triangle part of a seam. The one place to make bad cuts expensive.
double seam_price(const mesh::CoarseMesh& mesh, const mesh::TriangleTets& triangle)
{
  return triangle_area(mesh, triangle);
}

void connect_tets(TetGraph& graph)
{
  const auto num_sides = 4 * static_cast<std::size_t>(graph.num_tets());
  graph.tet_neighbours.assign(num_sides, kNoIndex);
  std::vector<double> price(num_sides);
  const auto& material = graph.mesh->tet_material;
  for (const mesh::TriangleTets& triangle : graph.triangles) {
    const double triangle_price = seam_price(*graph.mesh, triangle);
    for (std::size_t side = 0; side < 2 && triangle.tets[side] != kNoIndex; ++side) {
      const LocalIndex other = triangle.tets[1 - side];
      const auto tet = static_cast<std::size_t>(triangle.tets[side]);
      const auto at = 4 * tet + static_cast<std::size_t>(triangle.corners[side]);
      price[at] = triangle_price;
      if (other != kNoIndex && material[tet] == material[static_cast<std::size_t>(other)]) {
        graph.tet_neighbours[at] = other;
      }
    }
  }
  graph.tet_face_cost = quantise(price);
}

}  // namespace

double triangle_area(const mesh::CoarseMesh& mesh, const mesh::TriangleTets& triangle)
{
  const Vec3 a = mesh.position(triangle.vertices[0]);
  return 0.5
         * norm(cross(mesh.position(triangle.vertices[1]) - a,
                      mesh.position(triangle.vertices[2]) - a));
}

Vec3 centroid_of(const mesh::CoarseMesh& mesh, LocalIndex t)
{
  return tet_centroid(corners_at<4>(mesh.vertex_xyz, mesh.tet_vertices, t));
}

std::vector<std::int32_t> quantise(std::span<const double> values)
{
  constexpr double kWantedMean = 1000.0;  // three digits: finer than any balance that is asked for
  constexpr double kMaxSum = 5e8;         // leaves METIS room to add up in 32 bits
  constexpr double kMaxValue = 1e8;
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const double scale = std::min(kWantedMean * static_cast<double>(values.size()), kMaxSum) / sum;
  std::vector<std::int32_t> integers(values.size());
  const auto to_integer = [&](double value) {
    return static_cast<std::int32_t>(std::lround(std::clamp(scale * value, 1.0, kMaxValue)));
  };
  std::transform(values.begin(), values.end(), integers.begin(), to_integer);
  return integers;
}

TetGraph make_tet_graph(const mesh::CoarseMesh& mesh, std::span<const double> tet_weight)
{
  TetGraph graph;
  graph.mesh = &mesh;
  graph.tet_weight = tet_weight;
  graph.tet_int_weight = quantise(tet_weight);
  graph.triangles = mesh::triangles_of_tets(mesh.tet_vertices);
  connect_tets(graph);
  graph.vertex_tets = rows_by_key(mesh.tet_vertices, mesh.num_vertices(), 4);
  return graph;
}

Graph dual_graph(const TetGraph& graph, std::span<const LocalIndex> tets,
                 std::vector<LocalIndex>& local_index)
{
  Graph dual;
  dual.offsets.reserve(tets.size() + 1);
  dual.vertex_weight.reserve(tets.size());
  LocalIndex next = 0;
  for (const LocalIndex t : tets) local_index[static_cast<std::size_t>(t)] = next++;
  for (const LocalIndex t : tets) {
    const auto cost = graph.face_cost(t);
    for (std::size_t face = 0; face < 4; ++face) {
      const LocalIndex neighbour = graph.neighbours(t)[face];
      if (neighbour == kNoIndex) continue;
      const LocalIndex local = local_index[static_cast<std::size_t>(neighbour)];
      if (local == kNoIndex) continue;
      dual.neighbours.push_back(local);
      dual.edge_weight.push_back(cost[face]);
    }
    dual.offsets.push_back(static_cast<LocalIndex>(dual.neighbours.size()));
    dual.vertex_weight.push_back(graph.tet_int_weight[static_cast<std::size_t>(t)]);
  }
  for (const LocalIndex t : tets) local_index[static_cast<std::size_t>(t)] = kNoIndex;
  return dual;
}

}  // namespace tessera::decompose
