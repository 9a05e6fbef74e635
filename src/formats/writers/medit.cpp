// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/medit.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "formats/cells.hpp"
#include "formats/files/record_file.hpp"
#include "formats/files/text_records.hpp"
#include "formats/limits.hpp"
#include "formats/plain_name.hpp"

namespace tessera::formats {
namespace {

// Sections of the file; elements follow the points.
constexpr std::size_t kVertices = 0;
constexpr std::size_t kFirstShape = 1;

constexpr ByShape<const char*> kKeywords{
    {"Tetrahedra", "Pyramids", "Prisms", "Triangles", "Quadrilaterals", "Edges"}};

// Those of tets and triangles are always there.
std::vector<Shape> shapes_of(const Outline& outline)
{
  std::vector<Shape> shapes;
  for (const Shape shape : kAllShapes)
    if (shape == Shape::tet || shape == Shape::triangle || outline.num_of(shape) > 0)
      shapes.push_back(shape);
  return shapes;
}

constexpr std::string_view kNoReference = " 0\n";

struct Widths {
  std::size_t point = 1;
  std::size_t tag = 1;
};

Widths widths_of(const Outline& outline)
{
  const std::size_t num_tags = std::max(
      {outline.material_names.size(), outline.patch_names.size(), outline.line_names.size()});
  return {num_digits(outline.num_points()), num_digits(static_cast<GlobalIndex>(num_tags))};
}

GlobalIndex cell_size(const Widths& widths, std::size_t num_points)
{
  return static_cast<GlobalIndex>(num_points * (widths.point + 1) + widths.tag + 1);
}

// # patch 1 inlet
std::string names(const char* kind, const std::vector<std::string>& names_of_tags)
{
  std::string lines;
  for (std::size_t i = 0; i < names_of_tags.size(); ++i)
    lines += fmt::format("# {} {} {}\n", kind, i + 1, plain_name(names_of_tags[i]));
  return lines;
}

std::vector<RecordSection> sections_of(const Outline& outline)
{
  const Widths widths = widths_of(outline);
  constexpr auto kPointSize =
      static_cast<GlobalIndex>(3 * (kRealWidth + 1) - 1 + kNoReference.size());
  std::vector<RecordSection> sections{
      {fmt::format("MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n{}\n", outline.num_points()),
       outline.num_points(), kPointSize}};
  for (const Shape shape : shapes_of(outline)) {
    const GlobalIndex count = outline.num_of(shape);
    sections.push_back({fmt::format("\n{}\n{}\n", kKeywords[shape], count), count,
                        cell_size(widths, num_corners(shape))});
  }
  return sections;
}

class MeditWriter final : public Writer {
 public:
  explicit MeditWriter(const WriterTarget& target)
      : outline_(target.outline),
        widths_(widths_of(outline_)),
        file_(target.folder / "mesh.mesh", sections_of(outline_),
              "\nEnd\n" + names("material", outline_.material_names)
                  + names("patch", outline_.patch_names) + names("line", outline_.line_names))
  {
    require_32_bit_numbers(outline_, io::Format::medit);
  }

  void begin() override { file_.begin(); }

  void write(const Piece& piece) override
  {
    const std::size_t p = at(piece.number);
    file_.write(kVertices, outline_.first_point[p], points(piece));
    const PieceCells cells(piece);
    std::size_t section = kFirstShape;
    for (const Shape shape : shapes_of(outline_))
      file_.write(section++, outline_.first_of[shape][p], elements(piece, cells[shape]));
  }

  void close() override { file_.close(); }
  void commit() override { file_.commit(); }

 private:
  static std::string points(const Piece& piece)
  {
    TextRecords text;
    for (std::size_t p = 0; p < at(piece.num_own_points); ++p) {
      text.real(piece.point_xyz[3 * p], kRealWidth).text(" ");
      text.real(piece.point_xyz[3 * p + 1], kRealWidth).text(" ");
      text.real(piece.point_xyz[3 * p + 2], kRealWidth).text(kNoReference);
    }
    return text.take();
  }

  [[nodiscard]] std::string elements(const Piece& piece, const ElementList& list) const
  {
    TextRecords text;
    for (std::size_t i = 0; i < list.size(); ++i) {
      for (const LocalIndex row : list.of(i))
        text.integer(piece.point_numbers[at(row)] + 1, widths_.point).text(" ");
      text.integer(list.tags[i], widths_.tag).text("\n");
    }
    return text.take();
  }

  const Outline& outline_;
  Widths widths_;
  RecordFile file_;
};

}  // namespace

std::unique_ptr<Writer> make_medit_writer(const WriterTarget& target)
{
  return std::make_unique<MeditWriter>(target);
}

}  // namespace tessera::formats
