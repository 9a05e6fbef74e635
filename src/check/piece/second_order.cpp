// SPDX-License-Identifier: BSD-3-Clause
#include "check/piece/second_order.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace tessera::check {
namespace {

using EdgeCorners = std::array<std::size_t, 2>;

constexpr std::array<EdgeCorners, 3> kTriangleEdges{{{0, 1}, {1, 2}, {2, 0}}};

std::span<const EdgeCorners> edges_of(const PieceMesh& mesh)
{
  if (mesh.name.is_boundary) return kTriangleEdges;
  return kQuadraticTetEdges;
}

// A node as one cell has it.
struct EdgeNode {
  LocalIndex low = 0;
  LocalIndex high = 0;
  LocalIndex node = 0;
  LocalIndex cell = 0;

  [[nodiscard]] std::array<LocalIndex, 2> edge() const { return {low, high}; }
  friend auto operator<=>(const EdgeNode&, const EdgeNode&) = default;
};

// Whether the nodes are in range and different; sets them so that they count as used.
bool number_nodes(PieceMesh& mesh, LocalIndex cell, std::span<const LocalIndex> vertex_of,
                  std::vector<bool>& is_used)
{
  const std::size_t width = edges_of(mesh).size();
  const auto nodes =
      std::span(mesh.cell_nodes).subspan(static_cast<std::size_t>(cell) * width, width);
  bool is_good = true;
  for (std::size_t i = 0; i < width; ++i) {
    if (nodes[i] < 0 || nodes[i] >= mesh.num_points()) {
      is_good = false;
      continue;
    }
    const auto point = static_cast<std::size_t>(nodes[i]);
    is_used[point] = true;
    nodes[i] = vertex_of[point];
    for (std::size_t j = 0; j < i; ++j) is_good = is_good && nodes[j] != nodes[i];
  }
  return is_good;
}

void report(const PieceMesh& mesh, const EdgeNode& one, const std::string& what, Findings& findings)
{
  findings.add(Kind::edge_node, {mesh.name.piece, one.cell}, [&] {
    return fmt::format("{}: {} {}", describe_cell(mesh, one.cell), describe_point(mesh, one.node),
                       what);
  });
}

std::vector<EdgeNode> edge_nodes(const PieceMesh& mesh)
{
  const std::span<const EdgeCorners> edges = edges_of(mesh);
  std::vector<EdgeNode> all;
  for (LocalIndex c = 0; c < mesh.num_cells(); ++c) {
    if (mesh.is_left_out(c)) continue;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto [low, high] = std::minmax(mesh.cell(c)[edges[e][0]], mesh.cell(c)[edges[e][1]]);
      all.push_back(
          {low, high, mesh.cell_nodes[edges.size() * static_cast<std::size_t>(c) + e], c});
    }
  }
  return all;
}

// Every edge has one node, and every node one edge.
void match_nodes(const PieceMesh& mesh, Findings& findings)
{
  std::vector<bool> is_corner(static_cast<std::size_t>(mesh.num_points()), false);
  for (LocalIndex c = 0; c < mesh.num_cells(); ++c) {
    if (mesh.is_left_out(c)) continue;
    for (const LocalIndex v : mesh.cell(c)) is_corner[static_cast<std::size_t>(v)] = true;
  }
  std::vector<EdgeNode> all = edge_nodes(mesh);
  std::ranges::sort(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_corner[static_cast<std::size_t>(all[i].node)]) {
      report(mesh, all[i], "is a corner and a node of an edge", findings);
    } else if (i > 0 && all[i - 1].edge() == all[i].edge() && all[i - 1].node != all[i].node) {
      report(mesh, all[i], "is not the node that another cell has on the same edge", findings);
    }
  }
  std::ranges::sort(all, {}, [](const EdgeNode& one) { return std::pair(one.node, one.edge()); });
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i - 1].node == all[i].node && all[i - 1].edge() != all[i].edge())
      report(mesh, all[i], "is the node of several edges", findings);
  }
}

}  // namespace

std::vector<LocalIndex> take_nodes(mesh::MeshArrays& arrays)
{
  const bool is_tets = arrays.vertices_per_cell == 10;
  const bool is_second = is_tets || arrays.vertices_per_cell == 6;
  const auto width = static_cast<std::size_t>(arrays.vertices_per_cell);
  if (!is_second || arrays.cell_points.size() % width != 0) return {};
  const std::size_t num_corners = is_tets ? 4 : 3;
  std::vector<LocalIndex> corners;
  std::vector<LocalIndex> nodes;
  for (std::size_t first = 0; first < arrays.cell_points.size(); first += width) {
    const auto cell = std::span(arrays.cell_points).subspan(first, width);
    corners.insert(corners.end(), cell.begin(), cell.begin() + static_cast<long>(num_corners));
    nodes.insert(nodes.end(), cell.begin() + static_cast<long>(num_corners), cell.end());
  }
  arrays.vertices_per_cell = static_cast<int>(num_corners);
  arrays.cell_points = std::move(corners);
  return nodes;
}

void set_nodes(PieceMesh& mesh, std::span<const LocalIndex> vertex_of, std::vector<bool>& is_used,
               Findings& findings)
{
  if (!mesh.is_of_second_order()) return;
  for (LocalIndex c = 0; c < mesh.num_cells(); ++c) {
    if (number_nodes(mesh, c, vertex_of, is_used)) continue;
    findings.add(Kind::cell_points, {mesh.name.piece, c}, [&] {
      return fmt::format("{}: nodes of its edges are out of range or not different",
                         describe_cell(mesh, c));
    });
    mesh.leave_out(c);
  }
  match_nodes(mesh, findings);
}

LocalIndex node_between(const PieceMesh& mesh, LocalIndex cell, LocalIndex a, LocalIndex b)
{
  const auto vertices = mesh.cell(cell);
  const std::span<const EdgeCorners> edges = edges_of(mesh);
  const auto found = std::ranges::find_if(edges, [&](const EdgeCorners& edge) {
    return std::minmax(vertices[edge[0]], vertices[edge[1]]) == std::minmax(a, b);
  });
  return mesh.cell_nodes[edges.size() * static_cast<std::size_t>(cell)
                         + static_cast<std::size_t>(found - edges.begin())];
}

QuadraticTet node_positions(const PieceMesh& mesh, LocalIndex cell)
{
  QuadraticTet nodes;
  for (std::size_t c = 0; c < 4; ++c) nodes[c] = mesh.position(mesh.cell(cell)[c]);
  for (std::size_t e = 0; e < 6; ++e) {
    nodes[4 + e] = mesh.position(mesh.cell_nodes[6 * static_cast<std::size_t>(cell) + e]);
  }
  return nodes;
}

}  // namespace tessera::check
