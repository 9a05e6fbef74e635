// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tessera/improve/improve_region.hpp"
#include "tessera/improve/options.hpp"
#include "tessera/improve/regions.hpp"
#include "tessera/io/record_store.hpp"

#include "pipeline/cut_mesh.hpp"

namespace tessera::pipeline {

/// @brief What the store keeps of a region whose job has ended.
struct RegionRecord {
  bool is_improved = false;
  bool has_failed = false;   ///< The job died, or what it found was not valid.
  bool was_limited = false;  ///< It died for time or memory: not reproducible.
  std::string reason{};      ///< Why the region keeps its tets; empty if it is improved.
  improve::Patch patch{};    ///< Empty unless it is improved.
};

[[nodiscard]] Bytes to_bytes(const RegionRecord& record);
/// @throws InputError if the bytes are truncated.
[[nodiscard]] RegionRecord region_record_from_bytes(std::span<const std::byte> bytes);

/// @brief Name of a region's record.
[[nodiscard]] std::string region_name(LocalIndex region);

/// @brief What the jobs of an improvement work from. Borrowed.
struct ImproveContext {
  const CutMesh& cut;
  const improve::Regions& regions;
  const io::RecordStore& store;
  int generation = 0;  ///< Of the pieces that the phase starts from.
};

/// @brief The pieces that a region lies in, from the store: regions.subdomains_of(region), in that
/// order. Local.
[[nodiscard]] std::vector<mesh::Piece> pieces_around(const ImproveContext& context,
                                                     LocalIndex region);

/// @brief A region's tets, taken out of its pieces_around(). Local; a pure function.
/// @throws MeshError as improve::extract_region().
[[nodiscard]] improve::RegionMesh region_mesh(const std::vector<mesh::Piece>& pieces,
                                              const improve::Regions& regions, LocalIndex region);

/// @brief The job of one region: optimises its tets and judges the result.
/// @note Local; a pure function. The optimiser may crash: call it in a job process.
/// @throws NetgenError, MeshError if the try failed.
[[nodiscard]] RegionRecord improve_tets(const improve::RegionMesh& mesh, int rounds,
                                        const improve::Optimizer& optimizer);

/// @brief The piece of a subdomain with what the regions of one phase have become. Local; runs our
/// own code only.
[[nodiscard]] mesh::Piece merge_regions(const ImproveContext& context, LocalIndex subdomain,
                                        int phase);

}  // namespace tessera::pipeline
