// SPDX-License-Identifier: BSD-3-Clause
#include "formats/abaqus_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/labels.hpp"
#include "formats/limits.hpp"
#include "formats/plain_name.hpp"
#include "formats/record_file.hpp"
#include "formats/tag_groups.hpp"
#include "formats/text_records.hpp"

namespace tessera::formats {
namespace {

/// Of the side opposite to each corner.
constexpr std::array<std::string_view, 4> kSideOppositeToCorner{",S3\n", ",S4\n", ",S2\n", ",S1\n"};

constexpr std::size_t kFieldWidth = 20;
constexpr std::size_t kLongestLabel = 80;
constexpr std::string_view kNodeSetPrefix = "N_";
constexpr const char* kAllElements = "EALL";

std::string lines_of(const std::vector<std::string>& labels)
{
  std::string lines;
  for (const std::string& label : labels) lines += label + ",\n";
  return lines;
}

// The sections of the file, from its first to its last.
class Sections {
 public:
  Sections(const Outline& outline, const TagGroups& materials, const TagGroups& surfaces,
           const TagGroups& node_sets)
      : width_(num_digits(std::max(outline.num_points(), outline.num_tets()))),
        points_per_tet_(outline.points_per_tet())
  {
    next_head_ = "*HEADING\nTessera mesh\n*NODE, NSET=NALL\n";
    add({}, outline.num_points(), width_ + 3 * (1 + kFieldWidth) + 1);
    add_materials(materials);
    add_surfaces(surfaces, node_sets);
  }

  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] const std::vector<RecordSection>& sections() const { return sections_; }
  [[nodiscard]] const std::string& tail() const { return next_head_; }

 private:
  void add(const std::string& head, GlobalIndex num_records, std::size_t record_size)
  {
    sections_.push_back(
        {std::exchange(next_head_, {}) + head, num_records, static_cast<GlobalIndex>(record_size)});
  }

  void add_materials(const TagGroups& materials)
  {
    const auto labels = labels_of(materials.names(), {kAllElements}, kLongestLabel);
    for (std::size_t m = 0; m < labels.size(); ++m) {
      add(fmt::format("** material {}: {}\n*ELEMENT, TYPE=C3D{}, ELSET={}\n", materials.tag(m),
                      plain_name(materials.names()[m]), points_per_tet_, labels[m]),
          materials.total(m), (1 + points_per_tet_) * (width_ + 1));
    }
    next_head_ = fmt::format("*ELSET, ELSET={}\n{}", kAllElements, lines_of(labels));
  }

  // Patches that have triangles are those that have points.
  void add_surfaces(const TagGroups& surfaces, const TagGroups& node_sets)
  {
    const auto labels = labels_of(surfaces.names(), {}, kLongestLabel - kNodeSetPrefix.size());
    for (std::size_t s = 0; s < labels.size(); ++s) {
      add(fmt::format("** patch {}: {}\n*SURFACE, NAME={}, TYPE=ELEMENT\n", surfaces.tag(s),
                      plain_name(surfaces.names()[s]), labels[s]),
          surfaces.total(s), width_ + kSideOppositeToCorner[0].size());
    }
    for (std::size_t s = 0; s < labels.size(); ++s) {
      add(fmt::format("*NSET, NSET={}{}\n", kNodeSetPrefix, labels[s]), node_sets.total(s),
          width_ + 1);
    }
  }

  std::size_t width_;  // Of numbers of points and elements.
  std::size_t points_per_tet_;
  std::vector<RecordSection> sections_{};
  std::string next_head_{};
};

class AbaqusWriter final : public Writer {
 public:
  explicit AbaqusWriter(const WriterTarget& target)
      : outline_(target.outline),
        materials_(outline_, Grouped::tets),
        surfaces_(outline_, Grouped::triangles),
        node_sets_(outline_, Grouped::points),
        layout_(outline_, materials_, surfaces_, node_sets_),
        file_(target.folder / "mesh.inp", layout_.sections(), layout_.tail())
  {
    require_32_bit_numbers(outline_, io::Format::abaqus);
  }

  void begin() override { file_.begin(); }

  void write(const Piece& piece) override
  {
    write_nodes(piece);
    std::size_t section = 1;
    for_each_group(materials_, piece, section,
                   [&](std::span<const LocalIndex> tets) { return elements(piece, tets); });
    section += materials_.size();
    for_each_group(surfaces_, piece, section,
                   [&](std::span<const LocalIndex> triangles) { return sides(piece, triangles); });
    section += surfaces_.size();
    for_each_group(node_sets_, piece, section,
                   [&](std::span<const LocalIndex> points) { return nodes(piece, points); });
  }

  void close() override { file_.close(); }
  void commit() override { file_.commit(); }

 private:
  void write_nodes(const Piece& piece)
  {
    for (const PointRun& run : outline_.own_points(piece.number)) {
      TextRecords text;
      for (LocalIndex p = run.first_row; p < run.first_row + run.count; ++p) {
        text.integer(piece.point_numbers[at(p)] + 1, layout_.width());
        for (const double coordinate : std::span(piece.point_xyz).subspan(3 * at(p), 3))
          text.text(",").real(coordinate, kFieldWidth);
        text.text("\n");
      }
      file_.write(0, run.first_number, text.take());
    }
  }

  template <class TextOf>
  void for_each_group(const TagGroups& groups, const Piece& piece, std::size_t first_section,
                      const TextOf& text_of)
  {
    groups.for_each_of(piece,
                       [&](std::size_t group, GlobalIndex first, std::span<const LocalIndex> rows) {
                         file_.write(first_section + group, first, text_of(rows));
                       });
  }

  [[nodiscard]] GlobalIndex element(const Piece& piece, LocalIndex tet) const
  {
    return outline_.first_tet[at(piece.number)] + tet + 1;
  }

  [[nodiscard]] std::string elements(const Piece& piece, std::span<const LocalIndex> tets) const
  {
    const std::size_t width = outline_.points_per_tet();
    TextRecords text;
    for (const LocalIndex tet : tets) {
      text.integer(element(piece, tet), layout_.width());
      for (const LocalIndex point : std::span(piece.tet_points).subspan(width * at(tet), width))
        text.text(",").integer(piece.point_numbers[at(point)] + 1, layout_.width());
      text.text("\n");
    }
    return text.take();
  }

  [[nodiscard]] std::string sides(const Piece& piece, std::span<const LocalIndex> triangles) const
  {
    TextRecords text;
    for (const LocalIndex triangle : triangles) {
      const LocalIndex side = piece.triangle_side[at(triangle)];
      text.integer(element(piece, side / 4), layout_.width());
      text.text(kSideOppositeToCorner[at(side % 4)]);
    }
    return text.take();
  }

  [[nodiscard]] std::string nodes(const Piece& piece, std::span<const LocalIndex> points) const
  {
    TextRecords text;
    for (const LocalIndex point : points)
      text.integer(piece.point_numbers[at(point)] + 1, layout_.width()).text("\n");
    return text.take();
  }

  const Outline& outline_;
  TagGroups materials_;
  TagGroups surfaces_;
  TagGroups node_sets_;
  Sections layout_;
  RecordFile file_;
};

}  // namespace

std::unique_ptr<Writer> make_abaqus_writer(const WriterTarget& target)
{
  return std::make_unique<AbaqusWriter>(target);
}

}  // namespace tessera::formats
