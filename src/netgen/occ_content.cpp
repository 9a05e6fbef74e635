// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/occ_content.hpp"

#include <sstream>
#include <tuple>
#include <utility>

#include <BinTools.hxx>
#include <TopExp_Explorer.hxx>

#include "netgen/occ_shape.hpp"

namespace tessera::netgen {
namespace {

struct StoredContent {
  std::string image{};  // As BinTools writes the shape.
  std::vector<std::string> face_names{};
  std::vector<std::string> solid_names{};

  static auto fields(auto& self) { return std::tie(self.image, self.face_names, self.solid_names); }
};

std::string name_in(const ShapeNames& names, const TopoDS_Shape& part)
{
  const std::string* name = names.Seek(part);
  return name != nullptr ? *name : std::string();
}

}  // namespace

Bytes occ_content(const CadFile& cad)
{
  std::ostringstream image(std::ios::binary);
  BinTools::Write(cad.shape, image, Standard_False, Standard_False, BinTools_FormatVersion_CURRENT);
  StoredContent content{.image = image.str()};
  for (const TopoDS_Shape& face : parts_of(cad.shape, TopAbs_FACE)) {
    content.face_names.push_back(name_in(cad.names, face));
  }
  for (TopExp_Explorer solids(cad.shape, TopAbs_SOLID); solids.More(); solids.Next()) {
    content.solid_names.push_back(name_in(cad.names, solids.Current()));
  }
  return to_bytes(content);
}

OccContent read_occ_content(std::span<const std::byte> bytes)
{
  auto stored = from_bytes<StoredContent>(bytes);
  OccContent content;
  std::istringstream image(std::move(stored.image), std::ios::binary);
  BinTools::Read(content.shape, image);
  if (content.shape.IsNull()) throw InputError("the stored CAD model holds no shape");
  content.face_names = std::move(stored.face_names);
  content.solid_names = std::move(stored.solid_names);
  return content;
}

}  // namespace tessera::netgen
