// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/part_lines.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/subdomain/mesh_input.hpp"

namespace tessera::subdomain {
namespace {

using Ends = std::array<GlobalIndex, 2>;  // Ids, ascending.

Ends ends_of(const mesh::MeshArrays& edges, std::size_t edge)
{
  const auto id = [&](std::size_t end) {
    return edges.point_ids[at(edges.cell_points[2 * edge + end])];
  };
  return {std::min(id(0), id(1)), std::max(id(0), id(1))};
}

// Of all files one behind the other; points that files share stand in each.
void append(const mesh::MeshArrays& from, mesh::MeshArrays& to)
{
  const auto first = static_cast<LocalIndex>(to.num_points());
  to.point_xyz.insert(to.point_xyz.end(), from.point_xyz.begin(), from.point_xyz.end());
  to.point_ids.insert(to.point_ids.end(), from.point_ids.begin(), from.point_ids.end());
  to.cell_ids.insert(to.cell_ids.end(), from.cell_ids.begin(), from.cell_ids.end());
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
      const bool has_ids = edges.point_ids.size() == static_cast<std::size_t>(edges.num_points())
                           && edges.cell_ids.size() == static_cast<std::size_t>(edges.num_cells());
      if (edges.vertices_per_cell != 2 || !has_ids) {
        throw InputError(file.string() + ": edges on lines need two points each, and ids");
      }
      append(edges, all);
    }
  });
  return all;
}

std::vector<LocalIndex> parts_of_lines(const mesh::MeshArrays& lines,
                                       const migrate::DistributedMesh& mesh,
                                       const comm::Communicator& comm)
{
  std::map<Ends, std::size_t> row_of;
  std::vector<bool> is_on_line(at(mesh.num_vertices()), false);
  const auto num_edges = static_cast<std::size_t>(lines.num_cells());
  for (std::size_t e = 0; e < num_edges; ++e) row_of.emplace(ends_of(lines, e), e);
  std::vector<GlobalIndex> ids(lines.point_ids);
  std::ranges::sort(ids);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    is_on_line[at(v)] = std::ranges::binary_search(ids, mesh.vertex_ids[at(v)]);
  }
  // Higher for lower parts, as ranks can tell the largest; 0: no part of this rank.
  constexpr std::uint64_t kTop = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint64_t> height(num_edges, 0);
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    for (const auto& [i, j] : mesh::kTetEdgeCorners) {
      const LocalIndex a = mesh.tet(t)[i];
      const LocalIndex b = mesh.tet(t)[j];
      if (!is_on_line[at(a)] || !is_on_line[at(b)]) continue;
      const auto [low, high] = std::minmax(mesh.vertex_ids[at(a)], mesh.vertex_ids[at(b)]);
      const auto row = row_of.find({low, high});
      if (row == row_of.end()) continue;
      const auto part = static_cast<std::uint64_t>(mesh.tet_part[at(t)]);
      height[row->second] = std::max(height[row->second], kTop - part);
    }
  }
  comm.max_in_place(height);
  std::vector<LocalIndex> parts;
  for (const std::uint64_t high : height) {
    parts.push_back(high == 0 ? kNoIndex : static_cast<LocalIndex>(kTop - high));
  }
  return parts;
}

mesh::MeshArrays lines_of_part(const mesh::MeshArrays& lines, const std::vector<LocalIndex>& parts,
                               LocalIndex part, const mesh::MeshArrays& tets)
{
  mesh::MeshArrays own{.vertices_per_cell = 2, .are_edges = true, .field_texts = lines.field_texts};
  std::map<GlobalIndex, GlobalIndex> row_of_tets;
  for (std::size_t p = 0; p < tets.point_ids.size(); ++p)
    row_of_tets.emplace(tets.point_ids[p], static_cast<GlobalIndex>(p));
  std::map<GlobalIndex, LocalIndex> row_of;
  auto& line = own.cell_ints["line"];
  auto& owner = own.point_ints["owner"];
  for (std::size_t e = 0; e < parts.size(); ++e) {
    if (parts[e] != part) continue;
    for (std::size_t end = 0; end < 2; ++end) {
      const std::size_t point = at(lines.cell_points[2 * e + end]);
      const auto [row, is_new] =
          row_of.try_emplace(lines.point_ids[point], static_cast<LocalIndex>(own.point_ids.size()));
      own.cell_points.push_back(row->second);
      if (!is_new) continue;
      own.point_ids.push_back(row->first);
      own.point_xyz.insert(own.point_xyz.end(), &lines.point_xyz[3 * point],
                           &lines.point_xyz[3 * point] + 3);
      owner.push_back(
          tets.point_ints.at("owner")[static_cast<std::size_t>(row_of_tets.at(row->first))]);
    }
    own.cell_ids.push_back(lines.cell_ids[e]);
    line.push_back(lines.cell_ints.at("line")[e]);
  }
  own.cell_ints["subdomain"].assign(line.size(), part);
  return own;
}

}  // namespace tessera::subdomain
