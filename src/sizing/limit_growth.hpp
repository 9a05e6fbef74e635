// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

namespace tessera::sizing {

/// @brief Lowers values so that between neighbours none grows faster than `growth` per length:
/// shortest paths from all points at once, from the least value on.
/// @param[in] for_each_neighbour Called with a point and a function that takes a neighbour and the
/// distance to it.
template <class ForEachNeighbour>
void limit_growth(double growth, const ForEachNeighbour& for_each_neighbour,
                  std::span<double> values)
{
  using Entry = std::pair<double, std::size_t>;
  std::vector<Entry> first;  // Others lower nobody, unless they are lowered themselves.
  for (std::size_t point = 0; point < values.size(); ++point) {
    bool is_too_steep = false;
    for_each_neighbour(point, [&](std::size_t neighbour, double distance) {
      is_too_steep = is_too_steep || values[point] + growth * distance < values[neighbour];
    });
    if (is_too_steep) first.emplace_back(values[point], point);
  }
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue(std::greater<>(),
                                                                       std::move(first));
  while (!queue.empty()) {
    const auto [value, point] = queue.top();
    queue.pop();
    if (value > values[point]) continue;
    for_each_neighbour(point, [&, from = value](std::size_t neighbour, double distance) {
      const double limit = from + growth * distance;
      if (limit >= values[neighbour]) return;
      values[neighbour] = limit;
      queue.emplace(limit, neighbour);
    });
  }
}

}  // namespace tessera::sizing
