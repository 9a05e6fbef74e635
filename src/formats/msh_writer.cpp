// SPDX-License-Identifier: BSD-3-Clause
#include "formats/msh_writer.hpp"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/msh_sections.hpp"
#include "formats/record_file.hpp"

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

Blocks blocks_of(const Outline& outline, const MshCellType& type,
                 std::vector<TagCount> PieceCounts::*counts, std::size_t num_tags)
{
  std::vector<GlobalIndex> sums(num_tags + 1, 0);
  Blocks blocks{.type = type, .block_of = std::vector<std::size_t>(num_tags + 1, 0)};
  for (const PieceCounts& piece : outline.pieces) {
    for (const TagCount& count : piece.*counts)
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

class MshWriter final : public Writer {
 public:
  explicit MshWriter(const WriterTarget& target)
      : outline_(target.outline),
        triangles_(blocks_of(outline_, msh_triangle_type(outline_),
                             &PieceCounts::triangles_of_patch, outline_.patch_names.size())),
        tets_(blocks_of(outline_, msh_tet_type(outline_), &PieceCounts::tets_of_material,
                        outline_.material_names.size())),
        file_(target.folder / "mesh.msh", sections(), kMshEndElements)
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
    write(piece, triangles_, kFirstBlock, msh_triangles(outline_, piece));
    write(piece, tets_, kFirstBlock + triangles_.counts.size(), msh_tets(outline_, piece));
  }

  void close() override { file_.close(); }
  void commit() override { file_.commit(); }

 private:
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
    const GlobalIndex num_cells = outline_.num_triangles() + outline_.num_tets();
    const auto num_blocks =
        static_cast<GlobalIndex>(triangles_.counts.size() + tets_.counts.size());
    std::vector<RecordSection> sections(kFirstBlock);
    sections[kNodeTags] = {
        msh4_head(msh_entities(outline_)) + msh4_nodes_head(1, num_points, 1, num_points),
        num_points, kTagSize};
    sections[kNodePoints] = {"", num_points, kPointSize};
    sections[kElementsHead] = {
        kMshEndNodes + msh4_elements_head(num_blocks, num_cells, 1, num_cells), 0, 0};
    for (const Blocks* const blocks : {&triangles_, &tets_}) {
      for (const TagCount& count : blocks->counts) {
        const std::int32_t entity =
            blocks == &triangles_ ? msh_tag_of_patch(outline_, count.tag) : count.tag;
        sections.push_back({msh4_block_head(blocks->type, entity, count.count), count.count,
                            static_cast<GlobalIndex>(blocks->type.num_points + 1) * kTagSize});
      }
    }
    return sections;
  }

  const Outline& outline_;
  Blocks triangles_;
  Blocks tets_;
  RecordFile file_;
};

}  // namespace

std::unique_ptr<Writer> make_msh_writer(const WriterTarget& target)
{
  return std::make_unique<MshWriter>(target);
}

}  // namespace tessera::formats
