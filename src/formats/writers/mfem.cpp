// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/mfem.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "formats/cells.hpp"
#include "formats/files/text_buffer.hpp"
#include "formats/files/whole_file.hpp"
#include "formats/joined_tets.hpp"
#include "formats/plain_name.hpp"

namespace tessera::formats {
namespace {

// MFEM's number of a shape.
constexpr ByShape<int> kTypes{{4, 7, 6, 2, 3}};

// Points that name an entity, in an order that follows from their numbers in the whole mesh: so all
// pieces write them alike.
template <std::size_t N>
struct Entity {
  std::array<GlobalIndex, N> numbers{};
  std::array<LocalIndex, N> rows{};

  friend auto operator<=>(const Entity&, const Entity&) = default;
};

// Ascending; four go around from the lowest to the lower of the two beside it.
template <std::size_t N>
Entity<N> entity_of(const Piece& piece, std::array<LocalIndex, N> rows)
{
  Entity<N> entity;
  const auto number_of = [&](LocalIndex row) { return piece.point_numbers[at(row)]; };
  if constexpr (N < 4) {
    std::ranges::sort(rows, {}, number_of);
  } else {
    std::rotate(rows.begin(), std::ranges::min_element(rows, {}, number_of), rows.end());
    if (number_of(rows[3]) < number_of(rows[1])) std::swap(rows[1], rows[3]);
  }
  entity.rows = rows;
  for (std::size_t i = 0; i < N; ++i) entity.numbers[i] = piece.point_numbers[at(rows[i])];
  return entity;
}

// What one set of pieces shares.
struct Group {
  std::vector<Entity<1>> points{};
  std::vector<Entity<2>> edges{};
  std::vector<Entity<3>> triangles{};
  std::vector<Entity<4>> quads{};
};
using Groups = std::map<std::vector<LocalIndex>, Group>;  // By all pieces of the set, ascending.

std::vector<LocalIndex> members(const Piece& piece, std::span<const LocalIndex> others)
{
  std::vector<LocalIndex> all(others.begin(), others.end());
  all.insert(std::ranges::lower_bound(all, piece.number), piece.number);
  return all;
}

std::vector<LocalIndex> sides_of_seams(const Piece& piece)
{
  std::vector<LocalIndex> sides;
  for (const SeamFace& seam : piece.seams) sides.push_back(seam.side);
  return sides;
}

Groups groups_of(const Piece& piece)
{
  Groups groups;
  for (std::size_t p = 0; p < piece.shared_points.size(); ++p) {
    groups[members(piece, piece.sharers[static_cast<LocalIndex>(p)])].points.push_back(
        entity_of<1>(piece, {piece.shared_points[p]}));
  }
  for (std::size_t e = 0; e < piece.shared_edges.size(); ++e) {
    groups[members(piece, piece.edge_sharers[static_cast<LocalIndex>(e)])].edges.push_back(
        entity_of<2>(piece, piece.shared_edges[e]));
  }
  const JoinedTets tets(piece);
  const std::vector<LocalIndex> sides = sides_of_seams(piece);
  for (const JoinedSide& side : joined_sides(tets, sides)) {
    Group& group = groups[members(piece, std::span(&piece.seams[at(side.row)].other_piece, 1))];
    const std::vector<LocalIndex> c = corners_of(tets, sides, side);
    if (side.shape() == Shape::quad)
      group.quads.push_back(entity_of<4>(piece, {c[0], c[1], c[2], c[3]}));
    else
      group.triangles.push_back(entity_of<3>(piece, {c[0], c[1], c[2]}));
  }
  for (auto& [pieces, group] : groups) {
    std::ranges::sort(group.points);
    std::ranges::sort(group.edges);
    std::ranges::sort(group.triangles);
    std::ranges::sort(group.quads);
  }
  return groups;
}

// Names that ParMesh reads: all ranks have all of them.
struct Sets {
  std::string materials{};
  std::string patches{};
};

// Readers take a name from quote to quote.
std::string sets_of(const char* keyword, const std::vector<std::string>& names)
{
  std::set<std::string> taken;
  std::string text = fmt::format("\n{}\n{}\n", keyword, names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = unique_name(plain_name(names[i], "\"\\"), std::identity{}, taken);
    text += fmt::format("\"{}\" 1 {}\n", name, i + 1);
  }
  return text;
}

void add_names(const Outline& outline, TextBuffer& text)
{
  for (std::size_t i = 0; i < outline.material_names.size(); ++i)
    text.add("# attribute {}: {}\n", i + 1, plain_name(outline.material_names[i]));
  for (std::size_t i = 0; i < outline.patch_names.size(); ++i)
    text.add("# boundary attribute {}: {}\n", i + 1, plain_name(outline.patch_names[i]));
}

void add_elements(const PieceCells& cells, std::span<const Shape> shapes, TextBuffer& text)
{
  std::size_t count = 0;
  for (const Shape shape : shapes) count += cells[shape].size();
  text.add("{}\n", count);
  for (const Shape shape : shapes) {
    const ElementList list = cells[shape];
    for (std::size_t i = 0; i < list.size(); ++i)
      text.add("{} {} {}\n", list.tags[i], kTypes[shape], fmt::join(list.of(i), " "));
  }
}

void add_serial_mesh(const Piece& piece, const Sets& sets, TextBuffer& text)
{
  const PieceCells cells(piece);
  text.add("\ndimension\n3\n\nelements\n");
  add_elements(cells, kCellShapes, text);
  text.add("{}\nboundary\n", sets.materials);
  add_elements(cells, kFaceShapes, text);
  text.add("{}\nvertices\n{}\n3\n", sets.patches, piece.num_points());
  for (std::size_t i = 0; i < piece.point_xyz.size(); i += 3)
    text.add("{} {} {}\n", piece.point_xyz[i], piece.point_xyz[i + 1], piece.point_xyz[i + 2]);
  text.add("\nmfem_serial_mesh_end\n");
}

// Group 0 is the piece alone; it shares nothing.
void add_group_list(const Piece& piece, const Groups& groups, TextBuffer& text)
{
  std::size_t num_faces = 0;
  for (const auto& [pieces, group] : groups)
    num_faces += group.triangles.size() + group.quads.size();
  text.add(
      "\ncommunication_groups\nnumber_of_groups {}\n\n"
      "# number of entities in each group, followed by ranks in group\n1 {}\n",
      groups.size() + 1, piece.number);
  for (const auto& [pieces, group] : groups)
    text.add("{} {}\n", pieces.size(), fmt::join(pieces, " "));
  text.add(
      "\ntotal_shared_vertices {}\ntotal_shared_edges {}\ntotal_shared_faces {}\n"
      "\n# group 0 has no shared entities\n",
      piece.shared_points.size(), piece.shared_edges.size(), num_faces);
}

void add_groups(const Groups& groups, TextBuffer& text)
{
  int number = 0;
  for (const auto& [pieces, group] : groups) {
    text.add("\n# group {}\nshared_vertices {}\n", ++number, group.points.size());
    for (const Entity<1>& point : group.points) text.add("{}\n", point.rows[0]);
    text.add("\nshared_edges {}\n", group.edges.size());
    for (const Entity<2>& edge : group.edges) text.add("{} {}\n", edge.rows[0], edge.rows[1]);
    text.add("\nshared_faces {}\n", group.triangles.size() + group.quads.size());
    for (const Entity<3>& face : group.triangles)
      text.add("{} {}\n", kTypes[Shape::triangle], fmt::join(face.rows, " "));
    for (const Entity<4>& face : group.quads)
      text.add("{} {}\n", kTypes[Shape::quad], fmt::join(face.rows, " "));
  }
}

class MfemWriter final : public Writer {
 public:
  MfemWriter(const WriterTarget& target, MfemNames names)
      : outline_(target.outline), folder_(target.folder), names_(names)
  {
    if (names_ == MfemNames::comments) return;
    sets_.materials = sets_of("attribute_sets", outline_.material_names);
    sets_.patches = sets_of("bdr_attribute_sets", outline_.patch_names);
  }

  void begin() override {}

  void write(const Piece& piece) override
  {
    TextBuffer text;
    const bool has_sets = names_ == MfemNames::sets;
    text.add("MFEM mesh v1.{}\n\n", has_sets ? 3 : 2);
    if (!has_sets) add_names(outline_, text);
    add_serial_mesh(piece, sets_, text);
    const Groups groups = groups_of(piece);
    add_group_list(piece, groups, text);
    add_groups(groups, text);
    text.add("\nmfem_mesh_end\n");
    const char* const name = has_sets ? "mesh_sets" : "mesh";
    write_whole_file(folder_ / fmt::format("{}.{:06}", name, piece.number), text.view());
  }

 private:
  const Outline& outline_;
  const std::filesystem::path& folder_;
  MfemNames names_;
  Sets sets_{};
};

}  // namespace

std::unique_ptr<Writer> make_mfem_writer(const WriterTarget& target, MfemNames names)
{
  return std::make_unique<MfemWriter>(target, names);
}

}  // namespace tessera::formats
