// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/region_band.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <utility>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::improve {
namespace {

// A set of regions: bit i is row `first + i` of the regions of a piece.
using RegionSet = std::uint64_t;

constexpr std::size_t kMostAtOnce = 64;

RegionSet only(std::size_t row) { return RegionSet{1} << row; }

void for_each_of(RegionSet set, const auto& use)
{
  for (; set != 0; set &= set - 1) use(static_cast<std::size_t>(std::countr_zero(set)));
}

bool share_two_subdomains(std::span<const LocalIndex> a, std::span<const LocalIndex> b)
{
  return std::ranges::count_if(a, [&](LocalIndex s) { return std::ranges::binary_search(b, s); })
         > 1;
}

// Makes the bands of up to 64 regions.
class BandMaker {
 public:
  BandMaker(const PiecePart& part, std::span<const LocalIndex> labels, const SeamRegions& regions,
            std::span<const LocalIndex> wanted)
      : part_(part), piece_(part.piece), regions_(regions), wanted_(wanted), bands_(wanted.size())
  {
    find_tets(labels);
  }

  std::vector<Band> run() &&
  {
    find_vertices();
    find_outside();
    for (std::size_t row = 0; row < bands_.size(); ++row) finish(row);
    return std::move(bands_);
  }

 private:
  [[nodiscard]] const LocalIndex* tet(LocalIndex t) const
  {
    return &piece_.tet_vertices[4 * at(t)];
  }

  void find_tets(std::span<const LocalIndex> labels)
  {
    own_.assign(at(piece_.num_tets()), 0);
    for (LocalIndex t = 0; t < piece_.num_tets(); ++t) {
      const auto found = std::ranges::lower_bound(wanted_, labels[at(t)]);
      if (found == wanted_.end() || *found != labels[at(t)]) continue;
      const auto row = static_cast<std::size_t>(found - wanted_.begin());
      own_[at(t)] = only(row);
      auto& tets = bands_[row].tet_vertices;
      tets.insert(tets.end(), tet(t), tet(t) + 4);
    }
  }

  // Those of the tets, and those near the region that another piece of the region may hold.
  void find_vertices()
  {
    known_.assign(at(piece_.num_vertices()), 0);
    std::vector<RegionSet> near(at(piece_.num_skin_vertices()), 0);
    near.resize(at(piece_.num_vertices()), 0);
    std::map<LocalIndex, RegionSet> shared_with;  // By region: that meet it in two subdomains.
    std::vector<RegionSet> shared(at(piece_.num_skin_vertices()), 0);
    for (LocalIndex v = 0; v < piece_.num_skin_vertices(); ++v) {
      const LocalIndex region = regions_.region_of(piece_.skin_host[at(v)], piece_.material);
      const LocalIndex holders =
          region == kNoIndex ? regions_.region_made(piece_.skin_host[at(v)]) : region;
      if (holders == kNoIndex) continue;
      const auto [known, is_new] = shared_with.try_emplace(holders, 0);
      if (is_new) known->second = regions_beside(holders);
      shared[at(v)] = known->second;
      const auto row = std::ranges::lower_bound(wanted_, region);
      if (row != wanted_.end() && *row == region) {
        near[at(v)] = only(static_cast<std::size_t>(row - wanted_.begin()));
      }
    }
    spread(near);
    for (std::size_t v = 0; v < shared.size(); ++v) known_[v] = near[v] & shared[v];
    for (LocalIndex t = 0; t < piece_.num_tets(); ++t) {
      for (std::size_t c = 0; c < 4; ++c) known_[at(tet(t)[c])] |= own_[at(t)];
    }
  }

  [[nodiscard]] RegionSet regions_beside(LocalIndex region) const
  {
    RegionSet set = 0;
    for (std::size_t row = 0; row < wanted_.size(); ++row) {
      if (share_two_subdomains(regions_.subdomains_of(wanted_[row]),
                               regions_.subdomains_of(region))) {
        set |= only(row);
      }
    }
    return set;
  }

  void spread(std::vector<RegionSet>& near) const
  {
    std::vector<RegionSet> next;
    for (int layer = 0; layer < kSharedLayers; ++layer) {
      next = near;
      for (LocalIndex t = 0; t < piece_.num_tets(); ++t) {
        const LocalIndex* v = tet(t);
        const RegionSet all = near[at(v[0])] | near[at(v[1])] | near[at(v[2])] | near[at(v[3])];
        if (all == 0) continue;
        for (std::size_t c = 0; c < 4; ++c) next[at(v[c])] |= all;
      }
      near.swap(next);
    }
  }

  void find_outside()
  {
    for (LocalIndex t = 0; t < piece_.num_tets(); ++t) {
      const LocalIndex* v = tet(t);
      for (const auto& [a, b, c] : mesh::kTetFaceCorners) {
        const RegionSet around = known_[at(v[a])] & known_[at(v[b])] & known_[at(v[c])];
        const std::array triangle{v[a], v[b], v[c]};
        for_each_of(around & ~own_[at(t)], [&](std::size_t row) {
          auto& triangles = bands_[row].outside_triangles;
          triangles.insert(triangles.end(), triangle.begin(), triangle.end());
        });
      }
    }
  }

  // Gives the vertices of a band its own numbers.
  void finish(std::size_t row)
  {
    Band& band = bands_[row];
    number_.resize(at(piece_.num_vertices()));
    for (LocalIndex v = 0; v < piece_.num_vertices(); ++v) {
      if ((known_[at(v)] & only(row)) == 0) continue;
      number_[at(v)] = band.num_vertices();
      band.vertex_tag.push_back(part_.vertex_tag[at(v)]);
      const double* xyz = &piece_.vertex_xyz[3 * at(v)];
      band.vertex_xyz.insert(band.vertex_xyz.end(), xyz, xyz + 3);
      if (v >= piece_.num_skin_vertices()) continue;
      band.skin_host.push_back(piece_.skin_host[at(v)]);
      band.skin_index.push_back(piece_.skin_index[at(v)]);
    }
    for (LocalIndex& v : band.tet_vertices) v = number_[at(v)];
    for (LocalIndex& v : band.outside_triangles) v = number_[at(v)];
  }

  const PiecePart& part_;
  const mesh::Piece& piece_;
  const SeamRegions& regions_;
  std::span<const LocalIndex> wanted_;
  std::vector<Band> bands_;           // Until finish() in the part's numbers.
  std::vector<RegionSet> own_{};      // By tet: the region of its label.
  std::vector<RegionSet> known_{};    // By vertex: the bands that have it.
  std::vector<LocalIndex> number_{};  // In the band at hand.
};

}  // namespace

std::vector<Band> make_bands(const PiecePart& part, std::span<const LocalIndex> labels,
                             const SeamRegions& regions, int phase)
{
  const auto all = regions.regions_of(part.piece.subdomain, phase);
  std::vector<Band> bands;
  for (std::size_t first = 0; first < all.size(); first += kMostAtOnce) {
    const auto some = all.subspan(first, std::min(kMostAtOnce, all.size() - first));
    std::ranges::move(BandMaker(part, labels, regions, some).run(), std::back_inserter(bands));
  }
  return bands;
}

IndexLists tets_of_bands(const PiecePart& part, std::span<const LocalIndex> labels,
                         const SeamRegions& regions, int phase)
{
  const auto all = regions.regions_of(part.piece.subdomain, phase);
  std::vector<LocalIndex> row_of_tet;
  for (const LocalIndex label : labels) {
    const auto found = std::ranges::lower_bound(all, label);
    const bool is_there = found != all.end() && *found == label;
    row_of_tet.push_back(is_there ? static_cast<LocalIndex>(found - all.begin()) : kNoIndex);
  }
  IndexLists tets = rows_by_key(row_of_tet, static_cast<LocalIndex>(all.size()));
  for (LocalIndex& t : tets.values) t = part.tet_tag[at(t)];
  return tets;
}

}  // namespace tessera::improve
