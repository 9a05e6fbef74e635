// SPDX-License-Identifier: BSD-3-Clause
#include "box_pieces.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "tessera/base/vec3.hpp"

namespace tessera::testing {
namespace {

constexpr std::array<std::array<std::size_t, 3>, 6> kAxisOrders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
constexpr std::size_t kNumEvenOrders = 3;
constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

// Rows of the points of a piece, in the order in which they are asked for.
class PointRows {
 public:
  explicit PointRows(mesh::MeshArrays& arrays) : arrays_(arrays) {}

  LocalIndex row(GlobalIndex id, const Vec3& position)
  {
    const auto [entry, is_new] = row_.emplace(id, static_cast<LocalIndex>(arrays_.num_points()));
    if (is_new) {
      arrays_.point_ids.push_back(id);
      arrays_.point_xyz.insert(arrays_.point_xyz.end(), position.begin(), position.end());
    }
    return entry->second;
  }

 private:
  mesh::MeshArrays& arrays_;
  std::unordered_map<GlobalIndex, LocalIndex> row_{};
};

}  // namespace

// Points are of eight kinds: bit a says whether the point is strictly inside a piece along axis a.
BoxPieces::BoxPieces(int levels, GlobalIndex n)
    : levels_(levels), n_(n), side_(GlobalIndex{1} << levels)
{
  GlobalIndex next = 0;
  for (std::size_t kind = 0; kind < 8; ++kind) {
    first_of_kind_[kind] = next;
    GlobalIndex num = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      num *= (kind >> axis & 1U) != 0 ? side_ * (n_ - 1) : side_ + 1;
    next += num;
  }
}

BoxPieces::Cell BoxPieces::place_of(LocalIndex piece) const
{
  Cell place{};
  for (int level = 0; level < levels_; ++level)
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] |= GlobalIndex{piece >> (3 * level + static_cast<int>(axis)) & 1} << level;
  return place;
}

// Of points inside a piece along an axis, those of one piece are numbered together.
GlobalIndex BoxPieces::point_id(const Cell& point) const
{
  std::size_t kind = 0;
  GlobalIndex unit = 0;
  GlobalIndex inner = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const GlobalIndex at = point[axis] % n_;
    const bool is_inside = at != 0;
    unit = unit * (is_inside ? side_ : side_ + 1) + point[axis] / n_;
    if (!is_inside) continue;
    kind |= std::size_t{1} << axis;
    inner = inner * (n_ - 1) + at - 1;
  }
  GlobalIndex num_inner = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if ((kind >> axis & 1U) != 0) num_inner *= n_ - 1;
  return first_of_kind_[kind] + unit * num_inner + inner;
}

Vec3 BoxPieces::position(const Cell& point) const
{
  const double scale = 1.0 / static_cast<double>(side_ * n_);
  return {scale * static_cast<double>(point[0]), scale * static_cast<double>(point[1]),
          scale * static_cast<double>(point[2])};
}

template <class Visit>
void BoxPieces::for_each_tet(LocalIndex piece, const Visit& visit) const
{
  const Cell place = place_of(piece);
  for (GlobalIndex cell = 0; cell < n_ * n_ * n_; ++cell) {
    const Cell low{place[0] * n_ + cell / (n_ * n_), place[1] * n_ + cell / n_ % n_,
                   place[2] * n_ + cell % n_};
    for (std::size_t order = 0; order < kAxisOrders.size(); ++order) {
      std::array<Cell, 4> corners{low, low, low, low};
      for (std::size_t i = 1; i < 4; ++i) {
        corners[i] = corners[i - 1];
        ++corners[i][kAxisOrders[order][i - 1]];
      }
      if (order >= kNumEvenOrders) std::swap(corners[2], corners[3]);
      visit(corners);
    }
  }
}

mesh::MeshArrays BoxPieces::tets(LocalIndex piece) const
{
  mesh::MeshArrays arrays;
  PointRows rows(arrays);
  for_each_tet(piece, [&](const std::array<Cell, 4>& corners) {
    for (const Cell& c : corners) {
      arrays.cell_points.push_back(rows.row(point_id(c), position(c)));
    }
    arrays.cell_ids.push_back(piece * tets_per_piece()
                              + static_cast<GlobalIndex>(arrays.cell_ids.size()));
  });
  arrays.cell_ints["attribute"].assign(arrays.cell_ids.size(), 1);
  arrays.cell_ints["subdomain"].assign(arrays.cell_ids.size(), piece);
  return arrays;
}

mesh::MeshArrays BoxPieces::boundary(LocalIndex piece) const
{
  mesh::MeshArrays arrays;
  arrays.vertices_per_cell = 3;
  auto& patch = arrays.cell_ints["patch"];
  auto& subdomain = arrays.cell_ints["subdomain"];
  auto& tet_ids = arrays.cell_longs["tet"];
  PointRows rows(arrays);
  const GlobalIndex end = side_ * n_;
  GlobalIndex tet = piece * tets_per_piece();
  for_each_tet(piece, [&](const std::array<Cell, 4>& corners) {
    for (const auto& face : kFaces) {
      for (std::size_t side = 0; side < 6; ++side) {
        const GlobalIndex plane = side % 2 == 0 ? 0 : end;
        const bool is_on_plane = std::all_of(face.begin(), face.end(), [&](std::size_t corner) {
          return corners[corner][side / 2] == plane;
        });
        if (!is_on_plane) continue;
        for (const std::size_t corner : face) {
          const Cell& c = corners[corner];
          arrays.cell_points.push_back(rows.row(point_id(c), position(c)));
        }
        patch.push_back(static_cast<std::int32_t>(side));
        subdomain.push_back(piece);
        tet_ids.push_back(tet);
      }
    }
    ++tet;
  });
  return arrays;
}

}  // namespace tessera::testing
