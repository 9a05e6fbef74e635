// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/layers/options.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

namespace tessera::layers {
namespace {

// Of `count` layers, the first one of height 1.
double height_of(int count, double growth)
{
  double sum = 0.0;
  double height = 1.0;
  for (int layer = 0; layer < count; ++layer, height *= growth) sum += height;
  return sum;
}

}  // namespace

std::string defect_of(const LayerOptions& options)
{
  if (options.count > 0 && options.thickness > 0.0) {
    return "must not have both count and thickness";
  }
  if (!is_complete(options)) return {};
  if (options.count == 0 && options.thickness < options.first) {
    return fmt::format("thickness = {:g} is less than first = {:g}; must be at least that",
                       options.thickness, options.first);
  }
  if (num_layers(options) > kMostLayers) {
    return fmt::format(
        "thickness = {:g} needs more than {} layers that begin with first = {:g} and "
        "grow by {:g}",
        options.thickness, kMostLayers, options.first, options.growth);
  }
  std::vector<double> ends = layer_ends(options);
  ends.insert(ends.begin(), 0.0);
  if (std::ranges::adjacent_find(ends, std::greater_equal()) == ends.end()) return {};
  return fmt::format("{} layers that grow by {:g} differ too much in height for numbers of 64 bits",
                     num_layers(options), options.growth);
}

bool is_complete(const LayerOptions& options)
{
  return options.count > 0 || options.thickness > 0.0;
}

double height_of_tets(double size)
{
  constexpr double kOfRegularTet = 0.816;  // By its edge.
  return kOfRegularTet * size;
}

int count_up_to(const LayerOptions& options, double size)
{
  const double wanted = height_of_tets(size) / options.growth;
  if (options.first >= wanted) return 1;
  if (options.growth == 1.0) return 0;
  const double count = 1.0 + std::log(wanted / options.first) / std::log(options.growth);
  return static_cast<int>(std::lround(std::min<double>(count, kMostLayers + 1)));
}

int num_layers(const LayerOptions& options)
{
  if (options.count > 0) return options.count;
  const double wanted = options.thickness / options.first;
  int count = 1;
  const auto is_nearer = [&](int next) {
    return std::abs(height_of(next, options.growth) - wanted)
           < std::abs(height_of(next - 1, options.growth) - wanted);
  };
  while (count <= kMostLayers && is_nearer(count + 1)) ++count;
  return count;
}

double thickness(const LayerOptions& options)
{
  return options.first * height_of(num_layers(options), options.growth);
}

double last_height(const LayerOptions& options)
{
  return options.first * std::pow(options.growth, num_layers(options) - 1);
}

std::vector<double> layer_ends(const LayerOptions& options)
{
  const int count = num_layers(options);
  const double all = height_of(count, options.growth);
  std::vector<double> ends;
  // The layer at the tets is the highest one.
  for (int left = count - 1; left >= 0; --left) {
    ends.push_back(1.0 - height_of(left, options.growth) / all);
  }
  return ends;
}

}  // namespace tessera::layers
