// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/periodic_pairs.hpp"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::mesh {
namespace {

Affine affine_of(const std::string& text)
{
  std::istringstream in(text);
  Affine there;
  for (std::size_t i = 0; i < 3; ++i) {
    for (double& number : there.rows[i]) in >> number;
    in >> there.shift[i];
  }
  std::string rest;
  if (!in || in >> rest) {
    throw InputError(fmt::format("\"{}\" is no matrix of 3 x 4 numbers", text));
  }
  return there;
}

}  // namespace

std::vector<LocalIndex> transforms_of(std::span<const PeriodicPair> pairs)
{
  std::vector<LocalIndex> transforms;
  LocalIndex next = 0;
  for (const PeriodicPair& pair : pairs) {
    const auto first = std::ranges::find(pairs, pair.there, &PeriodicPair::there) - pairs.begin();
    const bool is_known = first < std::ssize(transforms);
    transforms.push_back(is_known ? transforms[static_cast<std::size_t>(first)] : next++);
  }
  return transforms;
}

std::string name_of_partners(LocalIndex transform)
{
  return fmt::format("{}{}", kPeriodicPartnerName, transform + 1);
}

std::array<double, 12> matrix_of(const Affine& there)
{
  std::array<double, 12> matrix{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::ranges::copy(there.rows[i], matrix.begin() + static_cast<std::ptrdiff_t>(4 * i));
    matrix[4 * i + 3] = there.shift[i];
  }
  return matrix;
}

std::vector<std::string> to_texts(std::span<const PeriodicPair> pairs)
{
  std::vector<std::string> texts;
  for (const PeriodicPair& pair : pairs) {
    const auto matrix = matrix_of(pair.there);
    texts.insert(texts.end(), {pair.from, pair.to, fmt::format("{}", fmt::join(matrix, " "))});
  }
  return texts;
}

std::vector<PeriodicPair> periodic_pairs(std::span<const std::string> texts)
{
  if (texts.size() % 3 != 0) {
    throw InputError(
        fmt::format("{} has {} texts; must be three a pair", kPeriodicPairsName, texts.size()));
  }
  std::vector<PeriodicPair> pairs;
  for (std::size_t i = 0; i < texts.size(); i += 3) {
    pairs.push_back({texts[i], texts[i + 1], affine_of(texts[i + 2])});
  }
  return pairs;
}

}  // namespace tessera::mesh
