// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/seam_regions.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace tessera::improve {
namespace {

using Subdomains = std::vector<LocalIndex>;

struct HostSubdomain {
  mesh::HostEntity host = 0;
  LocalIndex material = 0;
  LocalIndex subdomain = 0;

  friend auto operator<=>(const HostSubdomain&, const HostSubdomain&) = default;
};

// Which subdomains hold each host, in order. A subdomain holds a host if it has a skeleton triangle
// that does: its closure meets another one only in such triangles.
std::vector<HostSubdomain> holders_of_hosts(const mesh::Skeleton& skeleton,
                                            const mesh::Decomposition& decomposition)
{
  const mesh::HostLayout hosts(skeleton);
  std::vector<HostSubdomain> holders;
  holders.reserve(14 * at(skeleton.num_triangles()));
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    for (std::size_t side = 0; side < 2; ++side) {
      const LocalIndex subdomain = skeleton.triangle_subdomains[2 * at(t) + side];
      if (subdomain == kNoIndex) continue;
      const LocalIndex material = decomposition.subdomain_material[at(subdomain)];
      holders.push_back({hosts.first_triangle + t, material, subdomain});
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t corner = 3 * at(t) + c;
        holders.push_back(
            {hosts.first_edge + skeleton.triangle_edges[corner], material, subdomain});
        holders.push_back({skeleton.triangle_vertices[corner], material, subdomain});
      }
    }
  }
  std::sort(holders.begin(), holders.end());
  holders.erase(std::unique(holders.begin(), holders.end()), holders.end());
  return holders;
}

// A set of subdomains that meet, and where.
struct SeamSet {
  int phase = kNumPhases;
  LocalIndex region = kNoIndex;
};

struct SeamHost {
  mesh::HostEntity host = 0;
  LocalIndex material = 0;
  std::map<Subdomains, SeamSet>::iterator set{};
};

int phase_of_host(const mesh::HostLayout& hosts, mesh::HostEntity host)
{
  return host >= hosts.first_triangle ? 0 : host >= hosts.first_edge ? 1 : 2;
}

// The hosts that several subdomains of a material hold, by host and material; fills `sets`.
std::vector<SeamHost> seam_hosts(const std::vector<HostSubdomain>& holders,
                                 const mesh::HostLayout& hosts, std::map<Subdomains, SeamSet>& sets)
{
  std::vector<SeamHost> found;
  for (auto first = holders.begin(); first != holders.end();) {
    Subdomains subdomains;
    auto last = first;
    for (; last != holders.end() && last->host == first->host && last->material == first->material;
         ++last) {
      subdomains.push_back(last->subdomain);
    }
    if (subdomains.size() > 1) {
      const auto set = sets.try_emplace(std::move(subdomains)).first;
      set->second.phase = std::min(set->second.phase, phase_of_host(hosts, first->host));
      found.push_back({first->host, first->material, set});
    }
    first = last;
  }
  return found;
}

}  // namespace

SeamRegions::SeamRegions(const mesh::Skeleton& skeleton, const mesh::Decomposition& decomposition)
{
  const mesh::HostLayout hosts(skeleton);
  first_host_ = hosts.first_piece + decomposition.num_subdomains();
  std::map<Subdomains, SeamSet> sets;
  const std::vector<SeamHost> found =
      seam_hosts(holders_of_hosts(skeleton, decomposition), hosts, sets);

  region_offsets_.push_back(0);
  for (int phase = 0; phase < kNumPhases; ++phase) {
    for (auto& [subdomains, set] : sets) {
      if (set.phase != phase) continue;
      set.region = static_cast<LocalIndex>(region_offsets_.size()) - 1;
      region_subdomains_.insert(region_subdomains_.end(), subdomains.begin(), subdomains.end());
      region_offsets_.push_back(static_cast<LocalIndex>(region_subdomains_.size()));
    }
    phase_offsets_[static_cast<std::size_t>(phase) + 1] =
        static_cast<LocalIndex>(region_offsets_.size()) - 1;
  }

  host_offsets_.assign(at(hosts.first_piece) + 1, 0);
  for (const SeamHost& entry : found) {
    host_regions_.push_back({entry.material, entry.set->second.region});
    ++host_offsets_[at(entry.host) + 1];
  }
  for (std::size_t u = 1; u < host_offsets_.size(); ++u) host_offsets_[u] += host_offsets_[u - 1];
  list_subdomain_regions(decomposition.num_subdomains());
}

void SeamRegions::list_subdomain_regions(LocalIndex num_subdomains)
{
  subdomain_offsets_.assign(at(num_subdomains) + 1, 0);
  for (const LocalIndex s : region_subdomains_) ++subdomain_offsets_[at(s) + 1];
  for (std::size_t s = 1; s < subdomain_offsets_.size(); ++s) {
    subdomain_offsets_[s] += subdomain_offsets_[s - 1];
  }
  std::vector<LocalIndex> next(subdomain_offsets_.begin(), subdomain_offsets_.end() - 1);
  subdomain_regions_.resize(region_subdomains_.size());
  for (LocalIndex region = 0; region < num_regions(); ++region) {
    for (const LocalIndex s : subdomains_of(region)) {
      subdomain_regions_[at(next[at(s)]++)] = region;
    }
  }
}

int SeamRegions::phase_of(LocalIndex region) const
{
  int phase = 0;
  while (region >= phase_offsets_[static_cast<std::size_t>(phase) + 1]) ++phase;
  return phase;
}

LocalIndex SeamRegions::region_of(mesh::HostEntity host, LocalIndex material) const
{
  if (at(host) + 1 >= host_offsets_.size()) return kNoIndex;
  for (LocalIndex i = host_offsets_[at(host)]; i < host_offsets_[at(host) + 1]; ++i) {
    if (host_regions_[at(i)].material == material) return host_regions_[at(i)].region;
  }
  return kNoIndex;
}

std::span<const LocalIndex> SeamRegions::subdomains_of(LocalIndex region) const
{
  const std::size_t first = at(region_offsets_[at(region)]);
  return std::span(region_subdomains_).subspan(first, at(region_offsets_[at(region) + 1]) - first);
}

std::span<const LocalIndex> SeamRegions::regions_of(LocalIndex subdomain, int phase) const
{
  const auto first = subdomain_regions_.begin() + subdomain_offsets_[at(subdomain)];
  const auto last = subdomain_regions_.begin() + subdomain_offsets_[at(subdomain) + 1];
  const auto low = std::lower_bound(first, last, first_of_phase(phase));
  const auto high = std::lower_bound(low, last, first_of_phase(phase + 1));
  return {low, high};
}

}  // namespace tessera::improve
