// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tessera/mesh/mesh_arrays.hpp"

#include "check/findings.hpp"
#include "check/match/records.hpp"

namespace tessera::check {

/// @brief Which file a piece belongs to and which of its pieces it is.
struct PieceName {
  LocalIndex piece = 0;
  bool is_boundary = false;
  [[nodiscard]] LocalIndex vertices_per_cell() const { return is_boundary ? 3 : 4; }
};

/// @brief A number for each cell. Those that go up in equal steps, as ids do, or are all one are
/// not kept: of a piece of many cells they would take as much as its points.
template <class T>
class CellNumbers {
 public:
  CellNumbers() = default;
  explicit CellNumbers(std::vector<T> values) : size_(values.size()), values_(std::move(values))
  {
    if (size_ > 0) first_ = to_unsigned(values_[0]);
    if (size_ > 1) step_ = to_unsigned(values_[1]) - first_;
    for (std::size_t c = 0; c < size_; ++c)
      if (values_[c] != stepped(c)) return;
    values_ = std::vector<T>();  // An empty list would keep the memory.
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] T operator[](std::size_t c) const
  {
    return values_.empty() ? stepped(c) : values_[c];
  }
  [[nodiscard]] bool is_constant() const { return values_.empty() && (step_ == 0 || size_ < 2); }
  [[nodiscard]] std::vector<T> to_vector() const
  {
    std::vector<T> all(size_);
    for (std::size_t c = 0; c < size_; ++c) all[c] = (*this)[c];
    return all;
  }

 private:
  // Unsigned, since what a file holds may overflow.
  static std::uint64_t to_unsigned(T value) { return static_cast<std::uint64_t>(value); }
  [[nodiscard]] T stepped(std::size_t c) const { return static_cast<T>(first_ + step_ * c); }

  std::size_t size_ = 0;
  std::uint64_t first_ = 0;
  std::uint64_t step_ = 0;
  std::vector<T> values_{};  // Empty if they go up in equal steps.
};

/// @brief Arrays of a piece in which every index is in range, and which of its points are the same.
struct PieceMesh {
  PieceName name{};
  VertexIdentity identity = VertexIdentity::ids;
  mesh::MeshArrays arrays{};
  bool has_point_ids = false;
  bool has_cell_ids = false;
  std::vector<LocalIndex> cell_vertices{};  ///< Shape (num_cells, vertices_per_cell); the lowest of
                                            ///< the points that are one; -1 in cells left out.
                                            ///< Empty if all are as in the arrays.
  std::vector<LocalIndex> cell_nodes{};     ///< Of cells of second order, else empty; shape
                                            ///< (num_cells, 6 or 3), numbered as cell_vertices.
  std::vector<LocalIndex> unused_points{};
  /// Pairs at one position, if points may be double on purpose; else they are reported.
  std::vector<std::array<LocalIndex, 2>> equal_points{};
  CellNumbers<GlobalIndex> cell_ids{};    ///< Taken from the arrays, as the next two.
  CellNumbers<std::int32_t> attribute{};  ///< Shape (num_cells); material, 0 if the file has none.
  CellNumbers<std::int32_t> subdomain{};  ///< Shape (num_cells); if the file has none, the piece's
                                          ///< number; in the boundary file kNoSubdomain.
  bool has_subdomains = false;            ///< The file has them.

  [[nodiscard]] LocalIndex num_points() const
  {
    return static_cast<LocalIndex>(arrays.point_xyz.size() / 3);
  }
  [[nodiscard]] LocalIndex num_cells() const { return static_cast<LocalIndex>(arrays.num_cells()); }
  [[nodiscard]] Vec3 position(LocalIndex v) const
  {
    return point_at(std::span<const double>(arrays.point_xyz), v);
  }
  [[nodiscard]] std::span<const LocalIndex> cell(LocalIndex c) const
  {
    const auto width = static_cast<std::size_t>(arrays.vertices_per_cell);
    const auto& all = cell_vertices.empty() ? arrays.cell_points : cell_vertices;
    return std::span(all).subspan(static_cast<std::size_t>(c) * width, width);
  }
  /// @brief Names of patches on the plus and on the minus side of a split, in turn; usually none.
  [[nodiscard]] std::span<const std::string> split_patches() const
  {
    const auto found = arrays.field_texts.find("split_patches");
    if (found == arrays.field_texts.end()) return {};
    return found->second;
  }
  /// @brief Names of patches with one material on both sides; usually none.
  [[nodiscard]] std::span<const std::string> inside_patches() const
  {
    const auto found = arrays.field_texts.find(mesh::kInsidePatchesName);
    if (found == arrays.field_texts.end()) return {};
    return found->second;
  }
  [[nodiscard]] bool is_of_second_order() const { return !cell_nodes.empty(); }
  void set_cell(LocalIndex c, std::span<const LocalIndex> vertices)
  {
    if (cell_vertices.empty()) cell_vertices = arrays.cell_points;
    std::ranges::copy(vertices, &cell_vertices[static_cast<std::size_t>(c) * vertices.size()]);
  }
  void leave_out(LocalIndex c)
  {
    constexpr std::array kNone{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
    set_cell(c, std::span(kNone).first(cell(c).size()));
  }
  [[nodiscard]] bool is_left_out(LocalIndex c) const { return cell(c)[0] == kNoIndex; }
  [[nodiscard]] GlobalIndex point_id(LocalIndex v) const
  {
    return has_point_ids ? arrays.point_ids[static_cast<std::size_t>(v)] : kNoId;
  }
  [[nodiscard]] GlobalIndex cell_id(LocalIndex c) const
  {
    return has_cell_ids ? cell_ids[static_cast<std::size_t>(c)] : kNoId;
  }
  [[nodiscard]] std::int32_t material(LocalIndex c) const
  {
    return attribute[static_cast<std::size_t>(c)];
  }
  [[nodiscard]] VertexKey key(LocalIndex v) const
  {
    return identity == VertexIdentity::ids ? key_of_id(point_id(v)) : key_of_position(position(v));
  }
  [[nodiscard]] std::int32_t subdomain_of(LocalIndex c) const
  {
    return subdomain[static_cast<std::size_t>(c)];
  }
};

/// @brief Takes the arrays of one piece and reports what is wrong with them by themselves: sizes,
/// ranges, points that are not finite, used twice or never. Local.
/// @param[in] identity Points are matched by position, whatever is asked, if the piece has no ids.
/// @throws InputError if the piece has 2^29 cells or 2^31 points.
[[nodiscard]] PieceMesh make_piece_mesh(PieceName name, mesh::MeshArrays arrays,
                                        VertexIdentity identity, Findings& findings);

/// @brief Reports that point `p` is the same as `lowest`. Local.
void report_equal_points(const PieceMesh& mesh, Kind kind, LocalIndex p, LocalIndex lowest,
                         Findings& findings);

/// @brief "piece 3" or "boundary piece 3".
[[nodiscard]] std::string to_text(const PieceName& name);
/// @brief "cell 7 (id 1007) of piece 3".
[[nodiscard]] std::string describe_cell(const PieceMesh& mesh, LocalIndex cell);
/// @brief "point 7 (id 107) at (x, y, z)".
[[nodiscard]] std::string describe_point(const PieceMesh& mesh, LocalIndex point);

}  // namespace tessera::check
