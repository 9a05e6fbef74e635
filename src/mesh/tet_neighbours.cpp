// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/mesh/tet_neighbours.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"

#include "mesh/faces_by_vertex.hpp"

namespace tessera::mesh {
namespace {

using Corner = LocalIndex;

class NeighbourSearch {
 public:
  NeighbourSearch(std::span<const LocalIndex> tet_vertices, std::span<const LocalIndex> tet_name)
      : tet_name_(tet_name), neighbours_(tet_vertices.size(), kNoIndex)
  {
  }

  std::vector<LocalIndex> run(FacesByVertex faces, LocalIndex num_vertices)
  {
    for (LocalIndex v = 0; v < num_vertices; ++v) match(faces.at_vertex(v));
    return std::move(neighbours_);
  }

 private:
  [[nodiscard]] LocalIndex name_of(Corner corner) const
  {
    return tet_name_.empty() ? corner >> 2 : tet_name_[at(corner >> 2)];
  }

  // Some 22 faces, half as many triangles. A vertex of very many tets is sorted first, so that only
  // equal triangles are compared.
  void match(std::span<FaceOfTet> bucket)
  {
    constexpr std::size_t kManyFaces = 64;
    const bool is_sorted = bucket.size() > kManyFaces;
    if (is_sorted) {
      std::sort(bucket.begin(), bucket.end(),
                [](const FaceOfTet& a, const FaceOfTet& b) { return a.others < b.others; });
    }
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      for (std::size_t j = i + 1; j < bucket.size(); ++j) {
        if (bucket[i].others == bucket[j].others) {
          join(bucket[i], bucket[j]);
        } else if (is_sorted) {
          break;
        }
      }
    }
  }

  void join(const FaceOfTet& a, const FaceOfTet& b)
  {
    for (const Corner corner : {a.corner(), b.corner()}) {
      if (neighbours_[at(corner)] != kNoIndex) fail(corner, "has a triangle of three tets");
    }
    if (a.side() == b.side()) {
      fail(a.corner(),
           fmt::format("lies on the same side of a triangle as tet {}", name_of(b.corner())));
    }
    neighbours_[at(a.corner())] = b.corner();
    neighbours_[at(b.corner())] = a.corner();
  }

  [[noreturn]] void fail(Corner corner, const std::string& what) const
  {
    throw MeshError(fmt::format("tet {} {}", name_of(corner), what));
  }

  std::span<const LocalIndex> tet_name_;
  std::vector<LocalIndex> neighbours_;
};

}  // namespace

std::vector<LocalIndex> find_tet_neighbours(std::span<const LocalIndex> tet_vertices,
                                            LocalIndex num_vertices,
                                            std::span<const LocalIndex> tet_name)
{
  return NeighbourSearch(tet_vertices, tet_name)
      .run(FacesByVertex(tet_vertices, num_vertices), num_vertices);
}

}  // namespace tessera::mesh
