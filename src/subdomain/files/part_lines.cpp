// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/part_lines.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/subdomain/mesh_input.hpp"

namespace tessera::subdomain {
namespace {

// Places, ascending: ids may be given anew where a mesh is cut.
using Ends = std::array<Vec3, 2>;

Ends ends_of(std::span<const double> xyz, LocalIndex a, LocalIndex b)
{
  const Vec3 p = point_at(xyz, a);
  const Vec3 q = point_at(xyz, b);
  return {std::min(p, q), std::max(p, q)};
}

Ends ends_of(const mesh::MeshArrays& lines, std::size_t edge)
{
  return ends_of(lines.point_xyz, lines.cell_points[2 * edge], lines.cell_points[2 * edge + 1]);
}

std::set<Vec3> places_of(const mesh::MeshArrays& lines)
{
  std::set<Vec3> places;
  for (std::size_t p = 0; 3 * p < lines.point_xyz.size(); ++p)
    places.insert(point_at(std::span(lines.point_xyz), p));
  return places;
}

// Calls visit(tet, one vertex, other vertex) for the edges of tets between such places.
template <class Visit>
void for_each_edge_between(const std::set<Vec3>& places, std::span<const double> xyz,
                           std::span<const LocalIndex> tet_vertices, const Visit& visit)
{
  std::vector<bool> is_there;
  for (std::size_t p = 0; 3 * p < xyz.size(); ++p)
    is_there.push_back(places.contains(point_at(xyz, p)));
  for (std::size_t t = 0; 4 * t < tet_vertices.size(); ++t) {
    for (const auto& [i, j] : mesh::kTetEdgeCorners) {
      const LocalIndex a = tet_vertices[4 * t + i];
      const LocalIndex b = tet_vertices[4 * t + j];
      if (is_there[at(a)] && is_there[at(b)]) visit(t, a, b);
    }
  }
}

// Of all files one behind the other; points that files share stand in each.
void append(const mesh::MeshArrays& from, mesh::MeshArrays& to)
{
  const auto first = static_cast<LocalIndex>(to.num_points());
  to.point_xyz.insert(to.point_xyz.end(), from.point_xyz.begin(), from.point_xyz.end());
  for (const LocalIndex point : from.cell_points) to.cell_points.push_back(first + point);
  const auto line = from.cell_ints.find("line");
  if (line == from.cell_ints.end()) {
    to.cell_ints["line"].resize(static_cast<std::size_t>(to.num_cells()), 0);
  } else {
    auto& lines = to.cell_ints["line"];
    lines.insert(lines.end(), line->second.begin(), line->second.end());
  }
  to.field_texts.insert(from.field_texts.begin(), from.field_texts.end());
}

}  // namespace

std::optional<mesh::MeshArrays> read_lines(const std::filesystem::path& mesh,
                                           const comm::Communicator& comm)
{
  const auto files = pieces_beside(mesh, "lines.pvtu", comm);
  if (!files) return std::nullopt;
  mesh::MeshArrays all{.vertices_per_cell = 2, .are_edges = true};
  comm::all_or_none(comm, [&] {
    for (const std::filesystem::path& file : *files) {
      const mesh::MeshArrays edges = io::read_vtu(file, io::CellOrder::edges);
      if (edges.vertices_per_cell != 2)
        throw InputError(file.string() + ": edges of second order cannot be cut into parts");
      append(edges, all);
    }
    all.cell_ids.resize(static_cast<std::size_t>(all.num_cells()));
    std::iota(all.cell_ids.begin(), all.cell_ids.end(), 0);
  });
  return all;
}

std::vector<LocalIndex> parts_of_lines(const mesh::MeshArrays& lines,
                                       const migrate::DistributedMesh& mesh,
                                       const comm::Communicator& comm)
{
  // Higher for lower parts, as ranks can tell the largest; 0: no part of this rank.
  constexpr std::uint64_t kTop = std::numeric_limits<std::uint32_t>::max();
  const auto num_edges = static_cast<std::size_t>(lines.num_cells());
  std::map<Ends, std::uint64_t> height_of;
  for (std::size_t e = 0; e < num_edges; ++e) height_of.emplace(ends_of(lines, e), 0);
  for_each_edge_between(places_of(lines), mesh.vertex_xyz, mesh.tet_vertices,
                        [&](std::size_t t, LocalIndex a, LocalIndex b) {
                          const auto found = height_of.find(ends_of(mesh.vertex_xyz, a, b));
                          if (found == height_of.end()) return;
                          found->second = std::max(
                              found->second, kTop - static_cast<std::uint64_t>(mesh.tet_part[t]));
                        });
  std::vector<std::uint64_t> heights;
  for (std::size_t e = 0; e < num_edges; ++e) heights.push_back(height_of.at(ends_of(lines, e)));
  comm.max_in_place(heights);
  std::vector<LocalIndex> parts;
  for (const std::uint64_t height : heights)
    parts.push_back(height == 0 ? kNoIndex : static_cast<LocalIndex>(kTop - height));
  return parts;
}

mesh::MeshArrays lines_of_part(const mesh::MeshArrays& lines, const std::vector<LocalIndex>& parts,
                               LocalIndex part, const mesh::MeshArrays& tets)
{
  std::map<Ends, std::array<LocalIndex, 2>> rows_of;
  for_each_edge_between(places_of(lines), tets.point_xyz, tets.cell_points,
                        [&](std::size_t, LocalIndex a, LocalIndex b) {
                          rows_of.try_emplace(ends_of(tets.point_xyz, a, b), std::array{a, b});
                        });
  mesh::MeshArrays own{.vertices_per_cell = 2, .are_edges = true, .field_texts = lines.field_texts};
  std::map<LocalIndex, LocalIndex> new_row;
  auto& line = own.cell_ints["line"];
  auto& owner = own.point_ints["owner"];
  for (std::size_t e = 0; e < parts.size(); ++e) {
    if (parts[e] != part) continue;
    for (const LocalIndex row : rows_of.at(ends_of(lines, e))) {
      const auto next = static_cast<LocalIndex>(own.point_ids.size());
      const auto [place, is_new] = new_row.try_emplace(row, next);
      own.cell_points.push_back(place->second);
      if (!is_new) continue;
      own.point_ids.push_back(tets.point_ids[at(row)]);
      for (const double x : point_at(std::span(tets.point_xyz), row)) own.point_xyz.push_back(x);
      owner.push_back(tets.point_ints.at("owner")[at(row)]);
    }
    own.cell_ids.push_back(lines.cell_ids[e]);
    line.push_back(lines.cell_ints.at("line")[e]);
  }
  own.cell_ints["subdomain"].assign(line.size(), part);
  return own;
}

}  // namespace tessera::subdomain
