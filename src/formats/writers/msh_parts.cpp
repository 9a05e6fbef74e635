// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/msh_parts.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/sort_unique.hpp"
#include "tessera/io/files.hpp"

#include "formats/cells.hpp"
#include "formats/writers/msh_sections.hpp"

namespace tessera::formats {
namespace {

// Those of the elements of some shapes, ascending.
std::vector<std::int32_t> tags_of(const PieceCounts& piece, std::span<const Shape> shapes)
{
  std::vector<std::int32_t> tags;
  for (const Shape shape : shapes)
    for (const TagCount& count : piece.elements[shape]) tags.push_back(count.tag);
  sort_unique(tags);
  return tags;
}

constexpr std::array kDimensions{kMshCurve, kMshSurface, kMshVolume};

// What entities of one dimension are made of.
std::span<const Shape> shapes_of(std::int32_t dimension)
{
  static constexpr std::array kLine{Shape::line};
  if (dimension == kMshVolume) return kCellShapes;
  if (dimension == kMshSurface) return kFaceShapes;
  return kLine;
}

// Tags of the entities that pieces have, above those of the model: no two pieces share one.
class PartTags {
 public:
  explicit PartTags(const Outline& outline)
      : above_(msh_tag(outline, Shape::line, static_cast<std::int32_t>(outline.line_names.size())))
  {
    for (const std::int32_t dimension : kDimensions) {
      std::vector<std::int32_t>& first = first_[at(dimension)];
      first = {1};
      for (const PieceCounts& piece : outline.pieces) {
        const auto num_entities = tags_of(piece, shapes_of(dimension)).size();
        first.push_back(first.back() + static_cast<std::int32_t>(num_entities));
      }
    }
  }

  // Of the first entity of a piece that has this dimension; others follow.
  [[nodiscard]] std::int32_t first(std::int32_t dimension, LocalIndex piece) const
  {
    return above_ + first_[at(dimension)][at(piece)];
  }
  [[nodiscard]] std::int32_t ghosts(LocalIndex piece) const
  {
    return above_ + first_[at(kMshVolume)].back() + piece;
  }

 private:
  std::int32_t above_;
  std::array<std::vector<std::int32_t>, kMshVolume + 1> first_{};  // By dimension, by piece.
};

// The file of one piece.
class MshPart {
 public:
  MshPart(const Outline& outline, const PartTags& tags, const Piece& piece)
      : outline_(outline),
        piece_(piece),
        ghosts_(piece.ghosts),
        counts_(outline.pieces[at(piece.number)]),
        tags_(tags),
        cells_(piece)
  {
    for (const Shape shape : kAllShapes)
      elements_[shape] = msh_cells(outline, piece.number, shape, cells_[shape]);
  }

  [[nodiscard]] std::string text(const std::string& head)
  {
    bytes_.add(head);
    add_part_entities();
    add_nodes();
    add_elements();
    if (has_ghosts()) add_ghosts();
    return std::move(bytes_).take();
  }

 private:
  [[nodiscard]] bool has_ghosts() const { return !ghosts_.cells.empty(); }
  [[nodiscard]] std::int32_t part() const { return piece_.number + 1; }

  void add_part_entities()
  {
    bytes_.add("$PartitionedEntities\n").add(GlobalIndex{outline_.num_pieces()});
    bytes_.add(GlobalIndex{has_ghosts() ? 1 : 0});
    if (has_ghosts()) bytes_.add(tags_.ghosts(piece_.number)).add(part());
    bytes_.add(GlobalIndex{0});  // Points.
    for (const std::int32_t dimension : kDimensions)
      bytes_.add(static_cast<GlobalIndex>(tags_of(counts_, shapes_of(dimension)).size()));
    for (const std::int32_t dimension : kDimensions) add_entities(dimension);
    bytes_.add("\n$EndPartitionedEntities\n");
  }

  void add_entities(std::int32_t dimension)
  {
    const std::span<const Shape> shapes = shapes_of(dimension);
    std::int32_t entity = tags_.first(dimension, piece_.number);
    for (const std::int32_t tag : tags_of(counts_, shapes)) {
      const std::int32_t parent = msh_tag(outline_, shapes.front(), tag);
      bytes_.add(entity++).add(dimension).add(parent);
      bytes_.add(GlobalIndex{1}).add(part());
      msh4_add_entity({.tag = parent, .box = counts_.box}, bytes_);
    }
  }

  void add_nodes()
  {
    std::vector<GlobalIndex> nodes;
    for (const std::vector<GlobalIndex>* const numbers : {&piece_.point_numbers, &ghosts_.points})
      for (const GlobalIndex number : *numbers) nodes.push_back(number + 1);
    // A piece of another tool may be empty, and its part then has no volume of its own.
    if (nodes.empty()) {
      bytes_.add(msh4_nodes_head(1, 0, 0, 0)).add(kMshEndNodes);
      return;
    }
    const auto [first, last] = std::ranges::minmax(nodes);
    bytes_.add(msh4_nodes_head(tags_.first(kMshVolume, piece_.number),
                               static_cast<GlobalIndex>(nodes.size()), first, last));
    bytes_.add(bytes_of(nodes)).add(bytes_of(piece_.point_xyz)).add(bytes_of(ghosts_.point_xyz));
    bytes_.add(kMshEndNodes);
  }

  void add_elements()
  {
    const GlobalIndex none = elements_[Shape::tet].first_element;
    std::vector<GlobalIndex> firsts;
    GlobalIndex last = none - 1;
    auto num_elements = static_cast<GlobalIndex>(ghosts_.cells.size());
    if (has_ghosts()) {
      firsts.push_back(ghosts_.cells.front() + 1);
      last = std::max(last, ghosts_.cells.back() + 1);
    }
    for (const MshCells& cells : elements_.values) {
      const auto size = static_cast<GlobalIndex>(cells.list.size());
      if (size == 0) continue;
      firsts.push_back(cells.first_element);
      last = std::max(last, cells.first_element + size - 1);
      num_elements += size;
    }
    bytes_.add(msh4_elements_head(num_blocks(), num_elements,
                                  firsts.empty() ? none : std::ranges::min(firsts), last));
    for (const Shape shape : kMshShapes) add_blocks(shape);
    for (const Shape shape : kCellShapes) add_ghost_block(shape);
    bytes_.add(kMshEndElements);
  }

  [[nodiscard]] GlobalIndex num_blocks() const
  {
    std::size_t count = 0;
    for (const MshCells& cells : elements_.values) count += cells.counts.size();
    for (const Shape shape : kCellShapes)
      if (num_ghosts(shape) > 0) ++count;
    return static_cast<GlobalIndex>(count);
  }

  void add_blocks(Shape shape)
  {
    const MshCells& cells = elements_[shape];
    const std::int32_t dimension = cells.type.dimension;
    const std::vector<std::int32_t> tags = tags_of(counts_, shapes_of(dimension));
    const std::int32_t first_entity = tags_.first(dimension, piece_.number);
    for (const TagCount& count : cells.counts) {
      const auto row = std::ranges::lower_bound(tags, count.tag) - tags.begin();
      const std::int32_t entity = first_entity + static_cast<std::int32_t>(row);
      bytes_.add(msh4_block_head(cells.type, entity, count.count));
      bytes_.add(bytes_of(msh4_records(piece_, cells, count)));
    }
  }

  [[nodiscard]] GlobalIndex num_ghosts(Shape shape) const
  {
    return std::ranges::count(ghosts_.cell_shape, shape);
  }

  void add_ghost_block(Shape shape)
  {
    if (num_ghosts(shape) == 0) return;
    bytes_.add(
        msh4_block_head(elements_[shape].type, tags_.ghosts(piece_.number), num_ghosts(shape)));
    for (std::size_t g = 0; g < ghosts_.cells.size(); ++g) {
      if (ghosts_.cell_shape[g] != shape) continue;
      bytes_.add(ghosts_.cells[g] + 1);
      for (const GlobalIndex number : ghosts_.cell_points[static_cast<LocalIndex>(g)])
        bytes_.add(number + 1);
    }
  }

  // Each with the part that it belongs to, and the one part that it is a ghost of here.
  void add_ghosts()
  {
    bytes_.add("$GhostElements\n").add(static_cast<GlobalIndex>(ghosts_.cells.size()));
    for (std::size_t g = 0; g < ghosts_.cells.size(); ++g) {
      bytes_.add(ghosts_.cells[g] + 1).add(ghosts_.cell_piece[g] + 1);
      bytes_.add(GlobalIndex{1}).add(part());
    }
    bytes_.add("\n$EndGhostElements\n");
  }

  const Outline& outline_;
  const Piece& piece_;
  const Ghosts& ghosts_;
  const PieceCounts& counts_;
  const PartTags& tags_;
  PieceCells cells_;
  ByShape<MshCells> elements_{};
  MshBytes bytes_{};
};

class MshPartsWriter final : public Writer {
 public:
  explicit MshPartsWriter(const WriterTarget& target)
      : outline_(target.outline),
        folder_(target.folder),
        tags_(target.outline),
        head_(msh4_head(msh_entities(target.outline)))
  {
  }

  [[nodiscard]] bool needs_ghosts() const override { return true; }

  // Files of a mesh with more pieces, which deal.II takes for an error.
  void begin() override
  {
    LocalIndex part = outline_.num_pieces() + 1;
    while (std::filesystem::remove(file(part))) ++part;
  }

  void write(const Piece& piece) override
  {
    io::write_text_atomically(file(piece.number + 1), MshPart(outline_, tags_, piece).text(head_));
  }

 private:
  [[nodiscard]] std::filesystem::path file(LocalIndex part) const
  {
    return folder_ / fmt::format("mesh_{}.msh", part);
  }

  const Outline& outline_;
  const std::filesystem::path& folder_;
  PartTags tags_;
  std::string head_;
};

}  // namespace

std::unique_ptr<Writer> make_msh_parts_writer(const WriterTarget& target)
{
  return std::make_unique<MshPartsWriter>(target);
}

}  // namespace tessera::formats
