// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "tessera/mesh/coarse_mesh.hpp"

#include "coarse/tet_changes.hpp"

namespace tessera::coarse {

// The triangles and edges of a mesh that stay: those on the geometry, and lines inside.
class Geometry {
 public:
  explicit Geometry(const mesh::CoarseMesh& mesh);

  [[nodiscard]] bool has_vertex(LocalIndex v) const { return has_vertex_[at(v)] != 0; }
  [[nodiscard]] bool has_edge(LocalIndex a, LocalIndex b) const;
  // kNoIndex if the triangle is not on the geometry.
  [[nodiscard]] LocalIndex patch_of(LocalIndex a, LocalIndex b, LocalIndex c) const;
  [[nodiscard]] bool has_two_faces_on_a_patch(const Tet& tet) const;

 private:
  struct Face {
    std::array<LocalIndex, 3> vertices{};  // Ascending.
    LocalIndex patch = kNoIndex;
    friend auto operator<=>(const Face&, const Face&) = default;
  };

  std::vector<char> has_vertex_;
  std::vector<std::array<LocalIndex, 2>> edges_{};  // Ascending, as the faces.
  std::vector<Face> faces_{};
};

// One pass of flips over all edges and triangles off the geometry; their number. A tet takes part
// in one flip at most.
LocalIndex flip_tets(mesh::CoarseMesh& mesh, const Geometry& geometry);

}  // namespace tessera::coarse
