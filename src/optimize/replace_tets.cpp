// SPDX-License-Identifier: BSD-3-Clause
#include "optimize/replace_tets.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "tessera/mesh/tet_topology.hpp"

#include "optimize/tet_energy.hpp"

namespace tessera::optimize {
namespace {

// A triangle as a tet sees it, outward.
struct Face {
  std::array<LocalIndex, 3> vertices;  // Ascending.
  bool is_even;                        // mesh::is_even_triangle() of the outward order.

  friend bool operator==(const Face&, const Face&) = default;
};

Face make_face(LocalIndex a, LocalIndex b, LocalIndex c)
{
  return {mesh::sorted_triangle(a, b, c), mesh::is_even_triangle(a, b, c)};
}

// A face that waits for a new tet. Its known side is a corner of an old neighbour (`is_outside`) or
// of a new tet; those are counted from the first new one.
struct OpenFace {
  Face wanted;  // As the new tet will see it.
  bool is_outside;
  Corner side;  // Or is_boundary().
};

// Two sides of one face.
struct Link {
  OpenFace first;
  Corner second;  // Of a new tet.
};

class Joiner {
 public:
  Joiner(const WorkingMesh& mesh, const Replacement& change) : mesh_(mesh), change_(change)
  {
    links_.reserve(4 * change.new_tets.size());
    open_.reserve(4 * change.new_tets.size());
  }

  // Pairs all faces of the new tets with each other and with the faces around the old ones.
  [[nodiscard]] bool run()
  {
    for (const LocalIndex t : change_.old_tets) add_outer_faces(t);
    for (std::size_t i = 0; i < change_.new_tets.size(); ++i) {
      for (Corner c = 0; c < 4; ++c) join(static_cast<Corner>(4 * i) + c);
    }
    return open_.empty();
  }

  [[nodiscard]] const std::vector<Link>& links() const { return links_; }

 private:
  void add_outer_faces(LocalIndex t)
  {
    for (Corner corner = 4 * t; corner < 4 * t + 4; ++corner) {
      const Corner across = mesh_.tet_neighbours[at(corner)];
      if (!is_boundary(across) && is_old(tet_of(across))) continue;
      const auto [a, b, c] = face_vertices(mesh_.tet_vertices, corner);
      open_.push_back({make_face(a, b, c), true, across});
    }
  }

  [[nodiscard]] bool is_old(LocalIndex t) const
  {
    return std::find(change_.old_tets.begin(), change_.old_tets.end(), t) != change_.old_tets.end();
  }

  void join(Corner corner)
  {
    const TetVertices& tet = change_.new_tets[at(tet_of(corner))];
    const auto [a, b, c] = face_of(corner & 3);
    const Face seen = make_face(tet[at(a)], tet[at(b)], tet[at(c)]);
    const auto found = std::find_if(open_.begin(), open_.end(),
                                    [&](const OpenFace& face) { return face.wanted == seen; });
    if (found == open_.end()) {
      open_.push_back({{seen.vertices, !seen.is_even}, false, corner});
    } else {
      links_.push_back({*found, corner});
      *found = open_.back();
      open_.pop_back();
    }
  }

  const WorkingMesh& mesh_;
  const Replacement& change_;
  std::vector<OpenFace> open_{};
  std::vector<Link> links_{};
};

LocalIndex take_slot(WorkingMesh& mesh)
{
  if (!mesh.free_slots.empty()) {
    const LocalIndex slot = mesh.free_slots.back();
    mesh.free_slots.pop_back();
    return slot;
  }
  const LocalIndex slot = mesh.num_slots();
  mesh.tet_vertices.resize(mesh.tet_vertices.size() + 4, kNoIndex);
  mesh.tet_neighbours.resize(mesh.tet_neighbours.size() + 4, kNoIndex);
  mesh.tet_energy.push_back(0.0);
  mesh.tet_cost.push_back(0.0);
  mesh.tet_to_swap.push_back(0);
  return slot;
}

void free_slot(WorkingMesh& mesh, LocalIndex t)
{
  std::fill_n(&mesh.tet_vertices[4 * at(t)], 4, kNoIndex);
  mesh.tet_to_swap[at(t)] = 0;
  mesh.free_slots.push_back(t);
}

std::vector<LocalIndex> choose_slots(WorkingMesh& mesh, const Replacement& change)
{
  const std::size_t num_new = change.new_tets.size();
  std::vector<LocalIndex> slots(change.old_tets.begin(), change.old_tets.end());
  while (slots.size() < num_new) slots.push_back(take_slot(mesh));
  for (std::size_t i = num_new; i < slots.size(); ++i) free_slot(mesh, slots[i]);
  slots.resize(num_new);
  return slots;
}

void write_tet(WorkingMesh& mesh, LocalIndex t, const TetVertices& vertices, double energy)
{
  std::copy(vertices.begin(), vertices.end(), &mesh.tet_vertices[4 * at(t)]);
  mesh.tet_energy[at(t)] = energy;
  mesh.tet_cost[at(t)] = cost_of_energy(energy);
  mesh.tet_to_swap[at(t)] = 1;
  for (const LocalIndex v : vertices) {
    mesh.vertex_to_smooth[at(v)] = 1;
    mesh.vertex_to_collapse[at(v)] = 1;
  }
}

// Whether more outer faces would share a tet with another one of their group.
bool gathers_outer_faces(const WorkingMesh& mesh, const Replacement& change,
                         const std::vector<Link>& links)
{
  std::vector<std::array<Corner, 4>> across(change.new_tets.size(), {0, 0, 0, 0});
  for (const Link& link : links) {
    if (link.first.is_outside)
      across[at(tet_of(link.second))][at(link.second & 3)] = link.first.side;
  }
  std::size_t after = 0;
  for (const auto& faces : across) after += num_doubled_faces(faces);
  if (after == 0) return false;
  std::size_t before = 0;
  for (const LocalIndex t : change.old_tets) before += num_doubled_faces(mesh, t);
  return after > before;
}

void write_link(WorkingMesh& mesh, const std::vector<LocalIndex>& slots, const Link& link)
{
  const auto placed = [&](Corner corner) { return 4 * slots[at(tet_of(corner))] + (corner & 3); };
  const Corner first = link.first.is_outside ? link.first.side : placed(link.first.side);
  const Corner second = placed(link.second);
  mesh.tet_neighbours[at(second)] = first;
  if (!is_boundary(first)) mesh.tet_neighbours[at(first)] = second;
}

}  // namespace

bool replace_tets(WorkingMesh& mesh, const Replacement& change)
{
  Joiner joiner(mesh, change);
  if (!joiner.run()) return false;
  if (mesh.has_outer_faces && gathers_outer_faces(mesh, change, joiner.links())) return false;
  const std::vector<LocalIndex> slots = choose_slots(mesh, change);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    write_tet(mesh, slots[i], change.new_tets[i], change.new_energies[i]);
  }
  for (const Link& link : joiner.links()) write_link(mesh, slots, link);
  mesh.are_stars_stale = true;
  return true;
}

}  // namespace tessera::optimize
