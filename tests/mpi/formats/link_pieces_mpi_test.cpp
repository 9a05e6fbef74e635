// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/comm/communicator.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "support/box_pieces.hpp"
#include "support/shared_folder.hpp"

#include "formats/link/link_pieces.hpp"

namespace tessera::formats {
namespace {

namespace fs = std::filesystem;

const testing::BoxPieces kBox(1, 2);  // 8 pieces of 48 tets, 125 points, 192 triangles outside.

enum class Files { whole, without_ids, without_boundary };

mesh::MeshArrays tets_of(LocalIndex piece, Files files)
{
  mesh::MeshArrays tets = kBox.tets(piece);
  if (files == Files::without_ids) tets.point_ids.clear();
  if (files == Files::without_ids) tets.cell_ids.clear();
  tets.field_texts = {{"material_names", {"steel"}}, {"patch_names", {"skin", "", "skin"}}};
  return tets;
}

mesh::MeshArrays boundary_of(LocalIndex piece, Files files)
{
  mesh::MeshArrays triangles = kBox.boundary(piece);
  if (files == Files::without_ids) {
    triangles.point_ids.clear();
    triangles.cell_longs.clear();
  }
  for (std::size_t i = 0; i < triangles.cell_ints["patch"].size(); ++i)
    triangles.cell_ints["patch"][i] = static_cast<std::int32_t>(i % 3);
  return triangles;
}

// A corner of a tet or triangle as all pieces tell it.
using Position = std::array<double, 3>;

struct Point {
  GlobalIndex number = 0;
  Position position{};

  static auto fields(auto& self) { return std::tie(self.number, self.position); }
};

struct Seam {
  LocalIndex piece = 0;
  GlobalIndex tet = 0;
  LocalIndex other_piece = 0;
  GlobalIndex other_tet = 0;

  static auto fields(auto& self)
  {
    return std::tie(self.piece, self.tet, self.other_piece, self.other_tet);
  }
};

// An edge that a piece has, by positions of its ends.
struct EdgeOfPiece {
  std::array<Position, 2> ends{};
  LocalIndex piece = 0;

  static auto fields(auto& self) { return std::tie(self.ends, self.piece); }
};

class LinkPieces : public ::testing::TestWithParam<Files> {
 protected:
  LinkPieces()
  {
    if (comm_.rank() == 0) write_files();
    comm_.barrier();
    const PieceSource source(folder_ / "mesh.pvtu", comm_);
    mesh_ = link_pieces(source, comm_, [] {},
                        {.shared_edges = true, .face_numbers = true, .patch_points = true});
    for (std::size_t i = 0; i < mesh_.links.size(); ++i) {
      const LocalIndex number = source.first_of(comm_.rank()) + static_cast<LocalIndex>(i);
      own_.push_back(build_piece(source.load(number), number, mesh_.links[i], mesh_));
    }
  }

  void write_files() const
  {
    fs::create_directories(folder_ / "mesh");
    fs::create_directories(folder_ / "boundary");
    std::vector<fs::path> tets;
    std::vector<fs::path> boundary;
    for (LocalIndex p = 0; p < kBox.num_pieces(); ++p) {
      const std::string name = "piece_" + std::to_string(p) + ".vtu";
      tets.push_back(fs::path("mesh") / name);
      boundary.push_back(fs::path("boundary") / name);
      io::write_vtu(tets_of(p, GetParam()), folder_ / tets.back(), io::Compression::none);
      io::write_vtu(boundary_of(p, GetParam()), folder_ / boundary.back(), io::Compression::none);
    }
    io::write_pvtu(folder_ / "mesh.pvtu", tets, tets_of(0, GetParam()));
    if (GetParam() != Files::without_boundary)
      io::write_pvtu(folder_ / "boundary.pvtu", boundary, boundary_of(0, GetParam()));
  }

  static Position position(const Piece& piece, LocalIndex row)
  {
    const auto first = 3 * at(row);
    return {piece.point_xyz[first], piece.point_xyz[first + 1], piece.point_xyz[first + 2]};
  }

  static std::array<Position, 2> ends(const Piece& piece, LocalIndex a, LocalIndex b)
  {
    std::array<Position, 2> both{position(piece, a), position(piece, b)};
    std::ranges::sort(both);
    return both;
  }

  comm::Communicator comm_{MPI_COMM_WORLD};
  testing::SharedFolder folder_{comm_};
  LinkedMesh mesh_{};
  std::vector<Piece> own_{};
};

TEST_P(LinkPieces, APointHasOneNumberAndEveryNumberAPoint)
{
  std::vector<Point> points;
  for (const Piece& piece : own_)
    for (LocalIndex row = 0; row < piece.num_points(); ++row)
      points.push_back({piece.point_numbers[at(row)], position(piece, row)});
  std::map<GlobalIndex, Position> position_of;
  std::map<Position, GlobalIndex> number_of;
  for (const Point& point : comm_.all_gather_rows(points)) {
    EXPECT_EQ(position_of.emplace(point.number, point.position).first->second, point.position);
    EXPECT_EQ(number_of.emplace(point.position, point.number).first->second, point.number);
  }
  EXPECT_EQ(position_of.size(), 125U);
  EXPECT_EQ(position_of.begin()->first, 0);
  EXPECT_EQ(position_of.rbegin()->first, 124);
  EXPECT_EQ(mesh_.outline.num_points(), 125);
}

TEST_P(LinkPieces, OwnPointsComeFirstAndHaveTheNumbersOfThePiece)
{
  for (const Piece& piece : own_) {
    const GlobalIndex first = mesh_.outline.first_point[at(piece.number)];
    for (LocalIndex row = 0; row < piece.num_own_points; ++row)
      EXPECT_EQ(piece.point_numbers[at(row)], first + row);
    for (LocalIndex row = piece.num_own_points; row < piece.num_points(); ++row)
      EXPECT_LT(piece.point_numbers[at(row)], first);
    ASSERT_EQ(piece.sharers.num_lists(), static_cast<LocalIndex>(piece.shared_points.size()));
    EXPECT_TRUE(std::ranges::is_sorted(piece.shared_points));
    for (LocalIndex s = 0; s < piece.sharers.num_lists(); ++s) {
      const bool is_own = piece.shared_points[at(s)] < piece.num_own_points;
      EXPECT_EQ(piece.sharers[s].front() > piece.number, is_own);
    }
  }
}

TEST_P(LinkPieces, SeamsNameTheTetOnTheOtherSide)
{
  std::vector<Seam> seams;
  for (const Piece& piece : own_) {
    for (const SeamFace& seam : piece.seams)
      seams.push_back({piece.number, mesh_.outline.first_tet[at(piece.number)] + seam.side / 4,
                       seam.other_piece, seam.other_tet});
  }
  const std::vector<Seam> all = comm_.all_gather_rows(seams);
  std::multiset<std::tuple<LocalIndex, GlobalIndex, LocalIndex, GlobalIndex>> found;
  for (const Seam& seam : all)
    found.emplace(seam.piece, seam.tet, seam.other_piece, seam.other_tet);
  EXPECT_EQ(all.size(), 2U * 12U * 8U);  // Twelve faces between pieces, of eight triangles each.
  for (const Seam& seam : all) {
    EXPECT_NE(seam.piece, seam.other_piece);
    EXPECT_EQ(found.count({seam.other_piece, seam.other_tet, seam.piece, seam.tet}), 1U);
  }
}

TEST_P(LinkPieces, TrianglesAreFacesSeenFromOutside)
{
  GlobalIndex num_own = 0;
  for (const Piece& piece : own_) {
    num_own += piece.num_triangles();
    for (LocalIndex i = 0; i < piece.num_triangles(); ++i) {
      const LocalIndex side = piece.triangle_side[at(i)];
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t corner = mesh::kTetFaceCorners[at(side % 4)][c];
        EXPECT_EQ(piece.triangle_points[3 * at(i) + c],
                  piece.tet_points[4 * at(side / 4) + corner]);
      }
      EXPECT_EQ(piece.is_inner_triangle[at(i)], 0);
    }
  }
  EXPECT_EQ(comm_.sum(num_own), 192);
  EXPECT_EQ(mesh_.outline.num_faces(), 192);
}

TEST_P(LinkPieces, TagsBeginAtOneAndPatchesOfOneNameAreOne)
{
  EXPECT_EQ(mesh_.outline.material_names, std::vector<std::string>{"steel"});
  EXPECT_EQ(mesh_.outline.patch_names, (std::vector<std::string>{"skin", "patch_2"}));
  std::map<std::int32_t, GlobalIndex> triangles;
  for (const PieceCounts& piece : mesh_.outline.pieces) {
    EXPECT_EQ(piece.elements[Shape::tet].front().tag, 1);
    for (const TagCount& count : piece.elements[Shape::triangle])
      triangles[count.tag] += count.count;
  }
  const bool has_patches = GetParam() != Files::without_boundary;
  EXPECT_EQ(triangles[1], has_patches ? 128 : 192);
  EXPECT_EQ(triangles[2], has_patches ? 64 : 0);
}

TEST_P(LinkPieces, NeighboursSayHowManyPointsTheyShare)
{
  for (LocalIndex p = 0; p < mesh_.outline.num_pieces(); ++p) {
    std::multiset<GlobalIndex> shared;
    for (const PieceNeighbour& neighbour : mesh_.outline.pieces[at(p)].neighbours)
      shared.insert(neighbour.num_shared_points);
    // Three faces, three edges and a corner of a cube of 3 x 3 x 3 points.
    EXPECT_EQ(shared, (std::multiset<GlobalIndex>{1, 3, 3, 3, 9, 9, 9}));
  }
}

TEST_P(LinkPieces, APointOfAPatchIsListedOnceForEachPatchThatHasIt)
{
  std::set<std::tuple<std::int32_t, GlobalIndex>> expected;
  std::vector<GlobalIndex> corners;  // Patch and number, in turn.
  std::vector<GlobalIndex> listed;
  for (const Piece& piece : own_) {
    for (std::size_t c = 0; c < piece.triangle_points.size(); ++c) {
      corners.push_back(piece.triangle_patch[c / 3]);
      corners.push_back(piece.point_numbers[at(piece.triangle_points[c])]);
    }
    std::map<std::int32_t, GlobalIndex> counts;
    for (const PatchPoint& point : piece.patch_points) {
      listed.push_back(point.patch);
      listed.push_back(piece.point_numbers[at(point.point)]);
      ++counts[point.patch];
    }
    const auto& told = mesh_.outline.pieces[at(piece.number)].points_of_patch;
    EXPECT_EQ(told.size(), counts.size());
    for (const TagCount& count : told) EXPECT_EQ(count.count, counts[count.tag]);
  }
  const std::vector<GlobalIndex> all_corners = comm_.all_gather_rows(corners);
  for (std::size_t i = 0; i < all_corners.size(); i += 2)
    expected.emplace(static_cast<std::int32_t>(all_corners[i]), all_corners[i + 1]);
  const std::vector<GlobalIndex> all = comm_.all_gather_rows(listed);
  std::set<std::tuple<std::int32_t, GlobalIndex>> found;
  for (std::size_t i = 0; i < all.size(); i += 2) {
    const bool is_new = found.emplace(static_cast<std::int32_t>(all[i]), all[i + 1]).second;
    EXPECT_TRUE(is_new) << "patch " << all[i] << ", point " << all[i + 1];
  }
  EXPECT_GE(found.size(), 98U);  // Points on the surface of the cube; on two patches twice.
  EXPECT_EQ(found, expected);
}

TEST_P(LinkPieces, CountsOfFacesAddUp)
{
  for (const PieceCounts& piece : mesh_.outline.pieces) {
    std::multiset<GlobalIndex> shared;
    for (const PieceNeighbour& neighbour : piece.neighbours)
      shared.insert(neighbour.num_shared_faces);
    EXPECT_EQ(shared, (std::multiset<GlobalIndex>{0, 0, 0, 0, 8, 8, 8}));
    EXPECT_EQ(piece.num_open_faces, 24);
    ASSERT_EQ(piece.outer_triangles_of_patch.size(), piece.elements[Shape::triangle].size());
    for (std::size_t i = 0; i < piece.elements[Shape::triangle].size(); ++i)
      EXPECT_EQ(piece.outer_triangles_of_patch[i].count, piece.elements[Shape::triangle][i].count);
  }
}

TEST_P(LinkPieces, SharedEdgesAreThoseThatPiecesHave)
{
  std::vector<EdgeOfPiece> edges;
  for (const Piece& piece : own_) {
    for (std::size_t t = 0; t < piece.tet_material.size(); ++t) {
      const LocalIndex* const corner = piece.tet_points.data() + 4 * t;
      for (const auto& [a, b] : mesh::kTetEdgeCorners)
        edges.push_back({ends(piece, corner[a], corner[b]), piece.number});
    }
  }
  std::map<std::array<Position, 2>, std::set<LocalIndex>> pieces_of;
  for (const EdgeOfPiece& edge : comm_.all_gather_rows(edges))
    pieces_of[edge.ends].insert(edge.piece);
  std::map<LocalIndex, std::size_t> num_shared;
  for (const auto& [edge, pieces] : pieces_of)
    if (pieces.size() > 1)
      for (const LocalIndex piece : pieces) ++num_shared[piece];
  for (const Piece& piece : own_) {
    EXPECT_EQ(piece.shared_edges.size(), num_shared[piece.number]);
    EXPECT_GT(piece.shared_edges.size(), 0U);
    ASSERT_EQ(piece.edge_sharers.num_lists(), static_cast<LocalIndex>(piece.shared_edges.size()));
    for (std::size_t e = 0; e < piece.shared_edges.size(); ++e) {
      std::set<LocalIndex> others =
          pieces_of[ends(piece, piece.shared_edges[e][0], piece.shared_edges[e][1])];
      others.erase(piece.number);
      EXPECT_TRUE(std::ranges::equal(piece.edge_sharers[static_cast<LocalIndex>(e)], others));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllFiles, LinkPieces,
                         ::testing::Values(Files::whole, Files::without_ids,
                                           Files::without_boundary));

}  // namespace
}  // namespace tessera::formats
