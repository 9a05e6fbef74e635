// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/seam_regions.hpp"

#include <algorithm>
#include <cstddef>
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
                                            const mesh::HostLayout& hosts,
                                            const mesh::Decomposition& decomposition)
{
  std::vector<HostSubdomain> holders;
  holders.reserve(14 * at(skeleton.num_triangles()));
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    for (std::size_t side = 0; side < 2; ++side) {
      const LocalIndex subdomain = skeleton.triangle_subdomains[2 * at(t) + side];
      if (subdomain == kNoIndex) continue;
      const LocalIndex material = decomposition.subdomain_material[at(subdomain)];
      holders.push_back({hosts.triangle(t), material, subdomain});
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t corner = 3 * at(t) + c;
        holders.push_back({hosts.edge(skeleton.triangle_edges[corner]), material, subdomain});
        holders.push_back({hosts.vertex(skeleton.triangle_vertices[corner]), material, subdomain});
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

// By host of the skeleton, ascending.
IndexLists subdomains_of_hosts(const std::vector<HostSubdomain>& holders,
                               const mesh::HostLayout& hosts)
{
  IndexLists lists;
  auto next = holders.begin();
  for (mesh::HostEntity host = 0; host < hosts.num_on_skeleton(); ++host) {
    const auto first = lists.values.size();
    for (; next != holders.end() && next->host == host; ++next) {
      lists.values.push_back(next->subdomain);
    }
    std::sort(lists.values.begin() + static_cast<std::ptrdiff_t>(first), lists.values.end());
    lists.end_list();
  }
  return lists;
}

int phase_of_host(const mesh::HostLayout& hosts, mesh::HostEntity host)
{
  const mesh::HostKind kind = hosts.kind_of(host);
  return kind == mesh::HostKind::triangle ? 0 : kind == mesh::HostKind::edge ? 1 : 2;
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
    : hosts_(skeleton)
{
  std::map<Subdomains, SeamSet> sets;
  const std::vector<HostSubdomain> holders = holders_of_hosts(skeleton, hosts_, decomposition);
  const std::vector<SeamHost> found = seam_hosts(holders, hosts_, sets);
  host_subdomains_ = subdomains_of_hosts(holders, hosts_);

  for (int phase = 0; phase < kNumPhases; ++phase) {
    for (auto& [subdomains, set] : sets) {
      if (set.phase != phase) continue;
      set.region = region_subdomains_.num_lists();
      region_subdomains_.add(subdomains);
    }
    phase_offsets_[static_cast<std::size_t>(phase) + 1] = region_subdomains_.num_lists();
  }
  subdomain_regions_ = inverted(region_subdomains_, decomposition.num_subdomains());

  auto next = found.begin();
  for (mesh::HostEntity host = 0; host < hosts_.num_on_skeleton(); ++host) {
    for (; next != found.end() && next->host == host; ++next) {
      host_regions_.values.push_back({next->material, next->set->second.region});
    }
    host_regions_.end_list();
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
  if (host >= hosts_.num_on_skeleton()) return kNoIndex;
  const auto regions = host_regions_[host];
  const auto found = std::ranges::find(regions, material, &HostRegion::material);
  return found == regions.end() ? kNoIndex : found->region;
}

bool SeamRegions::may_be_on_seam(mesh::HostEntity host) const
{
  return host >= hosts_.num_on_skeleton() || !host_regions_[host].empty();
}

std::span<const LocalIndex> SeamRegions::holders_of(mesh::HostEntity host) const
{
  const LocalIndex region = region_made(host);
  return region == kNoIndex ? host_subdomains_[host] : subdomains_of(region);
}

std::span<const LocalIndex> SeamRegions::regions_of(LocalIndex subdomain, int phase) const
{
  const auto regions = subdomain_regions_[subdomain];
  const auto low = std::ranges::lower_bound(regions, first_of_phase(phase));
  const auto high = std::lower_bound(low, regions.end(), first_of_phase(phase + 1));
  return {low, high};
}

std::vector<char> vertices_perhaps_on_seams(const mesh::Piece& piece, const SeamRegions& regions)
{
  std::vector<char> may_be;
  may_be.reserve(piece.skin_host.size());
  for (const mesh::HostEntity host : piece.skin_host) {
    may_be.push_back(regions.may_be_on_seam(host) ? 1 : 0);
  }
  return may_be;
}

}  // namespace tessera::improve
