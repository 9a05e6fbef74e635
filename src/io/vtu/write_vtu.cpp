// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/io/vtu.hpp"

#include "io/vtu/arrays.hpp"
#include "io/vtu/vtu_writers.hpp"

namespace tessera::io {
namespace {

using mesh::MeshArrays;

void require(bool condition, std::string_view what)
{
  if (!condition) throw MeshError("arrays of a piece do not fit together: " + std::string(what));
}

template <class T>
void require_size(const std::map<std::string, std::vector<T>>& arrays, GlobalIndex size)
{
  for (const auto& [name, values] : arrays) {
    require(std::cmp_equal(values.size(), size), "size of " + name);
  }
}

void require_consistent(const MeshArrays& piece)
{
  const GlobalIndex num_points = piece.num_points();
  const GlobalIndex num_cells = piece.num_cells();
  const auto is_optional = [](const auto& values, GlobalIndex size) {
    return values.empty() || std::cmp_equal(values.size(), size);
  };
  require(vtk_cell_type(piece) != 0, "vertices per cell");
  require(piece.point_xyz.size() % 3 == 0, "size of positions");
  require(std::cmp_equal(piece.cell_points.size(), num_cells * piece.vertices_per_cell),
          "size of connectivity");
  require(std::cmp_less_equal(piece.cell_points.size(), std::numeric_limits<std::int32_t>::max())
              && num_points <= std::numeric_limits<std::int32_t>::max(),
          "more than 32-bit indices can hold; use more subdomains");
  const auto is_point = [&](LocalIndex point) { return point >= 0 && point < num_points; };
  require(std::all_of(piece.cell_points.begin(), piece.cell_points.end(), is_point),
          "a cell has a point that does not exist");
  require(is_optional(piece.point_ids, num_points), "size of point ids");
  require(is_optional(piece.cell_ids, num_cells), "size of cell ids");
  const bool has_ghosts = piece.num_ghost_layers > 0;
  require(std::cmp_equal(piece.point_ghost.size(), has_ghosts ? num_points : 0)
              && std::cmp_equal(piece.cell_ghost.size(), has_ghosts ? num_cells : 0),
          "size of ghosts");
  require_size(piece.point_ints, num_points);
  require_size(piece.point_longs, num_points);
  require_size(piece.cell_ints, num_cells);
  require_size(piece.cell_longs, num_cells);
  require_size(piece.cell_doubles, num_cells);
}

}  // namespace

Compression usual_compression() { return can_compress() ? Compression::lz4 : Compression::none; }

void require_compression(Compression compression)
{
  if (compression == Compression::none || can_compress()) return;
  throw ConfigError(
      "this build of tessera has no VTK (it was configured with -DTESSERA_WITH_VTK=OFF), which "
      "compresses mesh files; set output.compression = \"none\"");
}

void write_vtu(const MeshArrays& piece, const std::filesystem::path& path, Compression compression)
{
  require_compression(compression);
  require_consistent(piece);
  if (compression == Compression::none) {
    write_plain_vtu(piece, path);
  } else {
    write_compressed_vtu(piece, path, compression);
  }
}

}  // namespace tessera::io
