// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cstdint>
#include <map>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tessera/base/xml_escape.hpp"

#include "io/atomic_file.hpp"
#include "io/vtu/arrays.hpp"
#include "io/vtu/vtu_ghosts.hpp"
#include "io/vtu/vtu_writers.hpp"
#include "io/vtu/xml.hpp"

namespace tessera::io {
namespace {

using mesh::MeshArrays;

static_assert(std::endian::native == std::endian::little, "the file says LittleEndian");

constexpr std::string_view kHead =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\">\n"
    "  <UnstructuredGrid>\n";

constexpr std::string_view kTail =
    "\n  </AppendedData>\n"
    "</VTKFile>\n";

template <class T>
constexpr std::string_view type_name()
{
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

/// @brief The elements of a file, and views of the arrays that follow them, each behind its size.
class Document {
 public:
  [[nodiscard]] std::ostream& xml() { return xml_; }

  /// @brief An array whose `values` must live until write(). @param more further attributes.
  template <class T>
  void put(std::string_view name, const std::vector<T>& values, std::string_view more = "")
  {
    xml_ << "        <DataArray type=\"" << type_name<T>() << "\" Name=\"" << xml_escape(name)
         << '"' << more;
    put_block(std::as_bytes(std::span(values)));
  }

  /// @brief Texts, each ended by a 0.
  void put_texts(std::string_view name, std::size_t num_texts, const std::string& bytes)
  {
    xml_ << R"(      <Array type="String" Name=")" << xml_escape(name) << "\" NumberOfTuples=\""
         << num_texts << '"';
    put_block(std::as_bytes(std::span(bytes)));
  }

  template <class T>
  void put_all(const std::map<std::string, std::vector<T>>& arrays)
  {
    for (const auto& [name, values] : arrays) put(name, values);
  }

  void write(AtomicFile& file) const
  {
    const std::string xml = xml_.str();
    file.write(std::as_bytes(std::span(xml)));
    for (const std::span<const std::byte> block : blocks_) {
      const std::uint64_t size = block.size();
      file.write(std::as_bytes(std::span(&size, 1)));
      file.write(block);
    }
  }

 private:
  void put_block(std::span<const std::byte> bytes)
  {
    xml_ << " format=\"appended\" offset=\"" << next_offset_ << "\"/>\n";
    blocks_.push_back(bytes);
    next_offset_ += sizeof(std::uint64_t) + bytes.size();
  }

  std::ostringstream xml_{};
  std::vector<std::span<const std::byte>> blocks_{};
  std::uint64_t next_offset_ = 0;
};

void open_data(Document& document, std::string_view element, std::string_view name,
               const std::vector<GlobalIndex>& ids, bool has_ids)
{
  document.xml() << "      <" << element;
  if (has_ids) document.xml() << " GlobalIds=\"" << name << '"';
  document.xml() << ">\n";
  if (has_ids) document.put(name, ids, R"( IdType="1")");
}

void put_point_data(Document& document, const MeshArrays& piece)
{
  open_data(document, "PointData", kPointIdsName, piece.point_ids, has_point_ids(piece));
  document.put_all(piece.point_ints);
  document.put_all(piece.point_longs);
  if (piece.num_ghost_layers > 0) document.put(kGhostName, piece.point_ghost);
  document.xml() << "      </PointData>\n";
}

void put_cell_data(Document& document, const MeshArrays& piece)
{
  open_data(document, "CellData", kCellIdsName, piece.cell_ids, has_cell_ids(piece));
  document.put_all(piece.cell_ints);
  document.put_all(piece.cell_longs);
  document.put_all(piece.cell_doubles);
  if (piece.num_ghost_layers > 0) document.put(kGhostName, piece.cell_ghost);
  document.xml() << "      </CellData>\n";
}

/// @brief What a file has of each cell beside its points.
struct CellKinds {
  std::vector<std::int32_t> ends{};  ///< End of each cell in the list of points of cells.
  std::vector<std::uint8_t> types{};
};

[[nodiscard]] CellKinds kinds_of(const MeshArrays& piece)
{
  const auto num_cells = static_cast<std::size_t>(piece.num_cells());
  CellKinds kinds;
  kinds.types.assign(num_cells, vtk_cell_type(piece));
  kinds.ends.reserve(num_cells);
  for (std::size_t cell = 1; cell <= num_cells; ++cell) {
    kinds.ends.push_back(static_cast<std::int32_t>(cell) * piece.vertices_per_cell);
  }
  return kinds;
}

void put_geometry(Document& document, const MeshArrays& piece, const CellKinds& kinds)
{
  document.xml() << "      <Points>\n";
  document.put("Points", piece.point_xyz, R"( NumberOfComponents="3")");
  document.xml() << "      </Points>\n"
                    "      <Cells>\n";
  document.put("connectivity", piece.cell_points);
  document.put("offsets", kinds.ends);
  document.put("types", kinds.types);
  document.xml() << "      </Cells>\n";
}

/// @brief The texts of each array, one behind the other, each ended by a 0.
[[nodiscard]] std::map<std::string, std::string> bytes_of_texts(const MeshArrays& piece)
{
  std::map<std::string, std::string> all;
  for (const auto& [name, texts] : piece.field_texts) {
    for (const std::string& text : texts) all[name] += text + '\0';
  }
  return all;
}

}  // namespace

void write_plain_vtu(const MeshArrays& piece, const std::filesystem::path& path)
{
  AtomicFile file(path);
  const CellKinds kinds = kinds_of(piece);
  std::map<std::string, std::string> texts = bytes_of_texts(piece);
  Document document;
  document.xml() << kHead << "    <FieldData>\n";
  for (const auto& [name, values] : piece.field_texts) {
    document.put_texts(name, values.size(), texts[name]);
  }
  document.xml() << "    </FieldData>\n"
                 << "    <Piece NumberOfPoints=\"" << piece.num_points() << "\" NumberOfCells=\""
                 << piece.num_cells() << "\">\n";
  put_point_data(document, piece);
  put_cell_data(document, piece);
  put_geometry(document, piece, kinds);
  document.xml() << "    </Piece>\n"
                    "  </UnstructuredGrid>\n"
                    "  <AppendedData encoding=\"raw\">\n"
                    "   _";
  document.write(file);
  file.write(std::as_bytes(std::span(kTail)));
  file.commit();
}

}  // namespace tessera::io
