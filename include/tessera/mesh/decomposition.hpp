// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "tessera/base/flat_array.hpp"
#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief Which subdomain each coarse tet belongs to, and the weighted graph of the subdomains.
///
/// Subdomains are numbered hierarchically: neighbours in space have neighbouring numbers, so any
/// contiguous range of them is a fair part of the mesh. Symmetric graph in CSR form.
struct Decomposition {
  FlatArray<LocalIndex> tet_subdomain{};         ///< Shape (num_tets).
  std::vector<LocalIndex> subdomain_material{};  ///< Shape (num_subdomains); from 1.
  std::vector<double> subdomain_weight{};        ///< Shape (num_subdomains); predicted fine tets.

  /// Shape (num_parts + 1): the parts of the output are ranges of subdomains. Empty: there are
  /// none.
  std::vector<LocalIndex> part_offsets{};

  std::vector<LocalIndex> neighbour_offsets{};  ///< Shape (num_subdomains + 1).
  std::vector<LocalIndex> neighbours{};  ///< Subdomains that share a coarse triangle, ascending.
  std::vector<LocalIndex> neighbour_triangles{};  ///< Coarse triangles shared with that neighbour.
  std::vector<double> neighbour_area{};           ///< Their area, output length unit squared.

  static auto fields(auto& self)
  {
    return std::tie(self.tet_subdomain, self.subdomain_material, self.subdomain_weight,
                    self.part_offsets, self.neighbour_offsets, self.neighbours,
                    self.neighbour_triangles, self.neighbour_area);
  }

  [[nodiscard]] LocalIndex num_subdomains() const
  {
    return static_cast<LocalIndex>(subdomain_material.size());
  }
};

}  // namespace tessera::mesh
