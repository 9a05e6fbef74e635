// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/topology/split_patches.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/coarse_edges.hpp"
#include "tessera/mesh/face_tets.hpp"
#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/mesh/triangle_grading.hpp"
#include "tessera/refine/choose_levels.hpp"

#include "support/decompositions.hpp"
#include "support/flat_model.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/wedge_cube.hpp"

namespace tessera::topology {
namespace {

const testing::FlatModel kModel;
const SplitOptions kCrack{.patches = {{"crack"}}};

// A cube of two materials; those triangles between them that are chosen are the patch "crack".
mesh::CoarseMesh cube_with_crack(int n, const std::function<bool(const Vec3& centroid)>& is_crack)
{
  mesh::CoarseMesh cube = testing::two_material_cube(n);
  const LocalIndex between = 6;
  const LocalIndex crack = cube.num_patches();
  cube.patch_names.emplace_back("crack");
  cube.patch_surface.push_back(LocalIndex{cube.patch_surface[at(between)]});
  for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
    if (cube.face_patch[at(f)] != between) continue;
    Vec3 sum{};
    for (std::size_t c = 0; c < 3; ++c) {
      sum = sum + cube.position(cube.face_vertices[3 * at(f) + c]);
    }
    if (is_crack((1.0 / 3.0) * sum)) cube.face_patch[at(f)] = crack;
  }
  return cube;
}

bool is_in_middle(const Vec3& point)
{
  return std::abs(point[1] - 0.5) < 0.25 && std::abs(point[2] - 0.5) < 0.25;
}

double area_of(const mesh::CoarseMesh& mesh, const std::string& patch)
{
  double area = 0.0;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    if (mesh.patch_names[at(mesh.face_patch[at(f)])] != patch) continue;
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    area += triangle_area(mesh.position(v[0]), mesh.position(v[1]), mesh.position(v[2]));
  }
  return area;
}

LocalIndex num_double(const mesh::CoarseMesh& mesh)
{
  LocalIndex number = 0;
  for (LocalIndex v = 1; v < mesh.num_vertices(); ++v) {
    if (mesh.position(v) == mesh.position(v - 1)) ++number;
  }
  return number;
}

void open(mesh::CoarseMesh& mesh, const SplitOptions& options = kCrack)
{
  if (are_rims_near(mesh, options)) divide_at_rims(mesh, options, kModel);
  EXPECT_FALSE(are_rims_near(mesh, options));
  split_patches(mesh, options);
  mesh.patch_names = mesh::final_patch_names(mesh);
}

TEST(SplitPatches, PartsWhatNothingElseHoldsTogether)
{
  mesh::CoarseMesh cube = cube_with_crack(2, [](const Vec3&) { return true; });
  const LocalIndex num_vertices = cube.num_vertices();
  EXPECT_FALSE(are_rims_near(cube, kCrack));
  open(cube);
  EXPECT_EQ(cube.num_vertices(), num_vertices + 9);
  EXPECT_EQ(num_double(cube), 9);
  std::set<LocalIndex> of_first;
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    if (cube.tet_material[at(t)] == 1) of_first.insert(cube.tet(t).begin(), cube.tet(t).end());
  }
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    if (cube.tet_material[at(t)] == 1) continue;
    for (const LocalIndex v : cube.tet(t)) EXPECT_FALSE(of_first.contains(v));
  }
}

bool is_on_crack(const mesh::CoarseMesh& mesh, LocalIndex patch)
{
  return mesh.patch_names[at(patch)].starts_with("crack_");
}

TEST(SplitPatches, LeavesTheRimSingle)
{
  mesh::CoarseMesh cube = cube_with_crack(4, is_in_middle);
  open(cube);
  EXPECT_NEAR(testing::volume_of(cube), 1.0, 1e-12);
  EXPECT_NEAR(area_of(cube, "crack_plus"), 0.25, 1e-12);
  EXPECT_NEAR(area_of(cube, "crack_minus"), 0.25, 1e-12);
  for (LocalIndex v = 1; v < cube.num_vertices(); ++v) {
    const Vec3 point = cube.position(v);
    if (point != cube.position(v - 1)) continue;
    EXPECT_EQ(point[0], 0.5);
    EXPECT_TRUE(is_in_middle(point)) << point[1] << ' ' << point[2];
  }
  const auto plus = std::ranges::find(cube.patch_names, "crack_plus") - cube.patch_names.begin();
  const auto minus = std::ranges::find(cube.patch_names, "crack_minus") - cube.patch_names.begin();
  EXPECT_EQ(cube.images.patch_origin[static_cast<std::size_t>(minus)], plus);
  EXPECT_TRUE(cube.images.is_of_split(static_cast<LocalIndex>(minus)));
  EXPECT_FALSE(cube.images.is_of_split(static_cast<LocalIndex>(plus)));
}

// Its three vertices are all on the rim, so one is put into its middle.
TEST(SplitPatches, OpensASingleTriangle)
{
  mesh::CoarseMesh cube = cube_with_crack(2, [](const Vec3& centroid) {
    return centroid[1] < 0.5 && centroid[2] < 0.5 && centroid[1] < centroid[2];
  });
  const LocalIndex num_vertices = cube.num_vertices();
  ASSERT_TRUE(are_rims_near(cube, kCrack));
  open(cube);
  EXPECT_EQ(cube.num_vertices(), num_vertices + 2);
  EXPECT_EQ(num_double(cube), 1);
  EXPECT_NEAR(area_of(cube, "crack_plus"), 0.125, 1e-12);
}

// Every vertex has its sides one behind the other, so both sides have one order.
TEST(SplitPatches, GivesBothSidesTheSameOrder)
{
  mesh::CoarseMesh cube = cube_with_crack(4, is_in_middle);
  open(cube);
  std::multiset<std::vector<Vec3>> sides;
  for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
    if (!is_on_crack(cube, cube.face_patch[at(f)])) continue;
    std::vector<LocalIndex> v(&cube.face_vertices[3 * at(f)], &cube.face_vertices[3 * at(f)] + 3);
    std::ranges::sort(v);
    sides.insert({cube.position(v[0]), cube.position(v[1]), cube.position(v[2])});
  }
  ASSERT_FALSE(sides.empty());
  for (const auto& side : sides) EXPECT_EQ(sides.count(side), 2U);
}

// Sizes ask for more on one side only.
TEST(SplitPatches, GetTheSameLevelsOnBothSides)
{
  mesh::CoarseMesh cube = cube_with_crack(2, [](const Vec3&) { return true; });
  open(cube);
  const std::vector<LocalIndex> edges = mesh::coarse_edges(cube);
  std::set<LocalIndex> of_first;
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    if (cube.tet_material[at(t)] == 1) of_first.insert(cube.tet(t).begin(), cube.tet(t).end());
  }
  const auto is_on_crack = [&](LocalIndex v) { return cube.position(v)[0] == 0.5; };
  const auto is_fine = [&](LocalIndex v) { return is_on_crack(v) && of_first.contains(v); };
  std::vector<double> wanted;
  for (std::size_t e = 0; e < edges.size(); e += 2) {
    wanted.push_back(is_fine(edges[e]) && is_fine(edges[e + 1]) ? 4.0 : 1.0);
  }
  const mesh::EdgeLevels levels = refine::choose_levels(cube, edges, wanted, 5);
  ASSERT_FALSE(levels.is_uniform());
  std::map<std::array<Vec3, 2>, std::vector<int>> levels_at;
  for (std::size_t e = 0; e < edges.size(); e += 2) {
    if (!is_on_crack(edges[e]) || !is_on_crack(edges[e + 1])) continue;
    levels_at[{cube.position(edges[e]), cube.position(edges[e + 1])}].push_back(
        levels.of(edges[e], edges[e + 1]));
  }
  EXPECT_FALSE(levels_at.empty());
  for (const auto& [place, found] : levels_at) {
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0], found[1]);
  }
}

// A triangle is cut by the order of its sides. Where one side of a crack has layers, its tets end
// at other places than those of the other side.
TEST(SplitPatches, HasEdgesInOneOrderWhereTetsHaveMoved)
{
  mesh::CoarseMesh cube = cube_with_crack(4, [](const Vec3&) { return true; });
  open(cube);
  cube.layers = {.wall_xyz = cube.vertex_xyz, .most_layers = 1};
  cube.layers.vertex_stack.assign(at(cube.num_vertices()), 0);
  cube.layers.patch_is_wall.assign(at(cube.num_patches()), 0);
  cube.layers.ends.push_back(1.0);
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    if (cube.tet_material[at(t)] != 1) continue;
    for (const LocalIndex v : cube.tet(t)) {
      const Vec3 wall = cube.layers.wall(v);
      if (wall[0] == 0.5) cube.vertex_xyz[3 * at(v) + 1] = 0.5 * wall[1] + 0.3 * wall[2];
    }
  }
  const mesh::Skeleton skeleton =
      mesh::build_skeleton(cube, testing::one_subdomain_a_material(cube));
  const mesh::LatticeLevels levels = mesh::lattice_levels(skeleton, 1);
  const auto order = [&](LocalIndex t) {
    return mesh::triangle_grading(skeleton, cube, levels, t).order;
  };
  int num_pairs = 0;
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    const LocalIndex base = skeleton.orbits.triangles.base_of(t);
    if (base == t) continue;
    ++num_pairs;
    EXPECT_EQ(order(t), order(base));
  }
  EXPECT_EQ(num_pairs, 32);
}

// What holds a point back on one side of a crack does so on the other one.
TEST(SplitPatches, HasLimitsOnBothSides)
{
  mesh::CoarseMesh cube = cube_with_crack(4, is_in_middle);
  open(cube);
  const mesh::Skeleton skeleton =
      mesh::build_skeleton(cube, testing::one_subdomain_a_material(cube));
  const auto places_of = [&](LocalIndex triangle) {
    std::vector<Vec3> places;
    for (std::size_t c = 0; c < 3; ++c) {
      const LocalIndex v = skeleton.triangle_vertices[3 * at(triangle) + c];
      places.push_back(cube.position(skeleton.vertex_coarse[at(v)]));
    }
    return places;
  };
  int num_on_crack = 0;
  for (LocalIndex t = 0; t < skeleton.num_triangles(); ++t) {
    const bool has_two_sides = is_on_crack(cube, skeleton.triangle_patch[at(t)]);
    const auto key = mesh::LatticePointKey::on_triangle(t, 4, {1, 1});
    const auto limits = mesh::on_whole_orbits({{key, 0.5}}, skeleton.orbits);
    ASSERT_EQ(limits.size(), has_two_sides ? 2U : 1U);
    num_on_crack += has_two_sides ? 1 : 0;
    for (const mesh::PointLimit& limit : limits) {
      EXPECT_EQ(limit.key.index, key.index);
      EXPECT_EQ(limit.factor, 0.5);
      EXPECT_EQ(places_of(limit.key.entity), places_of(t));
    }
  }
  EXPECT_GT(num_on_crack, 0);
}

TEST(SplitPatches, GivesPatchesOfOneRowOneRow)
{
  mesh::CoarseMesh cube = cube_with_crack(4, is_in_middle);
  cube.patch_names[6] = "crack";
  cube.patch_row = {0, 1, 2, 3, 4, 5, 6, 6};
  open(cube);
  ASSERT_EQ(cube.num_patches(), 10);
  EXPECT_EQ(cube.patch_row[8], 7);
  EXPECT_EQ(cube.patch_row[9], 7);
  EXPECT_EQ(cube.patch_names[8], "crack_minus");
  EXPECT_EQ(cube.patch_names[9], "crack_minus");
}

// Solids in contact part the patches between them, be they a part of a patch only.
TEST(SplitPatches, OpensContactsOfSolids)
{
  mesh::CoarseMesh cube = testing::two_material_cube(4);
  cube.material_names.emplace_back("third");
  for (LocalIndex t = 0; t < cube.num_tets(); ++t) {
    if (cube.tet_material[at(t)] == 1) continue;
    double middle = 0.0;
    for (const LocalIndex v : cube.tet(t)) middle += 0.25 * cube.position(v)[1];
    if (middle > 0.5) cube.tet_material[at(t)] = 3;
  }
  // The faces between the second and the third material.
  const LocalIndex between = cube.num_patches();
  cube.patch_names.emplace_back("between");
  cube.patch_surface.push_back(LocalIndex{cube.patch_surface[6]});
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(cube.tet_vertices)) {
    if (triangle.tets[1] == kNoIndex) continue;
    const std::set<LocalIndex> both{cube.tet_material[at(triangle.tets[0])],
                                    cube.tet_material[at(triangle.tets[1])]};
    if (both != std::set<LocalIndex>{2, 3}) continue;
    cube.face_vertices.insert(cube.face_vertices.end(), triangle.vertices.begin(),
                              triangle.vertices.end());
    cube.face_patch.push_back(between);
  }
  mesh::validate(cube);
  const std::string shared = cube.patch_names[6];
  open(cube, {.contacts = {{"1", "third"}}});
  EXPECT_NEAR(area_of(cube, shared), 0.5, 1e-12);
  EXPECT_NEAR(area_of(cube, shared + "_plus"), 0.5, 1e-12);
  EXPECT_NEAR(area_of(cube, shared + "_minus"), 0.5, 1e-12);
  EXPECT_EQ(num_double(cube), 10);  // Where the second one holds both, points are single.
  const auto error = testing::message_of<ConfigError>([&] {
    (void)are_rims_near(cube, {.contacts = {{"1", "fourth"}}});
  });
  EXPECT_NE(error.find("[[geometry.contact]]: no solid is or fits \"fourth\""), std::string::npos);
}

TEST(SplitPatches, RefusesPatchesOnTheOutside)
{
  const mesh::CoarseMesh cube = testing::two_material_cube(2);
  const auto error_of = [&](const std::string& patch) {
    return testing::message_of<ConfigError>(
        [&] { (void)are_rims_near(cube, {.patches = {{patch}}}); });
  };
  EXPECT_NE(error_of(cube.patch_names[0]).find("only patches inside of it"), std::string::npos);
  EXPECT_NE(error_of("nowhere").find("nowhere"), std::string::npos);
}

// Sides of a joint are images with one name, of which the minus side is that of the solid.
TEST(Joints, OpenOnTheSideOfASolid)
{
  for (const std::string solid : {"1", "2"}) {
    mesh::CoarseMesh cube = testing::two_material_cube(2);
    const std::string between = cube.patch_names[6];
    split_patches(cube, {.joints = {{.patch = between, .solid = solid}}});
    EXPECT_EQ(num_double(cube), 9);
    EXPECT_EQ(cube.num_patches(), 8);
    EXPECT_TRUE(cube.images.is_joint(6));
    EXPECT_FALSE(cube.images.is_minus_of_joint(6));
    EXPECT_TRUE(cube.images.is_minus_of_joint(7));
    EXPECT_FALSE(cube.images.is_of_split(7));
    EXPECT_EQ(mesh::final_patch_names(cube)[7], between);
    EXPECT_EQ(cube.patch_row[7], cube.patch_row[6]);
    const auto faces = mesh::tets_of_faces(cube);
    for (LocalIndex f = 0; f < cube.num_faces(); ++f) {
      if (cube.face_patch[at(f)] != 7) continue;
      EXPECT_EQ(std::to_string(cube.tet_material[at(faces[at(f)].tets[0])]), solid);
    }
  }
}

TEST(Joints, CloseWhereNothingHasGrown)
{
  const mesh::CoarseMesh before = testing::two_material_cube(3);
  mesh::CoarseMesh cube = before;
  split_patches(cube, {.joints = {{.patch = before.patch_names[6], .solid = "*"}}});
  EXPECT_GT(cube.num_vertices(), before.num_vertices());
  close_joints(cube);
  EXPECT_EQ(cube.vertex_xyz, before.vertex_xyz);
  EXPECT_EQ(cube.tet_vertices, before.tet_vertices);
  EXPECT_EQ(cube.face_vertices, before.face_vertices);
}

TEST(Joints, AreNoneWhereTheCaseOpensTheMesh)
{
  mesh::CoarseMesh cube = testing::two_material_cube(2);
  const std::string between = cube.patch_names[6];
  split_patches(cube, {.patches = {{between}}, .joints = {{.patch = between, .solid = "1"}}});
  EXPECT_EQ(mesh::final_patch_names(cube)[6], between + "_plus");
  EXPECT_FALSE(cube.images.is_joint(6));
}

TEST(Joints, NameASolid)
{
  mesh::CoarseMesh cube = testing::two_material_cube(2);
  EXPECT_THROW(split_patches(cube, {.joints = {{.patch = "*", .solid = "steel"}}}), ConfigError);
}

// In front of the edge of a wedge: x from 1/2 to 3/4 at z = 1/2.
std::vector<mesh::WakeTriangle> wake_of(const mesh::CoarseMesh& cube)
{
  std::vector<mesh::WakeTriangle> wake;
  for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(cube.tet_vertices)) {
    const bool is_its = std::ranges::all_of(triangle.vertices, [&](LocalIndex v) {
      const Vec3 place = cube.position(v);
      return place[0] >= 0.5 && place[0] <= 0.75 && place[2] == 0.5;
    });
    if (is_its) wake.push_back({triangle.vertices, 7});
  }
  return wake;
}

TEST(Wakes, OpenFromAnEdgeAndHaveTheNameOfAWall)
{
  const mesh::CoarseMesh before = testing::wedge_cube(0.1);
  mesh::CoarseMesh cube = before;
  const auto wake = wake_of(before);
  ASSERT_EQ(wake.size(), 8U);
  open_wakes(cube, wake);
  EXPECT_EQ(cube.num_vertices(), before.num_vertices() + 5);
  EXPECT_EQ(cube.num_faces(), before.num_faces() + 16);
  ASSERT_EQ(cube.num_patches(), 10);
  for (const LocalIndex patch : {8, 9}) {
    EXPECT_TRUE(cube.is_wake(patch));
    EXPECT_TRUE(cube.images.is_joint(patch));
    EXPECT_EQ(cube.patch_names[at(patch)], before.patch_names[7]);
    EXPECT_EQ(cube.patch_row[at(patch)], cube.patch_row[7]);
  }
  EXPECT_EQ(cube.images.patch_origin[9], 8);
  EXPECT_FALSE(cube.is_wake(7));
  EXPECT_FALSE(cube.is_wake(kNoIndex));
}

TEST(Wakes, CloseWithoutATrace)
{
  const mesh::CoarseMesh before = testing::wedge_cube(0.1);
  mesh::CoarseMesh cube = before;
  open_wakes(cube, {});
  EXPECT_TRUE(cube.images.are_none());
  open_wakes(cube, wake_of(before));
  close_joints(cube);
  EXPECT_EQ(cube.vertex_xyz, before.vertex_xyz);
  EXPECT_EQ(cube.tet_vertices, before.tet_vertices);
  EXPECT_EQ(cube.face_vertices, before.face_vertices);
  EXPECT_EQ(cube.face_patch, before.face_patch);
}

}  // namespace
}  // namespace tessera::topology
