// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/exodus.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/cells.hpp"
#include "formats/files/netcdf_file.hpp"
#include "formats/files/record_file.hpp"
#include "formats/plain_name.hpp"
#include "formats/tag_groups.hpp"

namespace tessera::formats {
namespace {

// Of the side opposite to each corner of a tet; those of other cells follow CellSide::side.
constexpr std::array<GlobalIndex, 4> kSideOppositeToCorner{2, 3, 1, 4};

GlobalIndex number_of_side(const CellSide& side)
{
  if (side.cell.shape == Shape::tet) return kSideOppositeToCorner[side.side];
  return static_cast<GlobalIndex>(side.side) + 1;
}

// What the Exodus library writes of itself in Debian 12, which readers ask for.
constexpr float kVersion = 6.02F;
constexpr std::int32_t kAllNumbersHave64Bits = 0x1c00;
constexpr std::size_t kShortestNameLength = 33;  // Older readers take no other.

constexpr std::size_t kSectionsOfPoints = 3;
constexpr std::size_t kSectionsOfSideSet = 2;

// Cells of one shape and material. Blocks of one shape stand together.
struct Block {
  GlobalIndex id = 0;
  std::string name{};
  Shape shape = Shape::tet;
  GlobalIndex num_cells = 0;
};

std::vector<Block> blocks_of(const Outline& outline, const ByShape<TagGroups>& cells)
{
  const std::array<const char*, kCellShapes.size()> suffixes{"", "_pyramids", "_prisms"};
  std::set<std::string> taken;
  std::vector<Block> blocks;
  GlobalIndex first_id = 0;
  for (std::size_t s = 0; s < kCellShapes.size(); ++s) {
    const TagGroups& groups = cells[kCellShapes[s]];
    for (std::size_t g = 0; g < groups.size(); ++g) {
      blocks.push_back({first_id + groups.tag(g),
                        unique_name(groups.names()[g] + suffixes[s], std::identity{}, taken),
                        kCellShapes[s], groups.total(g)});
    }
    first_id += static_cast<GlobalIndex>(outline.material_names.size());
  }
  return blocks;
}

// Ids and names.
struct Named {
  std::vector<GlobalIndex> ids{};
  std::vector<std::string> names{};
};

Named named(const std::vector<Block>& blocks)
{
  Named result;
  for (const Block& block : blocks) {
    result.ids.push_back(block.id);
    result.names.push_back(block.name);
  }
  return result;
}

Named named(const TagGroups& groups)
{
  Named result{.names = groups.names()};
  for (std::size_t g = 0; g < groups.size(); ++g) result.ids.push_back(groups.tag(g));
  return result;
}

class Layout {
 public:
  Layout(const Outline& outline, const std::vector<Block>& blocks, const TagGroups& side_sets,
         const TagGroups& node_sets)
  {
    const Named named_blocks = named(blocks);
    std::size_t longest = kShortestNameLength - 1;
    for (const auto* names : {&named_blocks.names, &side_sets.names()})
      for (const std::string& name : *names) longest = std::max(longest, name.size());
    name_length_ = longest + 1;
    layout_.attributes = {{"api_version", kVersion},
                          {"version", kVersion},
                          {"floating_point_word_size", std::int32_t{8}},
                          {"file_size", std::int32_t{1}},
                          {"maximum_name_length", static_cast<std::int32_t>(longest)},
                          {"int64_status", kAllNumbersHave64Bits},
                          {"title", "Tessera mesh"}};
    layout_.dimensions = {{"len_string", kShortestNameLength},
                          {"len_line", 81},
                          {"four", 4},
                          {"len_name", static_cast<GlobalIndex>(name_length_)},
                          {"time_step", 0},
                          {"num_dim", 3},
                          {"num_nodes", outline.num_points()},
                          {"num_elem", outline.num_cells()}};
    add("time_whole", NetcdfType::float64, {"time_step"});
    add_groups("eb", "num_el_blk", named_blocks);
    add_groups("ss", "num_side_sets", named(side_sets));
    add_groups("ns", "num_node_sets", named(node_sets));
    add("coor_names", NetcdfType::text, {"num_dim", "len_name"}, padded({"x", "y", "z"}));
    for (const char* const name : {"coordx", "coordy", "coordz"})
      add(name, NetcdfType::float64, {"num_nodes"});
    for (std::size_t b = 0; b < blocks.size(); ++b)
      add_block(fmt::format("{}", b + 1), blocks[b], outline);
    for (std::size_t s = 0; s < side_sets.size(); ++s)
      add_side_set(fmt::format("{}", s + 1), side_sets.total(s));
    for (std::size_t s = 0; s < node_sets.size(); ++s)
      add_node_set(fmt::format("{}", s + 1), node_sets.total(s));
  }

  [[nodiscard]] std::vector<RecordSection> sections() const { return netcdf_sections(layout_); }

 private:
  void add(std::string name, NetcdfType type, std::vector<std::string> dimensions,
           std::string values = {})
  {
    layout_.variables.push_back(
        {std::move(name), type, std::move(dimensions), {}, std::move(values)});
  }

  // Ids, names, and that each is there.
  void add_groups(const std::string& prefix, const std::string& dimension, const Named& groups)
  {
    if (groups.ids.empty()) return;
    layout_.dimensions.push_back({dimension, static_cast<GlobalIndex>(groups.ids.size())});
    const std::vector<std::int32_t> ones(groups.ids.size(), 1);
    add(prefix + "_status", NetcdfType::int32, {dimension},
        big_endian(std::span<const std::int32_t>(ones)));
    add(prefix + "_prop1", NetcdfType::int64, {dimension},
        big_endian(std::span<const GlobalIndex>(groups.ids)));
    layout_.variables.back().attributes = {{"name", "ID"}};
    add(prefix + "_names", NetcdfType::text, {dimension, "len_name"}, padded(groups.names));
  }

  void add_block(const std::string& number, const Block& block, const Outline& outline)
  {
    const std::string cells = "num_el_in_blk" + number;
    const std::string points = "num_nod_per_el" + number;
    const std::size_t num_points = outline.points_per(block.shape);
    layout_.dimensions.push_back({cells, block.num_cells});
    layout_.dimensions.push_back({points, static_cast<GlobalIndex>(num_points)});
    add("connect" + number, NetcdfType::int64, {cells, points});
    const std::map<std::size_t, std::string> types{
        {4, "TETRA"}, {5, "PYRAMID"}, {6, "WEDGE"}, {10, "TETRA10"}};
    layout_.variables.back().attributes = {{"elem_type", types.at(num_points)}};
  }

  void add_side_set(const std::string& number, GlobalIndex num_sides)
  {
    const std::string sides = "num_side_ss" + number;
    layout_.dimensions.push_back({sides, num_sides});
    add("elem_ss" + number, NetcdfType::int64, {sides});
    add("side_ss" + number, NetcdfType::int64, {sides});
  }

  void add_node_set(const std::string& number, GlobalIndex num_nodes)
  {
    const std::string nodes = "num_nod_ns" + number;
    layout_.dimensions.push_back({nodes, num_nodes});
    add("node_ns" + number, NetcdfType::int64, {nodes});
  }

  [[nodiscard]] std::string padded(const std::vector<std::string>& names) const
  {
    std::string characters;
    for (const std::string& name : names)
      characters += name + std::string(name_length_ - name.size(), '\0');
    return characters;
  }

  std::size_t name_length_ = kShortestNameLength;
  NetcdfLayout layout_{};
};

class ExodusWriter final : public Writer {
 public:
  explicit ExodusWriter(const WriterTarget& target)
      : outline_(target.outline),
        cells_(groups_by_shape(outline_)),
        blocks_(blocks_of(outline_, cells_)),
        side_sets_(TagGroups::of_elements(outline_, kFaceShapes)),
        node_sets_(TagGroups::of_points(outline_)),
        file_(target.folder / "mesh.exo",
              Layout(outline_, blocks_, side_sets_, node_sets_).sections(), {}),
        first_element_(blocks_.size() + 1, 1)
  {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      first_element_[b + 1] = first_element_[b] + blocks_[b].num_cells;
  }

  void begin() override { file_.begin(); }

  void write(const Piece& piece) override
  {
    write_points(piece);
    const PieceCells cells(piece);
    write_side_sets(piece.number, cells, write_blocks(piece, cells));
    write_node_sets(piece);
  }

  void close() override { file_.close(); }
  void commit() override { file_.commit(); }

 private:
  template <class Value>
  void put(std::size_t section, GlobalIndex first, const std::vector<Value>& values)
  {
    file_.write(section, first, big_endian(std::span<const Value>(values)));
  }

  void write_points(const Piece& piece)
  {
    for (std::size_t d = 0; d < 3; ++d) {
      for (const PointRun& run : outline_.own_points(piece.number)) {
        std::vector<double> coordinates(at(run.count));
        for (std::size_t p = 0; p < coordinates.size(); ++p)
          coordinates[p] = piece.point_xyz[3 * (at(run.first_row) + p) + d];
        put(d, run.first_number, coordinates);
      }
    }
  }

  // Gives the number of each cell, from 1.
  ByShape<std::vector<GlobalIndex>> write_blocks(const Piece& piece, const PieceCells& cells)
  {
    ByShape<std::vector<GlobalIndex>> elements;
    std::size_t first_block = 0;
    for (const Shape shape : kCellShapes) {
      const ElementList list = cells[shape];
      elements[shape].resize(list.size());
      const auto write_block = [&](std::size_t group, GlobalIndex first,
                                   std::span<const LocalIndex> rows) {
        const std::size_t block = first_block + group;
        GlobalIndex element = first_element_[block] + first;
        std::vector<GlobalIndex> nodes;
        nodes.reserve(list.width * rows.size());
        for (const LocalIndex row : rows) {
          elements[shape][at(row)] = element++;
          for (const LocalIndex point : list.of(at(row)))
            nodes.push_back(piece.point_numbers[at(point)] + 1);
        }
        put(kSectionsOfPoints + block, static_cast<GlobalIndex>(list.width) * first, nodes);
      };
      cells_[shape].for_each_of(piece.number, list.tags, write_block);
      first_block += cells_[shape].size();
    }
    return elements;
  }

  void write_side_sets(LocalIndex piece, const PieceCells& cells,
                       const ByShape<std::vector<GlobalIndex>>& element_of)
  {
    side_sets_.for_each_of(
        piece, cells.patches(),
        [&](std::size_t set, GlobalIndex first, std::span<const LocalIndex> faces) {
          std::vector<GlobalIndex> elements;
          std::vector<GlobalIndex> sides;
          for (const LocalIndex face : faces) {
            const CellSide side = cells.side_of(at(face));
            elements.push_back(element_of[side.cell.shape][at(side.cell.row)]);
            sides.push_back(number_of_side(side));
          }
          const std::size_t section = kSectionsOfPoints + blocks_.size() + kSectionsOfSideSet * set;
          put(section, first, elements);
          put(section + 1, first, sides);
        });
  }

  void write_node_sets(const Piece& piece)
  {
    node_sets_.for_each_of(
        piece.number, patches_of_points(piece),
        [&](std::size_t set, GlobalIndex first, std::span<const LocalIndex> rows) {
          std::vector<GlobalIndex> nodes;
          for (const LocalIndex row : rows)
            nodes.push_back(piece.point_numbers[at(piece.patch_points[at(row)].point)] + 1);
          put(kSectionsOfPoints + blocks_.size() + kSectionsOfSideSet * side_sets_.size() + set,
              first, nodes);
        });
  }

  const Outline& outline_;
  ByShape<TagGroups> cells_;
  std::vector<Block> blocks_;
  TagGroups side_sets_;
  TagGroups node_sets_;
  RecordFile file_;
  std::vector<GlobalIndex> first_element_;  // Of each block, and the end.
};

}  // namespace

std::unique_ptr<Writer> make_exodus_writer(const WriterTarget& target)
{
  return std::make_unique<ExodusWriter>(target);
}

}  // namespace tessera::formats
