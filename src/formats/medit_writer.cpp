// SPDX-License-Identifier: BSD-3-Clause
#include "formats/medit_writer.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "formats/limits.hpp"
#include "formats/plain_name.hpp"
#include "formats/record_file.hpp"
#include "formats/text_records.hpp"

namespace tessera::formats {
namespace {

enum Section : std::size_t { kVertices, kTetrahedra, kTriangles };

constexpr std::string_view kNoReference = " 0\n";

struct Widths {
  std::size_t point = 1;
  std::size_t tag = 1;
};

Widths widths_of(const Outline& outline)
{
  const std::size_t num_tags = std::max(outline.material_names.size(), outline.patch_names.size());
  return {num_digits(outline.num_points()), num_digits(static_cast<GlobalIndex>(num_tags))};
}

GlobalIndex cell_size(const Widths& widths, std::size_t num_corners)
{
  return static_cast<GlobalIndex>(num_corners * (widths.point + 1) + widths.tag + 1);
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
  return {
      {fmt::format("MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n{}\n", outline.num_points()),
       outline.num_points(), kPointSize},
      {fmt::format("\nTetrahedra\n{}\n", outline.num_tets()), outline.num_tets(),
       cell_size(widths, 4)},
      {fmt::format("\nTriangles\n{}\n", outline.num_triangles()), outline.num_triangles(),
       cell_size(widths, 3)}};
}

class MeditWriter final : public Writer {
 public:
  explicit MeditWriter(const WriterTarget& target)
      : outline_(target.outline),
        widths_(widths_of(outline_)),
        file_(target.folder / "mesh.mesh", sections_of(outline_),
              "\nEnd\n" + names("material", outline_.material_names)
                  + names("patch", outline_.patch_names))
  {
    require_32_bit_numbers(outline_, io::Format::medit);
  }

  void begin() override { file_.begin(); }

  void write(const Piece& piece) override
  {
    const std::size_t p = at(piece.number);
    file_.write(kVertices, outline_.first_point[p], points(piece));
    file_.write(kTetrahedra, outline_.first_tet[p],
                cells(piece, piece.tet_points, piece.tet_material));
    file_.write(kTriangles, outline_.first_triangle[p],
                cells(piece, piece.triangle_points, piece.triangle_patch));
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

  std::string cells(const Piece& piece, const std::vector<LocalIndex>& rows,
                    const std::vector<std::int32_t>& tags) const
  {
    TextRecords text;
    const std::size_t num_corners = tags.empty() ? 0 : rows.size() / tags.size();
    for (std::size_t i = 0; i < tags.size(); ++i) {
      for (const LocalIndex row : std::span(rows).subspan(i * num_corners, num_corners))
        text.integer(piece.point_numbers[at(row)] + 1, widths_.point).text(" ");
      text.integer(tags[i], widths_.tag).text("\n");
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
