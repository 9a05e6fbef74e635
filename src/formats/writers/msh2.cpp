// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/msh2.hpp"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "formats/files/record_file.hpp"
#include "formats/writers/msh_periodic.hpp"
#include "formats/writers/msh_sections.hpp"

namespace tessera::formats {
namespace {

constexpr int kRealWidth = 24;  // The longest number that is read back with the same bits.

constexpr const char* kEndElements = "$EndElements\n";

// Sections of the file.
constexpr std::size_t kNodes = 0;
constexpr std::size_t kFirstShape = 1;  // Others follow as in kMshShapes, then periodic patches.

// Characters of numbers up to this one.
int width_of(GlobalIndex number) { return static_cast<int>(fmt::formatted_size("{}", number)); }

void add_number(std::string& text, GlobalIndex number, int width)
{
  const fmt::format_int digits(number);
  text.append(static_cast<std::size_t>(width) + 1 - digits.size(), ' ');
  text.append(digits.data(), digits.size());
}

void require_short_numbers(const Outline& outline)
{
  constexpr GlobalIndex kMost = std::numeric_limits<std::int32_t>::max();
  if (msh_num_elements(outline) <= kMost) return;
  throw ConfigError(fmt::format(
      "format msh2 holds {} elements at most, for its numbers have 32 bits; the mesh has {} cells "
      "and {} faces: take msh or xdmf",
      kMost, outline.num_cells(), outline.num_faces()));
}

class Msh2Writer final : public Writer {
 public:
  explicit Msh2Writer(const WriterTarget& target)
      : outline_(target.outline),
        point_width_(width_of(outline_.num_points())),
        element_width_(width_of(msh_num_elements(outline_))),
        tag_width_(width_of(static_cast<GlobalIndex>(outline_.material_names.size()
                                                     + outline_.patch_names.size()
                                                     + outline_.line_names.size()))),
        file_(target.folder / "mesh_v2.msh", sections(),
              outline_.periodic.empty() ? kEndElements : kMshEndPeriodic)
  {
  }

  void begin() override { file_.begin(); }

  void write(const Piece& piece) override
  {
    const LocalIndex number = piece.number;
    for (const PointRun& run : outline_.own_points(number))
      file_.write(kNodes, run.first_number, nodes_of(piece, run));
    const PieceCells cells(piece);
    std::size_t section = kFirstShape;
    for (const Shape shape : kMshShapes) {
      file_.write(section++, outline_.first_of[shape][at(number)],
                  elements_of(piece, msh_cells(outline_, number, shape, cells[shape]),
                              msh_tag(outline_, shape, 0)));
    }
    for_each_periodic(outline_, piece, [&](std::size_t row, GlobalIndex first, const auto& points) {
      std::string text;
      for (const PeriodicPoint& point : points) {
        for (const GlobalIndex node : periodic_nodes(piece, point))
          add_number(text, node, point_width_);
        text += '\n';
      }
      file_.write(section + row, first, text);
    });
  }

  void close() override { file_.close(); }
  void commit() override { file_.commit(); }

 private:
  [[nodiscard]] GlobalIndex node_size() const
  {
    return 1 + point_width_ + 3 * (1 + kRealWidth) + 1;
  }

  [[nodiscard]] GlobalIndex element_size(const MshCellType& type) const
  {
    // Number, type, how many tags, two tags, nodes.
    return 1 + element_width_ + 1 + width_of(type.number) + 2 + 2 * (1 + tag_width_)
           + static_cast<GlobalIndex>(type.num_points) * (1 + point_width_) + 1;
  }

  [[nodiscard]] std::vector<RecordSection> sections() const
  {
    const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
                             + msh_physical_names(msh_entities(outline_))
                             + fmt::format("$Nodes\n{}\n", outline_.num_points());
    std::vector<RecordSection> sections{{head, outline_.num_points(), node_size()}};
    for (const Shape shape : kMshShapes) {
      sections.push_back({"", outline_.num_of(shape), element_size(msh_type(outline_, shape))});
    }
    sections[kFirstShape].head =
        fmt::format("$EndNodes\n$Elements\n{}\n", msh_num_elements(outline_));
    for (std::size_t row = 0; row < outline_.periodic.size(); ++row) {
      sections.push_back({(row == 0 ? kEndElements : "") + msh2_periodic_head(outline_, row),
                          outline_.periodic[row].first_point.back(), 2 * (1 + point_width_) + 1});
    }
    return sections;
  }

  [[nodiscard]] std::string nodes_of(const Piece& piece, const PointRun& run) const
  {
    std::string text;
    text.reserve(static_cast<std::size_t>(node_size() * run.count));
    for (LocalIndex p = run.first_row; p < run.first_row + run.count; ++p) {
      add_number(text, piece.point_numbers[at(p)] + 1, point_width_);
      for (const double value : point_at(std::span(piece.point_xyz), p))
        fmt::format_to(std::back_inserter(text), " {:>{}}", value, kRealWidth);
      text += '\n';
    }
    return text;
  }

  // @param[in] shift From tags of the outline to tags of the file.
  [[nodiscard]] std::string elements_of(const Piece& piece, const MshCells& cells,
                                        std::int32_t shift) const
  {
    std::string text;
    text.reserve(static_cast<std::size_t>(element_size(cells.type)) * cells.list.size());
    std::vector<GlobalIndex> nodes;
    for (std::size_t c = 0; c < cells.list.size(); ++c) {
      add_number(text, cells.first_element + static_cast<GlobalIndex>(c), element_width_);
      add_number(text, cells.type.number, width_of(cells.type.number));
      add_number(text, 2, 1);
      for (int tag = 0; tag < 2; ++tag) add_number(text, cells.list.tags[c] + shift, tag_width_);
      nodes.clear();
      msh_add_nodes(piece, cells, c, nodes);
      for (const GlobalIndex node : nodes) add_number(text, node, point_width_);
      text += '\n';
    }
    return text;
  }

  const Outline& outline_;
  int point_width_;
  int element_width_;
  int tag_width_;
  RecordFile file_;
};

}  // namespace

std::unique_ptr<Writer> make_msh2_writer(const WriterTarget& target)
{
  require_short_numbers(target.outline);
  return std::make_unique<Msh2Writer>(target);
}

}  // namespace tessera::formats
