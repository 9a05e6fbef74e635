// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/region_mesh.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "improve/owner_set.hpp"

namespace tessera::improve {
namespace {

// A vertex that several pieces may hold, as one of them does.
struct SharedVertex {
  mesh::HostPoint name{};
  PieceVertex place{};

  friend bool operator<(const SharedVertex& a, const SharedVertex& b)
  {
    return a.name != b.name ? a.name < b.name : a.place.owner < b.place.owner;
  }
};

struct BoundaryFace {
  std::array<LocalIndex, 3> vertices{};  ///< Ascending.
  LocalIndex triangle = kNoIndex;

  friend bool operator<(const BoundaryFace& a, const BoundaryFace& b)
  {
    return a.vertices < b.vertices;
  }
};

class Extractor {
 public:
  explicit Extractor(std::span<const Band> bands) : bands_(bands) {}

  void run(RegionMesh& mesh)
  {
    mark_used();
    glue_shared();
    add_interior();
    add_tets(mesh);
    find_boundary(mesh);
    number_vertices(mesh);
    find_outside(mesh);
  }

 private:
  void mark_used()
  {
    for (const Band& band : bands_) {
      std::vector<char>& used = used_.emplace_back(at(band.num_vertices()), 0);
      for (const LocalIndex v : band.tet_vertices) used[at(v)] = 1;
      number_.emplace_back(at(band.num_vertices()), kNoIndex);
    }
  }

  // All pieces that hold a vertex of the region count, whether their tets of the region use it or
  // not.
  void glue_shared()
  {
    std::vector<SharedVertex> shared;
    for (std::size_t p = 0; p < bands_.size(); ++p) {
      for (LocalIndex v = 0; v < bands_[p].num_skin_vertices(); ++v) {
        shared.push_back({bands_[p].skin_point(v), {static_cast<LocalIndex>(p), v}});
      }
    }
    std::sort(shared.begin(), shared.end());
    for (auto first = shared.begin(); first != shared.end();) {
      const auto last = std::find_if(first, shared.end(),
                                     [&](const SharedVertex& v) { return v.name != first->name; });
      if (std::any_of(first, last, [&](const SharedVertex& v) { return is_used(v.place); })) {
        for (auto v = first; v != last; ++v) add_place(v->place);
        places_.end_list();
      }
      first = last;
    }
  }

  void add_interior()
  {
    for (std::size_t p = 0; p < bands_.size(); ++p) {
      for (LocalIndex v = bands_[p].num_skin_vertices(); v < bands_[p].num_vertices(); ++v) {
        const PieceVertex place{static_cast<LocalIndex>(p), v};
        if (!is_used(place)) continue;
        add_place(place);
        places_.end_list();
      }
    }
  }

  [[nodiscard]] bool is_used(const PieceVertex& place) const
  {
    return used_[at(place.owner)][at(place.vertex)] != 0;
  }

  [[nodiscard]] const double* xyz_of(const PieceVertex& place) const
  {
    return &bands_[at(place.owner)].vertex_xyz[3 * at(place.vertex)];
  }

  // One more place of the vertex that is being numbered. The bits are compared, not the numbers.
  void add_place(const PieceVertex& place)
  {
    const auto& known = places_.values;
    if (known.size() > at(places_.offsets.back())
        // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
        && std::memcmp(xyz_of(known.back()), xyz_of(place), 3 * sizeof(double)) != 0) {
      throw MeshError("two pieces disagree about the position of a vertex");
    }
    number_[at(place.owner)][at(place.vertex)] = places_.num_lists();
    places_.values.push_back(place);
  }

  void add_tets(RegionMesh& mesh) const
  {
    for (std::size_t p = 0; p < bands_.size(); ++p) {
      for (const LocalIndex v : bands_[p].tet_vertices) {
        mesh.tet_vertices.push_back(number_[p][at(v)]);
      }
      mesh.tet_owner.insert(mesh.tet_owner.end(), at(bands_[p].num_tets()),
                            static_cast<LocalIndex>(p));
    }
  }

  static void find_boundary(RegionMesh& mesh)
  {
    for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(mesh.tet_vertices)) {
      if (triangle.tets[1] != kNoIndex) continue;
      const std::size_t tet = at(triangle.tets[0]);
      for (const std::size_t c : mesh::kTetFaceCorners[at(triangle.corners[0])]) {
        mesh.triangle_vertices.push_back(mesh.tet_vertices[4 * tet + c]);
      }
      mesh.triangle_owner.push_back(mesh.tet_owner[tet]);
    }
  }

  // Fixed vertices first; apart from that they keep their order.
  void number_vertices(RegionMesh& mesh)
  {
    std::vector<LocalIndex> new_number(at(places_.num_lists()), kNoIndex);
    for (const LocalIndex v : mesh.triangle_vertices) new_number[at(v)] = 0;
    std::vector<LocalIndex> free;
    LocalIndex next = 0;
    for (LocalIndex v = 0; v < places_.num_lists(); ++v) {
      if (new_number[at(v)] == kNoIndex) {
        free.push_back(v);
        continue;
      }
      new_number[at(v)] = next++;
      add_position(v, mesh);
      for (const auto& [owner, vertex] : places_[v]) {
        mesh.fixed_places.values.push_back({owner, bands_[at(owner)].vertex_tag[at(vertex)]});
      }
      mesh.fixed_places.end_list();
    }
    for (const LocalIndex v : free) {
      new_number[at(v)] = next++;
      add_position(v, mesh);
    }
    for (LocalIndex& v : mesh.tet_vertices) v = new_number[at(v)];
    for (LocalIndex& v : mesh.triangle_vertices) v = new_number[at(v)];
    for (auto& numbers : number_) {
      for (LocalIndex& v : numbers) v = v == kNoIndex ? kNoIndex : new_number[at(v)];
    }
  }

  void add_position(LocalIndex v, RegionMesh& mesh) const
  {
    const double* xyz = xyz_of(places_[v].front());
    mesh.vertex_xyz.insert(mesh.vertex_xyz.end(), xyz, xyz + 3);
  }

  // Whose tets are in front of the boundary, if they are not of the region.
  void find_outside(RegionMesh& mesh) const
  {
    std::vector<BoundaryFace> faces;
    for (LocalIndex i = 0; i < mesh.num_triangles(); ++i) {
      const LocalIndex* v = &mesh.triangle_vertices[3 * at(i)];
      faces.push_back({mesh::sorted_triangle(v[0], v[1], v[2]), i});
    }
    std::sort(faces.begin(), faces.end());
    mesh.triangle_outside.assign(at(mesh.num_triangles()), kNoIndex);
    for (std::size_t p = 0; p < bands_.size(); ++p) {
      const std::vector<LocalIndex>& v = bands_[p].outside_triangles;
      for (std::size_t i = 0; i < v.size(); i += 3) {
        note_outside(p, {number_[p][at(v[i])], number_[p][at(v[i + 1])], number_[p][at(v[i + 2])]},
                     faces, mesh);
      }
    }
  }

  static void note_outside(std::size_t p, const std::array<LocalIndex, 3>& v,
                           const std::vector<BoundaryFace>& faces, RegionMesh& mesh)
  {
    if (std::ranges::find(v, kNoIndex) != v.end()) return;
    const BoundaryFace wanted{mesh::sorted_triangle(v[0], v[1], v[2]), kNoIndex};
    const auto found = std::lower_bound(faces.begin(), faces.end(), wanted);
    if (found != faces.end() && found->vertices == wanted.vertices) {
      mesh.triangle_outside[at(found->triangle)] = static_cast<LocalIndex>(p);
    }
  }

  std::span<const Band> bands_;
  std::vector<std::vector<char>> used_{};          ///< By band and its vertex.
  std::vector<std::vector<LocalIndex>> number_{};  ///< By band and its vertex: the region's.
  Lists<PieceVertex> places_{};                    ///< Of each vertex of the region.
};

}  // namespace

RegionMesh extract_region(std::span<const Band> bands, const SeamRegions& regions,
                          LocalIndex region)
{
  const auto subdomains = regions.subdomains_of(region);
  if (subdomains.size() > kMaxOwners) {
    throw MeshError(fmt::format("{} subdomains meet in one place; at most {} are supported",
                                subdomains.size(), kMaxOwners));
  }
  RegionMesh mesh;
  mesh.region = region;
  mesh.host = regions.host_of(region);
  mesh.subdomains.assign(subdomains.begin(), subdomains.end());
  Extractor(bands).run(mesh);
  return mesh;
}

}  // namespace tessera::improve
