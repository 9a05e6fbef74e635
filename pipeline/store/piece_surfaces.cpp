// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/piece_surfaces.hpp"

#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/mesh/orbits.hpp"
#include "tessera/subdomain/piece_surface.hpp"

#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {
namespace {

std::string list_name(LocalIndex subdomain) { return fmt::format("surface_{:06}", subdomain); }
std::string shared_name(LocalIndex subdomain) { return fmt::format("halo_{:06}", subdomain); }

// What a piece lets its neighbours know.
struct SharedPart {
  number::SharedSurface surface{};
  mesh::Piece halo{};

  static auto fields(auto& self) { return std::tie(self.surface, self.halo); }
};

number::SurfaceList find_list(const io::RecordStore& store, LocalIndex subdomain)
{
  return from_bytes<number::SurfaceList>(store.get(list_name(subdomain)));
}

// By subdomain, those on the other side of its joints.
std::vector<std::vector<LocalIndex>> subdomains_across_joints(const subdomain::PartitionedMesh& cut)
{
  const mesh::Skeleton& skeleton = cut.skeleton;
  std::vector<std::vector<LocalIndex>> across(at(skeleton.num_subdomains()));
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    const LocalIndex patch = skeleton.triangle_patch[at(t)];
    if (patch == kNoIndex || !cut.coarse.images.is_joint(patch)) continue;
    const LocalIndex here = skeleton.triangle_owner(t);
    const LocalIndex there = skeleton.triangle_owner(skeleton.orbits.triangles.base_of(t));
    across[at(here)].push_back(there);
    across[at(there)].push_back(here);
  }
  for (std::vector<LocalIndex>& others : across) sort_unique(others);
  return across;
}

SharedPart find_shared(const io::RecordStore& store, LocalIndex subdomain)
{
  return from_bytes<SharedPart>(store.get(shared_name(subdomain)));
}

}  // namespace

PieceSurfaces::PieceSurfaces(PieceStore pieces, const subdomain::PartitionedMesh& cut,
                             const subdomain::LayerTables* layers)
    : store_(store_folder(pieces.folder)),
      cut_(cut),
      pieces_(std::move(pieces)),
      neighbours_(mesh::neighbours_by_vertex(cut.skeleton)),
      layers_(layers),
      across_(subdomains_across_joints(cut))
{
}

// Those whose tets columns of the piece may end at: beside a joint, tets may have been exchanged.
std::vector<LocalIndex> PieceSurfaces::beyond_joints(LocalIndex subdomain) const
{
  std::vector<LocalIndex> beyond;
  for (const LocalIndex other : across_[at(subdomain)]) {
    beyond.push_back(other);
    beyond.insert(beyond.end(), neighbours_[at(other)].begin(), neighbours_[at(other)].end());
  }
  sort_unique(beyond);
  return beyond;
}

LocalIndex PieceSurfaces::body_of(LocalIndex subdomain) const
{
  return cut_.coarse.body(cut_.decomposition.subdomain_material[at(subdomain)]);
}

void PieceSurfaces::keep_list(LocalIndex subdomain) const
{
  number::SurfaceList list = subdomain::surface_of(stored_piece(pieces_, subdomain));
  list.material = body_of(subdomain);
  store_.put(list_name(subdomain), to_bytes(list));
}

number::PieceCounts PieceSurfaces::compare(LocalIndex subdomain,
                                           const subdomain::PieceSplit& split) const
{
  const number::SurfaceList own = find_list(store_, subdomain);
  std::vector<number::SurfaceList> others;
  for (const LocalIndex other : neighbours_[at(subdomain)]) {
    others.push_back(find_list(store_, other));
  }
  const mesh::Piece whole = stored_piece(pieces_, subdomain);
  SharedPart part{.surface = number::compare_surfaces(own, others)};
  part.halo = subdomain::halo_of(whole, own, part.surface);
  store_.put(shared_name(subdomain), to_bytes(part));
  return subdomain::count_split_piece(whole, own, part.surface, split, layers_);
}

subdomain::PieceSurroundings PieceSurfaces::surroundings(LocalIndex subdomain,
                                                         const subdomain::PieceSplit& split) const
{
  subdomain::PieceSurroundings around{.surface = find_list(store_, subdomain)};
  around.shared = find_shared(store_, subdomain).surface;
  std::vector<number::OwnedSurface> owners{{subdomain, around.shared.owned}};
  for (const LocalIndex other : neighbours_[at(subdomain)]) {
    const bool is_of_own_body = body_of(other) == around.surface.material;
    if (other > subdomain && !is_of_own_body) continue;
    SharedPart part = find_shared(store_, other);
    if (other < subdomain) owners.push_back({other, std::move(part.surface.owned)});
    if (is_of_own_body && !split.is_curved)  // Nothing moves beside curved tets.
      around.halos.push_back(subdomain::halo_beside(part.halo, around.surface));
  }
  const LocalIndex n = mesh::lattice::intervals(split.levels);
  around.places = number::place_surface(around.surface.simplices, owners, n);
  if (layers_ != nullptr && layers_->has_joints()) place_ends(n, around);
  return around;
}

void PieceSurfaces::place_ends(LocalIndex n, subdomain::PieceSurroundings& around) const
{
  std::vector<number::OwnedSurface> owners;
  for (const LocalIndex other : beyond_joints(around.surface.subdomain)) {
    owners.push_back({other, find_shared(store_, other).surface.owned});
  }
  around.ends = number::find_places(
      subdomain::ends_across_joints(around.surface.simplices, *layers_), owners, n);
}

}  // namespace tessera::pipeline
