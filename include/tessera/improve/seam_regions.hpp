// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/types.hpp"
#include "tessera/mesh/decomposition.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"

/// Tets around the seams between subdomains are optimised once more, so that their quality does not
/// depend on how many subdomains there are. First come those around the faces between two
/// subdomains, then those around the curves where several meet, then those around the ends of the
/// curves.
namespace tessera::improve {

/// @brief Phases by dimension: 0 faces between two subdomains, 1 curves, 2 points.
inline constexpr int kNumPhases = 3;

/// @brief The places where subdomains of one material meet.
///
/// A *region* is the work of one job: all hosts of the skeleton that lie in the same two or more
/// subdomains of a material. Regions are numbered by phase, then by their subdomains, so they have
/// the same numbers in every process.
class SeamRegions {
 public:
  /// @note Local; O(n log n) in the skeleton's triangles.
  SeamRegions(const mesh::Skeleton& skeleton, const mesh::Decomposition& decomposition);

  [[nodiscard]] LocalIndex num_regions() const { return phase_offsets_[kNumPhases]; }

  /// @brief The regions of phase p are first_of_phase(p) … first_of_phase(p + 1) - 1.
  [[nodiscard]] LocalIndex first_of_phase(int phase) const
  {
    return phase_offsets_[static_cast<std::size_t>(phase)];
  }

  [[nodiscard]] int phase_of(LocalIndex region) const;

  /// @brief The region of the subdomains of `material` that `host` lies in. kNoIndex if it lies in
  /// one such subdomain or none, or is not of the skeleton.
  [[nodiscard]] LocalIndex region_of(mesh::HostEntity host, LocalIndex material) const;

  /// @brief The region whose improvement made the vertices of `host`; kNoIndex if none did.
  [[nodiscard]] LocalIndex region_made(mesh::HostEntity host) const
  {
    return hosts_.kind_of(host) == mesh::HostKind::seam_region ? hosts_.row_of(host) : kNoIndex;
  }

  /// @brief Whether two subdomains of one material may hold the vertices of `host`. Local.
  [[nodiscard]] bool may_be_on_seam(mesh::HostEntity host) const;

  /// @brief The subdomains, of any material, that may hold vertices of `host`, ascending. Local.
  [[nodiscard]] std::span<const LocalIndex> holders_of(mesh::HostEntity host) const;

  /// @brief The subdomains that meet in a region, ascending; at least two, of one material.
  [[nodiscard]] std::span<const LocalIndex> subdomains_of(LocalIndex region) const
  {
    return region_subdomains_[region];
  }

  /// @brief The regions of one phase that a subdomain takes part in, ascending.
  [[nodiscard]] std::span<const LocalIndex> regions_of(LocalIndex subdomain, int phase) const;

  /// @brief Host of the new vertices that the improvement of a region makes and that several pieces
  /// share.
  [[nodiscard]] mesh::HostEntity host_of(LocalIndex region) const
  {
    return hosts_.seam_region(region);
  }

 private:
  struct HostRegion {
    LocalIndex material = 0;
    LocalIndex region = kNoIndex;
  };

  mesh::HostLayout hosts_;
  std::array<LocalIndex, kNumPhases + 1> phase_offsets_{};
  Lists<HostRegion> host_regions_{};  ///< By host of the skeleton, ascending by material.
  IndexLists host_subdomains_{};      ///< By host of the skeleton, ascending.
  IndexLists region_subdomains_{};    ///< By region, ascending.
  IndexLists subdomain_regions_{};    ///< By subdomain, ascending.
};

/// @brief Which shared vertices of a piece, or of a part of it, two subdomains of one material may
/// hold. Shape (num_skin_vertices). Local.
[[nodiscard]] std::vector<char> vertices_perhaps_on_seams(const mesh::Piece& piece,
                                                          const SeamRegions& regions);

/// @brief How many layers of tets around a seam are optimised, >= 1. Two lost 6 % of the 1st
/// percentile of boxcyl, three 4 %; four took a third more time for 0.002 of the mean (shaft, L =
/// 2, 64 subdomains, NETGEN's optimiser).
inline constexpr int kDefaultLayers = 3;

/// @brief The region of a phase that each tet of a piece belongs to, or kNoIndex beyond `layers`.
/// Shape (num_tets).
///
/// That is the nearest region, and the lowest of equally near ones. So every tet is in one job of a
/// phase at most, and jobs do not meet. Distance is counted in tets: those with a vertex on one of
/// the region's hosts are layer 1. A pure function of the piece, or of the part of it that is
/// given.
/// @note Local; linear.
[[nodiscard]] std::vector<LocalIndex> label_tets(const mesh::Piece& piece,
                                                 const SeamRegions& regions, int phase, int layers);

}  // namespace tessera::improve
