// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>

#include "tessera/base/types.hpp"
#include "tessera/decompose/graph_partitioner.hpp"
#include "tessera/decompose/options.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/decomposition.hpp"

namespace tessera::decompose {

/// @brief "auto" asks for at least this many subdomains a part of the output. Parts are made of
/// whole subdomains, and 16 of them can be shared out to within some per cent.
inline constexpr LocalIndex kAutoSubdomainsAPart = 16;

/// @brief What the decomposition was asked for and what it became. A *seam* triangle lies between
/// two subdomains of one material.
struct DecomposeReport {
  /// After "auto"; at least one a connected piece of a material, at most one a coarse tet.
  LocalIndex num_wanted = 0;
  LocalIndex num_subdomains = 0;         ///< What it became; >= num_wanted.
  LocalIndex num_moves = 0;              ///< Repair moves of one tet that were accepted.
  LocalIndex num_splits = 0;             ///< Subdomains cut in two because no move helped.
  LocalIndex num_merges = 0;             ///< Small subdomains that a neighbour could take up again.
  double seam_area = 0.0;                ///< Output length unit squared.
  double min_seam_dihedral_deg = 180.0;  ///< Smallest angle, inside a subdomain, between a seam
                                         ///< triangle and the next skin triangle; 180: no seam.
  double mean_weight = 0.0;              ///< Predicted fine tets a subdomain.
  double max_weight = 0.0;               ///< Of the heaviest subdomain.

  static auto fields(auto& self)
  {
    return std::tie(self.num_wanted, self.num_subdomains, self.num_moves, self.num_splits,
                    self.num_merges, self.seam_area, self.min_seam_dihedral_deg, self.mean_weight,
                    self.max_weight);
  }
};

/// @brief The subdomains, and how they came about.
struct DecomposeResult {
  mesh::Decomposition decomposition{};
  DecomposeReport report{};

  static auto fields(auto& self) { return std::tie(self.decomposition, self.report); }
};

/// @brief Cuts a coarse mesh into subdomains that a volume mesher can fill one by one.
///
/// Afterwards every subdomain is not empty, face-connected and of one material. Its skin is one
/// closed surface: no edge has four triangles, and nowhere does the surface touch itself at a
/// vertex. So a subdomain encloses neither another one nor a void of the model. validate() checks
/// all of it.
/// @note Local; the same bits for the same arguments. About linear in the number of tets.
/// @param[in] tet_weight Shape (num_tets), > 0: predicted fine tets of each coarse tet.
/// @param[in] tet_part Shape (num_tets), >= 0: parts of which subdomains are made, at least one
/// each; repair may move single tets, and small bits, between them. Empty: there are none.
/// @throws ConfigError if a negative number of subdomains is requested.
/// @throws MeshError if tet_weight or tet_part has a wrong length or the partitioner gives invalid
/// parts.
[[nodiscard]] DecomposeResult decompose(const mesh::CoarseMesh& mesh,
                                        const DecomposeOptions& options,
                                        std::span<const double> tet_weight,
                                        const GraphPartitioner& partitioner,
                                        std::span<const LocalIndex> tet_part = {});

/// @brief Throws MeshError, naming subdomain and vertex, unless the decomposition keeps every
/// promise of decompose() and its graph is the symmetric one of the shared triangles. Local.
void validate(const mesh::CoarseMesh& mesh, const mesh::Decomposition& decomposition);

}  // namespace tessera::decompose
