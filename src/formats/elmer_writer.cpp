// SPDX-License-Identifier: BSD-3-Clause
#include "formats/elmer_writer.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/io/files.hpp"

#include "formats/plain_name.hpp"
#include "formats/tets_behind.hpp"
#include "formats/text_buffer.hpp"
#include "formats/whole_file.hpp"

namespace tessera::formats {
namespace {

// Elmer's numbers of shapes.
constexpr int kTriangle = 303;
constexpr int kTet = 504;

void require_integers_suffice(const Outline& outline)
{
  const GlobalIndex most =
      std::max({outline.num_points(), outline.num_tets(), outline.num_triangles()});
  if (most <= INT32_MAX) return;
  throw ConfigError(fmt::format(
      "the mesh has {} tets and {} points, but Elmer can have {} of each; take xdmf or mfem",
      outline.num_tets(), outline.num_points(), INT32_MAX));
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

std::string header_text(const Piece& piece)
{
  std::string text =
      fmt::format("{} {} {}\n", piece.num_points(), piece.num_tets(), piece.num_triangles());
  text += fmt::format("{}\n{} {}\n", piece.num_triangles() > 0 ? 2 : 1, kTet, piece.num_tets());
  if (piece.num_triangles() > 0) text += fmt::format("{} {}\n", kTriangle, piece.num_triangles());
  return text + fmt::format("{} 0\n", piece.shared_points.size());
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

TextBuffer elements_text(const Piece& piece, GlobalIndex first_tet)
{
  TextBuffer text;
  const auto node = [&](LocalIndex row) { return piece.point_numbers[at(row)] + 1; };
  for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
    const LocalIndex* const row = piece.tet_points.data() + 4 * at(t);
    text.add("{} {} {} {} {} {} {}\n", first_tet + t + 1, piece.tet_material[at(t)], kTet,
             node(row[0]), node(row[1]), node(row[2]), node(row[3]));
  }
  return text;
}

// A tet of another piece cannot be named as a parent: 0 stands for it.
TextBuffer boundary_text(const Piece& piece, GlobalIndex first_tet, GlobalIndex first_triangle)
{
  TextBuffer text;
  const std::vector<LocalIndex> behind = tets_behind(piece.num_points(), piece.tet_points);
  const auto node = [&](LocalIndex row) { return piece.point_numbers[at(row)] + 1; };
  for (LocalIndex t = 0; t < piece.num_triangles(); ++t) {
    const LocalIndex side = piece.triangle_side[at(t)];
    const LocalIndex other = behind[at(side)];
    const LocalIndex* const row = piece.triangle_points.data() + 3 * at(t);
    text.add("{} {} {} {} {} {} {} {}\n", first_triangle + t + 1, piece.triangle_patch[at(t)],
             first_tet + side / 4 + 1, other == kNoIndex ? 0 : first_tet + other + 1, kTriangle,
             node(row[0]), node(row[1]), node(row[2]));
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
    const GlobalIndex first_tet = outline_.first_tet[at(piece.number)];
    const GlobalIndex first_triangle = outline_.first_triangle[at(piece.number)];
    write_part(piece, "nodes", nodes_text(piece));
    write_part(piece, "elements", elements_text(piece, first_tet));
    write_part(piece, "boundary", boundary_text(piece, first_tet, first_triangle));
    write_part(piece, "shared", shared_text(piece));
    write_whole_file(part(piece, "header"), header_text(piece));
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
