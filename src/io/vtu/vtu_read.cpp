// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/mesh/periodic_pairs.hpp"

#include "io/vtu/arrays.hpp"
#include "io/vtu/data_array.hpp"
#include "io/vtu/mesh_file.hpp"
#include "io/vtu/vtu_elements.hpp"
#include "io/vtu/vtu_ghosts.hpp"
#include "io/vtu/xml.hpp"

namespace tessera::io {
namespace {

using mesh::MeshArrays;

/// Kinds that are read; earlier ones come first where a file has several.
constexpr std::array kFirstOrder{CellKind{4}, CellKind{3}};
constexpr std::array kUpToSecondOrder{CellKind{4}, CellKind{3}, CellKind{10}, CellKind{6}};
constexpr std::array kTriangles{CellKind{3}};
constexpr std::array kEdges{CellKind{2, true}, CellKind{3, true}};

std::span<const CellKind> kinds_of(CellOrder order)
{
  if (order == CellOrder::edges) return kEdges;
  if (order == CellOrder::triangles) return kTriangles;
  if (order == CellOrder::first) return kFirstOrder;
  return kUpToSecondOrder;
}

/// @brief Which cells are kept, and how many there were.
struct Selection {
  std::vector<std::size_t> kept{};  ///< Empty if all are.
  std::size_t num_kept = 0;
  std::size_t num_cells = 0;

  [[nodiscard]] bool is_all() const { return num_kept == num_cells; }
};

[[nodiscard]] Selection select_cells(const MixedCells& cells, std::uint8_t kind)
{
  Selection selection;
  selection.num_cells = cells.types.size();
  selection.num_kept = static_cast<std::size_t>(std::ranges::count(cells.types, kind));
  if (selection.is_all()) return selection;
  for (std::size_t cell = 0; cell < cells.types.size(); ++cell) {
    if (cells.types[cell] == kind) selection.kept.push_back(cell);
  }
  return selection;
}

/// @brief Points of the cells that are kept. All of them are not copied: they are most of a file.
[[nodiscard]] std::vector<LocalIndex> points_of_cells(MixedCells cells, const Selection& selection,
                                                      std::size_t vertices_per_cell)
{
  const auto points_of = [&](std::size_t cell) {
    const auto points = cells.points_of(cell);
    require(points.size() == vertices_per_cell, "a cell has not the number of points of its type");
    return points;
  };
  if (selection.is_all()) {
    for (std::size_t cell = 0; cell < selection.num_cells; ++cell)
      static_cast<void>(points_of(cell));
    cells.connectivity.resize(selection.num_cells * vertices_per_cell);
    return std::move(cells.connectivity);
  }
  std::vector<LocalIndex> kept;
  kept.reserve(selection.num_kept * vertices_per_cell);
  for (const std::size_t cell : selection.kept)
    std::ranges::copy(points_of(cell), std::back_inserter(kept));
  return kept;
}

void keep_cells(MixedCells cells, const Selection& selection, MeshArrays& mesh)
{
  const GlobalIndex num_points = mesh.num_points();
  require(num_points <= std::numeric_limits<LocalIndex>::max(), kTooManyPoints);
  mesh.cell_points = points_of_cells(std::move(cells), selection,
                                     static_cast<std::size_t>(mesh.vertices_per_cell));
  for (const LocalIndex point : mesh.cell_points)
    require(point >= 0 && point < num_points, "a cell has a point that does not exist");
}

template <class T>
[[nodiscard]] std::vector<T> selected(std::vector<T> values, const Selection& selection)
{
  if (selection.is_all()) return values;
  std::vector<T> kept;
  kept.reserve(selection.num_kept);
  for (const std::size_t cell : selection.kept) kept.push_back(values[cell]);
  return kept;
}

/// @brief Name of the array with the ids: as flagged, else the first usual name there is, else "".
template <class Names>
[[nodiscard]] std::string ids_name(const XmlElement& data, const Names& usual_names)
{
  std::string flagged = data.attribute_or("GlobalIds", "");
  if (!flagged.empty()) return flagged;
  for (const std::string_view name : usual_names) {
    for (const XmlElement& element : data.children) {
      if (name_of(element) == name) return std::string(name);
    }
  }
  return {};
}

/// @brief The array, or nothing if it is text or has several components. MeshArrays has no place
/// for such an array, so it is not even decoded.
/// @throws InputError if it has not one value for each of `size` entities.
[[nodiscard]] std::optional<DataArray> read_scalars(const XmlElement& element,
                                                    const Encoding& encoding, std::size_t size)
{
  const bool is_array = element.name == "DataArray" && element.attribute("type") != "String";
  if (!is_array || element.attribute_or("NumberOfComponents", "1") != "1") return std::nullopt;
  DataArray array = decode_array(element, encoding);
  require(array.num_values() == size,
          fmt::format("array {} has not the size it should", name_of(element)));
  return array;
}

void read_point_data(const XmlElement& data, const Encoding& encoding, MeshArrays& mesh)
{
  const auto num_points = static_cast<std::size_t>(mesh.num_points());
  const std::string ids = ids_name(data, kUsualPointIdNames);
  for (const XmlElement& element : data.children) {
    const auto array = read_scalars(element, encoding, num_points);
    if (!array) continue;
    if (name_of(element) == ids) {
      if (auto values = values_as<GlobalIndex>(*array)) mesh.point_ids = *std::move(values);
    } else if (name_of(element).starts_with(mesh::kPeriodicPartnerName)) {
      if (auto values = values_as<GlobalIndex>(*array))
        mesh.point_longs[name_of(element)] = *std::move(values);
    } else if (auto values = values_as<std::int32_t>(*array)) {
      mesh.point_ints[name_of(element)] = *std::move(values);
    }
  }
}

[[nodiscard]] bool is_wide(ScalarType type)
{
  return type == ScalarType::i64 || type == ScalarType::u64 || type == ScalarType::u32;
}

/// @brief Whether these numbers have 32 bits in our files. Other tools write what they have.
[[nodiscard]] bool is_narrow(std::string_view name)
{
  return name == "attribute" || name == "subdomain" || name == "patch" || name == "line";
}

void read_cell_data(const XmlElement& data, const Encoding& encoding, const Selection& selection,
                    MeshArrays& mesh)
{
  const std::string ids = ids_name(data, kUsualCellIdNames);
  for (const XmlElement& element : data.children) {
    const auto array = read_scalars(element, encoding, selection.num_cells);
    if (!array) continue;
    const std::string name = name_of(element);
    if (array->is_floating()) {
      mesh.cell_doubles[name] = selected(*values_as<double>(*array), selection);
      continue;
    }
    const bool stays_wide = name == ids || (is_wide(array->type) && !is_narrow(name));
    if (auto values = stays_wide ? std::nullopt : values_as<std::int32_t>(*array)) {
      mesh.cell_ints[name] = selected(*std::move(values), selection);
    } else if (auto wide = values_as<GlobalIndex>(*array)) {
      (name == ids ? mesh.cell_ids : mesh.cell_longs[name]) = selected(*std::move(wide), selection);
    }
  }
}

/// @brief The texts of a string array: bytes, each text ended by a 0.
[[nodiscard]] std::vector<std::string> read_texts(const XmlElement& element,
                                                  const Encoding& encoding)
{
  const DataArray array = decode_array(element, encoding);
  std::vector<std::string> texts;
  std::string text;
  for (const std::byte byte : array.values) {
    if (byte == std::byte{0}) {
      texts.push_back(std::move(text));
      text.clear();
    } else {
      text += static_cast<char>(byte);
    }
  }
  if (!text.empty()) texts.push_back(std::move(text));
  return texts;
}

void read_field_data(const XmlElement& grid, const Encoding& encoding, MeshArrays& mesh)
{
  const XmlElement* const data = grid.child("FieldData");
  if (data == nullptr) return;
  for (const XmlElement& element : data->children) {
    const bool is_text = element.name == "Array" && element.attribute("type") == "String";
    if (is_text) mesh.field_texts[name_of(element)] = read_texts(element, encoding);
  }
}

/// @brief A piece element whose points and cells are read, but not yet reduced to one kind.
struct RawPiece {
  const XmlElement* element = nullptr;
  MixedCells cells{};
};

[[nodiscard]] MeshArrays reduce(RawPiece raw, const Encoding& encoding, const CellKind& kind)
{
  MeshArrays mesh;
  mesh.vertices_per_cell = kind.vertices;
  mesh.are_edges = kind.is_edge;
  mesh.point_xyz = read_points(*raw.element, encoding);
  const Selection selection = select_cells(raw.cells, vtk_cell_type(kind));
  mesh.num_other_cells = static_cast<GlobalIndex>(selection.num_cells - selection.num_kept);
  keep_cells(std::move(raw.cells), selection, mesh);
  if (const XmlElement* const data = raw.element->child("PointData")) {
    read_point_data(*data, encoding, mesh);
  }
  if (const XmlElement* const data = raw.element->child("CellData")) {
    read_cell_data(*data, encoding, selection, mesh);
  }
  drop_ghosts(mesh);
  return mesh;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from)
{
  to.insert(to.end(), from.begin(), from.end());
}

/// @brief Appends arrays that both have, and drops the others, which have no value for some
/// entities.
template <class T>
void append(std::map<std::string, std::vector<T>>& to,
            const std::map<std::string, std::vector<T>>& from)
{
  std::erase_if(to, [&](const auto& entry) { return !from.contains(entry.first); });
  for (auto& [name, values] : to) append(values, from.at(name));
}

/// @brief Appends ids if all entities of both have some; else the whole has none.
void append_ids(std::vector<GlobalIndex>& to, GlobalIndex num_to,
                const std::vector<GlobalIndex>& from, GlobalIndex num_from)
{
  const bool is_complete =
      std::cmp_equal(to.size(), num_to) && std::cmp_equal(from.size(), num_from);
  if (is_complete) {
    append(to, from);
  } else {
    to.clear();
  }
}

/// @brief Appends a further piece of the same file.
void append(MeshArrays& to, const MeshArrays& from)
{
  if (from.num_points() == 0) return;
  if (to.num_points() == 0) {
    to = from;
    return;
  }
  require(to.num_points() + from.num_points() <= std::numeric_limits<LocalIndex>::max(),
          kTooManyPoints);
  const auto first_point = static_cast<LocalIndex>(to.num_points());
  append_ids(to.point_ids, first_point, from.point_ids, from.num_points());
  append_ids(to.cell_ids, to.num_cells(), from.cell_ids, from.num_cells());
  append(to.point_xyz, from.point_xyz);
  for (const LocalIndex point : from.cell_points) to.cell_points.push_back(first_point + point);
  append(to.point_ints, from.point_ints);
  append(to.point_longs, from.point_longs);
  append(to.cell_ints, from.cell_ints);
  append(to.cell_longs, from.cell_longs);
  append(to.cell_doubles, from.cell_doubles);
  to.num_other_cells += from.num_other_cells;
}

/// @brief The first of these kinds that is there; the first of all if none is.
[[nodiscard]] CellKind kind_to_read(const std::vector<RawPiece>& pieces,
                                    std::span<const CellKind> kinds)
{
  const auto is_there = [&](const CellKind& kind) {
    return std::ranges::any_of(pieces, [&](const RawPiece& piece) {
      return std::ranges::find(piece.cells.types, vtk_cell_type(kind)) != piece.cells.types.end();
    });
  };
  const auto found = std::ranges::find_if(kinds, is_there);
  return found == kinds.end() ? kinds.front() : *found;
}

[[nodiscard]] MeshArrays read_document(const XmlDocument& document, const Encoding& encoding,
                                       CellOrder order)
{
  const XmlElement& grid = required_child(document.root, "UnstructuredGrid");
  std::vector<RawPiece> pieces;
  for (const XmlElement& element : grid.children) {
    if (element.name == "Piece") pieces.push_back({&element, read_cells(element, encoding)});
  }
  require(!pieces.empty(), "it has no piece");

  const CellKind kind = kind_to_read(pieces, kinds_of(order));
  MeshArrays mesh = reduce(std::move(pieces.front()), encoding, kind);
  for (RawPiece& raw : std::span(pieces).subspan(1))
    append(mesh, reduce(std::move(raw), encoding, kind));
  read_field_data(grid, encoding, mesh);
  return mesh;
}

/// @brief Whether the head of a file reaches to appended data, and these are raw bytes.
[[nodiscard]] bool reaches_raw_data(std::string_view head)
{
  const std::size_t tag = head.find("<AppendedData");
  if (tag == std::string_view::npos) return false;
  const std::size_t end = head.find('>', tag);
  if (end == std::string_view::npos || head.find('_', end) == std::string_view::npos) return false;
  const XmlDocument document = parse_vtk_xml(head);
  return document.appended.data() != nullptr && !document.appended_is_base64;
}

/// @brief Raw data stay in the file until an array is asked for: they are most of it, and the
/// arrays take their place in memory.
[[nodiscard]] MeshArrays read_file(const std::filesystem::path& path, CellOrder order)
{
  constexpr std::size_t kHeadSize = std::size_t{1} << 16;
  constexpr std::size_t kTailSize = 4096;
  const StoredBytes all(path);
  const auto text_of = [&](std::size_t begin, std::size_t end) {
    const Bytes bytes = all.read(begin, end);
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  std::string text = text_of(0, std::min(all.size(), kHeadSize));
  const bool is_head = reaches_raw_data(text);
  if (!is_head) text = load_file(path);
  require_complete(is_head ? text_of(all.size() - std::min(all.size(), kTailSize), all.size())
                           : text);

  const XmlDocument document = parse_vtk_xml(text);
  Encoding encoding = encoding_of(document);
  if (is_head) {
    const auto begin = static_cast<std::size_t>(document.appended.data() - text.data());
    encoding.appended = all.from(begin);
  }
  return read_document(document, encoding, order);
}

}  // namespace

MeshArrays read_vtu(const std::filesystem::path& path, CellOrder order)
{
  return naming_the_file(path, [&] { return read_file(path, order); });
}

}  // namespace tessera::io
