// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/box.hpp"
#include "tessera/decompose/graph_partitioner.hpp"

namespace tessera::decompose {
namespace {

constexpr int kDeepest = 21;  // Halvings of the root cube: three times as many bits fit a key.

// Octants are divided until they weigh no more than this part of what a part of the graph shall
// weigh. Measured on linkrods, shaft and packing with 8 and 64 parts: with 8 and with 256
// octants a part the heaviest part is heavier on average, and seams are as large.
constexpr std::int64_t kOctantsAPart = 32;

using Cell = std::array<std::uint32_t, 3>;

// Place of a cell along the Hilbert curve: @cite skilling2004, for three axes. Of the key, each
// three bits say in which eighth of a cube of the level before it is.
std::uint64_t hilbert_key(Cell cell)
{
  constexpr std::uint32_t kHalf = 1U << (kDeepest - 1);
  for (std::uint32_t bit = kHalf; bit > 1; bit >>= 1) {
    for (std::uint32_t& x : cell) {
      if ((x & bit) != 0) {
        cell[0] ^= bit - 1;
      } else {
        const std::uint32_t swapped = (cell[0] ^ x) & (bit - 1);
        cell[0] ^= swapped;
        x ^= swapped;
      }
    }
  }
  cell[1] ^= cell[0];
  cell[2] ^= cell[1];
  std::uint32_t turned = 0;
  for (std::uint32_t bit = kHalf; bit > 1; bit >>= 1) {
    if ((cell[2] & bit) != 0) turned ^= bit - 1;
  }
  std::uint64_t key = 0;
  for (int level = kDeepest - 1; level >= 0; --level) {
    for (const std::uint32_t x : cell) key = key << 1 | ((x ^ turned) >> level & 1U);
  }
  return key;
}

// Cells of the smallest cube around all places.
std::vector<std::uint64_t> hilbert_keys(const std::vector<Vec3>& places)
{
  constexpr double kNumCells = 1U << kDeepest;
  const Box box = bounding_box(places);
  const double size = std::ranges::max(box.extent());
  const double cells_a_unit = size > 0.0 ? kNumCells / size : 0.0;
  std::vector<std::uint64_t> keys;
  keys.reserve(places.size());
  for (const Vec3& place : places) {
    Cell cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double number = cells_a_unit * (place[axis] - box.low[axis]);
      cell[axis] = static_cast<std::uint32_t>(std::clamp(number, 0.0, kNumCells - 1.0));
    }
    keys.push_back(hilbert_key(cell));
  }
  return keys;
}

// The leaves of a graded octree in the order of the curve, each with the vertices in it.
class Octree {
 public:
  Octree(const Graph& graph, std::int64_t most)
      : weight_(graph.vertex_weight),
        most_(most),
        keys_(hilbert_keys(graph.place)),
        order_(keys_.size())
  {
    std::iota(order_.begin(), order_.end(), 0);
    std::ranges::sort(order_, {}, [this](LocalIndex v) { return std::pair(keys_[at(v)], v); });
  }

  template <class Visit>
  void for_each_leaf(const Visit& visit) const
  {
    visit_leaves(order_, kDeepest, visit);
  }

 private:
  // `level` halvings are left for the cube of these vertices.
  template <class Visit>
  void visit_leaves(std::span<const LocalIndex> vertices, int level, const Visit& visit) const
  {
    if (vertices.empty()) return;
    std::int64_t weight = 0;
    for (const LocalIndex v : vertices) weight += weight_[at(v)];
    if (level == 0 || vertices.size() == 1 || weight <= most_) return visit(vertices, weight);
    const auto eighth = [&](LocalIndex v) { return keys_[at(v)] >> 3 * (level - 1) & 7U; };
    auto begin = vertices.begin();
    for (std::uint64_t child = 0; child < 8; ++child) {
      const auto end = std::ranges::upper_bound(begin, vertices.end(), child, {}, eighth);
      visit_leaves({begin, end}, level - 1, visit);
      begin = end;
    }
  }

  const std::vector<std::int32_t>& weight_;
  std::int64_t most_;
  std::vector<std::uint64_t> keys_;
  std::vector<LocalIndex> order_;
};

class OctreePartitioner final : public GraphPartitioner {
 public:
  [[nodiscard]] bool needs_places() const override { return true; }

  // An octant is of the part in whose share of the whole weight its middle lies.
  [[nodiscard]] std::vector<LocalIndex> partition(const Graph& graph,
                                                  LocalIndex num_parts) const override
  {
    const auto total =
        std::accumulate(graph.vertex_weight.begin(), graph.vertex_weight.end(), std::int64_t{0});
    const Octree octree(graph, total / (kOctantsAPart * num_parts));
    std::vector<LocalIndex> part(at(graph.num_vertices()));
    std::int64_t before = 0;
    octree.for_each_leaf([&](std::span<const LocalIndex> vertices, std::int64_t weight) {
      const auto of_leaf = static_cast<LocalIndex>((2 * before + weight) * num_parts / (2 * total));
      for (const LocalIndex v : vertices) part[at(v)] = of_leaf;
      before += weight;
    });
    return part;
  }
};

}  // namespace

std::unique_ptr<GraphPartitioner> make_octree_partitioner()
{
  return std::make_unique<OctreePartitioner>();
}

}  // namespace tessera::decompose
