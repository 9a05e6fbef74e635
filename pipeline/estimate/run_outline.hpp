// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tessera/config/case.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/number/id_layout.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"
#include "tessera/subdomain/piece_file.hpp"

namespace tessera::pipeline {

/// @brief Whether every subdomain is to be subdivided: then all ids are known before any piece is.
[[nodiscard]] bool are_counts_known(const std::vector<fill::KernelKind>& kernels);

/// @brief Whether tets of some subdomain are divided that have several faces on the geometry.
[[nodiscard]] bool divides_corners(const fill::FillOptions& options,
                                   const std::vector<fill::KernelKind>& kernels);

/// @brief How pieces come into being; for a run chosen once, by plan_run().
struct PieceChoices {
  int splits = 0;  ///< Levels on which pieces are split after they were filled.
  /// Which tets have several faces on the geometry, and are divided, is known once they are made.
  bool divides_corners = false;
  bool improves_seams = false;
  bool has_files = true;   ///< False: pieces wait in the store until they are handed over.
  bool is_curved = false;  ///< Tets of second order, for which pieces wait in the store.
};

/// @brief What is known or expected of the fine mesh before any of it is made.
struct RunOutline {
  int levels = 0;       ///< Of the finest coarse edge.
  int fill_levels = 0;  ///< On which pieces are filled; the same unless they are split further.
  LocalIndex num_coarse_tets = 0;
  std::vector<fill::KernelKind> kernels{};    ///< Shape (num_subdomains).
  std::vector<number::PieceCounts> pieces{};  ///< Shape (num_subdomains). Tets and interior
                                              ///< vertices are exact where subdivided, else
                                              ///< expected; boundary triangles are exact.
  GlobalIndex num_skeleton_vertices = 0;      ///< Fine vertices on all skins, and of layers; exact.
  std::vector<GlobalIndex>
      seam_triangles{};           ///< Shape (num_subdomains). Fine triangles between the
                                  ///< subdomain and others, where seams are improved.
  bool are_counts_exact = false;  ///< What pieces hold is known before they are filled.
  bool is_one_pass = false;       ///< Then fill jobs may write the files themselves, and do.
  std::vector<subdomain::SubdomainRange> jobs{};   ///< What each fill job makes.
  std::vector<subdomain::SubdomainRange> files{};  ///< What each file holds.
  bool improves_seams = false;
  bool has_files = true;   ///< False: finished pieces are handed over instead.
  bool is_curved = false;  ///< Tets of second order.

  /// @brief Whether pieces are split after they were filled, or get nodes of second order.
  [[nodiscard]] bool splits_pieces() const { return fill_levels < levels || is_curved; }

  /// @brief Whether ranks turn the pieces of the store into files.
  [[nodiscard]] bool writes_from_store() const
  {
    return has_files && !is_one_pass && !splits_pieces();
  }

  /// @brief Tets that a filled piece has for one that the mesh will have.
  [[nodiscard]] double filled_share() const { return std::ldexp(1.0, 3 * (fill_levels - levels)); }

  [[nodiscard]] GlobalIndex tets_of(const subdomain::SubdomainRange& range) const;
  [[nodiscard]] GlobalIndex boundary_triangles_of(const subdomain::SubdomainRange& range) const;
};

/// @brief How many of the levels are left for pieces to be split after they were filled. Where all
/// is subdivided that is none.
[[nodiscard]] int splits_after_fill(const fill::FillOptions& options,
                                    const std::vector<fill::KernelKind>& kernels, int levels);

/// @brief The outline of a run. Local; O(coarse tets).
/// @param[in] cut With the levels on which pieces are filled.
/// @param[in] files output.files, or those asked for; see output_ranges().
[[nodiscard]] RunOutline outline_run(const subdomain::PartitionedMesh& cut,
                                     const std::vector<fill::KernelKind>& kernels,
                                     const std::vector<subdomain::SubdomainRange>& files,
                                     const PieceChoices& choices);

/// @brief What to say if a file would hold more than its 32-bit indices reach: the first such file
/// and the key to change. Local.
[[nodiscard]] std::optional<std::string> file_too_large(const RunOutline& outline,
                                                        const config::Case& run_case);

}  // namespace tessera::pipeline
