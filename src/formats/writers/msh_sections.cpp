// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/msh_sections.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "formats/plain_name.hpp"

namespace tessera::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they are");

constexpr std::size_t kMaxNameBytes = 127;
constexpr std::size_t kNumPointsOfTet10 = 10;

// Readers split lines by quotes and take backslashes for escapes.
std::string made_unique(const std::string& name, std::set<std::string>& taken)
{
  return unique_name(plain_name(name, "\"\\"), std::identity{}, taken, kMaxNameBytes);
}

Box box_of_mesh(const Outline& outline)
{
  Box box;
  for (const PieceCounts& piece : outline.pieces) box.include(piece.box);
  return box;
}

// By tag - 1.
std::vector<Box> boxes_of_tags(const Outline& outline, std::span<const Shape> shapes,
                               std::size_t num_tags)
{
  std::vector<Box> boxes(num_tags);
  for (const PieceCounts& piece : outline.pieces)
    for (const Shape shape : shapes)
      for (const TagCount& count : piece.elements[shape])
        boxes[at(count.tag - 1)].include(piece.box);
  const Box all = box_of_mesh(outline);
  for (Box& box : boxes)
    if (box.is_empty()) box = all;
  return boxes;
}

}  // namespace

GlobalIndex msh_num_elements(const Outline& outline)
{
  return outline.num_elements() + outline.num_line_edges();
}

std::int32_t msh_tag(const Outline& outline, Shape shape, std::int32_t tag)
{
  if (is_cell(shape)) return tag;
  std::size_t num_before = outline.material_names.size();
  if (shape == Shape::line) num_before += outline.patch_names.size();
  return static_cast<std::int32_t>(num_before) + tag;
}

MshCellType msh_type(const Outline& outline, Shape shape)
{
  switch (shape) {
    case Shape::tet:
      return outline.is_of_second_order() ? MshCellType{kMshVolume, 11, kNumPointsOfTet10}
                                          : MshCellType{kMshVolume, 4, 4};
    case Shape::pyramid:
      return {kMshVolume, 7, 5};
    case Shape::prism:
      return {kMshVolume, 6, 6};
    case Shape::triangle:
      return outline.is_of_second_order() ? MshCellType{kMshSurface, 9, 6}
                                          : MshCellType{kMshSurface, 2, 3};
    case Shape::quad:
      return {kMshSurface, 3, 4};
    case Shape::line:
      return outline.is_of_second_order() ? MshCellType{kMshCurve, 8, 3}
                                          : MshCellType{kMshCurve, 1, 2};
  }
  return {};
}

void msh_add_nodes(const Piece& piece, const MshCells& cells, std::size_t cell,
                   std::vector<GlobalIndex>& nodes)
{
  for (const LocalIndex row : cells.list.of(cell))
    nodes.push_back(piece.point_numbers[at(row)] + 1);
  if (cells.type.num_points == kNumPointsOfTet10)
    std::swap(*std::prev(nodes.end()), *std::prev(nodes.end(), 2));
}

MshCells msh_cells(const Outline& outline, LocalIndex piece, Shape shape, const ElementList& list)
{
  return {msh_type(outline, shape), list, outline.pieces[at(piece)].elements[shape],
          outline.first_number(shape, piece) + 1};
}

std::vector<GlobalIndex> msh4_records(const Piece& piece, const MshCells& cells,
                                      const TagCount& count)
{
  const std::size_t num_points = cells.type.num_points;
  std::vector<GlobalIndex> records;
  records.reserve(static_cast<std::size_t>(count.count) * (num_points + 1));
  for (std::size_t c = 0; c < cells.list.size(); ++c) {
    if (cells.list.tags[c] != count.tag) continue;
    records.push_back(cells.first_element + static_cast<GlobalIndex>(c));
    msh_add_nodes(piece, cells, c, records);
  }
  return records;
}

std::vector<MshEntity> msh_entities(const Outline& outline)
{
  std::set<std::string> taken;
  const auto of_dimension = [&](std::int32_t dimension, std::span<const Shape> shapes,
                                const std::vector<std::string>& names) {
    std::vector<MshEntity> entities;
    const std::vector<Box> boxes = boxes_of_tags(outline, shapes, names.size());
    for (std::size_t row = 0; row < names.size(); ++row) {
      const std::int32_t tag = msh_tag(outline, shapes.front(), static_cast<std::int32_t>(row) + 1);
      entities.push_back({dimension, tag, made_unique(names[row], taken), boxes[row]});
    }
    return entities;
  };
  constexpr std::array kLine{Shape::line};
  const auto materials = of_dimension(kMshVolume, kCellShapes, outline.material_names);
  const auto patches = of_dimension(kMshSurface, kFaceShapes, outline.patch_names);
  std::vector<MshEntity> entities = of_dimension(kMshCurve, kLine, outline.line_names);
  entities.insert(entities.end(), patches.begin(), patches.end());
  entities.insert(entities.end(), materials.begin(), materials.end());
  return entities;
}

std::string msh_physical_names(const std::vector<MshEntity>& entities)
{
  std::string text = fmt::format("$PhysicalNames\n{}\n", entities.size());
  for (const MshEntity& entity : entities)
    text += fmt::format("{} {} \"{}\"\n", entity.dimension, entity.tag, entity.name);
  return text + "$EndPhysicalNames\n";
}

std::string msh4_head(const std::vector<MshEntity>& entities)
{
  MshBytes bytes;
  // The 1 tells readers the order of bytes.
  bytes.add("$MeshFormat\n4.1 1 8\n").add(1).add("\n$EndMeshFormat\n");
  bytes.add(msh_physical_names(entities)).add("$Entities\n");
  bytes.add(GlobalIndex{0});  // Points.
  for (const std::int32_t dimension : {kMshCurve, kMshSurface, kMshVolume})
    bytes.add(GlobalIndex{std::ranges::count(entities, dimension, &MshEntity::dimension)});
  for (const MshEntity& entity : entities) {
    bytes.add(entity.tag);
    msh4_add_entity(entity, bytes);
  }
  return bytes.add("\n$EndEntities\n").text();
}

void msh4_add_entity(const MshEntity& entity, MshBytes& bytes)
{
  bytes.add(entity.box);
  bytes.add(GlobalIndex{1}).add(entity.tag);  // Its physical groups.
  bytes.add(GlobalIndex{0});                  // What bounds it.
}

std::string msh4_nodes_head(std::int32_t entity, GlobalIndex num_nodes, GlobalIndex first,
                            GlobalIndex last)
{
  MshBytes bytes;
  bytes.add("$Nodes\n").add(GlobalIndex{1}).add(num_nodes).add(first).add(last);
  return bytes.add(kMshVolume).add(entity).add(0).add(num_nodes).text();
}

std::string msh4_elements_head(GlobalIndex num_blocks, GlobalIndex num_elements, GlobalIndex first,
                               GlobalIndex last)
{
  MshBytes bytes;
  bytes.add("$Elements\n").add(num_blocks).add(num_elements).add(first).add(last);
  return bytes.text();
}

std::string msh4_block_head(const MshCellType& type, std::int32_t entity, GlobalIndex num_elements)
{
  MshBytes bytes;
  return bytes.add(type.dimension).add(entity).add(type.number).add(num_elements).text();
}

}  // namespace tessera::formats
