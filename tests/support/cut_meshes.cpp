// SPDX-License-Identifier: BSD-3-Clause
#include "support/cut_meshes.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace tessera::testing {
namespace {

LocalIndex add(const Branch& branch, cut::CutTree& tree)
{
  const auto row = static_cast<LocalIndex>(tree.nodes.size());
  tree.nodes.emplace_back();
  if (branch.below == nullptr) {
    tree.nodes[at(row)].part = tree.num_parts++;
    return row;
  }
  tree.nodes[at(row)].plane = branch.plane;
  const LocalIndex below = add(*branch.below, tree);
  const LocalIndex above = add(*branch.above, tree);
  tree.nodes[at(row)].below = below;
  tree.nodes[at(row)].above = above;
  return row;
}

// How far a point is beyond the planes around a part; negative inside.
double distance_outside(const cut::CutTree& tree, LocalIndex row, LocalIndex part,
                        const Vec3& point)
{
  constexpr double kFar = 1e300;
  const cut::CutNode& node = tree.nodes[at(row)];
  if (node.part != kNoIndex) return node.part == part ? -kFar : kFar;
  const double above = dot(node.plane.normal, point) - node.plane.offset;
  return std::min(std::max(above, distance_outside(tree, node.below, part, point)),
                  std::max(-above, distance_outside(tree, node.above, part, point)));
}

}  // namespace

Branch leaf() { return {}; }

Branch branch(const cut::Plane& plane, const Branch& below, const Branch& above)
{
  return {plane, std::make_shared<Branch>(below), std::make_shared<Branch>(above)};
}

cut::CutTree tree_of(const std::vector<Branch>& solids)
{
  cut::CutTree tree;
  for (const Branch& solid : solids) tree.solid_root.push_back(add(solid, tree));
  return tree;
}

double volume_of(const mesh::CoarseMesh& mesh, LocalIndex material)
{
  double volume = 0.0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    if (mesh.tet_material[at(t)] != material) continue;
    const auto v = mesh.tet(t);
    volume += tet_volume(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]),
                         mesh.position(v[3]));
  }
  return volume;
}

void expect_parts_in_their_cells(const cut::CutMesh& cut, const cut::CutTree& tree,
                                 double tolerance)
{
  ASSERT_EQ(cut.tet_part.size(), at(cut.mesh.num_tets()));
  std::vector<LocalIndex> num_tets(at(tree.num_parts), 0);
  for (LocalIndex t = 0; t < cut.mesh.num_tets(); ++t) {
    const LocalIndex part = cut.tet_part[at(t)];
    ++num_tets.at(at(part));
    const LocalIndex root = tree.solid_root.at(at(cut.mesh.tet_material[at(t)] - 1));
    for (const LocalIndex v : cut.mesh.tet(t)) {
      EXPECT_LE(distance_outside(tree, root, part, cut.mesh.position(v)), tolerance);
    }
  }
  EXPECT_EQ(std::ranges::count(num_tets, 0), 0);
}

void expect_same_names(const mesh::CoarseMesh& cut, const mesh::CoarseMesh& uncut)
{
  EXPECT_EQ(cut.patch_names, uncut.patch_names);
  EXPECT_EQ(cut.patch_surface, uncut.patch_surface);
  EXPECT_EQ(cut.material_names, uncut.material_names);
}

void expect_points_on_surfaces(const mesh::CoarseMesh& mesh, const model::Model& model,
                               double tolerance)
{
  ASSERT_GT(mesh.num_faces(), 0);
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const LocalIndex surface = mesh.patch_surface[at(mesh.face_patch[at(f)])];
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t corner = 3 * at(f) + c;
      const Vec3 point = mesh.position(mesh.face_vertices[corner]);
      model::SurfaceParameters uv{};
      if (!mesh.face_uv.empty()) uv = {mesh.face_uv[2 * corner], mesh.face_uv[2 * corner + 1]};
      EXPECT_LE(norm(model.project_to_surface(surface, point, uv).xyz - point), tolerance);
    }
  }
  for (std::size_t end = 0; end < mesh.segment_vertices.size(); ++end) {
    const Vec3 point = mesh.position(mesh.segment_vertices[end]);
    const double t = mesh.segment_t.empty() ? 0.0 : mesh.segment_t[end];
    const auto found = model.project_to_curve(mesh.segment_curve[end / 2], point, t);
    EXPECT_LE(norm(found.xyz - point), tolerance);
  }
}

}  // namespace tessera::testing
