// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <NCollection_DataMap.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Shape.hxx>

#include "tessera/base/types.hpp"
#include "tessera/model/assembly.hpp"
#include "tessera/model/options.hpp"

namespace tessera::cad {

/// @brief What a file says of a face or a solid.
struct ShapeLabel {
  std::string name{};    ///< Empty: none.
  std::string colour{};  ///< "#RRGGBB"; empty: none.
};

/// @brief Labels of faces and solids; a shape and its reverse are the same key.
using ShapeNames = NCollection_DataMap<TopoDS_Shape, ShapeLabel, TopTools_ShapeMapHasher>;

/// @brief What they say of a face, an edge or a solid; an empty label if they do not know it.
[[nodiscard]] inline ShapeLabel label_in(const ShapeNames& names, const TopoDS_Shape& part)
{
  const ShapeLabel* const label = names.Seek(part);
  return label != nullptr ? *label : ShapeLabel();
}

/// @brief What a STEP, IGES or BREP file holds, coordinates in the file's own length unit.
struct CadFile {
  TopoDS_Shape shape{};
  /// By solid of TopExp_Explorer: the body that it is a part of, from 1. Empty: each is its own.
  std::vector<LocalIndex> solid_body{};
  /// Faces that are pieces of one before those of the case were put in: its number there, from 1.
  TopTools_DataMapOfShapeInteger given_face{};
  ShapeNames names{};                  ///< Only those that the file names or colours.
  std::string length_unit{};           ///< "mm", "m", "in", …; empty if the file does not say.
  std::vector<std::string> repairs{};  ///< What was changed since, one line each.
  bool may_overlap = false;            ///< Solids may touch or overlap, and could not be glued.
  model::Assembly assembly{};          ///< What was found where solids meet.
};

/// @brief Reads a file by its extension: .step .stp .iges .igs .brep .brp (text or binary).
/// @throws InputError if it is unreadable, truncated or not what its name says.
[[nodiscard]] CadFile read_cad_file(const std::filesystem::path& file,
                                    model::StepReader reader = model::StepReader::with_names);

/// @brief Makes `cad.shape` one closed, valid solid, or a compound of several that share the faces
/// on which they touch, with the faces in them that are to be embedded. Names follow their faces
/// and solids; every change adds to `cad.repairs`.
/// @throws GeometryError that says what the file holds instead, what stays open, or what overlaps.
void make_closed_solids(CadFile& cad, const model::AssemblyOptions& options);

}  // namespace tessera::cad
