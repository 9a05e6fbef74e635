// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/msh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/files/record_file.hpp"
#include "formats/writers/msh_periodic.hpp"
#include "formats/writers/msh_sections.hpp"

namespace tessera::formats {
namespace {

constexpr GlobalIndex kTagSize = sizeof(GlobalIndex);
constexpr GlobalIndex kPointSize = 3 * sizeof(double);

// Sections of the file before the blocks of cells.
constexpr std::size_t kNodeTags = 0;
constexpr std::size_t kNodePoints = 1;
constexpr std::size_t kElementsHead = 2;
constexpr std::size_t kFirstBlock = 3;

// The blocks of one kind of cell, a block for each tag that has cells. In a block, pieces stand one
// behind the other.
struct Blocks {
  MshCellType type{};
  std::vector<TagCount> counts{};        // Of the blocks, with tags of the outline.
  std::vector<std::size_t> block_of{};   // By tag.
  Lists<GlobalIndex> first_of_pieces{};  // By piece: where it begins in the block of each tag.
};

Blocks blocks_of(const Outline& outline, Shape shape)
{
  const std::size_t num_tags = outline.names_of(shape).size();
  std::vector<GlobalIndex> sums(num_tags + 1, 0);
  Blocks blocks{.type = msh_type(outline, shape),
                .block_of = std::vector<std::size_t>(num_tags + 1, 0)};
  for (const PieceCounts& piece : outline.pieces) {
    for (const TagCount& count : piece.elements[shape])
      blocks.first_of_pieces.values.push_back(
          std::exchange(sums[at(count.tag)], sums[at(count.tag)] + count.count));
    blocks.first_of_pieces.end_list();
  }
  for (std::size_t tag = 1; tag <= num_tags; ++tag) {
    blocks.block_of[tag] = blocks.counts.size();
    if (sums[tag] > 0) blocks.counts.push_back({static_cast<std::int32_t>(tag), sums[tag]});
  }
  return blocks;
}

ByShape<Blocks> blocks_of_shapes(const Outline& outline)
{
  ByShape<Blocks> blocks;
  for (const Shape shape : kAllShapes) blocks[shape] = blocks_of(outline, shape);
  return blocks;
}

class MshWriter final : public Writer {
 public:
  explicit MshWriter(const WriterTarget& target)
      : outline_(target.outline),
        blocks_(blocks_of_shapes(outline_)),
        file_(target.folder / "mesh.msh", sections(), tail(target.outline))
  {
  }

  void begin() override { file_.begin(); }

  void write(const Piece& piece) override
  {
    for (const PointRun& run : outline_.own_points(piece.number)) {
      std::vector<GlobalIndex> tags(at(run.count));
      std::iota(tags.begin(), tags.end(), run.first_number + 1);
      file_.write(kNodeTags, run.first_number, bytes_of(tags));
      const auto xyz = std::span(piece.point_xyz).subspan(3 * at(run.first_row), 3 * at(run.count));
      file_.write(kNodePoints, run.first_number, bytes_of(xyz));
    }
    const PieceCells cells(piece);
    std::size_t first_block = kFirstBlock;
    for (const Shape shape : kMshShapes) {
      write(piece, blocks_[shape], first_block,
            msh_cells(outline_, piece.number, shape, cells[shape]));
      first_block += blocks_[shape].counts.size();
    }
    for_each_periodic(outline_, piece, [&](std::size_t row, GlobalIndex first, const auto& points) {
      std::vector<std::array<GlobalIndex, 2>> nodes;
      for (const PeriodicPoint& point : points) nodes.push_back(periodic_nodes(piece, point));
      file_.write(first_block + row, first, bytes_of(nodes));
    });
  }

  void close() override { file_.close(); }
  void commit() override { file_.commit(); }

 private:
  static std::string tail(const Outline& outline)
  {
    return outline.periodic.empty() ? kMshEndElements : std::string("\n") + kMshEndPeriodic;
  }

  void write(const Piece& piece, const Blocks& blocks, std::size_t first_block,
             const MshCells& cells)
  {
    const std::span<const GlobalIndex> first = blocks.first_of_pieces[piece.number];
    for (std::size_t i = 0; i < cells.counts.size(); ++i) {
      const TagCount& count = cells.counts[i];
      file_.write(first_block + blocks.block_of[at(count.tag)], first[i],
                  bytes_of(msh4_records(piece, cells, count)));
    }
  }

  [[nodiscard]] std::vector<RecordSection> sections() const
  {
    const GlobalIndex num_points = outline_.num_points();
    const GlobalIndex num_elements = msh_num_elements(outline_);
    GlobalIndex num_blocks = 0;
    for (const Blocks& blocks : blocks_.values)
      num_blocks += static_cast<GlobalIndex>(blocks.counts.size());
    std::vector<RecordSection> sections(kFirstBlock);
    sections[kNodeTags] = {
        msh4_head(msh_entities(outline_)) + msh4_nodes_head(1, num_points, 1, num_points),
        num_points, kTagSize};
    sections[kNodePoints] = {"", num_points, kPointSize};
    sections[kElementsHead] = {
        kMshEndNodes + msh4_elements_head(num_blocks, num_elements, 1, num_elements), 0, 0};
    for (const Shape shape : kMshShapes) {
      const MshCellType& type = blocks_[shape].type;
      for (const TagCount& count : blocks_[shape].counts) {
        sections.push_back({msh4_block_head(type, msh_tag(outline_, shape, count.tag), count.count),
                            count.count, static_cast<GlobalIndex>(type.num_points + 1) * kTagSize});
      }
    }
    for (std::size_t row = 0; row < outline_.periodic.size(); ++row) {
      sections.push_back({(row == 0 ? kMshEndElements : "") + msh4_periodic_head(outline_, row),
                          outline_.periodic[row].first_point.back(), 2 * kTagSize});
    }
    return sections;
  }

  const Outline& outline_;
  ByShape<Blocks> blocks_;
  RecordFile file_;
};

}  // namespace

std::unique_ptr<Writer> make_msh_writer(const WriterTarget& target)
{
  return std::make_unique<MshWriter>(target);
}

}  // namespace tessera::formats
