// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/periodic_partners.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/find_partners.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/mesh/periodic_pairs.hpp"
#include "tessera/mesh/side_places.hpp"

namespace tessera::subdomain {
namespace {

namespace fs = std::filesystem;

std::vector<mesh::PeriodicPair> pairs_of(const mesh::MeshArrays& boundary)
{
  const auto texts = boundary.field_texts.find(mesh::kPeriodicPairsName);
  if (texts == boundary.field_texts.end()) return {};
  return mesh::periodic_pairs(texts->second);
}

// An image, and the place at which it asks.
struct Image {
  LocalIndex transform = 0;
  LocalIndex point = 0;
  std::size_t asks_as = 0;
};

// The points of some files on periodic patches.
class PartnerFinder {
 public:
  // Files come in the order in which put() asks for them.
  void add(const mesh::MeshArrays& boundary)
  {
    images_.emplace_back();
    const std::vector<mesh::PeriodicPair> pairs = pairs_of(boundary);
    const std::vector<LocalIndex> transforms = mesh::transforms_of(pairs);
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      add_side(boundary, pairs[p].from, [&](LocalIndex point, const Vec3& place) {
        places_.push_back({.place = pairs[p].there(place),
                           .label = boundary.point_ids[at(point)],
                           .group = transforms[p]});
      });
      add_side(boundary, pairs[p].to, [&](LocalIndex point, const Vec3& place) {
        images_.back().push_back({transforms[p], point, places_.size()});
        places_.push_back({.place = place, .group = transforms[p], .is_image = true});
      });
    }
  }

  // Collective.
  void find(const comm::Communicator& comm) { partners_ = comm::find_partners(places_, comm); }

  // @return The number of images without one.
  GlobalIndex put(std::size_t file, mesh::MeshArrays& boundary) const
  {
    GlobalIndex num_missing = 0;
    for (const LocalIndex transform : mesh::transforms_of(pairs_of(boundary))) {
      boundary.point_longs[mesh::name_of_partners(transform)].assign(
          static_cast<std::size_t>(boundary.num_points()), comm::kNoPartner);
    }
    for (const Image& image : images_[file]) {
      const GlobalIndex partner = partners_[image.asks_as];
      boundary.point_longs[mesh::name_of_partners(image.transform)][at(image.point)] = partner;
      if (partner == comm::kNoPartner) ++num_missing;
    }
    return num_missing;
  }

 private:
  template <class Visit>
  static void add_side(const mesh::MeshArrays& boundary, const std::string& name,
                       const Visit& visit)
  {
    const auto texts = boundary.field_texts.find("patch_names");
    const auto patches = boundary.cell_ints.find("patch");
    if (texts == boundary.field_texts.end() || patches == boundary.cell_ints.end()) return;
    const std::vector<std::string>& names = texts->second;
    const std::vector<std::int32_t>& patch = patches->second;
    const auto width = static_cast<std::size_t>(boundary.vertices_per_cell);
    for (std::size_t t = 0; t < patch.size(); ++t) {
      if (at(patch[t]) >= names.size() || names[at(patch[t])] != name) continue;
      mesh::for_each_side_place(boundary.point_xyz,
                                std::span(boundary.cell_points).subspan(width * t, width), visit);
    }
  }

  std::vector<std::vector<Image>> images_{};  // By file.
  std::vector<comm::SidePoint> places_{};     // Their groups are transforms.
  std::vector<GlobalIndex> partners_{};       // Of places_.
};

}  // namespace

GlobalIndex add_periodic_partners(std::span<const fs::path> files, io::Compression compression,
                                  const comm::Communicator& comm,
                                  const std::function<void()>& before_each)
{
  std::vector<fs::path> own;
  for (auto f = static_cast<std::size_t>(comm.rank()); f < files.size(); f += at(comm.size())) {
    own.push_back(files[f]);
  }
  PartnerFinder finder;
  all_or_none(comm, [&] {
    for (const fs::path& file : own) {
      before_each();
      finder.add(io::read_vtu(file, io::CellOrder::up_to_second));
    }
  });
  finder.find(comm);
  GlobalIndex num_missing = 0;
  all_or_none(comm, [&] {
    for (std::size_t f = 0; f < own.size(); ++f) {
      before_each();
      mesh::MeshArrays boundary = io::read_vtu(own[f], io::CellOrder::up_to_second);
      if (pairs_of(boundary).empty()) continue;
      num_missing += finder.put(f, boundary);
      io::write_vtu(boundary, own[f], compression);
    }
  });
  return comm.sum(num_missing);
}

void name_periodic_partners(mesh::MeshArrays& schema)
{
  for (const LocalIndex transform : mesh::transforms_of(pairs_of(schema))) {
    schema.point_longs[mesh::name_of_partners(transform)];
  }
}

}  // namespace tessera::subdomain
