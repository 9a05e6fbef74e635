// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <tuple>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::check {

/// @brief Two components of pieces that are joined across pieces.
struct Link {
  GlobalIndex first = 0;  ///< As of component_name.
  GlobalIndex second = 0;

  static auto fields(auto& self) { return std::tie(self.first, self.second); }

  friend auto operator<=>(const Link&, const Link&) = default;
};

/// @brief One number for a component of a piece.
[[nodiscard]] constexpr GlobalIndex component_name(LocalIndex piece, LocalIndex component)
{
  return static_cast<GlobalIndex>(piece) << 32 | component;
}

/// @brief Brings links into order and drops repeated ones, with their memory.
void sort_unique(std::vector<Link>& links);

/// @brief Number of components after all links are drawn.
/// @note Collective; every rank holds the different links of all ranks for a moment.
/// @param[in] num_local_components Of the pieces of this rank.
[[nodiscard]] GlobalIndex count_components(GlobalIndex num_local_components,
                                           std::vector<Link> links, const comm::Communicator& comm);

}  // namespace tessera::check
