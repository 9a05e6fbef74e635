// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/divide_domains.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "tessera/base/vec3.hpp"

#include "support/meshes.hpp"
#include "support/surfaces.hpp"

namespace tessera::coarse {
namespace {

using testing::topology_of;
using testing::volume_inside;

constexpr int kCube = 8;

// The surface of a cube whose materials are domains; normals point out of the lower one.
CoarseSurface surface_of(mesh::CoarseMesh mesh)
{
  CoarseSurface surface;
  std::map<std::set<LocalIndex>, std::pair<Vec3, std::vector<LocalIndex>>> tets_at;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto v = mesh.tet(t);
    for (std::size_t c = 0; c < 4; ++c) {
      std::set<LocalIndex> face(v.begin(), v.end());
      face.erase(v[c]);
      auto& [apex, materials] = tets_at[face];
      if (materials.empty() || mesh.tet_material[at(t)] < materials.front()) {
        apex = mesh.position(v[c]);
      }
      materials.push_back(mesh.tet_material[at(t)]);
    }
  }
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    auto [apex, materials] = tets_at.at({v[0], v[1], v[2]});
    std::ranges::sort(materials);
    const Vec3 a = mesh.position(v[0]);
    const double inside = tet_volume(a, mesh.position(v[1]), mesh.position(v[2]), apex);
    if (inside > 0.0) std::swap(v[1], v[2]);
    surface.face_domains.push_back({materials.front(), materials.size() > 1 ? materials[1] : 0});
  }
  const auto num_domains = static_cast<std::size_t>(mesh.num_materials());
  surface.domain_material.resize(num_domains);
  std::iota(surface.domain_material.begin(), surface.domain_material.end(), 1);
  surface.domain_max_size.resize(num_domains, 1.0);
  mesh.tet_vertices.clear();
  mesh.tet_material.clear();
  surface.mesh = std::move(mesh);
  return surface;
}

Vec3 mean_of(const DomainSkin& skin, const std::vector<LocalIndex>& vertices)
{
  Vec3 sum{};
  for (const LocalIndex v : vertices) sum = sum + point_at(std::span(skin.vertex_xyz), v);
  return (1.0 / static_cast<double>(vertices.size())) * sum;
}

// Triangles from the middle of the border to its edges.
Membrane fan(const DomainSkin& skin, const MembraneBorder& border)
{
  std::vector<LocalIndex> ends;
  for (const auto& edge : border.edges) ends.push_back(edge[0]);
  const Vec3 middle = mean_of(skin, ends);
  Membrane membrane{.vertex_xyz = {middle.begin(), middle.end()}};
  const auto apex = static_cast<LocalIndex>(skin.vertex.size());
  for (const auto& [from, to] : border.edges) {
    membrane.triangle_vertices.insert(membrane.triangle_vertices.end(), {from, to, apex});
  }
  return membrane;
}

// Tets from the middle of a skin to its triangles.
DomainTets cone(const DomainSkin& skin)
{
  DomainTets tets{.vertex_xyz = skin.vertex_xyz};
  const Vec3 middle = mean_of(skin, skin.triangle_vertices);
  tets.vertex_xyz.insert(tets.vertex_xyz.end(), middle.begin(), middle.end());
  const auto apex = static_cast<LocalIndex>(skin.vertex.size());
  for (std::size_t c = 0; c < skin.triangle_vertices.size(); c += 3) {
    const auto* v = &skin.triangle_vertices[c];
    tets.tet_vertices.insert(tets.tet_vertices.end(), {v[0], v[2], v[1], apex});
  }
  return tets;
}

double volume_of(const DomainSkin& skin)
{
  return volume_inside(skin.vertex_xyz, skin.triangle_vertices);
}

TEST(DivideDomains, PiecesAreClosedAndFillTheirDomain)
{
  const CoarseSurface surface = surface_of(testing::kuhn_cube(kCube));
  const DividedSurface divided = divide_domains(surface, fan, 500.0);
  ASSERT_EQ(divided.num_pieces.size(), 1U);
  EXPECT_GE(divided.num_pieces.front(), 4);
  EXPECT_EQ(divided.surface.num_domains(), divided.num_pieces.front());
  double volume = 0.0;
  for (LocalIndex p = 1; p <= divided.surface.num_domains(); ++p) {
    const DomainSkin skin = skin_of(divided.surface, p);
    EXPECT_EQ(topology_of(skin.triangle_vertices).num_unmatched_edges, 0) << p;
    EXPECT_EQ(topology_of(skin.triangle_vertices).euler, 2) << p;
    EXPECT_GT(volume_of(skin), 0.5 / divided.num_pieces.front()) << p;
    volume += volume_of(skin);
  }
  EXPECT_NEAR(volume, 1.0, 1e-12);
}

TEST(DivideDomains, TheSurfaceStaysAsItIs)
{
  const CoarseSurface surface = surface_of(testing::kuhn_cube(kCube));
  const DividedSurface divided = divide_domains(surface, fan, 500.0);
  const auto& before = surface.mesh.face_vertices;
  const auto& after = divided.surface.mesh.face_vertices;
  ASSERT_GT(after.size(), before.size());
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
  const auto& patches = divided.surface.mesh.face_patch;
  EXPECT_EQ(std::ranges::count(patches, kNoIndex),
            static_cast<std::ptrdiff_t>((after.size() - before.size()) / 3));
}

TEST(DivideDomains, JoinedPiecesMakeAValidMeshWithoutTheMembranes)
{
  const CoarseSurface surface = surface_of(testing::two_material_cube(kCube));
  const DividedSurface divided = divide_domains(surface, fan, 500.0);
  ASSERT_EQ(divided.num_pieces.size(), 2U);
  EXPECT_GT(divided.surface.num_domains(), 3);
  std::vector<DomainTets> domains;
  LocalIndex piece = 0;
  for (LocalIndex d = 1; d <= 2; ++d) {
    std::vector<DomainSkin> skins;
    std::vector<DomainTets> tets;
    for (LocalIndex p = 0; p < divided.num_pieces[at(d - 1)]; ++p) {
      skins.push_back(skin_of(divided.surface, ++piece));
      EXPECT_EQ(divided.surface.domain_material[at(piece - 1)], d);
      EXPECT_EQ(skin_of_piece(divided, piece).is_piece, divided.num_pieces[at(d - 1)] > 1);
      tets.push_back(cone(skins.back()));
    }
    domains.push_back(join_pieces(skin_of(surface, d), skins, tets));
  }
  const mesh::CoarseMesh mesh = fill_surface(surface, domains).mesh;  // It validates.
  EXPECT_EQ(mesh.num_faces(), surface.mesh.num_faces());
  double volume = 0.0;
  for (LocalIndex t = 0; t < mesh.num_tets(); ++t) {
    const auto v = mesh.tet(t);
    volume += tet_volume(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]),
                         mesh.position(v[3]));
  }
  EXPECT_NEAR(volume, 1.0, 1e-12);
}

TEST(DivideDomains, SmallDomainsStayWhole)
{
  const CoarseSurface surface = surface_of(testing::kuhn_cube(kCube));
  EXPECT_FALSE(has_large_domain(surface, 1e6));
  EXPECT_TRUE(has_large_domain(surface, 500.0));
  const DividedSurface divided = divide_domains(surface, fan, 1e6);
  EXPECT_EQ(divided.num_pieces, std::vector<LocalIndex>{1});
  EXPECT_EQ(divided.surface.mesh.face_vertices, surface.mesh.face_vertices);
  EXPECT_EQ(divided.surface.face_domains, surface.face_domains);
}

TEST(DivideDomains, WithoutASoundMembraneADomainStaysWhole)
{
  const CoarseSurface surface = surface_of(testing::kuhn_cube(kCube));
  const auto none = [](const DomainSkin&, const MembraneBorder&) { return Membrane{}; };
  const auto turned = [](const DomainSkin& skin, const MembraneBorder& border) {
    Membrane membrane = fan(skin, border);
    for (std::size_t c = 0; c < membrane.triangle_vertices.size(); c += 3) {
      std::swap(membrane.triangle_vertices[c], membrane.triangle_vertices[c + 1]);
    }
    return membrane;
  };
  const auto torn = [](const DomainSkin& skin, const MembraneBorder& border) {
    Membrane membrane = fan(skin, border);
    membrane.triangle_vertices.resize(membrane.triangle_vertices.size() - 3);
    return membrane;
  };
  const auto bulging = [](const DomainSkin& skin, const MembraneBorder& border) {
    Membrane membrane = fan(skin, border);
    for (std::size_t d = 0; d < 3; ++d) membrane.vertex_xyz[d] += 2.0 * border.plane.normal[d];
    return membrane;
  };
  for (const MembraneMesher& mesher : {MembraneMesher(none), MembraneMesher(turned),
                                       MembraneMesher(torn), MembraneMesher(bulging)}) {
    EXPECT_EQ(divide_domains(surface, mesher, 500.0).num_pieces, std::vector<LocalIndex>{1});
  }
}

TEST(MembraneBorder, GoesOnceAroundACube)
{
  const DomainSkin skin = skin_of(surface_of(testing::kuhn_cube(kCube)), 1);
  const auto border = membrane_border(skin, {{0.0, 0.0, 1.0}, 0.47});
  ASSERT_TRUE(border);
  EXPECT_EQ(border->edges.size(), 4U * kCube);
  std::set<LocalIndex> starts;
  for (const auto& edge : border->edges) starts.insert(edge[0]);
  EXPECT_EQ(starts.size(), border->edges.size());
  double area = 0.0;  // Positive: what it encloses is to its left, seen from above.
  for (const auto& [a, b] : border->edges) {
    const Vec3 from = point_at(std::span(skin.vertex_xyz), a);
    const Vec3 to = point_at(std::span(skin.vertex_xyz), b);
    EXPECT_NEAR(from[2], 0.47, 1.0 / kCube);
    area += 0.5 * (from[0] * to[1] - from[1] * to[0]);
  }
  EXPECT_NEAR(area, 1.0, 1e-12);
}

TEST(MembraneBorder, IsNoneBesideTheSkin)
{
  const DomainSkin skin = skin_of(surface_of(testing::kuhn_cube(2)), 1);
  EXPECT_FALSE(membrane_border(skin, {{0.0, 0.0, 1.0}, 1.5}));
}

TEST(MembraneBorder, IsNoneOnASurfaceThatIsNotClosed)
{
  DomainSkin skin = skin_of(surface_of(testing::kuhn_cube(2)), 1);
  skin.triangle_vertices.resize(skin.triangle_vertices.size() - 3);
  skin.triangle_patch.pop_back();
  EXPECT_FALSE(membrane_border(skin, {{0.0, 0.0, 1.0}, 0.5}));
}

}  // namespace
}  // namespace tessera::coarse
