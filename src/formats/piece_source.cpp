// SPDX-License-Identifier: BSD-3-Clause
#include "formats/piece_source.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <span>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/quadratic_tet.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/mesh/mesh_arrays.hpp"
#include "tessera/mesh/periodic_pairs.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/subdomain/mesh_input.hpp"

#include "formats/joined_tets.hpp"

namespace tessera::formats {
namespace {

namespace fs = std::filesystem;

// Points of a cell of second order.
constexpr int num_points_with_nodes(int num_corners) { return num_corners == 4 ? 10 : 6; }

mesh::MeshArrays read_cells(const fs::path& file, int num_corners)
{
  mesh::MeshArrays cells = io::read_vtu(file, io::CellOrder::up_to_second);
  if (cells.num_cells() > 0 && cells.vertices_per_cell != num_points_with_nodes(num_corners)
      && cells.vertices_per_cell != num_corners) {
    throw InputError(
        fmt::format("{}: it has no {}", file.string(), num_corners == 4 ? "tets" : "triangles"));
  }
  return cells;
}

// Leaves cells with their corners alone. @return The nodes of their edges; none of first order.
std::vector<LocalIndex> take_nodes(mesh::MeshArrays& cells, int num_corners)
{
  if (cells.vertices_per_cell == num_corners) return {};
  const auto width = static_cast<std::size_t>(cells.vertices_per_cell);
  std::vector<LocalIndex> corners;
  std::vector<LocalIndex> nodes;
  for (std::size_t first = 0; first < cells.cell_points.size(); first += width) {
    const auto cell = cells.cell_points.begin() + static_cast<std::ptrdiff_t>(first);
    corners.insert(corners.end(), cell, cell + num_corners);
    nodes.insert(nodes.end(), cell + num_corners, cell + cells.vertices_per_cell);
  }
  cells.cell_points = std::move(corners);
  cells.vertices_per_cell = num_corners;
  return nodes;
}

// From rows in the file to rows with the nodes behind all vertices, each kind in its order.
struct NodesLast {
  std::vector<LocalIndex> rows{};
  LocalIndex num_nodes = 0;
};

NodesLast nodes_last(const mesh::MeshArrays& cells, const std::vector<LocalIndex>& nodes,
                     const fs::path& file)
{
  std::vector<bool> is_node(at(static_cast<LocalIndex>(cells.num_points())), false);
  for (const LocalIndex node : nodes) is_node[at(node)] = true;
  for (const LocalIndex corner : cells.cell_points) {
    if (!is_node[at(corner)]) continue;
    throw InputError(
        fmt::format("{}: point {} is a corner of a tet and stands on an edge of another",
                    file.string(), corner));
  }
  NodesLast found;
  found.num_nodes = static_cast<LocalIndex>(std::ranges::count(is_node, true));
  LocalIndex next_vertex = 0;
  LocalIndex next_node = static_cast<LocalIndex>(is_node.size()) - found.num_nodes;
  for (const bool is_last : is_node) found.rows.push_back(is_last ? next_node++ : next_vertex++);
  return found;
}

void move_points(const std::vector<LocalIndex>& rows, mesh::MeshArrays& cells)
{
  const std::vector<double> xyz = cells.point_xyz;
  const std::vector<GlobalIndex> ids = cells.point_ids;
  for (std::size_t p = 0; p < rows.size(); ++p) {
    for (std::size_t d = 0; d < 3; ++d) cells.point_xyz[3 * at(rows[p]) + d] = xyz[3 * p + d];
    if (!ids.empty()) cells.point_ids[at(rows[p])] = ids[p];
  }
  for (LocalIndex& corner : cells.cell_points) corner = rows[at(corner)];
}

// Makes points of the nodes that tets of second order have.
void take_nodes(mesh::MeshArrays& cells, const fs::path& file, LoadedPiece& piece)
{
  piece.tet_nodes = take_nodes(cells, 4);
  if (piece.tet_nodes.empty()) return;
  const NodesLast last = nodes_last(cells, piece.tet_nodes, file);
  piece.num_nodes = last.num_nodes;
  move_points(last.rows, cells);
  for (LocalIndex& node : piece.tet_nodes) node = last.rows[at(node)];
}

std::vector<VertexKey> keys_of_points(const mesh::MeshArrays& cells, VertexIdentity identity,
                                      const fs::path& file)
{
  std::vector<VertexKey> keys;
  keys.reserve(at(static_cast<LocalIndex>(cells.num_points())));
  if (identity == VertexIdentity::ids) {
    if (cells.point_ids.empty() && cells.num_points() > 0) {
      throw InputError(file.string() + ": it has no ids of points, though other pieces have; "
                       "`tessera repartition` gives all of them ids");
    }
    for (const GlobalIndex id : cells.point_ids) keys.push_back(key_of_id(id));
  } else {
    for (std::size_t p = 0; p < cells.point_xyz.size(); p += 3) {
      keys.push_back(
          key_of_position({cells.point_xyz[p], cells.point_xyz[p + 1], cells.point_xyz[p + 2]}));
    }
  }
  return keys;
}

void require_positive(const LoadedPiece& piece, const fs::path& file)
{
  const std::span<const double> xyz(piece.point_xyz);
  for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
    const LocalIndex* const corner = piece.tet_points.data() + 4 * at(t);
    const double volume = tet_volume(point_at(xyz, corner[0]), point_at(xyz, corner[1]),
                                     point_at(xyz, corner[2]), point_at(xyz, corner[3]));
    if (volume > 0.0) continue;
    throw InputError(fmt::format("{}: tet {} has no positive volume; `tessera check` says more",
                                 file.string(), t));
  }
}

// Tets of one prism follow one another, and say so.
std::vector<LocalIndex> cells_of_tets(const mesh::MeshArrays& cells, std::size_t num_tets,
                                      const fs::path& file)
{
  std::vector<LocalIndex> cell_of_tet(num_tets);
  const auto of_prism = cells.cell_ints.find("tet_of_prism");
  LocalIndex cell = kNoIndex;
  for (std::size_t t = 0; t < num_tets; ++t) {
    const std::int32_t number = of_prism == cells.cell_ints.end() ? 0 : of_prism->second[t];
    const bool follows = number > 0 && number < 3 && t > 0 && of_prism->second[t - 1] == number - 1;
    if (number != 0 && !follows) {
      throw InputError(
          fmt::format("{}: tet_of_prism of tet {} is {}; it must be 0, or 1 or 2 "
                      "behind a tet where it is one less",
                      file.string(), t, number));
    }
    if (number == 0) ++cell;
    cell_of_tet[t] = cell;
  }
  return cell_of_tet;
}

constexpr const char* kTakeTets = "`tessera convert --layers tets` writes the tets themselves";

// Tets of one cell must make a prism or a pyramid.
void require_cells(const LoadedPiece& piece, const fs::path& file)
{
  const JoinedTets tets(piece);
  if (!tets.has_prisms()) return;
  for (LocalIndex tet = 0; tet < tets.num_tets();) {
    const CellTets cell = tets_of_cell(tets, tet);
    const std::string_view defect = defect_of_cell(tets, cell);
    if (!defect.empty()) {
      throw InputError(fmt::format("{}: tets {} to {} are one cell by tet_of_prism, but {}; {}",
                                   file.string(), tet, tet + cell.count - 1, defect, kTakeTets));
    }
    tet += cell.count;
  }
}

// The two triangles of a side of a prism must be on one patch.
void require_whole_sides(const LoadedPiece& piece, const fs::path& file)
{
  const JoinedTets tets(piece);
  if (!tets.has_prisms()) return;
  for (const JoinedSide& side : joined_sides(tets, piece.triangle_side)) {
    const bool is_whole = side.other_row == kNoIndex
                              ? other_half(tets, piece.triangle_side[at(side.row)]) == kNoIndex
                              : piece.patch[at(side.row)] == piece.patch[at(side.other_row)];
    if (is_whole) continue;
    throw InputError(
        fmt::format("{}: triangle {} is half a side of a prism, and the other half is not on its "
                    "patch; {}",
                    file.string(), side.row, kTakeTets));
  }
}

// Rows of the boundary's points among those of the piece.
std::vector<LocalIndex> rows_of(const std::vector<VertexKey>& boundary,
                                const std::vector<VertexKey>& points, const fs::path& file)
{
  std::unordered_map<std::uint64_t, LocalIndex> rows_by_hash;
  rows_by_hash.reserve(boundary.size());
  for (std::size_t b = 0; b < boundary.size(); ++b) {
    rows_by_hash.emplace(hash_of(boundary[b]), static_cast<LocalIndex>(b));
  }
  std::vector<LocalIndex> rows(boundary.size(), kNoIndex);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto found = rows_by_hash.find(hash_of(points[p]));
    if (found != rows_by_hash.end()) rows[at(found->second)] = static_cast<LocalIndex>(p);
  }
  if (std::ranges::find(rows, kNoIndex) == rows.end()) return rows;
  throw InputError(file.string() + ": it has points that the tets of its piece have not");
}

using Triangle = std::array<LocalIndex, 3>;

struct TriangleHash {
  std::size_t operator()(const Triangle& triangle) const { return hash_of(triangle); }
};

// For triangles that do not say which tet is behind them: of two the one from whose outside it is
// seen.
class Sides {
 public:
  explicit Sides(const std::vector<Triangle>& triangles)
  {
    rows_.reserve(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const auto& [a, b, c] = triangles[i];
      rows_.emplace(mesh::sorted_triangle(a, b, c), static_cast<LocalIndex>(i));
    }
  }

  std::vector<LocalIndex> find(const std::vector<Triangle>& triangles,
                               const std::vector<LocalIndex>& tet_points) const
  {
    std::vector<LocalIndex> side(triangles.size(), kNoIndex);
    for (std::size_t t = 0; 4 * t < tet_points.size(); ++t) {
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const auto& [i, j, k] = mesh::kTetFaceCorners[corner];
        const Triangle face{tet_points[4 * t + i], tet_points[4 * t + j], tet_points[4 * t + k]};
        const auto found = rows_.find(mesh::sorted_triangle(face[0], face[1], face[2]));
        if (found == rows_.end()) continue;
        const auto& [a, b, c] = triangles[at(found->second)];
        const bool is_outside =
            mesh::is_even_triangle(face[0], face[1], face[2]) == mesh::is_even_triangle(a, b, c);
        LocalIndex& known = side[at(found->second)];
        if (known == kNoIndex || is_outside) known = static_cast<LocalIndex>(4 * t + corner);
      }
    }
    return side;
  }

 private:
  std::unordered_map<Triangle, LocalIndex, TriangleHash> rows_{};
};

// The side of tet `t` with the points of the triangle.
LocalIndex side_of(const Triangle& triangle, std::size_t t,
                   const std::vector<LocalIndex>& tet_points)
{
  LocalIndex side = kNoIndex;
  int num_others = 0;
  for (std::size_t corner = 0; corner < 4; ++corner) {
    if (std::ranges::find(triangle, tet_points[4 * t + corner]) != triangle.end()) continue;
    side = static_cast<LocalIndex>(4 * t + corner);
    ++num_others;
  }
  return num_others == 1 ? side : kNoIndex;
}

// For triangles that say which tet is behind them; empty if they do not.
std::vector<LocalIndex> sides_by_id(const std::vector<Triangle>& triangles,
                                    const mesh::MeshArrays& boundary,
                                    const std::vector<GlobalIndex>& tet_ids,
                                    const std::vector<LocalIndex>& tet_points)
{
  const auto tets = boundary.cell_longs.find("tet");
  if (tets == boundary.cell_longs.end() || !std::ranges::is_sorted(tet_ids)) return {};
  std::vector<LocalIndex> sides;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto found = std::ranges::lower_bound(tet_ids, tets->second[i]);
    if (found == tet_ids.end() || *found != tets->second[i]) return {};
    const auto row = static_cast<std::size_t>(found - tet_ids.begin());
    sides.push_back(side_of(triangles[i], row, tet_points));
  }
  return sides;
}

void add_triangles(const mesh::MeshArrays& boundary, const std::vector<VertexKey>& keys,
                   const std::vector<GlobalIndex>& tet_ids, const fs::path& file,
                   LoadedPiece& piece)
{
  const std::vector<LocalIndex> row = rows_of(keys, piece.point_keys, file);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 2 < boundary.cell_points.size(); i += 3) {
    const LocalIndex* const point = boundary.cell_points.data() + i;
    triangles.push_back({row[at(point[0])], row[at(point[1])], row[at(point[2])]});
  }
  piece.triangle_side = sides_by_id(triangles, boundary, tet_ids, piece.tet_points);
  if (piece.triangle_side.empty())
    piece.triangle_side = Sides(triangles).find(triangles, piece.tet_points);
  if (std::ranges::find(piece.triangle_side, kNoIndex) != piece.triangle_side.end()) {
    throw InputError(file.string() + ": it has triangles that no tet of its piece has");
  }
  const auto patch = boundary.cell_ints.find("patch");
  piece.patch = patch != boundary.cell_ints.end() ? patch->second
                                                  : std::vector<std::int32_t>(triangles.size(), 0);
}

void add_lines(const fs::path& file, VertexIdentity identity, LoadedPiece& piece)
{
  const mesh::MeshArrays edges = io::read_vtu(file, io::CellOrder::edges);
  const int num_points = piece.tet_nodes.empty() ? 2 : 3;
  if (edges.num_cells() > 0 && edges.vertices_per_cell != num_points) {
    throw InputError(file.string() + ": its edges are not of the order of the tets");
  }
  const std::vector<LocalIndex> row =
      rows_of(keys_of_points(edges, identity, file), piece.point_keys, file);
  for (const LocalIndex point : edges.cell_points) piece.line_points.push_back(row[at(point)]);
  const auto line = edges.cell_ints.find("line");
  piece.line = line != edges.cell_ints.end()
                   ? line->second
                   : std::vector<std::int32_t>(at(static_cast<LocalIndex>(edges.num_cells())), 0);
}

// What the first piece tells of all.
struct FirstPiece {
  bool has_ids = true;
  FileNames names{};

  static auto fields(auto& self)
  {
    return std::tie(self.has_ids, self.names.materials, self.names.patches, self.names.length_unit,
                    self.names.periodic);
  }
};

FileNames names_in(const mesh::MeshArrays& cells)
{
  const auto texts = [&](const std::string& name) {
    const auto found = cells.field_texts.find(name);
    return found == cells.field_texts.end() ? std::vector<std::string>{} : found->second;
  };
  const std::vector<std::string> unit = texts("length_unit");
  return {texts("material_names"), texts("patch_names"), unit.empty() ? "" : unit.front(),
          texts(mesh::kPeriodicPairsName), texts("line_names")};
}

std::vector<std::string> names_of_lines(const std::vector<fs::path>& files,
                                        const comm::Communicator& comm)
{
  const auto first = std::ranges::find_if_not(files, &fs::path::empty);
  if (first == files.end()) return {};
  return on_root(comm, [&] { return names_in(io::read_vtu(*first, io::CellOrder::edges)).lines; });
}

}  // namespace

std::vector<LocalIndex> LoadedPiece::points_of_side(LocalIndex side) const
{
  const std::array<std::size_t, 3>& corners = mesh::kTetFaceCorners[at(side % 4)];
  const std::size_t tet = at(side / 4);
  std::vector<LocalIndex> points;
  for (const std::size_t c : corners) points.push_back(tet_points[4 * tet + c]);
  if (tet_nodes.empty()) return points;
  for (std::size_t c = 0; c < 3; ++c)
    points.push_back(tet_nodes[6 * tet + row_of_edge(corners[c], corners[(c + 1) % 3])]);
  return points;
}

PieceSource::PieceSource(const fs::path& index, const comm::Communicator& comm,
                         io::LayerCells layers)
    : num_ranks_(comm.size()), layers_(layers), tets_(subdomain::pieces_of(index, comm))
{
  boundary_ = files_beside(index, "boundary.pvtu", comm);
  lines_ = files_beside(index, "lines.pvtu", comm);
  const FirstPiece first = on_root(comm, [&] {
    FirstPiece found;
    if (tets_.empty()) return found;
    const mesh::MeshArrays cells = read_cells(tets_.front(), 4);
    found.has_ids = !cells.point_ids.empty() || cells.num_points() == 0;
    found.names = names_in(cells);
    return found;
  });
  identity_ = first.has_ids ? VertexIdentity::ids : VertexIdentity::positions;
  names_ = first.names;
  if (lines_) names_.lines = names_of_lines(*lines_, comm);
}

PieceSource::OptionalFiles PieceSource::files_beside(const fs::path& index, const std::string& name,
                                                     const comm::Communicator& comm) const
{
  const auto files = subdomain::pieces_beside(index, name, comm);
  if (!files) return std::nullopt;
  std::map<fs::path, LocalIndex> piece_of;
  for (LocalIndex p = 0; p < num_pieces(); ++p) piece_of[tets_[at(p)].filename()] = p;
  std::vector<fs::path> of_piece(tets_.size());
  for (const fs::path& file : *files) {
    const auto piece = piece_of.find(file.filename());
    if (piece == piece_of.end()) {
      throw comm::Collective<InputError>(fmt::format("{}: {} has no piece {} that it belongs to",
                                                     file.string(), index.string(),
                                                     file.filename().string()));
    }
    of_piece[at(piece->second)] = file;
  }
  return of_piece;
}

LocalIndex PieceSource::first_of(Rank rank) const
{
  return static_cast<LocalIndex>(GlobalIndex{num_pieces()} * rank / num_ranks_);
}

LoadedPiece PieceSource::load(LocalIndex number) const
{
  const fs::path& file = tets_[at(number)];
  mesh::MeshArrays cells = read_cells(file, 4);
  LoadedPiece piece;
  take_nodes(cells, file, piece);
  piece.point_keys = keys_of_points(cells, identity_, file);
  piece.point_xyz = std::move(cells.point_xyz);
  piece.tet_points = std::move(cells.cell_points);
  const auto material = cells.cell_ints.find("attribute");
  piece.material = material != cells.cell_ints.end()
                       ? std::move(material->second)
                       : std::vector<std::int32_t>(piece.tet_points.size() / 4, 1);
  piece.tet_cell = cells_of_tets(cells, piece.material.size(), file);
  const bool has_prisms = layers_ == io::LayerCells::prisms && piece.tet_nodes.empty();
  if (!has_prisms) std::iota(piece.tet_cell.begin(), piece.tet_cell.end(), 0);
  require_positive(piece, file);
  require_cells(piece, file);
  if (lines_ && !(*lines_)[at(number)].empty()) add_lines((*lines_)[at(number)], identity_, piece);
  if (!boundary_ || (*boundary_)[at(number)].empty()) return piece;
  const fs::path& boundary_file = (*boundary_)[at(number)];
  mesh::MeshArrays boundary = read_cells(boundary_file, 3);
  take_nodes(boundary, 3);  // They are those of the tets.
  add_triangles(boundary, keys_of_points(boundary, identity_, boundary_file), cells.cell_ids,
                boundary_file, piece);
  require_whole_sides(piece, boundary_file);
  return piece;
}

}  // namespace tessera::formats
