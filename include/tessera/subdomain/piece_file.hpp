// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tessera/io/options.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

namespace tessera::subdomain {

/// @brief A file has no more tets: the indices of their corners have 32 bits.
inline constexpr GlobalIndex kMostTetsOfFile = std::numeric_limits<LocalIndex>::max() / 4;

/// @brief Subdomains first…last-1 that go together: into one file, or through one job.
struct SubdomainRange {
  LocalIndex number = 0;  ///< Of the file or record.
  LocalIndex first = 0;
  LocalIndex last = 0;
};

/// @brief What each piece file holds: contiguous ranges of almost equal length. Depends on the case
/// only, never on ranks.
/// @param[in] files output.files; 0, or more than there are subdomains: one a subdomain.
[[nodiscard]] std::vector<SubdomainRange> file_ranges(LocalIndex num_subdomains, LocalIndex files);

/// @brief One range for each part. @param[in] offsets mesh::Decomposition::part_offsets.
[[nodiscard]] std::vector<SubdomainRange> part_ranges(const std::vector<LocalIndex>& offsets);

/// @brief One range for each of the given subdomains, under its own number.
[[nodiscard]] std::vector<SubdomainRange> single_ranges(const std::vector<LocalIndex>& subdomains);

/// @brief Name of a file's tets, boundary triangles or edges on lines, relative to the output
/// folder.
[[nodiscard]] std::filesystem::path piece_path(const std::string& folder, LocalIndex file);

/// @brief Gathers the pieces of one output file, points that they share once, and writes it.
class PieceFile {
 public:
  /// @brief Both are borrowed.
  PieceFile(const WriteContext& mesh, const io::OutputOptions& options);

  /// @brief Adds a piece and returns its digest. @pre pieces come in the order of subdomains.
  Hash128 add(mesh::Piece piece);

  /// @brief Writes the tets and, unless there are none, the boundary triangles and the edges on
  /// lines below `folder`: mesh/piece_NNNNNN.vtu, boundary/piece_NNNNNN.vtu and
  /// lines/piece_NNNNNN.vtu.
  /// @return The files, relative to `folder`. @throws OutputError
  [[nodiscard]] std::vector<std::filesystem::path> write(const std::filesystem::path& folder,
                                                         LocalIndex file) const;

  /// @brief What it would write.
  [[nodiscard]] PieceArrays take() && { return std::move(arrays_); }

 private:
  using PointOfId = std::unordered_map<GlobalIndex, LocalIndex>;

  const WriteContext& mesh_;
  const io::OutputOptions& options_;
  PieceArrays arrays_{};
  std::size_t num_skin_of_first_ = 0;
  std::size_t num_of_tets_of_first_ = 0;
  PointOfId tet_points_{};  ///< Points of skins only: no other is shared.
  PointOfId boundary_points_{};
  PointOfId line_points_{};
};

}  // namespace tessera::subdomain
