// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "optimize/edge_ring.hpp"
#include "optimize/passes/passes.hpp"
#include "optimize/replace_tets.hpp"
#include "optimize/tet_energy.hpp"

namespace tessera::optimize {
namespace {

// Whether both have outer faces opposite to them, of one group.
bool are_doubled(const WorkingMesh& mesh, Corner one, Corner other)
{
  const Corner across = mesh.tet_neighbours[at(one)];
  return is_outer(across) && mesh.tet_neighbours[at(other)] == across;
}

// A way to share out the outer faces of a tet, those of one group, among several tets.
class Division {
 public:
  explicit Division(const WorkingMesh& mesh) : mesh_(&mesh) {}

  void add_vertex(const Vec3& position)
  {
    new_point_ = {position[0], position[1], position[2], 0.0};
    has_vertex_ = true;
  }
  void remove(LocalIndex tet) { old_tets_.push_back(tet); }
  void add(const TetVertices& tet)
  {
    new_tets_.push_back(tet);
    new_energies_.push_back(tet_energy(point(tet[0]), point(tet[1]), point(tet[2]), point(tet[3])));
  }

  [[nodiscard]] LocalIndex new_vertex() const { return mesh_->num_vertices(); }
  [[nodiscard]] double worst_energy() const
  {
    return new_energies_.empty() ? kInfinity : *std::ranges::max_element(new_energies_);
  }

  [[nodiscard]] bool apply(WorkingMesh& mesh) const
  {
    const LocalIndex vertex =
        has_vertex_ ? optimize::add_vertex(mesh, to_vec3(new_point_)) : kNoIndex;
    if (replace_tets(mesh, {old_tets_, new_tets_, new_energies_})) return true;
    if (has_vertex_) mesh.vertex_removed[at(vertex)] = 1;
    return false;
  }

 private:
  [[nodiscard]] const Point& point(LocalIndex v) const
  {
    return v == new_vertex() ? new_point_ : mesh_->points[at(v)];
  }

  const WorkingMesh* mesh_;
  std::vector<LocalIndex> old_tets_{};
  std::vector<TetVertices> new_tets_{};
  std::vector<double> new_energies_{};
  Point new_point_{};
  bool has_vertex_ = false;
};

// A vertex in the middle of the tet, which becomes four.
Division with_middle(const WorkingMesh& mesh, LocalIndex t)
{
  Division division(mesh);
  Vec3 sum{};
  for (Corner c = 4 * t; c < 4 * t + 4; ++c) sum = sum + to_vec3(mesh.corner_point(c));
  division.add_vertex(0.25 * sum);
  division.remove(t);
  for (Corner c = 4 * t; c < 4 * t + 4; ++c) {
    const auto [i, j, k] = face_vertices(mesh.tet_vertices, c);
    division.add({division.new_vertex(), i, j, k});
  }
  return division;
}

// A vertex in the middle of the edge that the outer faces do not share. All tets around it become
// two, each with the outer faces of one end. Nothing if the edge is on the boundary.
Division with_edge_cut(const WorkingMesh& mesh, LocalIndex t, const TetEdge& edge)
{
  Division division(mesh);
  EdgeRing ring;
  const auto never = [](LocalIndex) { return false; };
  if (!walk_ring(mesh, t, edge, kMaxRing, never, ring)) return division;
  division.add_vertex(0.5 * (to_vec3(mesh.points[at(ring.a)]) + to_vec3(mesh.points[at(ring.b)])));
  for (std::size_t i = 0; i < ring.size; ++i) {
    division.remove(ring.tets[i]);
    const LocalIndex from = ring.vertices[i];
    const LocalIndex to = ring.vertices[(i + 1) % ring.size];
    division.add({ring.a, division.new_vertex(), from, to});
    division.add({division.new_vertex(), ring.b, from, to});
  }
  return division;
}

// Each of the three tets around the new edge has a face of either old one, opposite to one corner
// of the face that goes. Not both may be outer faces of one group.
bool would_part_outer_faces(const WorkingMesh& mesh, Corner corner)
{
  const LocalIndex other = tet_of(mesh.tet_neighbours[at(corner)]);
  return std::ranges::none_of(face_of(corner), [&](Corner c) {
    Corner of_other = 4 * other;
    while (mesh.tet_vertices[at(of_other)] != mesh.tet_vertices[at(c)]) ++of_other;
    return are_doubled(mesh, c, of_other);
  });
}

// An edge in place of the face opposite to the corner: two tets become three.
Division with_face_exchanged(const WorkingMesh& mesh, Corner corner)
{
  Division division(mesh);
  const Corner across = mesh.tet_neighbours[at(corner)];
  if (is_boundary(across) || !would_part_outer_faces(mesh, corner)) return division;
  division.remove(tet_of(corner));
  division.remove(tet_of(across));
  const std::array<LocalIndex, 3> face = face_vertices(mesh.tet_vertices, corner);
  for (std::size_t i = 0; i < 3; ++i) {
    division.add(
        {mesh.tet_vertices[at(corner)], mesh.tet_vertices[at(across)], face[i], face[(i + 1) % 3]});
  }
  return division;
}

// The way whose worst tet is the best.
Division best_division(const WorkingMesh& mesh, LocalIndex t)
{
  Division best = with_middle(mesh, t);
  const auto consider = [&](Division&& other) {
    if (other.worst_energy() < best.worst_energy()) best = std::move(other);
  };
  for (Corner c = 4 * t; c < 4 * t + 4; ++c) consider(with_face_exchanged(mesh, c));
  for (const TetEdge& edge : kTetEdges) {
    if (are_doubled(mesh, 4 * t + edge.a, 4 * t + edge.b)) {
      consider(with_edge_cut(mesh, t, edge));
    }
  }
  return best;
}

}  // namespace

void divide_pass(WorkingMesh& mesh)
{
  refresh_energies(mesh);
  const LocalIndex num_slots = mesh.num_slots();  // New tets have one outer face of a group.
  for (LocalIndex t = 0; t < num_slots; ++t) {
    if (mesh.is_free_slot(t) || num_doubled_faces(mesh, t) == 0) continue;
    const Division best = best_division(mesh, t);
    if (!(best.worst_energy() <= kHighestEnergy)) continue;
    mesh.statistics.num_divided += best.apply(mesh) ? 1 : 0;
  }
  tighten_bound(mesh);
}

}  // namespace tessera::optimize
