// SPDX-License-Identifier: BSD-3-Clause
#include "layers/interior.hpp"

#include <algorithm>
#include <utility>

#include "tessera/optimize/optimize.hpp"

namespace tessera::layers {
namespace {

// Tets that the walls have pushed at are short in one direction: first vertices move, then some of
// them go.
optimize::Schedule schedule_of_step()
{
  return {.steps = optimize::parse_steps("mmsmscmsmmww"),
          .collapse_below = 0.85,
          .collapse_reach = 0.95};
}

// The tets of one material in numbers of their own.
struct MaterialTets {
  optimize::TetMesh tets{};
  std::vector<LocalIndex> vertices{};  // Of the coarse mesh, ascending.
};

MaterialTets tets_of_material(const mesh::CoarseMesh& mesh, LocalIndex material)
{
  MaterialTets part;
  std::vector<LocalIndex> number(at(mesh.num_vertices()), kNoIndex);
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    if (mesh.tet_material[at(t)] != material) continue;
    for (const LocalIndex v : mesh.tet(t)) {
      number[at(v)] = 0;
      part.tets.tet_vertices.push_back(v);
    }
  }
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (number[at(v)] == kNoIndex) continue;
    number[at(v)] = static_cast<LocalIndex>(part.vertices.size());
    part.vertices.push_back(v);
    const Vec3 point = mesh.position(v);
    part.tets.vertex_xyz.insert(part.tets.vertex_xyz.end(), point.begin(), point.end());
  }
  for (LocalIndex& v : part.tets.tet_vertices) v = number[at(v)];
  return part;
}

void renumber(const std::vector<LocalIndex>& number, FlatArray<LocalIndex>& vertices)
{
  for (LocalIndex& v : vertices) v = number[at(v)];
}

// Vertices without a tet go.
std::vector<LocalIndex> drop_unused(mesh::CoarseMesh& mesh)
{
  std::vector<LocalIndex> number(at(mesh.num_vertices()), kNoIndex);
  for (const LocalIndex v : mesh.tet_vertices) number[at(v)] = 0;
  FlatArray<double> kept;
  LocalIndex next = 0;
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    if (number[at(v)] == kNoIndex) continue;
    number[at(v)] = next++;
    const Vec3 point = mesh.position(v);
    kept.insert(kept.end(), point.begin(), point.end());
  }
  mesh.vertex_xyz = std::move(kept);
  renumber(number, mesh.tet_vertices);
  renumber(number, mesh.face_vertices);
  renumber(number, mesh.segment_vertices);
  return number;
}

}  // namespace

std::vector<LocalIndex> improve_interior(mesh::CoarseMesh& mesh)
{
  FlatArray<LocalIndex> tet_vertices;
  FlatArray<LocalIndex> tet_material;
  for (LocalIndex material = 1; material <= mesh.num_materials(); ++material) {
    const MaterialTets part = tets_of_material(mesh, material);
    const optimize::OptimizeResult better = optimize::optimize(part.tets, schedule_of_step());
    const auto vertex = [&](LocalIndex v) {
      return part.vertices[at(better.vertex_origin[at(v)])];
    };
    for (LocalIndex v = 0; v < static_cast<LocalIndex>(better.vertex_origin.size()); ++v) {
      std::copy_n(&better.vertex_xyz[3 * at(v)], 3, &mesh.vertex_xyz[3 * at(vertex(v))]);
    }
    for (const LocalIndex v : better.tet_vertices) tet_vertices.push_back(vertex(v));
    tet_material.resize(tet_vertices.size() / 4, material);
  }
  mesh.tet_vertices = std::move(tet_vertices);
  mesh.tet_material = std::move(tet_material);
  return drop_unused(mesh);
}

}  // namespace tessera::layers
