// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/store/piece_surfaces.hpp"

#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/subdomain/piece_surface.hpp"

#include "pipeline/store/fill_record.hpp"

namespace tessera::pipeline {
namespace {

std::string list_name(LocalIndex subdomain) { return fmt::format("surface_{:06}", subdomain); }
std::string shared_name(LocalIndex subdomain) { return fmt::format("halo_{:06}", subdomain); }

// What a piece lets its neighbours know: two segments of its record.
enum SharedSegment : LocalIndex { kSurface, kHalo };

number::SurfaceList find_list(const io::RecordStore& store, LocalIndex subdomain)
{
  return from_bytes<number::SurfaceList>(store.get(list_name(subdomain)));
}

number::SharedSurface find_shared(const io::RecordStore& store, LocalIndex subdomain)
{
  return from_bytes<number::SharedSurface>(store.get(shared_name(subdomain), kSurface));
}

mesh::Piece find_halo(const io::RecordStore& store, LocalIndex subdomain)
{
  return from_bytes<mesh::Piece>(store.get(shared_name(subdomain), kHalo));
}

}  // namespace

PieceSurfaces::PieceSurfaces(PieceStore pieces, const subdomain::PartitionedMesh& cut,
                             const subdomain::LayerTables* layers)
    : store_(store_folder(pieces.folder)),
      cut_(cut),
      pieces_(std::move(pieces)),
      neighbours_(mesh::neighbours_by_vertex(cut.skeleton)),
      layers_(layers)
{
  if (layers == nullptr || !layers->has_joints()) return;
  const FlatArray<LocalIndex>& vertices = cut.skeleton.triangle_vertices;
  triangles_at_ = rows_by_key({vertices.begin(), vertices.end()}, cut.skeleton.num_vertices(), 3);
}

// Those whose tets columns of the piece may end at. There, too, tets may have been exchanged.
std::vector<LocalIndex> PieceSurfaces::beyond_joints(LocalIndex subdomain) const
{
  const mesh::Skeleton& skeleton = cut_.skeleton;
  std::vector<LocalIndex> beyond;
  for (const LocalIndex v : layers_->vertices_of_ends(subdomain)) {
    for (const LocalIndex t : triangles_at_[v]) {
      for (const LocalIndex other : std::span(skeleton.triangle_subdomains).subspan(2 * at(t), 2)) {
        if (other != kNoIndex) beyond.push_back(other);
      }
    }
  }
  sort_unique(beyond);
  const std::vector<LocalIndex> there = beyond;
  for (const LocalIndex other : there) {
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
  const number::SharedSurface shared = number::compare_surfaces(own, others);
  store_.put(shared_name(subdomain),
             std::vector{to_bytes(shared), to_bytes(subdomain::halo_of(whole, own, shared))});
  return subdomain::count_split_piece(whole, own, shared, split, layers_);
}

subdomain::PieceSurroundings PieceSurfaces::surroundings(LocalIndex subdomain,
                                                         const subdomain::PieceSplit& split) const
{
  subdomain::PieceSurroundings around{.surface = find_list(store_, subdomain)};
  around.shared = find_shared(store_, subdomain);
  std::vector<number::OwnedSurface> owners{{subdomain, around.shared.owned}};
  for (const LocalIndex other : neighbours_[at(subdomain)]) {
    const bool is_of_own_body = body_of(other) == around.surface.material;
    if (other > subdomain && !is_of_own_body) continue;
    if (other < subdomain) owners.push_back({other, find_shared(store_, other).owned});
    if (is_of_own_body && !split.is_curved)  // Nothing moves beside curved tets.
      around.halos.push_back(subdomain::halo_beside(find_halo(store_, other), around.surface));
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
    owners.push_back({other, find_shared(store_, other).owned});
  }
  around.ends = number::find_places(
      subdomain::ends_across_joints(around.surface.simplices, *layers_), owners, n);
}

}  // namespace tessera::pipeline
