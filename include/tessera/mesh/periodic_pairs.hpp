// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tessera/base/affine.hpp"
#include "tessera/base/types.hpp"

namespace tessera::mesh {

/// @brief A patch whose points and triangles are the images of another one's, as files say it.
struct PeriodicPair {
  std::string from{};
  std::string to{};
  Affine there{};  ///< Lengths are the file's.

  friend bool operator==(const PeriodicPair&, const PeriodicPair&) = default;
};

/// @brief Name of the array of field data with the texts of to_texts().
inline constexpr const char* kPeriodicPairsName = "periodic_patches";

/// @brief How the names of point arrays of ids of partners begin; a number from 1 follows.
inline constexpr const char* kPeriodicPartnerName = "periodic_partner_";

/// @brief Of each pair its transform among the different ones, numbered from 0 as they first come:
/// patches of one [[periodic]] have one. Local.
[[nodiscard]] std::vector<LocalIndex> transforms_of(std::span<const PeriodicPair> pairs);

/// @brief Name of the point array with the ids of the points whose images others are, for such a
/// transform. Local.
[[nodiscard]] std::string name_of_partners(LocalIndex transform);

/// @brief The transform as a 3 x 4 matrix by rows, of which the last column is the shift. Local.
[[nodiscard]] std::array<double, 12> matrix_of(const Affine& there);

/// @brief Three texts a pair: both names, and matrix_of() its transform as numbers that read back
/// as the same. Local.
[[nodiscard]] std::vector<std::string> to_texts(std::span<const PeriodicPair> pairs);

/// @brief The other way round. Local. @throws InputError if the texts are none of to_texts().
[[nodiscard]] std::vector<PeriodicPair> periodic_pairs(std::span<const std::string> texts);

}  // namespace tessera::mesh
