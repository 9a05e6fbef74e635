// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/hash.hpp"
#include "tessera/io/record_store.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/projection_limiter.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_summary.hpp"

namespace tessera::pipeline {

/// @brief A file that a job has written, so that a resumed run can tell whether it is whole.
struct WrittenFile {
  std::string path{};  ///< Relative to the output folder.
  std::uint64_t size = 0;
  Hash128 hash{};

  static auto fields(auto& self) { return std::tie(self.path, self.size, self.hash); }
};

/// @brief What the store keeps of the subdomains that one job filled. Their tets are in the files
/// that it names, or in further segments of the record.
struct FillRecord {
  Hash128 plan{};  ///< plan_fingerprint() that they were made under.
  std::vector<subdomain::FillResult> results{};
  std::vector<WrittenFile> files{};

  static auto fields(auto& self) { return std::tie(self.plan, self.results, self.files); }
};

/// @brief Segments of the record of a piece that waits in the store.
enum class PieceSegment : LocalIndex {
  head,   ///< FillRecord
  piece,  ///< mesh::Piece
  bands,  ///< If its seams are to be improved: band_segments() of phase 0.
};

/// @brief A piece from its record, as it was filled or refined. Local.
/// @throws InputError if the record is missing or damaged.
[[nodiscard]] mesh::Piece piece_of_record(const std::filesystem::path& output,
                                          const std::string& name);

/// @brief Where finished pieces and the state of an unfinished run are; in the output folder.
[[nodiscard]] std::filesystem::path store_folder(const std::filesystem::path& output);

/// @brief Name of the record of one job's subdomains.
[[nodiscard]] std::string record_name(LocalIndex batch);

/// @brief The same for subdomains that were split further.
[[nodiscard]] std::string refined_name(LocalIndex batch);

/// @brief Size and hash of a file below `folder`, by reading it. @throws OutputError
[[nodiscard]] WrittenFile measure_file(const std::filesystem::path& folder,
                                       const std::filesystem::path& path);

/// @brief The record if it is sound, was made under that plan, and its files are whole. Local.
[[nodiscard]] std::optional<FillRecord> find_record(const std::filesystem::path& output,
                                                    const std::string& name, const Hash128& plan);

/// @brief Hash of the coarse mesh and its subdomains. Local.
[[nodiscard]] Hash128 cut_fingerprint(const subdomain::PartitionedMesh& cut);

/// @brief What of the plan bears on the subdomains first…last-1: their pieces are valid as long as
/// it stays the same. Local.
/// @param[in] cut cut_fingerprint().
[[nodiscard]] Hash128 plan_fingerprint(const Hash128& cut, const mesh::Skeleton& skeleton,
                                       const mesh::ProjectionLimiter& limiter, LocalIndex first,
                                       LocalIndex last);

}  // namespace tessera::pipeline
