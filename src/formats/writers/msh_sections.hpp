// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tessera/formats/piece.hpp"

#include "formats/cells.hpp"

/// What the forms of Gmsh's MSH files have in common. Entities and physical groups have the same
/// tags: materials 1…M, patches M+1…M+P, then lines, because some readers have one list of groups
/// for all dimensions. Points and elements have their numbers plus 1: faces follow cells, and lines
/// come last.
namespace tessera::formats {

/// @brief A kind of cell as MSH numbers it.
struct MshCellType {
  std::int32_t dimension = 0;
  std::int32_t number = 0;
  std::size_t num_points = 0;
};
inline constexpr std::int32_t kMshCurve = 1;  ///< A dimension.
inline constexpr std::int32_t kMshSurface = 2;
inline constexpr std::int32_t kMshVolume = 3;

/// @brief The kind that elements of a shape have in a mesh. Local.
[[nodiscard]] MshCellType msh_type(const Outline& outline, Shape shape);

/// @brief The order in which files have elements.
inline constexpr std::array kMshShapes{Shape::line, Shape::triangle, Shape::quad,
                                       Shape::tet,  Shape::pyramid,  Shape::prism};

/// @brief How many elements files have: those on lines too. Local.
[[nodiscard]] GlobalIndex msh_num_elements(const Outline& outline);

/// @brief Bytes of numbers, one behind the other. MSH's size_t is a GlobalIndex here.
class MshBytes {
 public:
  MshBytes& add(std::int32_t value) { return add_bytes(&value, sizeof(value)); }
  MshBytes& add(GlobalIndex value) { return add_bytes(&value, sizeof(value)); }
  MshBytes& add(const Box& box)
  {
    return add_bytes(box.low.data(), sizeof(box.low)).add_bytes(box.high.data(), sizeof(box.high));
  }
  MshBytes& add(std::string_view text) { return add_bytes(text.data(), text.size()); }

  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::string take() && { return std::move(text_); }

 private:
  MshBytes& add_bytes(const void* data, std::size_t size)
  {
    text_.append(static_cast<const char*>(data), size);
    return *this;
  }

  std::string text_{};
};

/// @brief An array as the bytes that it has in a file. Borrowed.
template <class Values>
[[nodiscard]] std::string_view bytes_of(const Values& values)
{
  const std::span all(values);
  return {reinterpret_cast<const char*>(all.data()), all.size_bytes()};
}

/// @brief The tag in files of what an element of a shape is of. Local.
/// @param[in] tag In the outline.
[[nodiscard]] std::int32_t msh_tag(const Outline& outline, Shape shape, std::int32_t tag);

/// @brief Cells of one kind of a piece.
struct MshCells {
  MshCellType type{};
  ElementList list{};
  std::span<const TagCount> counts{};  ///< How many cells have which tag; ascending.
  GlobalIndex first_element = 0;       ///< Tag of the first cell in files.
};

/// @brief Tags of the nodes of a cell, in the order of MSH, which has the last two nodes of a tet
/// of second order the other way round than VTK. Local.
void msh_add_nodes(const Piece& piece, const MshCells& cells, std::size_t cell,
                   std::vector<GlobalIndex>& nodes);

/// @brief Elements of one shape of a piece. Local. Borrows from the outline and from `list`.
[[nodiscard]] MshCells msh_cells(const Outline& outline, LocalIndex piece, Shape shape,
                                 const ElementList& list);

/// @brief What a block of version 4.1 holds of a piece: of each cell with a tag, its own tag as an
/// element and those of its nodes. Local.
/// @return Shape (count.count, cells.type.num_points + 1).
[[nodiscard]] std::vector<GlobalIndex> msh4_records(const Piece& piece, const MshCells& cells,
                                                    const TagCount& count);

/// @brief A model's entity, which is a physical group too.
struct MshEntity {
  std::int32_t dimension = 0;
  std::int32_t tag = 0;
  std::string name{};
  Box box{};  ///< Of the pieces that have cells of it; of the mesh if none has.
};

/// @brief Lines, patches, then materials. Names can be read by all readers: of 127 bytes at most,
/// without quotes, backslashes and control characters, none twice. Local.
[[nodiscard]] std::vector<MshEntity> msh_entities(const Outline& outline);

/// @brief $PhysicalNames, which is text in binary files too. Local.
[[nodiscard]] std::string msh_physical_names(const std::vector<MshEntity>& entities);

/// @brief What binary files of version 4.1 begin with, up to $EndEntities. Local.
[[nodiscard]] std::string msh4_head(const std::vector<MshEntity>& entities);

/// @brief $Nodes up to the tags of its only block. Local.
/// @param[in] entity Of dimension 3. @param[in] first, last Least and greatest tag.
[[nodiscard]] std::string msh4_nodes_head(std::int32_t entity, GlobalIndex num_nodes,
                                          GlobalIndex first, GlobalIndex last);

/// @brief $Elements up to its first block. Local.
[[nodiscard]] std::string msh4_elements_head(GlobalIndex num_blocks, GlobalIndex num_elements,
                                             GlobalIndex first, GlobalIndex last);

/// @brief Begins a block of elements. Local.
[[nodiscard]] std::string msh4_block_head(const MshCellType& type, std::int32_t entity,
                                          GlobalIndex num_elements);

/// @brief An entity in $Entities or $PartitionedEntities behind its first tags. Local.
void msh4_add_entity(const MshEntity& entity, MshBytes& bytes);

inline constexpr const char* kMshEndNodes = "\n$EndNodes\n";
inline constexpr const char* kMshEndElements = "\n$EndElements\n";

}  // namespace tessera::formats
