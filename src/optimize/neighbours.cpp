// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/neighbours.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "optimize/corners.hpp"

namespace tessera::optimize {
namespace {

// A face of a tet in the bucket of its lowest vertex.
struct Face {
  std::uint64_t other_vertices;  // The middle and the highest one.
  std::uint32_t corner_and_side;

  [[nodiscard]] Corner corner() const { return static_cast<Corner>(corner_and_side >> 1); }
  [[nodiscard]] bool side() const { return (corner_and_side & 1) != 0; }
};

class NeighbourSearch {
 public:
  NeighbourSearch(const std::vector<LocalIndex>& tet_vertices,
                  const std::vector<LocalIndex>& tet_origin)
      : tet_vertices_(tet_vertices),
        tet_origin_(tet_origin),
        faces_(tet_vertices.size()),
        neighbours_(tet_vertices.size(), kNoIndex)
  {
  }

  std::vector<LocalIndex> run(LocalIndex num_vertices)
  {
    fill_buckets(num_vertices);
    for (LocalIndex v = 0; v < num_vertices; ++v) {
      match(std::span(faces_).subspan(at(offsets_[at(v)]),
                                      at(offsets_[at(v) + 1] - offsets_[at(v)])));
    }
    return std::move(neighbours_);
  }

 private:
  [[nodiscard]] LocalIndex lowest(Corner corner) const
  {
    const auto [a, b, c] = face_vertices(tet_vertices_, corner);
    return std::min({a, b, c});
  }

  void fill_buckets(LocalIndex num_vertices)
  {
    const auto num_corners = static_cast<Corner>(tet_vertices_.size());
    offsets_.assign(at(num_vertices) + 1, 0);
    for (Corner corner = 0; corner < num_corners; ++corner) ++offsets_[at(lowest(corner)) + 1];
    for (std::size_t v = 0; v < at(num_vertices); ++v) offsets_[v + 1] += offsets_[v];
    std::vector<LocalIndex> next(offsets_.begin(), offsets_.end() - 1);
    for (Corner corner = 0; corner < num_corners; ++corner) {
      const auto [a, b, c] = face_vertices(tet_vertices_, corner);
      const auto [low, middle, high] = mesh::sorted_triangle(a, b, c);
      faces_[at(next[at(low)]++)] = {
          (static_cast<std::uint64_t>(middle) << 32) | static_cast<std::uint32_t>(high),
          (static_cast<std::uint32_t>(corner) << 1)
              | static_cast<std::uint32_t>(mesh::is_even_triangle(a, b, c))};
    }
  }

  // Some 22 faces, half as many triangles. A vertex of very many tets is sorted first, so that only
  // equal triangles are compared.
  void match(std::span<Face> bucket)
  {
    constexpr std::size_t kManyFaces = 64;
    const bool is_sorted = bucket.size() > kManyFaces;
    if (is_sorted) {
      std::sort(bucket.begin(), bucket.end(),
                [](const Face& a, const Face& b) { return a.other_vertices < b.other_vertices; });
    }
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      for (std::size_t j = i + 1; j < bucket.size(); ++j) {
        if (bucket[i].other_vertices == bucket[j].other_vertices) {
          join(bucket[i], bucket[j]);
        } else if (is_sorted) {
          break;
        }
      }
    }
  }

  void join(const Face& a, const Face& b)
  {
    for (const Corner corner : {a.corner(), b.corner()}) {
      if (neighbours_[at(corner)] != kNoIndex) fail(corner, "has a triangle of three tets");
    }
    if (a.side() == b.side()) {
      fail(a.corner(), fmt::format("lies on the same side of a triangle as tet {}",
                                   tet_origin_[at(tet_of(b.corner()))]));
    }
    neighbours_[at(a.corner())] = b.corner();
    neighbours_[at(b.corner())] = a.corner();
  }

  [[noreturn]] void fail(Corner corner, const std::string& what) const
  {
    throw MeshError(fmt::format("tet {} {}", tet_origin_[at(tet_of(corner))], what));
  }

  const std::vector<LocalIndex>& tet_vertices_;
  const std::vector<LocalIndex>& tet_origin_;
  std::vector<LocalIndex> offsets_{};  // Shape (num_vertices + 1): into faces_, by lowest vertex.
  std::vector<Face> faces_;
  std::vector<LocalIndex> neighbours_;
};

// Whether two corners see one triangle from both sides.
bool are_opposite(const std::vector<LocalIndex>& tet_vertices, Corner corner, Corner other)
{
  const auto [a, b, c] = face_vertices(tet_vertices, corner);
  const auto [d, e, f] = face_vertices(tet_vertices, other);
  return mesh::sorted_triangle(a, b, c) == mesh::sorted_triangle(d, e, f)
         && mesh::is_even_triangle(a, b, c) != mesh::is_even_triangle(d, e, f);
}

}  // namespace

std::vector<LocalIndex> find_neighbours(const std::vector<LocalIndex>& tet_vertices,
                                        LocalIndex num_vertices,
                                        const std::vector<LocalIndex>& tet_origin)
{
  return NeighbourSearch(tet_vertices, tet_origin).run(num_vertices);
}

void require_neighbours(const std::vector<LocalIndex>& tet_vertices,
                        const std::vector<LocalIndex>& tet_neighbours)
{
  const auto num_corners = static_cast<Corner>(tet_vertices.size());
  for (Corner corner = 0; corner < num_corners; ++corner) {
    const Corner other = tet_neighbours[at(corner)];
    if (other == kNoIndex) continue;
    if (other < 0 || other >= num_corners || tet_neighbours[at(other)] != corner
        || !are_opposite(tet_vertices, corner, other)) {
      throw MeshError(fmt::format("tet {} has a wrong neighbour opposite to its corner {}",
                                  tet_of(corner), corner & 3));
    }
  }
}

}  // namespace tessera::optimize
