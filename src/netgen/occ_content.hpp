// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include <TopoDS_Shape.hxx>

#include "tessera/base/bytes.hpp"

#include "netgen/occ_cad_file.hpp"

namespace tessera::netgen {

/// @brief A healed shape and its names as they travel in ModelSource::content.
struct OccContent {
  TopoDS_Shape shape{};
  std::vector<std::string> face_names{};   ///< In TopExp::MapShapes order; empty text: no name.
  std::vector<std::string> solid_names{};  ///< In the order of TopExp_Explorer.
};

[[nodiscard]] Bytes to_bytes(const CadFile& cad);
/// @throws InputError if the bytes are truncated or hold no shape.
[[nodiscard]] OccContent occ_content_from_bytes(std::span<const std::byte> bytes);

}  // namespace tessera::netgen
