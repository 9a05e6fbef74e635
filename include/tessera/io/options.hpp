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
  elmer,            ///< Elmer's partitioning.N.
  mfem,             ///< MFEM's parallel mesh, a file a piece.
  openfoam,         ///< A decomposed case of OpenFOAM.
  openfoam_serial,  ///< A case of OpenFOAM for one process.
};
[[nodiscard]] constexpr Format last_value(Format /*type*/) { return Format::openfoam_serial; }

/// @brief Words of `output.formats`, and of `tessera convert`.
constexpr auto enum_words(Format /*tag*/)
{
  return std::to_array<EnumWord<Format>>({
      {Format::pvtu, "pvtu"},
      {Format::xdmf, "xdmf"},
      {Format::elmer, "elmer"},
      {Format::mfem, "mfem"},
      {Format::openfoam, "openfoam"},
      {Format::openfoam_serial, "openfoam-serial"},
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
  LocalIndex files = 0;       ///< Number of piece files; 0: one for each subdomain.
  LocalIndex parts = 0;       ///< Number of balanced, connected parts, a file each; 0: see `files`.
  int order = 1;              ///< 1: straight tets; 2: with a node in the middle of every edge.
  bool cell_quality = false;  ///< Also write the mean ratio of every tet.

  friend bool operator==(const OutputOptions&, const OutputOptions&) = default;
};

}  // namespace tessera::io
