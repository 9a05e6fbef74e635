// SPDX-License-Identifier: BSD-3-Clause
#include "cad/content.hpp"

#include <numeric>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>

#include <BinTools.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/given_up.hpp"

#include "cad/error.hpp"
#include "cad/shape.hpp"

namespace tessera::cad {
namespace {

struct StoredContent {
  std::string image{};  // As BinTools writes the shape.
  std::vector<std::string> face_names{};
  std::vector<std::string> face_colours{};
  std::vector<LocalIndex> given_face{};
  std::vector<std::string> edge_names{};
  std::vector<std::string> solid_names{};
  std::vector<LocalIndex> solid_body{};
  bool may_overlap = false;
  std::optional<RoughFigures> figures{};

  static auto fields(auto& self)
  {
    return std::tie(self.image, self.face_names, self.face_colours, self.given_face,
                    self.edge_names, self.solid_names, self.solid_body, self.may_overlap,
                    self.figures);
  }
};

// An only solid has triangles since it was asked which side of its faces is inside.
std::optional<RoughFigures> known_figures(const TopoDS_Shape& shape)
{
  if (count_of(shape, TopAbs_SOLID) != 1) return std::nullopt;
  try {
    return rough_figures_of(shape, box_diagonal_of(shape));
  } catch (const Standard_Failure& failure) {
    note_given_up("figures of the model", error_of(failure));
    return std::nullopt;
  }
}

}  // namespace

Bytes occ_content(const CadFile& cad)
{
  std::ostringstream image(std::ios::binary);
  BinTools::Write(cad.shape, image, Standard_False, Standard_False, BinTools_FormatVersion_CURRENT);
  StoredContent content{.image = image.str(),
                        .solid_body = cad.solid_body,
                        .may_overlap = cad.may_overlap,
                        .figures = known_figures(cad.shape)};
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(cad.shape, TopAbs_FACE, faces);
  for (int f = 1; f <= faces.Extent(); ++f) {
    const ShapeLabel label = label_in(cad.names, faces(f));
    content.face_names.push_back(label.name);
    content.face_colours.push_back(label.colour);
    if (cad.given_face.IsEmpty()) continue;
    const int* const given = cad.given_face.Seek(faces(f));
    content.given_face.push_back(given == nullptr ? 0 : *given);
  }
  for (const TopoDS_Shape& edge : parts_of(cad.shape, TopAbs_EDGE)) {
    content.edge_names.push_back(label_in(cad.names, edge).name);
  }
  for (TopExp_Explorer solids(cad.shape, TopAbs_SOLID); solids.More(); solids.Next()) {
    const ShapeLabel label = label_in(cad.names, solids.Current());
    content.solid_names.push_back(label.name);
    for (const TopoDS_Shape& face : parts_of(solids.Current(), TopAbs_FACE)) {
      auto& colour = content.face_colours[static_cast<std::size_t>(faces.FindIndex(face)) - 1];
      if (colour.empty()) colour = label.colour;
    }
  }
  if (content.solid_body.empty()) {
    content.solid_body.resize(content.solid_names.size());
    std::iota(content.solid_body.begin(), content.solid_body.end(), 1);
  }
  return to_bytes(content);
}

model::ModelSource closed_source(CadFile cad, const std::string& file_name,
                                 const model::AssemblyOptions& options)
{
  try {
    with_occ_errors("healing", [&] { make_closed_solids(cad, options); });
  } catch (const GeometryError& error) {
    throw GeometryError(fmt::format("{}: {}", file_name, error.what()));
  } catch (const ConfigError& error) {
    throw ConfigError(fmt::format("{}: {}", file_name, error.what()));
  }
  model::ModelSource source;
  source.format = model::Format::occ;
  source.file_name = file_name;
  source.length_unit = cad.length_unit;
  source.content = occ_content(cad);
  source.repairs = cad.repairs;
  source.assembly = cad.assembly;
  return source;
}

OccContent read_occ_content(std::span<const std::byte> bytes)
{
  auto stored = from_bytes<StoredContent>(bytes);
  OccContent content;
  std::istringstream image(std::move(stored.image), std::ios::binary);
  BinTools::Read(content.shape, image);
  if (content.shape.IsNull()) throw InputError("the stored CAD model holds no shape");
  content.face_names = std::move(stored.face_names);
  content.face_colours = std::move(stored.face_colours);
  content.given_face = std::move(stored.given_face);
  content.edge_names = std::move(stored.edge_names);
  content.solid_names = std::move(stored.solid_names);
  content.solid_body = std::move(stored.solid_body);
  content.may_overlap = stored.may_overlap;
  content.figures = stored.figures;
  return content;
}

}  // namespace tessera::cad
