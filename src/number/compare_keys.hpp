// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"

namespace tessera::number {

// The keys that one neighbour lists; ascending.
template <class Key>
struct NeighbourKeys {
  LocalIndex subdomain;
  LocalIndex material;
  const std::vector<Key>& keys;
};

// Compares a piece's ascending keys with those of its neighbours. `owned` gets those that no lower
// piece lists; returns for each key whether two pieces of one material list it.
template <class Key>
std::vector<char> compare_keys(const NeighbourKeys<Key>& own,
                               const std::vector<NeighbourKeys<Key>>& neighbours,
                               std::vector<Key>& owned)
{
  const std::size_t num_keys = own.keys.size();
  std::vector<char> on_seam(num_keys, 0);
  std::vector<char> is_owned(num_keys, 1);
  // Two materials beside the piece's own may have a seam that ends at one of its keys.
  std::vector<std::vector<LocalIndex>> materials(num_keys);
  for (const NeighbourKeys<Key>& other : neighbours) {
    auto next = other.keys.begin();
    for (std::size_t k = 0; k < num_keys; ++k) {
      while (next != other.keys.end() && *next < own.keys[k]) ++next;
      if (next == other.keys.end()) break;
      if (*next != own.keys[k]) continue;
      if (other.subdomain < own.subdomain) is_owned[k] = 0;
      const bool is_known =
          other.material == own.material
          || std::ranges::find(materials[k], other.material) != materials[k].end();
      if (is_known) on_seam[k] = 1;
      materials[k].push_back(other.material);
    }
  }
  for (std::size_t k = 0; k < num_keys; ++k) {
    if (is_owned[k] != 0) owned.push_back(own.keys[k]);
  }
  return on_seam;
}

}  // namespace tessera::number
