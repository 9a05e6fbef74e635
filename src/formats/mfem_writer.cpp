// SPDX-License-Identifier: BSD-3-Clause
#include "formats/mfem_writer.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tessera/mesh/tet_topology.hpp"

#include "formats/plain_name.hpp"
#include "formats/text_buffer.hpp"
#include "formats/whole_file.hpp"

namespace tessera::formats {
namespace {

// MFEM's numbers of shapes.
constexpr int kTriangle = 2;
constexpr int kTet = 4;

// Points that name an entity, ascending by their numbers in the whole mesh: so all pieces write
// them alike.
template <std::size_t N>
struct Entity {
  std::array<GlobalIndex, N> numbers{};
  std::array<LocalIndex, N> rows{};

  friend auto operator<=>(const Entity&, const Entity&) = default;
};

template <std::size_t N>
Entity<N> entity_of(const Piece& piece, std::array<LocalIndex, N> rows)
{
  Entity<N> entity;
  std::ranges::sort(rows, {}, [&](LocalIndex row) { return piece.point_numbers[at(row)]; });
  entity.rows = rows;
  for (std::size_t i = 0; i < N; ++i) entity.numbers[i] = piece.point_numbers[at(rows[i])];
  return entity;
}

// What one set of pieces shares.
struct Group {
  std::vector<Entity<1>> points{};
  std::vector<Entity<2>> edges{};
  std::vector<Entity<3>> faces{};
};
using Groups = std::map<std::vector<LocalIndex>, Group>;  // By all pieces of the set, ascending.

std::vector<LocalIndex> members(const Piece& piece, std::span<const LocalIndex> others)
{
  std::vector<LocalIndex> all(others.begin(), others.end());
  all.insert(std::ranges::lower_bound(all, piece.number), piece.number);
  return all;
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
  for (const SeamFace& seam : piece.seams) {
    const LocalIndex* const corner = piece.tet_points.data() + 4 * at(seam.side / 4);
    const auto& [a, b, c] = mesh::kTetFaceCorners[at(seam.side % 4)];
    groups[members(piece, std::span(&seam.other_piece, 1))].faces.push_back(
        entity_of<3>(piece, {corner[a], corner[b], corner[c]}));
  }
  for (auto& [pieces, group] : groups) {
    std::ranges::sort(group.points);
    std::ranges::sort(group.edges);
    std::ranges::sort(group.faces);
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

void add_serial_mesh(const Piece& piece, const Sets& sets, TextBuffer& text)
{
  text.add("\ndimension\n3\n\nelements\n{}\n", piece.num_tets());
  for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
    const LocalIndex* const point = piece.tet_points.data() + 4 * at(t);
    text.add("{} {} {} {} {} {}\n", piece.tet_material[at(t)], kTet, point[0], point[1], point[2],
             point[3]);
  }
  text.add("{}\nboundary\n{}\n", sets.materials, piece.num_triangles());
  for (LocalIndex t = 0; t < piece.num_triangles(); ++t) {
    const LocalIndex* const point = piece.triangle_points.data() + 3 * at(t);
    text.add("{} {} {} {} {}\n", piece.triangle_patch[at(t)], kTriangle, point[0], point[1],
             point[2]);
  }
  text.add("{}\nvertices\n{}\n3\n", sets.patches, piece.num_points());
  for (std::size_t i = 0; i < piece.point_xyz.size(); i += 3)
    text.add("{} {} {}\n", piece.point_xyz[i], piece.point_xyz[i + 1], piece.point_xyz[i + 2]);
  text.add("\nmfem_serial_mesh_end\n");
}

// Group 0 is the piece alone; it shares nothing.
void add_group_list(const Piece& piece, const Groups& groups, TextBuffer& text)
{
  text.add(
      "\ncommunication_groups\nnumber_of_groups {}\n\n"
      "# number of entities in each group, followed by ranks in group\n1 {}\n",
      groups.size() + 1, piece.number);
  for (const auto& [pieces, group] : groups)
    text.add("{} {}\n", pieces.size(), fmt::join(pieces, " "));
  text.add(
      "\ntotal_shared_vertices {}\ntotal_shared_edges {}\ntotal_shared_faces {}\n"
      "\n# group 0 has no shared entities\n",
      piece.shared_points.size(), piece.shared_edges.size(), piece.seams.size());
}

void add_groups(const Groups& groups, TextBuffer& text)
{
  int number = 0;
  for (const auto& [pieces, group] : groups) {
    text.add("\n# group {}\nshared_vertices {}\n", ++number, group.points.size());
    for (const Entity<1>& point : group.points) text.add("{}\n", point.rows[0]);
    text.add("\nshared_edges {}\n", group.edges.size());
    for (const Entity<2>& edge : group.edges) text.add("{} {}\n", edge.rows[0], edge.rows[1]);
    text.add("\nshared_faces {}\n", group.faces.size());
    for (const Entity<3>& face : group.faces)
      text.add("{} {} {} {}\n", kTriangle, face.rows[0], face.rows[1], face.rows[2]);
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
