// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/piece_arrays.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/version.hpp"
#include "tessera/mesh/lattice.hpp"
#include "tessera/quality/tet_quality.hpp"
#include "tessera/subdomain/count_pieces.hpp"

#include "support/filled_cube.hpp"

namespace tessera::subdomain {
namespace {

std::size_t at(GlobalIndex i) { return static_cast<std::size_t>(i); }

struct ArraysOfPieces : testing::FilledCube {
  std::vector<PieceArrays> arrays{};

  ArraysOfPieces()
  {
    for (const FilledPiece& filled : pieces()) {
      arrays.push_back(piece_arrays(filled.piece, context(), false));
    }
  }
};

Vec3 point_of(const mesh::MeshArrays& mesh, GlobalIndex point)
{
  return point_at(std::span<const double>(mesh.point_xyz), point);
}

void expect_dense(const std::vector<GlobalIndex>& sorted, GlobalIndex count)
{
  ASSERT_EQ(static_cast<GlobalIndex>(sorted.size()), count);
  for (GlobalIndex i = 0; i < count; ++i) ASSERT_EQ(sorted[at(i)], i);
}

TEST_F(ArraysOfPieces, IdsAreDenseOverAllPieces)
{
  std::set<GlobalIndex> points;
  std::vector<GlobalIndex> tets;
  std::vector<GlobalIndex> triangles;
  for (const PieceArrays& piece : arrays) {
    const std::set<GlobalIndex> own(piece.tets.point_ids.begin(), piece.tets.point_ids.end());
    EXPECT_EQ(own.size(), piece.tets.point_ids.size());
    points.insert(own.begin(), own.end());
    tets.insert(tets.end(), piece.tets.cell_ids.begin(), piece.tets.cell_ids.end());
    triangles.insert(triangles.end(), piece.boundary.cell_ids.begin(),
                     piece.boundary.cell_ids.end());
  }
  expect_dense({points.begin(), points.end()}, ids().num_vertices());
  expect_dense(tets, ids().num_tets());
  expect_dense(triangles, ids().num_boundary_triangles());
}

TEST_F(ArraysOfPieces, AnIdIsOnePlaceBitForBit)
{
  std::map<GlobalIndex, std::array<std::uint64_t, 3>> place_of;
  std::set<std::array<std::uint64_t, 3>> places;
  for (const PieceArrays& piece : arrays) {
    for (const mesh::MeshArrays* mesh : {&piece.tets, &piece.boundary}) {
      ASSERT_EQ(mesh->num_points(), static_cast<GlobalIndex>(mesh->point_ids.size()));
      for (GlobalIndex p = 0; p < mesh->num_points(); ++p) {
        const auto place = testing::bits(point_of(*mesh, p));
        EXPECT_EQ(place_of.emplace(mesh->point_ids[at(p)], place).first->second, place);
        places.insert(place);
      }
    }
  }
  EXPECT_EQ(places.size(), place_of.size());
}

TEST_F(ArraysOfPieces, OwnerIsTheLowestSubdomainThatHoldsThePoint)
{
  std::map<GlobalIndex, LocalIndex> lowest;
  for (std::size_t s = 0; s < arrays.size(); ++s) {
    for (const GlobalIndex id : arrays[s].tets.point_ids) {
      lowest.emplace(id, static_cast<LocalIndex>(s));  // Keeps the first, which is the lowest.
    }
  }
  std::set<LocalIndex> owners;
  for (const PieceArrays& piece : arrays) {
    for (const mesh::MeshArrays* mesh : {&piece.tets, &piece.boundary}) {
      const auto& owner = mesh->point_ints.at("owner");
      ASSERT_EQ(owner.size(), mesh->point_ids.size());
      for (std::size_t p = 0; p < owner.size(); ++p) {
        EXPECT_EQ(owner[p], lowest.at(mesh->point_ids[p]));
        owners.insert(owner[p]);
      }
    }
  }
  EXPECT_EQ(owners.size(), arrays.size());
}

TEST_F(ArraysOfPieces, CellsCarryMaterialAndSubdomain)
{
  for (std::size_t s = 0; s < arrays.size(); ++s) {
    const mesh::MeshArrays& tets = arrays[s].tets;
    const LocalIndex material = body().decomposition.subdomain_material[s];
    EXPECT_EQ(tets.cell_ints.at("attribute"),
              std::vector<std::int32_t>(at(tets.num_cells()), material));
    EXPECT_EQ(tets.cell_ints.at("subdomain"),
              std::vector<std::int32_t>(at(tets.num_cells()), static_cast<LocalIndex>(s)));
    for (GlobalIndex p = 0; p < tets.num_points(); ++p) {
      EXPECT_TRUE(material == 1 ? point_of(tets, p)[0] <= 0.5 : point_of(tets, p)[0] >= 0.5);
    }
  }
}

// A triangle and the tet behind it, found by its id in whatever piece it is.
TEST_F(ArraysOfPieces, BoundaryTrianglesPointOutOfTheTetTheyName)
{
  for (const PieceArrays& piece : arrays) {
    const mesh::MeshArrays& boundary = piece.boundary;
    ASSERT_EQ(boundary.vertices_per_cell, 3);
    for (GlobalIndex t = 0; t < boundary.num_cells(); ++t) {
      const GlobalIndex tet = boundary.cell_longs.at("tet")[at(t)] - piece.tets.cell_ids.front();
      ASSERT_GE(tet, 0);
      ASSERT_LT(tet, piece.tets.num_cells());
      std::array<Vec3, 3> corner;
      std::set<GlobalIndex> of_triangle;
      for (std::size_t c = 0; c < 3; ++c) {
        const GlobalIndex point = boundary.cell_points[3 * at(t) + c];
        corner[c] = point_of(boundary, point);
        of_triangle.insert(boundary.point_ids[at(point)]);
      }
      int others = 0;
      for (std::size_t c = 0; c < 4; ++c) {
        const GlobalIndex point = piece.tets.cell_points[4 * at(tet) + c];
        if (of_triangle.count(piece.tets.point_ids[at(point)]) > 0) continue;
        ++others;
        EXPECT_LT(tet_volume(corner[0], corner[1], corner[2], point_of(piece.tets, point)), 0.0);
      }
      EXPECT_EQ(others, 1);
    }
  }
}

// Patches 0…5 are the sides of the cube and 6 the interface, which the lower side alone has.
TEST_F(ArraysOfPieces, BoundaryCoversEveryPatchOnce)
{
  std::array<double, 7> area{};
  for (std::size_t s = 0; s < arrays.size(); ++s) {
    const mesh::MeshArrays& boundary = arrays[s].boundary;
    for (GlobalIndex t = 0; t < boundary.num_cells(); ++t) {
      const auto patch = at(boundary.cell_ints.at("patch")[at(t)]);
      EXPECT_EQ(boundary.cell_ints.at("subdomain")[at(t)], static_cast<LocalIndex>(s));
      std::array<Vec3, 3> p;
      for (std::size_t c = 0; c < 3; ++c) {
        p[c] = point_of(boundary, boundary.cell_points[3 * at(t) + c]);
        EXPECT_EQ(p[c][patch == 6 ? 0 : patch / 2],
                  patch == 6 ? 0.5 : static_cast<double>(patch % 2));
      }
      area.at(patch) += 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
    }
  }
  for (const double one : area) EXPECT_NEAR(one, 1.0, 1e-12);
}

TEST_F(ArraysOfPieces, BoundaryHasNoPointItDoesNotUse)
{
  for (const PieceArrays& piece : arrays) {
    const auto& points = piece.boundary.cell_points;
    const std::set<GlobalIndex> used(points.begin(), points.end());
    EXPECT_EQ(static_cast<GlobalIndex>(used.size()), piece.boundary.num_points());
    EXPECT_EQ(*used.rbegin(), piece.boundary.num_points() - 1);
  }
}

TEST_F(ArraysOfPieces, NamesStandInEveryFile)
{
  for (const mesh::MeshArrays* mesh : {&arrays[0].tets, &arrays[3].boundary}) {
    EXPECT_EQ(mesh->field_texts.at("material_names").size(), 2U);
    EXPECT_EQ(mesh->field_texts.at("patch_names").at(6), "interface");
    EXPECT_EQ(mesh->field_texts.at("length_unit"), std::vector<std::string>{"mm"});
    EXPECT_EQ(mesh->field_texts.at("tessera_version"),
              std::vector<std::string>{std::string(version())});
  }
}

// Pieces numbered by owner, as after an improvement; but here the owners are the skeleton's.
class NumberedByOwner {
 public:
  explicit NumberedByOwner(const testing::Body& body)
      : body_(body), hosts_(body.skeleton), owned_(at(body.num_subdomains()))
  {
  }

  // @pre pieces are added in their order.
  void add(const FilledPiece& filled)
  {
    const mesh::Piece& piece = filled.piece;
    auto& here = owned_[at(piece.subdomain)];
    for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
      if (owner_of(piece, v) != piece.subdomain) continue;
      here.emplace(piece.skin_point(v), static_cast<LocalIndex>(here.size()));
    }
    counts_.push_back(counts_of(filled.result.summary));
    counts_.back().owned_vertices =
        static_cast<GlobalIndex>(here.size()) + piece.num_interior_vertices();
  }

  [[nodiscard]] number::IdLayout ids() const { return number::IdLayout::by_owner(counts_); }

  [[nodiscard]] std::vector<VertexPlace> places_of(const mesh::Piece& piece) const
  {
    std::vector<VertexPlace> places;
    for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
      const LocalIndex owner = owner_of(piece, v);
      places.push_back({owner, owned_[at(owner)].at(piece.skin_point(v))});
    }
    auto next = static_cast<LocalIndex>(owned_[at(piece.subdomain)].size());
    for (LocalIndex v = 0; v < piece.num_interior_vertices(); ++v) {
      places.push_back({piece.subdomain, next++});
    }
    return places;
  }

 private:
  [[nodiscard]] LocalIndex owner_of(const mesh::Piece& piece, LocalIndex v) const
  {
    return mesh::owner_of_host(body_.skeleton, hosts_, piece.skin_host[at(v)]);
  }

  const testing::Body& body_;
  mesh::HostLayout hosts_;
  std::vector<std::map<mesh::HostPoint, LocalIndex>> owned_;  ///< By subdomain: place of each.
  std::vector<number::PieceCounts> counts_{};
};

TEST_F(ArraysOfPieces, ByOwnerEveryVertexHasOneIdAsWell)
{
  NumberedByOwner numbered(body());
  for (const FilledPiece& filled : pieces()) numbered.add(filled);
  const number::IdLayout by_owner = numbered.ids();
  EXPECT_EQ(by_owner.num_vertices(), ids().num_vertices());
  const std::string none;
  const WriteContext mesh{body().coarse, body().skeleton, by_owner, none,
                          [&](const mesh::Piece& piece) { return numbered.places_of(piece); }};
  std::map<GlobalIndex, GlobalIndex> id_by_host;
  for (std::size_t s = 0; s < pieces().size(); ++s) {
    const PieceArrays renumbered = piece_arrays(pieces()[s].piece, mesh, false);
    EXPECT_EQ(renumbered.tets.point_ints.at("owner"), arrays[s].tets.point_ints.at("owner"));
    for (std::size_t p = 0; p < renumbered.tets.point_ids.size(); ++p) {
      const GlobalIndex other = arrays[s].tets.point_ids[p];
      EXPECT_EQ(id_by_host.emplace(renumbered.tets.point_ids[p], other).first->second, other);
    }
  }
  EXPECT_EQ(static_cast<GlobalIndex>(id_by_host.size()), by_owner.num_vertices());
  EXPECT_EQ(id_by_host.begin()->first, 0);
  EXPECT_EQ(id_by_host.rbegin()->first, by_owner.num_vertices() - 1);
}

TEST_F(ArraysOfPieces, ByOwnerAnEmptyPieceGivesTheSchema)
{
  const auto by_owner = number::IdLayout::by_owner({{}});
  const std::string none;
  const WriteContext mesh{body().coarse, body().skeleton, by_owner, none,
                          [](const mesh::Piece&) -> std::vector<VertexPlace> {
                            throw MeshError("nobody has noted the owners of an empty piece");
                          }};
  const PieceArrays empty = piece_arrays({}, mesh, false);
  EXPECT_TRUE(empty.tets.point_ids.empty());
  EXPECT_EQ(empty.tets.point_ints.count("owner"), 1U);
}

TEST_F(ArraysOfPieces, UnknownLengthUnitIsNoText)
{
  const std::string none;
  const WriteContext mesh{body().coarse, body().skeleton, ids(), none};
  EXPECT_TRUE(piece_arrays(pieces()[0].piece, mesh, false).tets.field_texts["length_unit"].empty());
}

TEST_F(ArraysOfPieces, QualityIsWrittenIfAskedFor)
{
  EXPECT_EQ(arrays[1].tets.cell_doubles.count("mean_ratio"), 0U);
  const mesh::Piece& piece = pieces()[1].piece;
  const PieceArrays with = piece_arrays(piece, context(), true);
  const auto& mean_ratio = with.tets.cell_doubles.at("mean_ratio");
  ASSERT_EQ(static_cast<LocalIndex>(mean_ratio.size()), piece.num_tets());
  EXPECT_EQ(mean_ratio.back(), quality::mean_ratio(piece.corners(piece.num_tets() - 1)));
}

template <class Map>
std::set<std::string> keys_of(const Map& map)
{
  std::set<std::string> keys;
  for (const auto& [key, value] : map) keys.insert(key);
  return keys;
}

void expect_same_schema(const mesh::MeshArrays& empty, const mesh::MeshArrays& full)
{
  EXPECT_EQ(empty.num_cells(), 0);
  EXPECT_EQ(empty.num_points(), 0);
  EXPECT_EQ(empty.vertices_per_cell, full.vertices_per_cell);
  EXPECT_EQ(keys_of(empty.point_ints), keys_of(full.point_ints));
  EXPECT_EQ(keys_of(empty.cell_ints), keys_of(full.cell_ints));
  EXPECT_EQ(keys_of(empty.cell_longs), keys_of(full.cell_longs));
  EXPECT_EQ(keys_of(empty.cell_doubles), keys_of(full.cell_doubles));
  EXPECT_EQ(empty.field_texts, full.field_texts);
}

TEST_F(ArraysOfPieces, AnEmptyPieceHasTheSchemaOfAllOthers)
{
  for (const bool with_quality : {false, true}) {
    const PieceArrays empty = piece_arrays({}, context(), with_quality);
    const PieceArrays full = piece_arrays(pieces()[0].piece, context(), with_quality);
    expect_same_schema(empty.tets, full.tets);
    expect_same_schema(empty.boundary, full.boundary);
  }
}

struct Digest : ArraysOfPieces {
  mesh::MeshArrays tets = arrays[0].tets;

  [[nodiscard]] bool is_changed() const { return !(digest_of(tets) == digest_of(arrays[0].tets)); }
};

TEST_F(Digest, ChangesWithOneBitOfAnyCoordinate)
{
  for (std::size_t i = 0; i < tets.point_xyz.size(); ++i) {
    const double intact = tets.point_xyz[i];
    std::uint64_t image = 0;
    std::memcpy(&image, &intact, sizeof(image));
    image ^= std::uint64_t{1} << (i % 64);
    std::memcpy(&tets.point_xyz[i], &image, sizeof(image));
    EXPECT_TRUE(is_changed()) << i;
    tets.point_xyz[i] = intact;
  }
  EXPECT_FALSE(is_changed());
}

TEST_F(Digest, ChangesWithOneBitOfAnyId)
{
  for (std::size_t p = 0; p < tets.point_ids.size(); ++p) {
    tets.point_ids[p] ^= GlobalIndex{1} << (p % 63);
    EXPECT_TRUE(is_changed()) << p;
    tets.point_ids[p] = arrays[0].tets.point_ids[p];
  }
}

TEST_F(Digest, ChangesWithOneBitOfAnyMaterial)
{
  auto& attribute = tets.cell_ints.at("attribute");
  for (std::size_t t = 0; t < attribute.size(); ++t) {
    attribute[t] ^= 1 << (t % 31);
    EXPECT_TRUE(is_changed()) << t;
    attribute[t] = 1;
  }
}

TEST_F(Digest, ChangesWithTheOrderOfCornersButNotOfTets)
{
  std::swap_ranges(tets.cell_points.begin(), tets.cell_points.begin() + 4,
                   tets.cell_points.end() - 4);
  EXPECT_FALSE(is_changed());
  std::rotate(tets.cell_points.begin(), tets.cell_points.begin() + 1, tets.cell_points.begin() + 3);
  EXPECT_TRUE(is_changed());
}

TEST_F(Digest, OfNothingIsZero)
{
  EXPECT_EQ(digest_of(piece_arrays({}, context(), false).tets), Hash128{});
}

}  // namespace
}  // namespace tessera::subdomain
