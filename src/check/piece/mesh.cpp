// SPDX-License-Identifier: BSD-3-Clause
#include "check/piece/mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "check/piece/second_order.hpp"

namespace tessera::check {
namespace {

// Side indices of triangles, with one bit for the parity, are 32-bit.
constexpr GlobalIndex kMaxCells = GlobalIndex{1} << 29;

void add_array_defect(const PieceName& name, const std::string& what, Findings& findings)
{
  findings.add(Kind::arrays, {name.piece, 0},
               [&] { return fmt::format("{}: {}", to_text(name), what); });
}

// Removes the arrays of a map whose length is not the number of cells.
template <class Arrays>
void drop_wrong_lengths(const PieceName& name, std::size_t num_cells, Arrays& arrays,
                        Findings& findings)
{
  for (auto it = arrays.begin(); it != arrays.end();) {
    if (it->second.size() == num_cells) {
      ++it;
      continue;
    }
    add_array_defect(name,
                     fmt::format("cell array \"{}\" has {} values for {} cells", it->first,
                                 it->second.size(), num_cells),
                     findings);
    it = arrays.erase(it);
  }
}

bool has_ids(const PieceName& name, const char* of, std::size_t num_entities,
             const std::vector<GlobalIndex>& ids, Findings& findings)
{
  if (ids.size() == num_entities) return true;
  if (!ids.empty()) {
    add_array_defect(name, fmt::format("{} ids for {} {}", ids.size(), num_entities, of), findings);
  }
  return false;
}

void check_sizes(const PieceName& name, mesh::MeshArrays& arrays, Findings& findings)
{
  const auto width = static_cast<std::size_t>(name.vertices_per_cell());
  if (arrays.cell_points.empty()) arrays.vertices_per_cell = name.vertices_per_cell();
  const bool is_readable = arrays.vertices_per_cell == name.vertices_per_cell()
                           && arrays.point_xyz.size() % 3 == 0
                           && arrays.cell_points.size() % width == 0;
  if (!is_readable) {
    add_array_defect(name,
                     fmt::format("{} coordinates and {} cell corners are no whole points and cells "
                                 "of {} corners; the piece is left out",
                                 arrays.point_xyz.size(), arrays.cell_points.size(), width),
                     findings);
    arrays = {};
    arrays.vertices_per_cell = name.vertices_per_cell();
  }
  if (arrays.num_cells() >= kMaxCells
      || arrays.num_points() > std::numeric_limits<LocalIndex>::max())
    throw InputError(
        fmt::format("{} has more than 2^29 cells or 2^31 points; split it", to_text(name)));
  const auto num_cells = static_cast<std::size_t>(arrays.num_cells());
  drop_wrong_lengths(name, num_cells, arrays.cell_ints, findings);
  drop_wrong_lengths(name, num_cells, arrays.cell_longs, findings);
  drop_wrong_lengths(name, num_cells, arrays.cell_doubles, findings);
}

// For each point the lowest point with the same key, by a hash table of points.
template <class KeyOf>
std::vector<LocalIndex> lowest_of_equal(LocalIndex num_points, const KeyOf& key_of)
{
  const std::size_t num_slots = std::bit_ceil(2 * static_cast<std::size_t>(num_points) + 1);
  std::vector<LocalIndex> slots(num_slots, kNoIndex);
  std::vector<LocalIndex> lowest(static_cast<std::size_t>(num_points));
  for (LocalIndex p = 0; p < num_points; ++p) {
    const VertexKey key = key_of(p);
    std::size_t slot = hash_of(key) & (num_slots - 1);
    while (slots[slot] != kNoIndex && key_of(slots[slot]) != key)
      slot = (slot + 1) & (num_slots - 1);
    if (slots[slot] == kNoIndex) slots[slot] = p;
    lowest[static_cast<std::size_t>(p)] = slots[slot];
  }
  return lowest;
}

void check_points(const PieceMesh& mesh, Findings& findings)
{
  for (LocalIndex p = 0; p < mesh.num_points(); ++p) {
    const Vec3 x = mesh.position(p);
    if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2])) continue;
    findings.add(Kind::non_finite_point, {mesh.name.piece, p}, [&] {
      return fmt::format("{}: {}", to_text(mesh.name), describe_point(mesh, p));
    });
  }
}

// The vertex of each point, with a defect for each point that repeats an id or a position.
std::vector<LocalIndex> match_points(PieceMesh& mesh, Findings& findings)
{
  const auto by_position = lowest_of_equal(
      mesh.num_points(), [&](LocalIndex p) { return key_of_position(mesh.position(p)); });
  std::vector<LocalIndex> vertex = by_position;
  if (mesh.identity == VertexIdentity::ids) {
    vertex = lowest_of_equal(mesh.num_points(), [&](LocalIndex p) { return mesh.key(p); });
  }
  for (LocalIndex p = 0; p < mesh.num_points(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    if (mesh.identity == VertexIdentity::ids && vertex[i] != p)
      report_equal_points(mesh, Kind::point_id_twice, p, vertex[i], findings);
    else if (by_position[i] != p && !mesh.split_patches().empty())
      mesh.equal_points.push_back({by_position[i], p});
    else if (by_position[i] != p)
      report_equal_points(mesh, Kind::duplicate_point, p, by_position[i], findings);
  }
  return vertex;
}

// Whether the corners are different vertices in range; finds out which.
bool find_vertices(const PieceMesh& mesh, LocalIndex cell, std::span<const LocalIndex> vertex_of,
                   std::vector<bool>& is_used, std::span<LocalIndex> vertices)
{
  const std::size_t at = static_cast<std::size_t>(cell) * vertices.size();
  bool is_good = true;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const LocalIndex corner = mesh.arrays.cell_points[at + i];
    vertices[i] = kNoIndex;
    if (corner < 0 || corner >= mesh.num_points()) {
      is_good = false;
      continue;
    }
    const auto p = static_cast<std::size_t>(corner);
    is_used[p] = true;
    vertices[i] = vertex_of[p];
    for (std::size_t j = 0; j < i; ++j) is_good = is_good && vertices[j] != vertices[i];
  }
  return is_good;
}

std::string describe_corners(const PieceMesh& mesh, LocalIndex cell)
{
  const auto width = static_cast<std::size_t>(mesh.arrays.vertices_per_cell);
  std::string text;
  for (std::size_t i = 0; i < width; ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ",
                        mesh.arrays.cell_points[static_cast<std::size_t>(cell) * width + i]);
  }
  return text;
}

void set_cells(PieceMesh& mesh, Findings& findings)
{
  const std::vector<LocalIndex> vertex_of = match_points(mesh, findings);
  std::vector<bool> is_used(vertex_of.size(), false);
  std::array<LocalIndex, 4> corners{};
  const auto vertices =
      std::span(corners).first(static_cast<std::size_t>(mesh.arrays.vertices_per_cell));
  for (LocalIndex c = 0; c < mesh.num_cells(); ++c) {
    if (find_vertices(mesh, c, vertex_of, is_used, vertices)) {
      if (!std::ranges::equal(vertices, mesh.cell(c))) mesh.set_cell(c, vertices);
      continue;
    }
    mesh.leave_out(c);
    findings.add(Kind::cell_points, {mesh.name.piece, c}, [&] {
      return fmt::format("{}: points {} of {} are out of range or not different",
                         describe_cell(mesh, c), describe_corners(mesh, c), mesh.num_points());
    });
  }
  set_nodes(mesh, vertex_of, is_used, findings);
  for (LocalIndex p = 0; p < mesh.num_points(); ++p) {
    if (is_used[static_cast<std::size_t>(p)]) continue;
    mesh.unused_points.push_back(p);
    findings.add(Kind::unused_point, {mesh.name.piece, p}, [&] {
      return fmt::format("{}: {}", to_text(mesh.name), describe_point(mesh, p));
    });
  }
}

// Takes a cell array out of the piece. @return `otherwise` for every cell if the piece has none.
CellNumbers<std::int32_t> take_ints(mesh::MeshArrays& arrays, const std::string& name,
                                    std::int32_t otherwise)
{
  const auto found = arrays.cell_ints.find(name);
  if (found != arrays.cell_ints.end()) return CellNumbers(std::exchange(found->second, {}));
  return CellNumbers(
      std::vector<std::int32_t>(static_cast<std::size_t>(arrays.num_cells()), otherwise));
}

}  // namespace

void report_equal_points(const PieceMesh& mesh, Kind kind, LocalIndex p, LocalIndex lowest,
                         Findings& findings)
{
  findings.add(kind, {mesh.name.piece, p}, [&] {
    return fmt::format("{}: {} and {}", to_text(mesh.name), describe_point(mesh, lowest),
                       describe_point(mesh, p));
  });
}

PieceMesh make_piece_mesh(PieceName name, mesh::MeshArrays arrays, VertexIdentity identity,
                          Findings& findings)
{
  PieceMesh mesh;
  mesh.cell_nodes = take_nodes(arrays);
  check_sizes(name, arrays, findings);
  mesh.name = name;
  mesh.has_point_ids = has_ids(name, "points", static_cast<std::size_t>(arrays.num_points()),
                               arrays.point_ids, findings);
  mesh.has_cell_ids = has_ids(name, "cells", static_cast<std::size_t>(arrays.num_cells()),
                              arrays.cell_ids, findings);
  mesh.identity = mesh.has_point_ids ? identity : VertexIdentity::positions;
  if (mesh.has_cell_ids) mesh.cell_ids = CellNumbers(std::exchange(arrays.cell_ids, {}));
  mesh.arrays = std::move(arrays);
  mesh.attribute = take_ints(mesh.arrays, "attribute", 0);
  mesh.has_subdomains = mesh.arrays.cell_ints.contains("subdomain");
  mesh.subdomain =
      take_ints(mesh.arrays, "subdomain", name.is_boundary ? kNoSubdomain : name.piece);
  check_points(mesh, findings);
  set_cells(mesh, findings);
  return mesh;
}

std::string to_text(const PieceName& name)
{
  return fmt::format("{}{}", name.is_boundary ? "boundary piece " : "piece ", name.piece);
}

std::string describe_cell(const PieceMesh& mesh, LocalIndex cell)
{
  const std::string id = mesh.has_cell_ids ? fmt::format(" (id {})", mesh.cell_id(cell)) : "";
  return fmt::format("cell {}{} of {}", cell, id, to_text(mesh.name));
}

std::string describe_point(const PieceMesh& mesh, LocalIndex point)
{
  const std::string id = mesh.has_point_ids ? fmt::format(" (id {})", mesh.point_id(point)) : "";
  return fmt::format("point {}{} at {}", point, id, to_text(mesh.position(point)));
}

}  // namespace tessera::check
