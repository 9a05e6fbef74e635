// SPDX-License-Identifier: BSD-3-Clause
#include "formats/msh_parts_writer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/io/files.hpp"

#include "formats/msh_sections.hpp"

namespace tessera::formats {
namespace {

// Tags of the entities that pieces have, above those of the model: no two pieces share one.
class PartTags {
 public:
  explicit PartTags(const Outline& outline)
      : above_(
          static_cast<std::int32_t>(outline.material_names.size() + outline.patch_names.size()))
  {
    for (const PieceCounts& piece : outline.pieces) {
      first_surface_.push_back(num_surfaces_ + 1);
      first_volume_.push_back(num_volumes_ + 1);
      num_surfaces_ += static_cast<std::int32_t>(piece.triangles_of_patch.size());
      num_volumes_ += static_cast<std::int32_t>(piece.tets_of_material.size());
    }
  }

  // Of the first one of a piece; others follow.
  [[nodiscard]] std::int32_t surface(LocalIndex piece) const
  {
    return above_ + first_surface_[at(piece)];
  }
  [[nodiscard]] std::int32_t volume(LocalIndex piece) const
  {
    return above_ + first_volume_[at(piece)];
  }
  [[nodiscard]] std::int32_t ghosts(LocalIndex piece) const
  {
    return above_ + num_volumes_ + 1 + piece;
  }

 private:
  std::int32_t above_;
  std::int32_t num_surfaces_ = 0;
  std::int32_t num_volumes_ = 0;
  std::vector<std::int32_t> first_surface_{};
  std::vector<std::int32_t> first_volume_{};
};

// The file of one piece.
class MshPart {
 public:
  MshPart(const Outline& outline, const PartTags& tags, const Piece& piece)
      : piece_(piece),
        ghosts_(piece.ghosts),
        box_(outline.pieces[at(piece.number)].box),
        tags_(tags),
        triangles_(msh_triangles(outline, piece)),
        tets_(msh_tets(outline, piece)),
        tag_of_first_patch_(msh_tag_of_patch(outline, 1)),
        num_pieces_(outline.num_pieces())
  {
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
  [[nodiscard]] bool has_ghosts() const { return !ghosts_.tets.empty(); }
  [[nodiscard]] std::int32_t part() const { return piece_.number + 1; }

  void add_part_entities()
  {
    bytes_.add("$PartitionedEntities\n").add(GlobalIndex{num_pieces_});
    bytes_.add(GlobalIndex{has_ghosts() ? 1 : 0});
    if (has_ghosts()) bytes_.add(tags_.ghosts(piece_.number)).add(part());
    bytes_.add(GlobalIndex{0}).add(GlobalIndex{0});
    bytes_.add(static_cast<GlobalIndex>(triangles_.counts.size()));
    bytes_.add(static_cast<GlobalIndex>(tets_.counts.size()));
    add_entities(triangles_, tags_.surface(piece_.number), tag_of_first_patch_);
    add_entities(tets_, tags_.volume(piece_.number), 1);
    bytes_.add("\n$EndPartitionedEntities\n");
  }

  void add_entities(const MshCells& cells, std::int32_t tag, std::int32_t first_parent)
  {
    for (const TagCount& count : cells.counts) {
      const std::int32_t parent = first_parent + count.tag - 1;
      bytes_.add(tag++).add(cells.type.dimension).add(parent);
      bytes_.add(GlobalIndex{1}).add(part());
      msh4_add_entity({.tag = parent, .box = box_}, bytes_);
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
    bytes_.add(msh4_nodes_head(tags_.volume(piece_.number), static_cast<GlobalIndex>(nodes.size()),
                               first, last));
    bytes_.add(bytes_of(nodes)).add(bytes_of(piece_.point_xyz)).add(bytes_of(ghosts_.point_xyz));
    bytes_.add(kMshEndNodes);
  }

  void add_elements()
  {
    const auto num_tets = static_cast<GlobalIndex>(tets_.tags.size());
    const auto num_triangles = static_cast<GlobalIndex>(triangles_.tags.size());
    const auto num_ghosts = static_cast<GlobalIndex>(ghosts_.tets.size());
    const auto num_blocks = triangles_.counts.size() + tets_.counts.size() + (has_ghosts() ? 1 : 0);
    GlobalIndex first = tets_.first_element;
    GlobalIndex last = first + num_tets - 1;
    if (has_ghosts()) {
      first = std::min(first, ghosts_.tets.front() + 1);
      last = std::max(last, ghosts_.tets.back() + 1);
    }
    if (num_triangles > 0) last = triangles_.first_element + num_triangles - 1;
    bytes_.add(msh4_elements_head(static_cast<GlobalIndex>(num_blocks),
                                  num_triangles + num_tets + num_ghosts, first, last));
    add_blocks(triangles_, tags_.surface(piece_.number));
    add_blocks(tets_, tags_.volume(piece_.number));
    if (has_ghosts()) add_ghost_block();
    bytes_.add(kMshEndElements);
  }

  void add_blocks(const MshCells& cells, std::int32_t tag)
  {
    for (const TagCount& count : cells.counts) {
      bytes_.add(msh4_block_head(cells.type, tag++, count.count));
      bytes_.add(bytes_of(msh4_records(piece_, cells, count)));
    }
  }

  void add_ghost_block()
  {
    bytes_.add(msh4_block_head(kMshTet, tags_.ghosts(piece_.number),
                               static_cast<GlobalIndex>(ghosts_.tets.size())));
    for (std::size_t g = 0; g < ghosts_.tets.size(); ++g) {
      bytes_.add(ghosts_.tets[g] + 1);
      for (const GlobalIndex number : std::span(ghosts_.tet_points).subspan(4 * g, 4))
        bytes_.add(number + 1);
    }
  }

  // Each with the part that it belongs to, and the one part that it is a ghost of here.
  void add_ghosts()
  {
    bytes_.add("$GhostElements\n").add(static_cast<GlobalIndex>(ghosts_.tets.size()));
    for (std::size_t g = 0; g < ghosts_.tets.size(); ++g) {
      bytes_.add(ghosts_.tets[g] + 1).add(ghosts_.tet_piece[g] + 1);
      bytes_.add(GlobalIndex{1}).add(part());
    }
    bytes_.add("\n$EndGhostElements\n");
  }

  const Piece& piece_;
  const Ghosts& ghosts_;
  const Box& box_;
  const PartTags& tags_;
  MshCells triangles_;
  MshCells tets_;
  std::int32_t tag_of_first_patch_;
  LocalIndex num_pieces_;
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
