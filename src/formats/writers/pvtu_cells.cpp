// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/pvtu_cells.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "tessera/formats/export_mesh.hpp"
#include "tessera/io/files.hpp"
#include "tessera/io/vtu.hpp"

#include "formats/cells.hpp"
#include "formats/files/shared_file.hpp"

namespace tessera::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPieceFolder = "cells";

fs::path file_name(LocalIndex piece) { return fmt::format("piece_{:06}.vtu", piece); }

// Elements of a file, and the arrays that follow them, each behind its size.
class VtuText {
 public:
  void element(std::string_view line) { xml_ += line; }

  template <class Value>
  void array(std::string_view type, std::string_view name, const std::vector<Value>& values,
             std::string_view more = "")
  {
    xml_ += fmt::format(R"(<DataArray type="{}" Name="{}"{} format="appended" offset="{}"/>)"
                        "\n",
                        type, name, more, arrays_.size());
    append_block(values.data(), values.size() * sizeof(Value));
  }

  void texts(const std::string& name, const std::vector<std::string>& texts)
  {
    xml_ += fmt::format(
        R"(<Array type="String" Name="{}" NumberOfTuples="{}" format="appended" offset="{}"/>)"
        "\n",
        name, texts.size(), arrays_.size());
    std::string characters;
    for (const std::string& text : texts) characters += text + '\0';
    append_block(characters.data(), characters.size());
  }

  void write(SharedFile& file) const
  {
    const auto xml_size = static_cast<GlobalIndex>(xml_.size());
    file.write(0, xml_);
    file.write(xml_size, arrays_);
    file.write(xml_size + static_cast<GlobalIndex>(arrays_.size()),
               std::string_view("\n</AppendedData>\n</VTKFile>\n"));
  }

 private:
  void append_block(const void* data, std::uint64_t size)
  {
    arrays_.append(reinterpret_cast<const char*>(&size), sizeof(size));
    arrays_.append(static_cast<const char*>(data), size);
  }

  std::string xml_{};
  std::string arrays_{};
};

class PvtuCellsWriter final : public Writer {
 public:
  explicit PvtuCellsWriter(const WriterTarget& target)
      : outline_(target.outline), folder_(target.folder)
  {
    texts_["material_names"] = outline_.material_names;
    auto& names = texts_["attribute_names"] = outline_.material_names;
    names.insert(names.end(), outline_.patch_names.begin(), outline_.patch_names.end());
    if (!outline_.length_unit.empty()) texts_["length_unit"] = {outline_.length_unit};
  }

  void begin() override { io::make_own_folder(folder_ / kPieceFolder); }

  void write(const Piece& piece) override
  {
    const PieceCells cells(piece);
    VtuText text;
    text.element(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n");
    for (const auto& [name, texts] : texts_) text.texts(name, texts);
    put_neighbours(piece.number, text);
    text.element("</FieldData>\n");
    text.element(fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                             piece.num_points(), num_elements(cells)));
    put_data(piece, cells, text);
    put_geometry(piece, cells, text);
    text.element("</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    SharedFile file(folder_ / kPieceFolder / file_name(piece.number));
    file.create();
    text.write(file);
    file.close();
    file.commit();
  }

  void commit() override
  {
    mesh::MeshArrays schema;
    schema.point_xyz.assign(3, 0.0);
    schema.point_ids.assign(1, 0);
    schema.cell_points.assign(4, 0);
    schema.cell_ids.assign(1, 0);
    schema.cell_ints["attribute"] = {};
    schema.field_texts = texts_;
    std::vector<fs::path> files;
    for (LocalIndex p = 0; p < outline_.num_pieces(); ++p)
      files.push_back(fs::path(kPieceFolder) / file_name(p));
    io::write_pvtu(folder_ / "cells.pvtu", files, schema, shared_points(outline_.pieces));
  }

 private:
  // As in the index, but the piece itself comes first in each row.
  void put_neighbours(LocalIndex piece, VtuText& text) const
  {
    std::vector<GlobalIndex> rows;
    for (const PieceNeighbour& other : outline_.pieces[at(piece)].neighbours) {
      rows.insert(rows.end(), {piece, other.piece, other.num_shared_points});
    }
    if (rows.empty()) return;
    text.array("Int64", "neighbours", rows,
               fmt::format(R"( NumberOfComponents="3" NumberOfTuples="{}")", rows.size() / 3));
  }

  static std::size_t num_elements(const PieceCells& cells)
  {
    std::size_t count = 0;
    for (const Shape shape : kShapes) count += cells[shape].size();
    return count;
  }

  void put_data(const Piece& piece, const PieceCells& cells, VtuText& text) const
  {
    std::vector<GlobalIndex> ids;
    std::vector<std::int32_t> attribute;
    const auto num_materials = static_cast<std::int32_t>(outline_.material_names.size());
    for (const Shape shape : kShapes) {
      GlobalIndex id = outline_.first_number(shape, piece.number);
      for (const std::int32_t tag : cells[shape].tags) {
        ids.push_back(id++);
        attribute.push_back(is_cell(shape) ? tag : num_materials + tag);
      }
    }
    text.element("<PointData GlobalIds=\"GlobalPointIds\">\n");
    text.array("Int64", "GlobalPointIds", piece.point_numbers, R"( IdType="1")");
    text.element("</PointData>\n<CellData GlobalIds=\"GlobalCellIds\">\n");
    text.array("Int64", "GlobalCellIds", ids, R"( IdType="1")");
    text.array("Int32", "attribute", attribute);
    text.element("</CellData>\n");
  }

  static void put_geometry(const Piece& piece, const PieceCells& cells, VtuText& text)
  {
    std::vector<LocalIndex> corners;
    std::vector<std::uint8_t> kinds;
    std::vector<std::int64_t> ends;
    std::int64_t end = 0;
    for (const Shape shape : kShapes) {
      const ElementList list = cells[shape];
      for (std::size_t i = 0; i < list.size(); ++i) {
        append_vtk_points(shape, list.of(i), corners);
        kinds.push_back(kVtkTypes[shape]);
        ends.push_back(end += static_cast<std::int64_t>(list.width));
      }
    }
    text.element("<Points>\n");
    text.array("Float64", "Points", piece.point_xyz, R"( NumberOfComponents="3")");
    text.element("</Points>\n<Cells>\n");
    text.array("Int32", "connectivity", corners);
    text.array("Int64", "offsets", ends);
    text.array("UInt8", "types", kinds);
    text.element("</Cells>\n");
  }

  const Outline& outline_;
  const fs::path& folder_;
  std::map<std::string, std::vector<std::string>> texts_{};
};

}  // namespace

std::unique_ptr<Writer> make_pvtu_cells_writer(const WriterTarget& target)
{
  return std::make_unique<PvtuCellsWriter>(target);
}

}  // namespace tessera::formats
