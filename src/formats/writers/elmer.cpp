// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/elmer.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/io/files.hpp"

#include "formats/cells.hpp"
#include "formats/files/text_buffer.hpp"
#include "formats/files/whole_file.hpp"
#include "formats/link/tets_behind.hpp"
#include "formats/plain_name.hpp"

namespace tessera::formats {
namespace {

// Elmer's number of a shape.
constexpr ByShape<int> kTypes{{504, 605, 706, 303, 404}};

void require_integers_suffice(const Outline& outline)
{
  const GlobalIndex most =
      std::max({outline.num_points(), outline.num_cells(), outline.num_faces()});
  if (most <= INT32_MAX) return;
  throw ConfigError(fmt::format(
      "the mesh has {} cells and {} points, but Elmer can have {} of each; take xdmf or mfem",
      outline.num_cells(), outline.num_points(), INT32_MAX));
}

std::string lower_case(std::string text)
{
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

// Elmer finds names without regard to case, and reads a line up to "=".
std::string name_lines(const std::vector<std::string>& names, std::set<std::string>& taken)
{
  std::string lines;
  for (std::size_t i = 0; i < names.size(); ++i) {
    lines += fmt::format("$ {} = {}\n", unique_name(plain_name(names[i], "$=!"), lower_case, taken),
                         i + 1);
  }
  return lines;
}

std::string names_text(const Outline& outline)
{
  std::set<std::string> taken;
  std::string text = "! ----- names for bodies -----\n" + name_lines(outline.material_names, taken);
  return text + "! ----- names for boundaries -----\n" + name_lines(outline.patch_names, taken);
}

std::string header_text(const Piece& piece, const PieceCells& cells)
{
  std::size_t num_cells = 0;
  std::size_t num_faces = 0;
  int num_types = 0;
  std::string types;
  for (const Shape shape : kShapes) {
    const std::size_t count = cells[shape].size();
    (is_cell(shape) ? num_cells : num_faces) += count;
    if (count == 0 && shape != Shape::tet) continue;
    ++num_types;
    types += fmt::format("{} {}\n", kTypes[shape], count);
  }
  return fmt::format("{} {} {}\n{}\n{}{} 0\n", piece.num_points(), num_cells, num_faces, num_types,
                     types, piece.shared_points.size());
}

TextBuffer nodes_text(const Piece& piece)
{
  TextBuffer text;
  for (std::size_t p = 0; p < piece.point_numbers.size(); ++p) {
    const double* const xyz = piece.point_xyz.data() + 3 * p;
    text.add("{} -1 {} {} {}\n", piece.point_numbers[p] + 1, xyz[0], xyz[1], xyz[2]);
  }
  return text;
}

TextBuffer elements_text(const Piece& piece, const PieceCells& cells, const Outline& outline)
{
  TextBuffer text;
  for (const Shape shape : kCellShapes) {
    const ElementList list = cells[shape];
    const std::vector<GlobalIndex> nodes = point_numbers(piece, list, 1);
    GlobalIndex number = outline.first_number(shape, piece.number);
    for (std::size_t i = 0; i < list.size(); ++i) {
      text.add("{} {} {} {}\n", ++number, list.tags[i], kTypes[shape],
               fmt::join(std::span(nodes).subspan(list.width * i, list.width), " "));
    }
  }
  return text;
}

// Numbers of the cells on both sides of a face, from 1. A cell of another piece cannot be named as
// a parent: 0 stands for it.
std::array<GlobalIndex, 2> parents_of(LocalIndex side, const std::vector<LocalIndex>& behind,
                                      const PieceCells& cells, const ByShape<GlobalIndex>& first_of)
{
  const auto number = [&](LocalIndex tet) {
    const CellPlace cell = cells.cell_of(tet);
    return first_of[cell.shape] + cell.row + 1;
  };
  const LocalIndex other = behind[at(side)];
  return {number(side / 4), other == kNoIndex ? 0 : number(other)};
}

TextBuffer boundary_text(const Piece& piece, const PieceCells& cells, const Outline& outline)
{
  TextBuffer text;
  const std::vector<LocalIndex> behind = tets_behind(piece.num_points(), piece.tet_points);
  ByShape<GlobalIndex> first_of;
  for (const Shape shape : kShapes) first_of[shape] = outline.first_number(shape, piece.number);
  std::size_t face = 0;
  for (const Shape shape : kFaceShapes) {
    const ElementList list = cells[shape];
    const std::vector<GlobalIndex> nodes = point_numbers(piece, list, 1);
    GlobalIndex number = first_of[shape] - outline.num_cells();
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto [parent, other] = parents_of(cells.tet_side(face++), behind, cells, first_of);
      text.add("{} {} {} {} {} {}\n", ++number, list.tags[i], parent, other, kTypes[shape],
               fmt::join(std::span(nodes).subspan(list.width * i, list.width), " "));
    }
  }
  return text;
}

// The owner, which is the lowest piece, stands first.
TextBuffer shared_text(const Piece& piece)
{
  TextBuffer text;
  for (std::size_t p = 0; p < piece.shared_points.size(); ++p) {
    const auto others = piece.sharers[static_cast<LocalIndex>(p)];
    std::vector<LocalIndex> parts(others.begin(), others.end());
    parts.push_back(piece.number);
    std::ranges::sort(parts);
    for (LocalIndex& part : parts) ++part;
    text.add("{} {} {}\n", piece.point_numbers[at(piece.shared_points[p])] + 1, parts.size(),
             fmt::join(parts, " "));
  }
  return text;
}

class ElmerWriter final : public Writer {
 public:
  explicit ElmerWriter(const WriterTarget& target)
      : outline_(target.outline),
        folder_(target.folder),
        parts_(target.folder / fmt::format("partitioning.{}", target.outline.num_pieces()))
  {
    require_integers_suffice(outline_);
  }

  void begin() override { io::make_own_folder(parts_); }

  void write(const Piece& piece) override
  {
    const PieceCells cells(piece);
    write_part(piece, "nodes", nodes_text(piece));
    write_part(piece, "elements", elements_text(piece, cells, outline_));
    write_part(piece, "boundary", boundary_text(piece, cells, outline_));
    write_part(piece, "shared", shared_text(piece));
    write_whole_file(part(piece, "header"), header_text(piece, cells));
  }

  void commit() override { write_whole_file(folder_ / "mesh.names", names_text(outline_)); }

 private:
  [[nodiscard]] std::filesystem::path part(const Piece& piece, const char* kind) const
  {
    return parts_ / fmt::format("part.{}.{}", piece.number + 1, kind);
  }

  void write_part(const Piece& piece, const char* kind, const TextBuffer& text) const
  {
    write_whole_file(part(piece, kind), text.view());
  }

  const Outline& outline_;
  const std::filesystem::path& folder_;
  std::filesystem::path parts_;
};

}  // namespace

std::unique_ptr<Writer> make_elmer_writer(const WriterTarget& target)
{
  return std::make_unique<ElmerWriter>(target);
}

}  // namespace tessera::formats
