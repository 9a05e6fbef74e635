// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/predict/choose_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace tessera::pipeline {
namespace {

constexpr double kShare = 0.2;
constexpr double kLeastBudget_s = 5.0;
constexpr double kMostBudget_s = 20.0;
constexpr std::size_t kLeastSamples = 3;

// Places in the list sorted by cost, as eighths of its length.
constexpr std::array<std::size_t, 8> kEighths{0, 4, 6, 2, 1, 3, 5, 7};

std::vector<std::size_t> largest_first(const std::vector<double>& cost_s)
{
  std::vector<std::size_t> order(cost_s.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cost_s[a] > cost_s[b]; });
  return order;
}

// In the order in which they are wanted. Lists of eight and more have eight different places.
std::vector<std::size_t> candidates(const std::vector<double>& cost_s)
{
  const std::vector<std::size_t> order = largest_first(cost_s);
  std::vector<std::size_t> wanted;
  for (const std::size_t eighth : kEighths) {
    if (order.empty()) break;
    const std::size_t job = order[eighth * order.size() / kEighths.size()];
    if (std::find(wanted.begin(), wanted.end(), job) == wanted.end()) wanted.push_back(job);
  }
  return wanted;
}

}  // namespace

SampleChoice choose_samples(const std::vector<double>& cost_s, int levels)
{
  const std::vector<std::size_t> wanted = candidates(cost_s);
  std::size_t least = std::min(kLeastSamples, wanted.size());
  const std::size_t most = std::min(wanted.size(), std::max(least, cost_s.size() / 2));
  const double all_s = std::accumulate(cost_s.begin(), cost_s.end(), 0.0);
  const double budget_s = std::clamp(kShare * all_s, kLeastBudget_s, kMostBudget_s);

  SampleChoice choice{levels, {}};
  double spent_s = 0.0;
  for (std::size_t i = 0; i < least; ++i) spent_s += cost_s[wanted[i]];
  // Two jobs in full tell more than three coarser ones: pieces with fewer levels are mostly skin.
  if (least == kLeastSamples && spent_s > budget_s
      && spent_s - cost_s[wanted[2]] <= kMostBudget_s) {
    return {levels, {wanted[0], wanted[1]}};
  }
  for (; choice.levels > 0 && spent_s > budget_s; --choice.levels) spent_s /= 8.0;
  choice.jobs.assign(wanted.begin(), wanted.begin() + static_cast<std::ptrdiff_t>(least));
  for (std::size_t i = least; i < most; ++i) {
    spent_s += std::ldexp(cost_s[wanted[i]], -3 * (levels - choice.levels));
    if (spent_s > budget_s) break;
    choice.jobs.push_back(wanted[i]);
  }
  return choice;
}

}  // namespace tessera::pipeline
