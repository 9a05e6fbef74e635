// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/base/quadratic_tet.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/io/vtu.hpp"

#include "support/box_pieces.hpp"
#include "support/shared_folder.hpp"

#include "formats/link/link_pieces.hpp"

namespace tessera::formats {
namespace {

namespace fs = std::filesystem;

const testing::BoxPieces kBox(1, 2);  // 8 pieces of 48 tets, 125 points, 192 triangles outside.
constexpr GlobalIndex kSide = 9;      // Points with the nodes, along an axis.
constexpr GlobalIndex kNumVertices = 125;
constexpr std::array<std::array<std::size_t, 2>, 3> kTriangleEdges{{{0, 1}, {1, 2}, {2, 0}}};

using Position = std::array<double, 3>;

GlobalIndex id_of(const Position& at)
{
  GlobalIndex id = 0;
  for (const double x : at) id = kSide * id + std::lround(x * (kSide - 1));
  return id;
}

Position position(const std::vector<double>& xyz, LocalIndex row)
{
  const std::size_t first = 3 * at(row);
  return {xyz[first], xyz[first + 1], xyz[first + 2]};
}

Position middle(const Position& a, const Position& b)
{
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

// Rows of points by their positions, in the order in which they are asked for.
class Points {
 public:
  explicit Points(mesh::MeshArrays& mesh) : mesh_(mesh) {}

  LocalIndex row(const Position& at)
  {
    const auto [found, is_new] = rows_.emplace(at, static_cast<LocalIndex>(rows_.size()));
    if (is_new) {
      mesh_.point_xyz.insert(mesh_.point_xyz.end(), at.begin(), at.end());
      mesh_.point_ids.push_back(id_of(at));
    }
    return found->second;
  }

 private:
  mesh::MeshArrays& mesh_;
  std::map<Position, LocalIndex> rows_{};
};

// The same cells with nodes on their edges, which stand among the vertices in any order.
template <class Edges>
mesh::MeshArrays with_nodes_on(mesh::MeshArrays cells, const Edges& edges)
{
  const auto width = static_cast<std::size_t>(cells.vertices_per_cell);
  const std::vector<LocalIndex> corners = std::exchange(cells.cell_points, {});
  const std::vector<double> xyz = std::exchange(cells.point_xyz, {});
  cells.point_ids.clear();
  cells.point_ints.clear();
  cells.vertices_per_cell += static_cast<int>(edges.size());
  Points points(cells);
  for (std::size_t cell = 0; cell < corners.size(); cell += width) {
    for (std::size_t c = 0; c < width; ++c)
      cells.cell_points.push_back(points.row(position(xyz, corners[cell + c])));
    for (const auto& [a, b] : edges) {
      cells.cell_points.push_back(
          points.row(middle(position(xyz, corners[cell + a]), position(xyz, corners[cell + b]))));
    }
  }
  return cells;
}

mesh::MeshArrays tets_of(LocalIndex piece)
{
  return with_nodes_on(kBox.tets(piece), kQuadraticTetEdges);
}

class LinkSecondOrder : public ::testing::Test {
 protected:
  LinkSecondOrder()
  {
    if (comm_.rank() == 0) write_files();
    comm_.barrier();
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
      io::write_vtu(tets_of(p), folder_ / tets.back(), io::Compression::none);
      io::write_vtu(with_nodes_on(kBox.boundary(p), kTriangleEdges), folder_ / boundary.back(),
                    io::Compression::none);
    }
    io::write_pvtu(folder_ / "mesh.pvtu", tets, tets_of(0));
    io::write_pvtu(folder_ / "boundary.pvtu", boundary,
                   with_nodes_on(kBox.boundary(0), kTriangleEdges));
  }

  void link()
  {
    const PieceSource source(folder_ / "mesh.pvtu", comm_);
    mesh_ = link_pieces(source, comm_, [] {}, {.patch_points = true});
    for (std::size_t i = 0; i < mesh_.links.size(); ++i) {
      const LocalIndex number = source.first_of(comm_.rank()) + static_cast<LocalIndex>(i);
      own_.push_back(build_piece(source.load(number), number, mesh_.links[i], mesh_));
    }
  }

  comm::Communicator comm_{MPI_COMM_WORLD};
  testing::SharedFolder folder_{comm_};
  LinkedMesh mesh_{};
  std::vector<Piece> own_{};
};

using Pairs = std::multiset<std::pair<GlobalIndex, GlobalIndex>>;

Pairs pairs_of(const std::vector<GlobalIndex>& in_turn)
{
  Pairs pairs;
  for (std::size_t i = 0; i < in_turn.size(); i += 2) pairs.emplace(in_turn[i], in_turn[i + 1]);
  return pairs;
}

Pairs once_each(const std::vector<GlobalIndex>& in_turn)
{
  const Pairs pairs = pairs_of(in_turn);
  const std::set<Pairs::value_type> once(pairs.begin(), pairs.end());
  return {once.begin(), once.end()};
}

TEST_F(LinkSecondOrder, NumbersNodesDenselyAfterAllVertices)
{
  link();
  ASSERT_TRUE(mesh_.outline.is_of_second_order());
  EXPECT_EQ(mesh_.outline.num_points(), kSide * kSide * kSide);
  std::vector<GlobalIndex> told;  // Number, id and whether it is a node, in turn.
  for (const Piece& piece : own_) {
    std::set<LocalIndex> nodes;
    for (std::size_t p = 0; p < piece.tet_points.size(); ++p)
      if (p % 10 >= 4) nodes.insert(piece.tet_points[p]);
    for (LocalIndex row = 0; row < piece.num_points(); ++row)
      told.insert(told.end(), {piece.point_numbers[at(row)], id_of(position(piece.point_xyz, row)),
                               nodes.contains(row) ? 1 : 0});
  }
  const std::vector<GlobalIndex> all = comm_.all_gather_rows(told);
  std::map<GlobalIndex, GlobalIndex> id_of_number;
  std::set<GlobalIndex> ids;
  for (std::size_t i = 0; i < all.size(); i += 3) {
    EXPECT_EQ(id_of_number.emplace(all[i], all[i + 1]).first->second, all[i + 1]);
    EXPECT_EQ(all[i] >= kNumVertices, all[i + 2] == 1) << all[i];
    ids.insert(all[i + 1]);
  }
  EXPECT_EQ(ids.size(), id_of_number.size());
  EXPECT_EQ(id_of_number.begin()->first, 0);
  EXPECT_EQ(id_of_number.rbegin()->first, kSide * kSide * kSide - 1);
  EXPECT_EQ(id_of_number.size(), static_cast<std::size_t>(kSide * kSide * kSide));
}

TEST_F(LinkSecondOrder, OwnPointsStandInTwoRuns)
{
  link();
  for (const Piece& piece : own_) {
    LocalIndex next = 0;
    for (const PointRun& run : mesh_.outline.own_points(piece.number)) {
      EXPECT_EQ(run.first_row, next);
      for (LocalIndex i = 0; i < run.count; ++i)
        EXPECT_EQ(piece.point_numbers[at(next++)], run.first_number + i);
    }
    EXPECT_EQ(next, piece.num_own_points);
  }
}

TEST_F(LinkSecondOrder, CellsHaveTheirNodesInTheOrderOfVtk)
{
  link();
  for (const Piece& piece : own_) {
    for (std::size_t t = 0; t < piece.tet_points.size(); t += 10) {
      for (std::size_t e = 0; e < kQuadraticTetEdges.size(); ++e) {
        const auto [a, b] = kQuadraticTetEdges[e];
        EXPECT_EQ(position(piece.point_xyz, piece.tet_points[t + 4 + e]),
                  middle(position(piece.point_xyz, piece.tet_points[t + a]),
                         position(piece.point_xyz, piece.tet_points[t + b])));
      }
    }
    ASSERT_EQ(piece.triangle_points.size(), 6 * piece.triangle_side.size());
    for (std::size_t t = 0; t < piece.triangle_points.size(); t += 6) {
      for (std::size_t e = 0; e < kTriangleEdges.size(); ++e) {
        const auto [a, b] = kTriangleEdges[e];
        EXPECT_EQ(position(piece.point_xyz, piece.triangle_points[t + 3 + e]),
                  middle(position(piece.point_xyz, piece.triangle_points[t + a]),
                         position(piece.point_xyz, piece.triangle_points[t + b])));
      }
    }
  }
}

TEST_F(LinkSecondOrder, PatchesListNodesAndNeighboursCountThem)
{
  link();
  std::vector<GlobalIndex> listed;  // Patch and number, in turn.
  std::vector<GlobalIndex> expected;
  for (const Piece& piece : own_) {
    for (const PatchPoint& point : piece.patch_points)
      listed.insert(listed.end(), {point.patch, piece.point_numbers[at(point.point)]});
    for (std::size_t p = 0; p < piece.triangle_points.size(); ++p) {
      expected.insert(expected.end(), {piece.triangle_patch[p / 6],
                                       piece.point_numbers[at(piece.triangle_points[p])]});
    }
  }
  EXPECT_EQ(pairs_of(comm_.all_gather_rows(listed)), once_each(comm_.all_gather_rows(expected)));
  for (const PieceCounts& piece : mesh_.outline.pieces) {
    std::multiset<GlobalIndex> shared;
    for (const PieceNeighbour& neighbour : piece.neighbours)
      shared.insert(neighbour.num_shared_points);
    EXPECT_EQ(shared, (std::multiset<GlobalIndex>{1, 5, 5, 5, 25, 25, 25}));
  }
}

TEST_F(LinkSecondOrder, RefusesPiecesOfFirstOrderAmongThem)
{
  if (comm_.rank() == 0)
    io::write_vtu(kBox.tets(3), folder_ / "mesh" / "piece_3.vtu", io::Compression::none);
  comm_.barrier();
  if (comm_.rank() == 0) fs::remove(folder_ / "boundary.pvtu");
  comm_.barrier();
  EXPECT_THROW(link(), InputError);
}

TEST_F(LinkSecondOrder, RefusesANodeThatIsACornerElsewhere)
{
  mesh::MeshArrays tets = tets_of(0);
  tets.cell_points[10] = tets.cell_points[4];
  if (comm_.rank() == 0)
    io::write_vtu(tets, folder_ / "mesh" / "piece_0.vtu", io::Compression::none);
  comm_.barrier();
  EXPECT_THROW(link(), InputError);
}

// A node of an edge that the pieces beside have as well, moved or under another id there.
TEST_F(LinkSecondOrder, RefusesPiecesThatDisagreeOnANode)
{
  for (const bool is_moved : {true, false}) {
    mesh::MeshArrays tets = tets_of(0);
    // Pieces are cubes of half a side: this edge lies on their common one through the middle.
    const Position node{0.5, 0.5, 0.125};
    for (LocalIndex row = 0; row < static_cast<LocalIndex>(tets.point_ids.size()); ++row) {
      if (position(tets.point_xyz, row) != node) continue;
      if (is_moved) tets.point_xyz[3 * at(row)] += 1e-3;
      if (!is_moved) tets.point_ids[at(row)] = 100'000;
    }
    if (comm_.rank() == 0)
      io::write_vtu(tets, folder_ / "mesh" / "piece_0.vtu", io::Compression::none);
    comm_.barrier();
    try {
      link();
      ADD_FAILURE() << "is not refused";
    } catch (const InputError& error) {
      const std::string text = error.what();
      const char* const how = is_moved ? "at (0.501, 0.5, 0.125)" : "id 100000";
      for (const char* const words : {"piece_0.vtu and ", "disagree on the node", how,
                                      "from (0.5, 0.5, 0", "to (0.5, 0.5, 0"}) {
        EXPECT_NE(text.find(words), std::string::npos) << text;
      }
    }
    comm_.barrier();
  }
}

}  // namespace
}  // namespace tessera::formats
