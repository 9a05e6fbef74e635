// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/abaqus.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "formats/cells.hpp"
#include "formats/files/record_file.hpp"
#include "formats/files/text_records.hpp"
#include "formats/labels.hpp"
#include "formats/limits.hpp"
#include "formats/periodic_nodes.hpp"
#include "formats/plain_name.hpp"
#include "formats/tag_groups.hpp"

namespace tessera::formats {
namespace {

// By CellSide::side.
constexpr std::array kSidesOfTet{3, 4, 2, 1};
constexpr std::array kSidesOfPrism{3, 4, 5, 1, 2};

// Pyramids are prisms with the upper ends of two columns at one point: C3D5 is not known to
// CalculiX. Of the corners of a pyramid those of the prism, and by CellSide::side the sides.
constexpr std::array<std::size_t, 6> kPrismOfPyramid{0, 3, 4, 1, 2, 4};
constexpr std::array kSidesOfPyramid{5, 2, 4, 1, 3};

int number_of_side(const CellSide& side)
{
  if (side.cell.shape == Shape::tet) return kSidesOfTet[side.side];
  return side.cell.shape == Shape::prism ? kSidesOfPrism[side.side] : kSidesOfPyramid[side.side];
}

// Nodes that a cell has in the file.
std::size_t num_nodes(const Outline& outline, Shape shape)
{
  return shape == Shape::pyramid ? kPrismOfPyramid.size() : outline.points_per(shape);
}

constexpr std::size_t kSideWidth = 4;  // ",S3", and the end of the line.

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
  Sections(const Outline& outline, const ByShape<TagGroups>& cells, const TagGroups& surfaces,
           const TagGroups& node_sets)
      : width_(num_digits(std::max(outline.num_points(), outline.num_cells())))
  {
    next_head_ = "*HEADING\nTessera mesh\n*NODE, NSET=NALL\n";
    add({}, outline.num_points(), width_ + 3 * (1 + kFieldWidth) + 1);
    add_materials(outline, cells);
    add_surfaces(surfaces, node_sets);
    add_periodic(outline);
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

  void add_materials(const Outline& outline, const ByShape<TagGroups>& cells)
  {
    const TagGroups materials = TagGroups::of_elements(outline, kCellShapes);
    const auto labels = labels_of(materials.names(), {kAllElements}, kLongestLabel);
    std::map<std::int32_t, std::string> label_of;
    for (std::size_t m = 0; m < labels.size(); ++m) label_of[materials.tag(m)] = labels[m];
    for (const Shape shape : kCellShapes) {
      const TagGroups& groups = cells[shape];
      const std::size_t num_points = num_nodes(outline, shape);
      for (std::size_t g = 0; g < groups.size(); ++g) {
        add(fmt::format("** material {}: {}\n*ELEMENT, TYPE=C3D{}, ELSET={}\n", groups.tag(g),
                        plain_name(groups.names()[g]), num_points, label_of.at(groups.tag(g))),
            groups.total(g), (1 + num_points) * (width_ + 1));
      }
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
          surfaces.total(s), width_ + kSideWidth);
    }
    for (std::size_t s = 0; s < labels.size(); ++s) {
      add(fmt::format("*NSET, NSET={}{}\n", kNodeSetPrefix, labels[s]), node_sets.total(s),
          width_ + 1);
    }
  }

  // Two sets a pair, in one order. A node where several sides meet stands in several pairs.
  void add_periodic(const Outline& outline)
  {
    for (std::size_t p = 0; p < outline.periodic.size(); ++p) {
      const PeriodicPatch& pair = outline.periodic[p];
      const auto name = [&](std::int32_t tag) {
        return plain_name(outline.patch_names[at(tag - 1)]);
      };
      const std::string comment = fmt::format("** periodic {}: from patch {} to patch {}\n", p + 1,
                                              name(pair.from), name(pair.to));
      for (const auto& [side, before] :
           {std::pair{"TO", comment}, std::pair{"FROM", std::string()}})
        add(fmt::format("{}*NSET, NSET=PERIODIC_{}_{}, UNSORTED\n", before, p + 1, side),
            pair.first_point.back(), width_ + 1);
    }
  }

  std::size_t width_;  // Of numbers of points and elements.
  std::vector<RecordSection> sections_{};
  std::string next_head_{};
};

class AbaqusWriter final : public Writer {
 public:
  explicit AbaqusWriter(const WriterTarget& target)
      : outline_(target.outline),
        cells_(groups_by_shape(outline_)),
        surfaces_(TagGroups::of_elements(outline_, kFaceShapes)),
        node_sets_(TagGroups::of_points(outline_)),
        layout_(outline_, cells_, surfaces_, node_sets_),
        file_(target.folder / "mesh.inp", layout_.sections(), layout_.tail())
  {
    require_32_bit_numbers(outline_, io::Format::abaqus);
  }

  void begin() override { file_.begin(); }

  void write(const Piece& piece) override
  {
    write_nodes(piece);
    const PieceCells cells(piece);
    std::size_t section = 1;
    const auto write_groups = [&](const TagGroups& groups, std::span<const std::int32_t> tags,
                                  const auto& text_of) {
      groups.for_each_of(
          piece.number, tags,
          [&](std::size_t group, GlobalIndex first, std::span<const LocalIndex> rows) {
            file_.write(section + group, first, text_of(rows));
          });
      section += groups.size();
    };
    for (const Shape shape : kCellShapes) {
      const ElementList list = cells[shape];
      write_groups(cells_[shape], list.tags, [&](std::span<const LocalIndex> rows) {
        return elements(piece, shape, list, rows);
      });
    }
    write_groups(surfaces_, cells.patches(), [&](std::span<const LocalIndex> faces) {
      return sides(piece.number, cells, faces);
    });
    write_groups(node_sets_, patches_of_points(piece),
                 [&](std::span<const LocalIndex> rows) { return nodes(piece, rows); });
    write_periodic(piece, section);
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

  void write_periodic(const Piece& piece, std::size_t first_section)
  {
    for_each_periodic(
        outline_, piece,
        [&](std::size_t row, GlobalIndex first, std::span<const PeriodicPoint> points) {
          TextRecords to;
          TextRecords from;
          for (const PeriodicPoint& point : points) {
            const auto [image, original] = periodic_nodes(piece, point);
            to.integer(image, layout_.width()).text("\n");
            from.integer(original, layout_.width()).text("\n");
          }
          file_.write(first_section + 2 * row, first, to.take());
          file_.write(first_section + 2 * row + 1, first, from.take());
        });
  }

  [[nodiscard]] std::string elements(const Piece& piece, Shape shape, const ElementList& list,
                                     std::span<const LocalIndex> rows) const
  {
    const GlobalIndex first = outline_.first_number(shape, piece.number) + 1;
    TextRecords text;
    const auto add = [&](LocalIndex point) {
      text.text(",").integer(piece.point_numbers[at(point)] + 1, layout_.width());
    };
    for (const LocalIndex row : rows) {
      text.integer(first + row, layout_.width());
      const std::span<const LocalIndex> points = list.of(at(row));
      if (shape == Shape::pyramid)
        for (const std::size_t corner : kPrismOfPyramid) add(points[corner]);
      else
        for (const LocalIndex point : points) add(point);
      text.text("\n");
    }
    return text.take();
  }

  [[nodiscard]] std::string sides(LocalIndex piece, const PieceCells& cells,
                                  std::span<const LocalIndex> faces) const
  {
    TextRecords text;
    for (const LocalIndex face : faces) {
      const CellSide side = cells.side_of(at(face));
      text.integer(outline_.first_number(side.cell.shape, piece) + side.cell.row + 1,
                   layout_.width());
      text.text(",S").integer(number_of_side(side), 1).text("\n");
    }
    return text.take();
  }

  [[nodiscard]] std::string nodes(const Piece& piece, std::span<const LocalIndex> rows) const
  {
    TextRecords text;
    for (const LocalIndex row : rows) {
      const LocalIndex point = piece.patch_points[at(row)].point;
      text.integer(piece.point_numbers[at(point)] + 1, layout_.width()).text("\n");
    }
    return text.take();
  }

  const Outline& outline_;
  ByShape<TagGroups> cells_;
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
