// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/improve/region_mesh.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

#include "support/bodies.hpp"
#include "support/decompositions.hpp"
#include "support/meshes.hpp"
#include "support/piece_sets.hpp"

namespace tessera::improve {
namespace {

using testing::Body;

struct RegionsOfOctants : ::testing::Test {
  const Body body{testing::kuhn_cube(8), testing::octants(testing::kuhn_cube(8))};
  const SeamRegions regions{body.skeleton, body.decomposition};
  std::vector<mesh::Piece> pieces = testing::coarse_pieces(body);

  // 12 faces between two octants, 6 curves, 1 point: else loops over regions would see nothing.
  void SetUp() override { ASSERT_EQ(regions.num_regions(), 12 + 6 + 1); }

  [[nodiscard]] RegionMesh extract(LocalIndex region, int layers) const
  {
    return extract_region(testing::bands_of_region(pieces, regions, region, layers), regions,
                          region);
  }
};

double volume_of(const RegionMesh& mesh)
{
  const std::span<const double> xyz(mesh.vertex_xyz);
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.tet_vertices.size(); t += 4) {
    const LocalIndex* v = &mesh.tet_vertices[t];
    sum += tet_volume(point_at(xyz, v[0]), point_at(xyz, v[1]), point_at(xyz, v[2]),
                      point_at(xyz, v[3]));
  }
  return sum;
}

double enclosed_by_triangles(const RegionMesh& mesh)
{
  const std::span<const double> xyz(mesh.vertex_xyz);
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangle_vertices.size(); t += 3) {
    const LocalIndex* v = &mesh.triangle_vertices[t];
    sum += tet_volume({}, point_at(xyz, v[0]), point_at(xyz, v[1]), point_at(xyz, v[2]));
  }
  return sum;
}

TEST_F(RegionsOfOctants, HoldEveryLabelledTetOnce)
{
  for (int phase = 0; phase < kNumPhases; ++phase) {
    LocalIndex num_labelled = 0;
    for (const mesh::Piece& piece : pieces) {
      const auto labels = label_tets(piece, regions, phase, 2);
      num_labelled += piece.num_tets()
                      - static_cast<LocalIndex>(std::count(labels.begin(), labels.end(), kNoIndex));
    }
    LocalIndex num_extracted = 0;
    for (LocalIndex r = regions.first_of_phase(phase); r < regions.first_of_phase(phase + 1); ++r) {
      num_extracted += extract(r, 2).num_tets();
    }
    EXPECT_GT(num_labelled, 0);
    EXPECT_EQ(num_extracted, num_labelled);
  }
}

TEST_F(RegionsOfOctants, AreEnclosedByTheirTriangles)
{
  for (LocalIndex r = 0; r < regions.num_regions(); ++r) {
    const RegionMesh mesh = extract(r, 2);
    EXPECT_GT(volume_of(mesh), 0.0);
    EXPECT_NEAR(enclosed_by_triangles(mesh), volume_of(mesh), 1e-12);
  }
}

TEST_F(RegionsOfOctants, FixTheVerticesOfTheirTrianglesAndNoOthers)
{
  for (LocalIndex r = 0; r < regions.num_regions(); ++r) {
    const RegionMesh mesh = extract(r, 2);
    const std::set<LocalIndex> on_boundary(mesh.triangle_vertices.begin(),
                                           mesh.triangle_vertices.end());
    EXPECT_EQ(static_cast<LocalIndex>(on_boundary.size()), mesh.num_fixed());
    EXPECT_EQ(*on_boundary.rbegin(), mesh.num_fixed() - 1);
    EXPECT_GT(mesh.num_vertices(), mesh.num_fixed());
  }
}

TEST_F(RegionsOfOctants, KnowFixedVerticesInAllPiecesThatHoldThem)
{
  for (LocalIndex r = 0; r < regions.num_regions(); ++r) {
    const RegionMesh mesh = extract(r, 2);
    for (LocalIndex v = 0; v < mesh.num_fixed(); ++v) {
      const Vec3 p = point_at(std::span(mesh.vertex_xyz), v);
      std::vector<PieceVertex> expected;
      for (LocalIndex owner = 0; owner < mesh.num_owners(); ++owner) {
        const mesh::Piece& piece = pieces[at(mesh.subdomains[at(owner)])];
        for (LocalIndex i = 0; i < piece.num_vertices(); ++i) {
          if (point_at(std::span(piece.vertex_xyz), i) == p) expected.push_back({owner, i});
        }
      }
      EXPECT_EQ(std::vector<PieceVertex>(mesh.places_of(v).begin(), mesh.places_of(v).end()),
                expected);
    }
  }
}

using Face = std::set<Vec3>;  // Its corners.

// The subdomains on either side of every triangle.
std::map<Face, std::set<LocalIndex>> subdomains_beside(const std::vector<mesh::Piece>& pieces)
{
  std::map<Face, std::set<LocalIndex>> subdomains;
  for (const mesh::Piece& piece : pieces) {
    for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
      const auto corners = piece.corners(t);
      for (const Vec3& opposite : corners) {
        Face face(corners.begin(), corners.end());
        face.erase(opposite);
        subdomains[face].insert(piece.subdomain);
      }
    }
  }
  return subdomains;
}

bool is_on_cube(const Face& face)
{
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {0.0, 1.0}) {
      const auto is_there = [&](const Vec3& p) { return p[axis] == side; };
      if (std::all_of(face.begin(), face.end(), is_there)) return true;
    }
  }
  return false;
}

TEST_F(RegionsOfOctants, KnowWhichOfTheirPiecesIsOutsideOfATriangle)
{
  const auto beside = subdomains_beside(pieces);
  for (LocalIndex r = 0; r < regions.num_regions(); ++r) {
    const RegionMesh mesh = extract(r, 1);
    EXPECT_GT(mesh.num_triangles(), 0);
    for (LocalIndex i = 0; i < mesh.num_triangles(); ++i) {
      Face face;
      for (std::size_t c = 0; c < 3; ++c) {
        face.insert(point_at(std::span(mesh.vertex_xyz), mesh.triangle_vertices[3 * at(i) + c]));
      }
      std::set<LocalIndex> expected{mesh.subdomains[at(mesh.triangle_owner[at(i)])]};
      const LocalIndex outside = mesh.triangle_outside[at(i)];
      if (outside != kNoIndex) expected.insert(mesh.subdomains[at(outside)]);
      // On the cube there is nobody, and subdomains that take no part are not seen.
      std::set<LocalIndex> taking_part;
      for (const LocalIndex s : beside.at(face)) {
        if (std::binary_search(mesh.subdomains.begin(), mesh.subdomains.end(), s)) {
          taking_part.insert(s);
        }
      }
      EXPECT_EQ(taking_part, expected);
      EXPECT_TRUE(outside == kNoIndex || !is_on_cube(face));
    }
  }
}

TEST_F(RegionsOfOctants, RefusePiecesThatDisagreeAboutAVertex)
{
  const RegionMesh mesh = extract(0, 2);
  for (LocalIndex v = 0; v < mesh.num_fixed(); ++v) {
    if (mesh.places_of(v).size() < 2) continue;
    pieces[0].vertex_xyz[3 * at(mesh.places_of(v)[0].vertex)] += 1e-12;
    EXPECT_THROW(static_cast<void>(extract(0, 2)), MeshError);
    return;
  }
  FAIL() << "no vertex is shared";
}

}  // namespace
}  // namespace tessera::improve
