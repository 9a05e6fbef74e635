// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/io/options.hpp"
#include "tessera/mesh/mesh_arrays.hpp"

namespace tessera::io {

/// @brief Writes one piece as a VTK XML unstructured grid (.vtu). Local.
///
/// Raw appended data, Int32 connectivity; ids as Int64 arrays "GlobalPointIds" and "GlobalCellIds"
/// with the attribute GLOBAL_IDS, which spares a reader a global sort. Equal arrays give equal
/// bytes. The file appears under its name only when complete. All pieces of one mesh need the same
/// keys in the maps of arrays, also those without points or cells.
/// @pre The arrays fit together: every array has one entry a point or cell, or is empty where it is
///      optional; `cell_points` lie in 0…num_points-1.
/// @throws ConfigError as require_compression().
/// @throws MeshError if they do not, or if a 32-bit index cannot hold the piece.
/// @throws OutputError naming the file and the cause (permission, disk full).
void write_vtu(const mesh::MeshArrays& piece, const std::filesystem::path& path,
               Compression compression);

/// @brief That this build can write files of that compression: without VTK it compresses none.
/// Local.
/// @throws ConfigError saying what to set.
void require_compression(Compression compression);

/// @brief The default compression; none in a build without VTK. Local.
[[nodiscard]] Compression usual_compression();

/// @brief Points that two pieces both have. Pieces are numbered in the order of their index.
struct SharedPoints {
  LocalIndex piece = 0;
  LocalIndex other = 0;  ///< Above `piece`.
  GlobalIndex num_points = 0;

  static auto fields(auto& self) { return std::tie(self.piece, self.other, self.num_points); }

  friend auto operator<=>(const SharedPoints&, const SharedPoints&) = default;
};

/// @brief Writes the index (.pvtu) of piece files that all have the arrays of `schema`. Local.
///
/// @param pieces paths relative to the folder of `path`, in the order in which they are read.
/// @param schema any one piece; only its names and which optional arrays are there matter.
/// @param neighbours become the field data "neighbours", shape (pairs, 3), unless there are none.
/// @throws OutputError naming the file and the cause.
void write_pvtu(const std::filesystem::path& path, const std::vector<std::filesystem::path>& pieces,
                const mesh::MeshArrays& schema, const std::vector<SharedPoints>& neighbours = {});

/// @brief The piece files that a .pvtu names, in its order; a .vtu is its own only piece. Local.
///
/// Whether the pieces exist is not looked at. A piece outside the index's own folder is refused: a
/// mesh from elsewhere must not make a program read other files.
/// @throws InputError naming the file and what is wrong.
[[nodiscard]] std::vector<std::filesystem::path> piece_files(const std::filesystem::path& path);

/// @brief Which cells a reader takes.
enum class CellOrder {
  first,
  up_to_second,
  triangles,  ///< The linear triangles alone, also in a file of tets.
  edges,      ///< The linear edges; in a file without any, those of second order.
};

/// @brief Reads a .vtu of any tool, in every encoding that VTK's XML format has. Local.
/// A build without VTK cannot read compressed arrays.
///
/// - Cells: the linear tets; in a file without any, the linear triangles. With
///   CellOrder::up_to_second in a file without either the tets, else the triangles, of second
///   order, as VTK_QUADRATIC_TETRA and VTK_QUADRATIC_TRIANGLE. Cells of all other kinds
///   are counted in `num_other_cells` and left out. A file without cells counts as one of tets.
/// - Ghosts, cells that "vtkGhostType" says are copies of another piece's, are left out.
/// - Ids: the array that the attribute GlobalIds names; else one of the usual names.
/// - Positions and cell arrays of 32-bit floating point are widened.
/// - Integer arrays with one component: up to 32 bits (and UInt32 or 64 bits on points) become
///   `point_ints`, `cell_ints`; wider ones of cells `cell_longs`, and ids of periodic partners
///   `point_longs`. Arrays with no place in MeshArrays, or with values that do not fit it, are left
///   out.
///
/// VTK's own reader is not used: it hangs or dies of a few flipped bits (a block size of 0).
/// What is returned is consistent: sizes match, `cell_points` lie in 0…num_points-1.
/// @throws InputError naming the file and what is wrong: missing, not a .vtu, cut off, corrupt,
/// compressed in a build without VTK.
[[nodiscard]] mesh::MeshArrays read_vtu(const std::filesystem::path& path,
                                        CellOrder order = CellOrder::first);

/// @brief VTK's version, e.g. "9.1.0"; "none" in a build without VTK. Local.
[[nodiscard]] std::string vtk_version();

}  // namespace tessera::io
