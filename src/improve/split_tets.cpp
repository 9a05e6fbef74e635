// SPDX-License-Identifier: BSD-3-Clause
#include "improve/split_tets.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>
#include <vector>

#include "tessera/base/vec3.hpp"
#include "tessera/mesh/surface_match.hpp"

#include "improve/owner_set.hpp"

namespace tessera::improve {
namespace {

// Some corners of a tet, by ascending vertex; kNoIndex fills up.
using Simplex = std::array<LocalIndex, 4>;

struct DisputedSimplex {
  Simplex vertices{};
  LocalIndex tet = kNoIndex;

  friend auto operator<=>(const DisputedSimplex&, const DisputedSimplex&) = default;
};

class Splitter {
 public:
  Splitter(const RegionMesh& mesh, TetMesh& tets)
      : mesh_(mesh), tets_(tets), holders_(holders_of_fixed(mesh)), all_(all_owners(mesh))
  {
  }

  LocalIndex run()
  {
    LocalIndex num_splits = 0;
    for (const std::size_t size : {2U, 3U, 4U}) {
      while (const LocalIndex splits = split_some(size)) num_splits += splits;
    }
    return num_splits;
  }

 private:
  // Splits disputed simplices of `size` vertices that have no tet in common.
  LocalIndex split_some(std::size_t size)
  {
    const std::vector<DisputedSimplex> disputed = size == 4 ? disputed_tets() : disputed_in(size);
    std::vector<char> is_touched(tets_.tet_vertices.size() / 4, 0);
    LocalIndex num_splits = 0;
    for (auto first = disputed.begin(); first != disputed.end();) {
      const auto last = std::find_if(first, disputed.end(), [&](const DisputedSimplex& s) {
        return s.vertices != first->vertices;
      });
      if (std::none_of(first, last, [&](const auto& s) { return is_touched[at(s.tet)] != 0; })) {
        for (auto s = first; s != last; ++s) is_touched[at(s->tet)] = 1;
        split({first, last}, size);
        ++num_splits;
      }
      first = last;
    }
    return num_splits;
  }

  // Edges or triangles whose vertices no owner holds together, with every tet around them.
  [[nodiscard]] std::vector<DisputedSimplex> disputed_in(std::size_t size) const
  {
    std::vector<DisputedSimplex> found;
    for (std::size_t t = 0; 4 * t < tets_.tet_vertices.size(); ++t) {
      Simplex tet;
      std::copy_n(&tets_.tet_vertices[4 * t], 4, tet.begin());
      if (owners_of(tet) != 0) continue;
      std::sort(tet.begin(), tet.end());
      for (unsigned corners = 0; corners < 16; ++corners) {
        if (static_cast<std::size_t>(std::popcount(corners)) != size) continue;
        const Simplex simplex = part_of(tet, corners);
        if (owners_of(simplex) == 0) found.push_back({simplex, static_cast<LocalIndex>(t)});
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  // Here the boundary counts, too: a tet may be behind triangles of two owners.
  [[nodiscard]] std::vector<DisputedSimplex> disputed_tets() const
  {
    const auto match =
        mesh::match_surface(mesh_.triangle_vertices, mesh_.num_fixed(), tets_.tet_vertices);
    const std::vector<OwnerSet> allowed = allowed_owners(mesh_, tets_, match.triangle_tet);
    std::vector<DisputedSimplex> found;
    for (std::size_t t = 0; t < allowed.size(); ++t) {
      if (allowed[t] != 0) continue;
      Simplex simplex;
      std::copy_n(&tets_.tet_vertices[4 * t], 4, simplex.begin());
      found.push_back({simplex, static_cast<LocalIndex>(t)});
    }
    return found;
  }

  // The corners whose bits are set.
  static Simplex part_of(const Simplex& tet, unsigned corners)
  {
    Simplex part{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
    std::size_t next = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      if ((corners >> c & 1U) != 0) part[next++] = tet[c];
    }
    return part;
  }

  // Who holds all vertices; free ones are everybody's.
  [[nodiscard]] OwnerSet owners_of(const Simplex& simplex) const
  {
    OwnerSet owners = all_;
    for (const LocalIndex v : simplex) {
      if (v != kNoIndex && at(v) < holders_.size()) owners &= holders_[at(v)];
    }
    return owners;
  }

  // Puts a vertex into the middle of a simplex; every tet around it becomes one a vertex of it.
  void split(std::span<const DisputedSimplex> around, std::size_t size)
  {
    const Simplex& simplex = around.front().vertices;
    Vec3 sum{};
    for (std::size_t i = 0; i < size; ++i) {
      sum = sum + point_at(std::span<const double>(tets_.vertex_xyz), simplex[i]);
    }
    const Vec3 middle = (1.0 / static_cast<double>(size)) * sum;
    const auto new_vertex = static_cast<LocalIndex>(tets_.vertex_xyz.size() / 3);
    tets_.vertex_xyz.insert(tets_.vertex_xyz.end(), middle.begin(), middle.end());
    for (const DisputedSimplex& place : around) {
      Simplex old;
      std::copy_n(&tets_.tet_vertices[4 * at(place.tet)], 4, old.begin());
      for (std::size_t i = 0; i < size; ++i) {
        Simplex child = old;
        std::replace(child.begin(), child.end(), simplex[i], new_vertex);
        if (i == 0) {
          std::copy(child.begin(), child.end(), &tets_.tet_vertices[4 * at(place.tet)]);
        } else {
          tets_.tet_vertices.insert(tets_.tet_vertices.end(), child.begin(), child.end());
        }
      }
    }
  }

  const RegionMesh& mesh_;
  TetMesh& tets_;
  std::vector<OwnerSet> holders_;
  OwnerSet all_;
};

}  // namespace

LocalIndex split_disputed(const RegionMesh& mesh, TetMesh& tets)
{
  return Splitter(mesh, tets).run();
}

}  // namespace tessera::improve
