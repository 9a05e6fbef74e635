// SPDX-License-Identifier: BSD-3-Clause
#include "formats/exodus_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/netcdf_file.hpp"
#include "formats/record_file.hpp"
#include "formats/tag_groups.hpp"

namespace tessera::formats {
namespace {

/// Of the side opposite to each corner.
constexpr std::array<GlobalIndex, 4> kSideOppositeToCorner{2, 3, 1, 4};

// What the Exodus library writes of itself in Debian 12, which readers ask for.
constexpr float kVersion = 6.02F;
constexpr std::int32_t kAllNumbersHave64Bits = 0x1c00;
constexpr std::size_t kShortestNameLength = 33;  // Older readers take no other.

constexpr std::size_t kSectionsOfPoints = 3;
constexpr std::size_t kSectionsOfSideSet = 2;

class Layout {
 public:
  Layout(const Outline& outline, const TagGroups& blocks, const TagGroups& side_sets,
         const TagGroups& node_sets)
  {
    std::size_t longest = kShortestNameLength - 1;
    for (const auto* names : {&blocks.names(), &side_sets.names()})
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
                          {"num_elem", outline.num_tets()}};
    add("time_whole", NetcdfType::float64, {"time_step"});
    add_groups("eb", "num_el_blk", blocks);
    add_groups("ss", "num_side_sets", side_sets);
    add_groups("ns", "num_node_sets", node_sets);
    add("coor_names", NetcdfType::text, {"num_dim", "len_name"}, padded({"x", "y", "z"}));
    for (const char* const name : {"coordx", "coordy", "coordz"})
      add(name, NetcdfType::float64, {"num_nodes"});
    for (std::size_t b = 0; b < blocks.size(); ++b)
      add_block(fmt::format("{}", b + 1), blocks.total(b), outline.points_per_tet());
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
  void add_groups(const std::string& prefix, const std::string& dimension, const TagGroups& groups)
  {
    if (groups.size() == 0) return;
    layout_.dimensions.push_back({dimension, static_cast<GlobalIndex>(groups.size())});
    const std::vector<std::int32_t> ones(groups.size(), 1);
    std::vector<GlobalIndex> ids;
    for (std::size_t g = 0; g < groups.size(); ++g) ids.push_back(groups.tag(g));
    add(prefix + "_status", NetcdfType::int32, {dimension},
        big_endian(std::span<const std::int32_t>(ones)));
    add(prefix + "_prop1", NetcdfType::int64, {dimension},
        big_endian(std::span<const GlobalIndex>(ids)));
    layout_.variables.back().attributes = {{"name", "ID"}};
    add(prefix + "_names", NetcdfType::text, {dimension, "len_name"}, padded(groups.names()));
  }

  void add_block(const std::string& number, GlobalIndex num_tets, std::size_t points_per_tet)
  {
    const std::string tets = "num_el_in_blk" + number;
    const std::string points = "num_nod_per_el" + number;
    layout_.dimensions.push_back({tets, num_tets});
    layout_.dimensions.push_back({points, static_cast<GlobalIndex>(points_per_tet)});
    add("connect" + number, NetcdfType::int64, {tets, points});
    layout_.variables.back().attributes = {
        {"elem_type", points_per_tet == 4 ? "TETRA" : "TETRA10"}};
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
        blocks_(outline_, Grouped::tets),
        side_sets_(outline_, Grouped::triangles),
        node_sets_(outline_, Grouped::points),
        file_(target.folder / "mesh.exo",
              Layout(outline_, blocks_, side_sets_, node_sets_).sections(), {}),
        first_element_(blocks_.size() + 1, 1)
  {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
      first_element_[b + 1] = first_element_[b] + blocks_.total(b);
  }

  void begin() override { file_.begin(); }

  void write(const Piece& piece) override
  {
    write_points(piece);
    write_side_sets(piece, write_blocks(piece));
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

  // Gives the number of each tet, from 1.
  std::vector<GlobalIndex> write_blocks(const Piece& piece)
  {
    const std::size_t width = outline_.points_per_tet();
    std::vector<GlobalIndex> element_of_tet(at(piece.num_tets()));
    blocks_.for_each_of(piece, [&](std::size_t block, GlobalIndex first,
                                   std::span<const LocalIndex> tets) {
      std::vector<GlobalIndex> nodes;
      nodes.reserve(width * tets.size());
      GlobalIndex element = first_element_[block] + first;
      for (const LocalIndex tet : tets) {
        element_of_tet[at(tet)] = element++;
        for (const LocalIndex point : std::span(piece.tet_points).subspan(width * at(tet), width))
          nodes.push_back(piece.point_numbers[at(point)] + 1);
      }
      put(kSectionsOfPoints + block, static_cast<GlobalIndex>(width) * first, nodes);
    });
    return element_of_tet;
  }

  void write_side_sets(const Piece& piece, const std::vector<GlobalIndex>& element_of_tet)
  {
    side_sets_.for_each_of(
        piece, [&](std::size_t set, GlobalIndex first, std::span<const LocalIndex> triangles) {
          std::vector<GlobalIndex> elements;
          std::vector<GlobalIndex> sides;
          for (const LocalIndex triangle : triangles) {
            const LocalIndex side = piece.triangle_side[at(triangle)];
            elements.push_back(element_of_tet[at(side / 4)]);
            sides.push_back(kSideOppositeToCorner[at(side % 4)]);
          }
          const std::size_t section = kSectionsOfPoints + blocks_.size() + kSectionsOfSideSet * set;
          put(section, first, elements);
          put(section + 1, first, sides);
        });
  }

  void write_node_sets(const Piece& piece)
  {
    node_sets_.for_each_of(
        piece, [&](std::size_t set, GlobalIndex first, std::span<const LocalIndex> points) {
          std::vector<GlobalIndex> nodes;
          for (const LocalIndex point : points) nodes.push_back(piece.point_numbers[at(point)] + 1);
          put(kSectionsOfPoints + blocks_.size() + kSectionsOfSideSet * side_sets_.size() + set,
              first, nodes);
        });
  }

  const Outline& outline_;
  TagGroups blocks_;
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
