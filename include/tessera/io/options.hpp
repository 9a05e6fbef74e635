// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/types.hpp"

namespace tessera::io {

/// @brief Forms that a mesh is written in.
enum class Format : int {
  pvtu,             ///< Piece files in VTU, and indices of them in PVTU.
  xdmf,             ///< HDF5 with an index in XDMF.
  abaqus,           ///< Text, for CalculiX and Abaqus.
  elmer,            ///< Elmer's partitioning.N.
  exodus,           ///< Binary, for ParaView and MOOSE.
  medit,            ///< Text, for FreeFEM.
  mfem,             ///< MFEM's parallel mesh, a file a piece.
  mfem_sets,        ///< The same with named sets of attributes, for MFEM 4.7 and later.
  msh,              ///< Gmsh's MSH 4.1, binary, one file.
  msh2,             ///< Gmsh's MSH 2.2, text, one file.
  msh_parts,        ///< Gmsh's MSH 4.1, binary, a file for each piece, with ghost tets.
  openfoam,         ///< A decomposed case of OpenFOAM.
  openfoam_serial,  ///< A case of OpenFOAM for one process.
  pvtu_cells,       ///< As pvtu, with the triangles in the grids of the tets, for GEOS.
};
[[nodiscard]] constexpr Format last_value(Format /*type*/) { return Format::pvtu_cells; }

/// @brief Words of `output.formats`, and of `tessera convert`.
constexpr auto enum_words(Format /*tag*/)
{
  return std::to_array<EnumWord<Format>>({
      {Format::pvtu, "pvtu"},
      {Format::xdmf, "xdmf"},
      {Format::abaqus, "abaqus"},
      {Format::elmer, "elmer"},
      {Format::exodus, "exodus"},
      {Format::medit, "medit"},
      {Format::mfem, "mfem"},
      {Format::mfem_sets, "mfem-sets"},
      {Format::msh, "msh"},
      {Format::msh2, "msh2"},
      {Format::msh_parts, "msh-parts"},
      {Format::openfoam, "openfoam"},
      {Format::openfoam_serial, "openfoam-serial"},
      {Format::pvtu_cells, "pvtu-cells"},
  });
}

/// @brief Whether a format is written of tets of second order. Others do not know them, or nothing
/// on Debian 12 reads them.
[[nodiscard]] constexpr bool holds_second_order(Format format)
{
  return format == Format::pvtu || format == Format::xdmf || format == Format::abaqus
         || format == Format::exodus || format == Format::msh || format == Format::msh2;
}

/// @brief What formats other than pvtu have on walls with layers.
enum class LayerCells : int { prisms, tets };
[[nodiscard]] constexpr LayerCells last_value(LayerCells /*type*/) { return LayerCells::tets; }

/// @brief Words of `output.layers`, and of `tessera convert --layers`.
constexpr auto enum_words(LayerCells /*tag*/)
{
  return std::to_array<EnumWord<LayerCells>>({
      {LayerCells::prisms, "prisms"},
      {LayerCells::tets, "tets"},
  });
}

/// @brief How the arrays of mesh files are packed.
enum class Compression : int { none, lz4, zlib };
[[nodiscard]] constexpr Compression last_value(Compression /*type*/) { return Compression::zlib; }

/// @brief Words of `output.compression`.
constexpr auto enum_words(Compression /*tag*/)
{
  return std::to_array<EnumWord<Compression>>({
      {Compression::none, "none"},
      {Compression::lz4, "lz4"},
      {Compression::zlib, "zlib"},
  });
}

/// @brief Options of the output; table `[output]` of a case file.
struct OutputOptions {
  std::filesystem::path directory{};  ///< Relative to the working directory.
  /// Not empty, none twice. Piece files in `pvtu` are always written: all that reads a mesh reads
  /// them.
  std::vector<Format> formats{Format::pvtu};
  Compression compression = Compression::lz4;
  LocalIndex files = 0;  ///< Number of piece files; 0: one for each subdomain.
  LocalIndex parts = 0;  ///< Number of balanced, connected parts, a file each; 0: see `files`.
  LayerCells layers = LayerCells::prisms;  ///< Of formats other than pvtu.
  int order = 1;              ///< 1: straight tets; 2: with a node in the middle of every edge.
  bool cell_quality = false;  ///< Also write the mean ratio of every tet.
  bool report_html = true;    ///< Also write the report for people, with pictures.

  friend bool operator==(const OutputOptions&, const OutputOptions&) = default;
};

}  // namespace tessera::io
