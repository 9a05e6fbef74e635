// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/point_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>
#include <vector>

#include "tessera/io/vtu.hpp"

#include "io/vtu/mesh_file.hpp"
#include "io/vtu/split_cells.hpp"
#include "io/vtu/vtu_elements.hpp"

namespace tessera::io {
namespace {

using mesh::GridField;
using mesh::TetField;

bool is_scalar(const XmlElement& element)
{
  return element.name == "DataArray" && element.attribute_or("NumberOfComponents", "1") == "1";
}

std::string names_of_scalars(const XmlElement* data)
{
  std::string names;
  if (data == nullptr) return names;
  for (const XmlElement& element : data->children) {
    if (is_scalar(element)) {
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", name_of(element));
    }
  }
  return names;
}

bool has_array(const XmlElement* data, const std::string& name)
{
  return data != nullptr && std::ranges::any_of(data->children, [&](const XmlElement& element) {
           return name_of(element) == name;
         });
}

[[noreturn]] void fail_without_array(const XmlElement& piece, const std::string& array)
{
  const XmlElement* const data = piece.child("PointData");
  const std::string names = names_of_scalars(data);
  std::string text = fmt::format("it has no point array \"{}\" with one component", array);
  text += names.empty() ? ", and no other" : fmt::format("; it has {}", names);
  if (has_array(piece.child("CellData"), array)) {
    text += fmt::format(" (\"{}\" is an array of cells; take its averages at points)", array);
  }
  throw InputError(text);
}

// The values of the array, one for each of `num_points`.
std::vector<double> read_point_array(const XmlElement& piece, const Encoding& encoding,
                                     const std::string& array, std::size_t num_points)
{
  if (const XmlElement* const data = piece.child("PointData")) {
    for (const XmlElement& element : data->children) {
      if (!is_scalar(element) || name_of(element) != array) continue;
      std::vector<double> values = read_values<double>(element, encoding);
      require(values.size() == num_points,
              fmt::format("array {} has not the size it should", array));
      return values;
    }
  }
  fail_without_array(piece, array);
}

void append_piece(const XmlElement& piece, const Encoding& encoding, const std::string& array,
                  TetField& field)
{
  const std::vector<double> xyz = read_points(piece, encoding);
  if (xyz.empty()) return;
  const std::size_t num_points = xyz.size() / 3;
  const std::size_t first = field.values.size();
  require(first + num_points <= std::numeric_limits<LocalIndex>::max(),
          "it has more than 2^31 points");
  const std::vector<double> values = read_point_array(piece, encoding, array, num_points);
  field.point_xyz.insert(field.point_xyz.end(), xyz.begin(), xyz.end());
  field.values.insert(field.values.end(), values.begin(), values.end());
  for (const LocalIndex point : split_into_tets(read_cells(piece, encoding), num_points)) {
    field.tet_points.push_back(static_cast<LocalIndex>(first) + point);
  }
}

template <class Visit>
void for_each_piece(const XmlElement& grid, const Visit& visit)
{
  for (const XmlElement& element : grid.children) {
    if (element.name == "Piece") visit(element);
  }
}

TetField with_file(TetField field, const std::string& file, const std::string& array)
{
  require_complete(file);
  const XmlDocument document = parse_vtk_xml(file);
  const Encoding encoding = encoding_of(document);
  for_each_piece(required_child(document.root, "UnstructuredGrid"),
                 [&](const XmlElement& piece) { append_piece(piece, encoding, array, field); });
  return field;
}

TetField read_tets(const std::filesystem::path& path, const std::string& array)
{
  TetField field;
  for (const std::filesystem::path& piece : piece_files(path)) {
    field = naming_the_file(piece,
                            [&] { return with_file(std::move(field), load_file(piece), array); });
  }
  if (field.tet_points.empty()) {
    throw InputError(path.string() + ": it has no cells with a volume");
  }
  return field;
}

// N numbers in an attribute.
template <class T, std::size_t N>
std::array<T, N> numbers_of(const XmlElement& element, const std::string& key,
                            const std::string& standard)
{
  std::istringstream text(element.attribute_or(key, standard));
  text.imbue(std::locale::classic());
  std::array<T, N> numbers{};
  for (T& number : numbers) text >> number;
  require(!text.fail(), fmt::format("{} of element {} is not {} numbers", key, element.name, N));
  return numbers;
}

// First and last index in each direction.
struct Extent {
  std::array<LocalIndex, 3> first{};
  std::array<LocalIndex, 3> counts{};

  [[nodiscard]] std::size_t num_points() const
  {
    return at(counts[0]) * at(counts[1]) * at(counts[2]);
  }
};

Extent extent_of(const XmlElement& element, const std::string& key)
{
  // Beyond this, differences would overflow; and no grid of so many points fits into memory.
  constexpr LocalIndex kLargest = 1 << 20;
  const auto ends = numbers_of<LocalIndex, 6>(element, key, "");
  Extent extent;
  for (std::size_t i = 0; i < 3; ++i) {
    const LocalIndex first = ends[2 * i];
    const LocalIndex last = ends[2 * i + 1];
    require(first >= -kLargest && last <= kLargest && first <= last,
            fmt::format("{} of element {} is corrupt", key, element.name));
    extent.first[i] = first;
    extent.counts[i] = last - first + 1;
  }
  return extent;
}

GridField empty_grid(const XmlElement& image, const Extent& whole)
{
  const auto spacing = numbers_of<double, 3>(image, "Spacing", "1 1 1");
  const auto rows = numbers_of<double, 9>(image, "Direction", "1 0 0 0 1 0 0 0 1");
  GridField grid{.origin = numbers_of<double, 3>(image, "Origin", "0 0 0"), .counts = whole.counts};
  for (std::size_t i = 0; i < 3; ++i) {
    require(spacing[i] > 0.0 && std::isfinite(spacing[i]), "its Spacing is not positive");
    require(whole.counts[i] >= 2, "it has no cells with a volume");
    grid.steps[i] = spacing[i] * Vec3{rows[i], rows[3 + i], rows[6 + i]};
    grid.origin = grid.origin + double(whole.first[i]) * grid.steps[i];
  }
  constexpr double kTolerance = 1e-6;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double cosine = dot(grid.steps[i], grid.steps[j]) / (spacing[i] * spacing[j]);
      require(std::abs(cosine - (i == j ? 1.0 : 0.0)) < kTolerance, "its Direction is no rotation");
    }
  }
  return grid;
}

struct GridPiece {
  Extent extent{};
  std::vector<double> values{};
};

// Puts a piece's values where they are in the whole.
void copy_into(const GridPiece& part, const Extent& whole, GridField& grid)
{
  const Extent& piece = part.extent;
  std::array<LocalIndex, 3> offset{};
  for (std::size_t i = 0; i < 3; ++i) {
    offset[i] = piece.first[i] - whole.first[i];
    require(offset[i] >= 0 && offset[i] + piece.counts[i] <= whole.counts[i],
            "a piece is outside of the whole");
  }
  const double* from = part.values.data();
  for (LocalIndex k = 0; k < piece.counts[2]; ++k) {
    for (LocalIndex j = 0; j < piece.counts[1]; ++j) {
      const std::size_t row = at(k + offset[2]) * at(whole.counts[1]) + at(j + offset[1]);
      double* to = &grid.values[row * at(whole.counts[0]) + at(offset[0])];
      std::copy_n(from, piece.counts[0], to);
      from += piece.counts[0];
    }
  }
}

GridField read_grid(const std::string& file, const std::string& array)
{
  require_complete(file);
  const XmlDocument document = parse_vtk_xml(file);
  const Encoding encoding = encoding_of(document);
  const XmlElement& image = required_child(document.root, "ImageData");
  const Extent whole = extent_of(image, "WholeExtent");
  GridField grid = empty_grid(image, whole);
  std::vector<GridPiece> pieces;
  std::size_t num_values = 0;
  for_each_piece(image, [&](const XmlElement& element) {
    const Extent extent = extent_of(element, "Extent");
    pieces.push_back({extent, read_point_array(element, encoding, array, extent.num_points())});
    num_values += pieces.back().values.size();
  });
  // Nothing is allocated for an extent that the values do not fill. What they leave out is NaN.
  require(num_values >= whole.num_points(), "its pieces do not cover the whole");
  grid.values.assign(whole.num_points(), std::numeric_limits<double>::quiet_NaN());
  for (const GridPiece& piece : pieces) copy_into(piece, whole, grid);
  return grid;
}

}  // namespace

mesh::PointField read_point_field(const std::filesystem::path& path, const std::string& array)
{
  if (path.extension() != ".vti") return read_tets(path, array);
  return naming_the_file(path, [&] { return read_grid(load_file(path), array); });
}

}  // namespace tessera::io
