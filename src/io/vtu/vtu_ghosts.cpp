// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtu/vtu_ghosts.hpp"

#include <cstddef>
#include <span>
#include <utility>

#include "tessera/base/types.hpp"

namespace tessera::io {
namespace {

constexpr std::int32_t kDuplicateCell = 1;  // One bit of several; others are no copies.

// Keeps the rows that are marked; an array of another length has no rows.
template <class T>
void keep_rows(std::vector<T>& values, const std::vector<bool>& is_kept, std::size_t width = 1)
{
  if (values.size() != width * is_kept.size()) return;
  std::size_t to = 0;
  for (std::size_t row = 0; row < is_kept.size(); ++row) {
    if (!is_kept[row]) continue;
    for (std::size_t i = 0; i < width; ++i) values[to++] = values[width * row + i];
  }
  values.resize(to);
}

template <class Arrays>
void keep_rows_of_all(Arrays& arrays, const std::vector<bool>& is_kept)
{
  for (auto& [name, values] : arrays) keep_rows(values, is_kept);
}

void drop_cells(mesh::MeshArrays& mesh, const std::vector<bool>& is_kept)
{
  keep_rows(mesh.cell_points, is_kept, static_cast<std::size_t>(mesh.vertices_per_cell));
  keep_rows(mesh.cell_ids, is_kept);
  keep_rows_of_all(mesh.cell_ints, is_kept);
  keep_rows_of_all(mesh.cell_longs, is_kept);
  keep_rows_of_all(mesh.cell_doubles, is_kept);
}

void drop_points(mesh::MeshArrays& mesh, const std::vector<bool>& is_kept)
{
  std::vector<LocalIndex> place;
  place.reserve(is_kept.size());
  LocalIndex next = 0;
  for (const bool kept : is_kept) place.push_back(kept ? next++ : kNoIndex);
  for (LocalIndex& point : mesh.cell_points) point = place[static_cast<std::size_t>(point)];
  keep_rows(mesh.point_ids, is_kept);
  keep_rows_of_all(mesh.point_ints, is_kept);
  keep_rows_of_all(mesh.point_longs, is_kept);
  keep_rows(mesh.point_xyz, is_kept, 3);
}

}  // namespace

void drop_ghosts(mesh::MeshArrays& mesh)
{
  mesh.point_ints.erase(kGhostName);
  const auto ghosts = mesh.cell_ints.extract(kGhostName);
  if (ghosts.empty()) return;
  std::vector<bool> is_kept_cell;
  for (const std::int32_t bits : ghosts.mapped()) {
    is_kept_cell.push_back((bits & kDuplicateCell) == 0);
  }
  const auto width = static_cast<std::size_t>(mesh.vertices_per_cell);
  // Points on no cell at all are left to whoever looks for such defects.
  std::vector<bool> is_kept_point(static_cast<std::size_t>(mesh.num_points()), true);
  const auto mark = [&](bool of_kept) {
    for (std::size_t i = 0; i < mesh.cell_points.size(); ++i) {
      if (is_kept_cell[i / width] == of_kept) {
        is_kept_point[static_cast<std::size_t>(mesh.cell_points[i])] = of_kept;
      }
    }
  };
  mark(false);
  mark(true);
  drop_cells(mesh, is_kept_cell);
  drop_points(mesh, is_kept_point);
}

}  // namespace tessera::io
