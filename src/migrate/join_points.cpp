// SPDX-License-Identifier: BSD-3-Clause
#include "migrate/join_points.hpp"

#include <algorithm>
#include <string>

#include "tessera/base/error.hpp"

namespace tessera::migrate {
namespace {

// Faces of tets are numbered with 32 bits.
constexpr std::size_t kMaxTets = std::size_t{1} << 29;

struct UsedPoint {
  VertexKey key{};
  std::size_t corner = 0;  // Among the corners of all tets: its first use.
  Vec3 position{};
};

Vec3 position_of(const mesh::MeshArrays& piece, std::size_t p)
{
  return {piece.point_xyz[3 * p], piece.point_xyz[3 * p + 1], piece.point_xyz[3 * p + 2]};
}

// The points that tets use, once a piece, in the order of their first use.
// @param[out] corner_point Row among them of each corner of all tets.
std::vector<UsedPoint> used_points(std::span<const mesh::MeshArrays> pieces,
                                   VertexIdentity identity, std::vector<LocalIndex>& corner_point)
{
  std::vector<UsedPoint> used;
  for (const mesh::MeshArrays& piece : pieces) {
    std::vector<LocalIndex> row(static_cast<std::size_t>(piece.num_points()), kNoIndex);
    for (const LocalIndex point : piece.cell_points) {
      const auto p = static_cast<std::size_t>(point);
      if (row[p] == kNoIndex) {
        row[p] = static_cast<LocalIndex>(used.size());
        used.push_back(
            {key_of_point(piece, p, identity), corner_point.size(), position_of(piece, p)});
      }
      corner_point.push_back(row[p]);
    }
  }
  return used;
}

// Makes one vertex of all points with one key. @return Vertex of each point.
std::vector<LocalIndex> add_vertices(std::span<const UsedPoint> points, JoinedTets& joined)
{
  std::vector<LocalIndex> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<LocalIndex>(i);
  std::ranges::sort(order, [&](LocalIndex a, LocalIndex b) {
    const UsedPoint& x = points[at(a)];
    const UsedPoint& y = points[at(b)];
    return x.key != y.key ? x.key < y.key : x.corner < y.corner;
  });
  std::vector<LocalIndex> vertex(points.size());
  for (const LocalIndex p : order) {
    const UsedPoint& point = points[at(p)];
    if (joined.vertex_keys.empty() || joined.vertex_keys.back() != point.key) {
      joined.vertex_keys.push_back(point.key);
      joined.first_use.push_back(static_cast<GlobalIndex>(point.corner));
      joined.block.vertex_xyz.insert(joined.block.vertex_xyz.end(), point.position.begin(),
                                     point.position.end());
    }
    vertex[at(p)] = static_cast<LocalIndex>(joined.vertex_keys.size()) - 1;
    if (joined.block.position(vertex[at(p)]) != point.position) joined.has_contradiction = true;
  }
  return vertex;
}

void add_materials(const mesh::MeshArrays& piece, MeshBlock& block)
{
  const auto found = piece.cell_ints.find("attribute");
  if (found == piece.cell_ints.end()) {
    block.tet_material.resize(
        block.tet_material.size() + static_cast<std::size_t>(piece.num_cells()), 1);
  } else {
    block.tet_material.insert(block.tet_material.end(), found->second.begin(), found->second.end());
  }
}

}  // namespace

VertexKey key_of_point(const mesh::MeshArrays& piece, std::size_t p, VertexIdentity identity)
{
  return identity == VertexIdentity::ids ? key_of_id(piece.point_ids[p])
                                         : key_of_position(position_of(piece, p));
}

JoinedTets join_tets(std::span<const mesh::MeshArrays> pieces, VertexIdentity identity)
{
  JoinedTets joined;
  std::vector<LocalIndex> corners;
  const std::vector<UsedPoint> points = used_points(pieces, identity, corners);
  if (corners.size() / 4 > kMaxTets) {
    throw InputError("more than 2^29 tets on one rank; use more ranks");
  }
  const std::vector<LocalIndex> vertex = add_vertices(points, joined);
  for (LocalIndex& corner : corners) corner = vertex[at(corner)];
  MeshBlock& block = joined.block;
  block.vertex_ids.assign(joined.vertex_keys.size(), 0);
  block.tet_ids.assign(corners.size() / 4, 0);
  block.tet_part.assign(corners.size() / 4, 0);
  block.tet_vertices = std::move(corners);
  for (const mesh::MeshArrays& piece : pieces) add_materials(piece, block);
  return joined;
}

void require_tets(const MeshBlock& block)
{
  for (LocalIndex t = 0; t < block.num_tets(); ++t) {
    const auto v = block.tet(t);
    const bool is_good = v[0] != v[1] && v[0] != v[2] && v[0] != v[3] && v[1] != v[2]
                         && v[1] != v[3] && v[2] != v[3];
    if (!is_good) throw InputError("the mesh has a tet with the same corner twice");
  }
}

}  // namespace tessera::migrate
