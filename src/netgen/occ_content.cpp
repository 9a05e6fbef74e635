// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/occ_content.hpp"

#include <sstream>

#include <BinTools.hxx>
#include <TopExp_Explorer.hxx>

#include "netgen/occ_shape.hpp"

namespace tessera::netgen {
namespace {

std::string name_in(const ShapeNames& names, const TopoDS_Shape& part)
{
  const std::string* name = names.Seek(part);
  return name != nullptr ? *name : std::string();
}

}  // namespace

Bytes to_bytes(const CadFile& cad)
{
  std::ostringstream image(std::ios::binary);
  BinTools::Write(cad.shape, image, Standard_False, Standard_False, BinTools_FormatVersion_CURRENT);
  std::vector<std::string> face_names;
  std::vector<std::string> solid_names;
  for (const TopoDS_Shape& face : parts_of(cad.shape, TopAbs_FACE)) {
    face_names.push_back(name_in(cad.names, face));
  }
  for (TopExp_Explorer solids(cad.shape, TopAbs_SOLID); solids.More(); solids.Next()) {
    solid_names.push_back(name_in(cad.names, solids.Current()));
  }
  ByteWriter out;
  out.put(image.str());
  out.put(face_names);
  out.put(solid_names);
  return std::move(out).take();
}

OccContent occ_content_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  OccContent content;
  std::istringstream image(in.get_string(), std::ios::binary);
  BinTools::Read(content.shape, image);
  if (content.shape.IsNull()) throw InputError("the stored CAD model holds no shape");
  content.face_names = in.get_strings();
  content.solid_names = in.get_strings();
  return content;
}

}  // namespace tessera::netgen
