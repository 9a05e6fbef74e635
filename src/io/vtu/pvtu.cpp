// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/xml_escape.hpp"
#include "tessera/io/files.hpp"
#include "tessera/io/vtu.hpp"

#include "io/vtu/arrays.hpp"
#include "io/vtu/mesh_file.hpp"
#include "io/vtu/vtu_ghosts.hpp"
#include "io/vtu/xml.hpp"

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

void put_array(std::string& out, std::string_view type, std::string_view name)
{
  out += fmt::format("      <PDataArray type=\"{}\" Name=\"{}\"/>\n", type, xml_escape(name));
}

template <class Arrays>
void put_arrays(std::string& out, std::string_view type, const Arrays& arrays)
{
  for (const auto& [name, values] : arrays) put_array(out, type, name);
}

void put_ids(std::string& out, std::string_view element, std::string_view name, bool has_ids)
{
  if (!has_ids) {
    out += fmt::format("    <{}>\n", element);
    return;
  }
  out += fmt::format("    <{} GlobalIds=\"{}\">\n", element, name);
  out += fmt::format("      <PDataArray type=\"Int64\" IdType=\"1\" Name=\"{}\"/>\n", name);
}

/// @brief A text array: the codes of its characters as VTK writes them, each text ended by a 0.
void put_texts(std::string& out, const std::string& name, const std::vector<std::string>& texts)
{
  out += fmt::format(
      "      <Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">\n",
      xml_escape(name), texts.size());
  for (const std::string& text : texts) {
    for (const char character : text) {
      out += fmt::format("{} ", int{static_cast<signed char>(character)});
    }
    out += "0\n";
  }
  out += "      </Array>\n";
}

void put_neighbours(std::string& out, const std::vector<SharedPoints>& neighbours)
{
  out += fmt::format(
      "      <DataArray type=\"Int64\" Name=\"neighbours\" NumberOfComponents=\"3\" "
      "NumberOfTuples=\"{}\" format=\"ascii\">\n",
      neighbours.size());
  for (const auto& [piece, other, num_points] : neighbours) {
    out += fmt::format("{} {} {}\n", piece, other, num_points);
  }
  out += "      </DataArray>\n";
}

void put_field_data(std::string& out, const mesh::MeshArrays& schema,
                    const std::vector<SharedPoints>& neighbours)
{
  if (schema.field_texts.empty() && neighbours.empty()) return;
  out += "    <FieldData>\n";
  for (const auto& [name, texts] : schema.field_texts) put_texts(out, name, texts);
  if (!neighbours.empty()) put_neighbours(out, neighbours);
  out += "    </FieldData>\n";
}

[[nodiscard]] std::string index_text(const std::vector<fs::path>& pieces,
                                     const mesh::MeshArrays& schema,
                                     const std::vector<SharedPoints>& neighbours)
{
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "  <PUnstructuredGrid GhostLevel=\"{}\">\n",
      schema.num_ghost_layers);
  put_field_data(out, schema, neighbours);
  put_ids(out, "PPointData", kPointIdsName, has_point_ids(schema));
  put_arrays(out, "Int32", schema.point_ints);
  put_arrays(out, "Int64", schema.point_longs);
  if (schema.num_ghost_layers > 0) put_array(out, "UInt8", kGhostName);
  out += "    </PPointData>\n";
  put_ids(out, "PCellData", kCellIdsName, has_cell_ids(schema));
  put_arrays(out, "Int32", schema.cell_ints);
  put_arrays(out, "Int64", schema.cell_longs);
  put_arrays(out, "Float64", schema.cell_doubles);
  if (schema.num_ghost_layers > 0) put_array(out, "UInt8", kGhostName);
  out +=
      "    </PCellData>\n"
      "    <PPoints>\n"
      "      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n"
      "    </PPoints>\n";
  for (const fs::path& piece : pieces) {
    out += fmt::format("    <Piece Source=\"{}\"/>\n", xml_escape(piece.generic_string()));
  }
  out +=
      "  </PUnstructuredGrid>\n"
      "</VTKFile>\n";
  return out;
}

[[nodiscard]] bool is_within(const fs::path& folder, const fs::path& path)
{
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

[[nodiscard]] fs::path piece_path(const fs::path& folder, const std::string& source)
{
  if (source.empty()) throw InputError("a piece has no file name");
  // Of an index in the working directory the folder is empty, which fs::absolute() refuses.
  const fs::path base = (fs::current_path() / folder).lexically_normal();
  if (!is_within(base, (base / source).lexically_normal())) {
    throw InputError(fmt::format("piece {} is outside of the folder of its index", source));
  }
  return (folder / source).lexically_normal();
}

[[nodiscard]] std::vector<fs::path> pieces_of_index(const fs::path& path)
{
  const std::string file = load_file(path);
  const XmlDocument document = parse_vtk_xml(file);
  const XmlElement* const grid = document.root.child("PUnstructuredGrid");
  if (grid == nullptr) throw InputError("it has no element PUnstructuredGrid");
  std::vector<fs::path> pieces;
  for (const XmlElement& element : grid->children) {
    if (element.name == "Piece") {
      pieces.push_back(piece_path(path.parent_path(), element.attribute("Source")));
    }
  }
  return pieces;
}

/// @brief Whether the head of a file says that it is an index; throws if it is no mesh at all.
[[nodiscard]] bool is_index(const fs::path& path)
{
  constexpr std::size_t kHeadSize = 4096;
  const std::string head = load_file(path, kHeadSize);
  const std::size_t begin = head.find("<VTKFile");
  const std::string_view tag = std::string_view(head).substr(std::min(begin, head.size()));
  const std::string_view root = tag.substr(0, tag.find('>'));
  if (root.find("\"PUnstructuredGrid\"") != std::string_view::npos) return true;
  if (root.find("\"UnstructuredGrid\"") != std::string_view::npos) return false;
  throw InputError("it is no VTK XML file of an unstructured grid (.vtu, .pvtu)");
}

}  // namespace

void write_pvtu(const fs::path& path, const std::vector<fs::path>& pieces,
                const mesh::MeshArrays& schema, const std::vector<SharedPoints>& neighbours)
{
  write_text_atomically(path, index_text(pieces, schema, neighbours));
}

std::vector<fs::path> piece_files(const fs::path& path)
{
  return naming_the_file(path, [&]() -> std::vector<fs::path> {
    if (is_index(path)) return pieces_of_index(path);
    return {path};
  });
}

}  // namespace tessera::io
