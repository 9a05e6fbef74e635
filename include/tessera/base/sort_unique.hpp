// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

namespace tessera {

/// @brief Each value once, ascending.
template <class T>
void sort_unique(std::vector<T>& values)
{
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace tessera
