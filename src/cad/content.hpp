// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <TopoDS_Shape.hxx>

#include "tessera/base/bytes.hpp"
#include "tessera/base/types.hpp"
#include "tessera/model/model.hpp"

#include "cad/cad_file.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {

/// @brief A healed shape and its names as they travel in ModelSource::content.
struct OccContent {
  TopoDS_Shape shape{};
  std::vector<std::string> face_names{};    ///< In TopExp::MapShapes order; empty text: no name.
  std::vector<std::string> face_colours{};  ///< Beside face_names; its own, or that of a solid.
  std::vector<LocalIndex> given_face{};     ///< Beside face_names: as in CadFile; 0: put in.
                                            ///< Empty: nothing was.
  std::vector<std::string> edge_names{};    ///< As face_names.
  std::vector<std::string> solid_names{};   ///< In the order of TopExp_Explorer.
  std::vector<LocalIndex> solid_body{};     ///< Beside solid_names: as in CadFile, never empty.
  bool may_overlap = false;                 ///< As in CadFile.
  std::optional<RoughFigures> figures{};    ///< Of an only solid, which has triangles.
};

/// @brief ModelSource::content of a CAD file. Local.
[[nodiscard]] Bytes occ_content(const CadFile& cad);

/// @brief Closes the solids, and packs them for all ranks; `cad.repairs` are those of the source.
/// Local. @throws As make_closed_solids(), after the file's name.
[[nodiscard]] model::ModelSource closed_source(CadFile cad, const std::string& file_name,
                                               const model::AssemblyOptions& options);

/// @brief Reads it back. Local. @throws InputError if the bytes are damaged or hold no shape.
[[nodiscard]] OccContent read_occ_content(std::span<const std::byte> bytes);

}  // namespace tessera::cad
