// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/assemble.hpp"
#include "tessera/migrate/cut_into_parts.hpp"
#include "tessera/migrate/part_figures.hpp"
#include "tessera/migrate/partition.hpp"

#include "support/box_pieces.hpp"

namespace tessera::migrate {
namespace {

const testing::BoxPieces kBox(1, 2);  // 8 pieces of 48 tets, 125 points.

// Pieces of the box, dealt to the ranks, with a column of numbers.
MeshPieces box_pieces(const comm::Communicator& comm)
{
  MeshPieces pieces;
  pieces.has_boundary = true;
  for (LocalIndex p = 0; p < kBox.num_pieces(); ++p) {
    if (p % comm.size() != comm.rank()) continue;
    pieces.tets.push_back(kBox.tets(p));
    pieces.boundary.push_back(kBox.boundary(p));
    auto& numbers = pieces.tets.back().cell_doubles["number"];
    for (const GlobalIndex id : pieces.tets.back().cell_ids) {
      numbers.push_back(0.5 * static_cast<double>(id));
    }
  }
  return pieces;
}

void drop_ids(MeshPieces& pieces)
{
  for (auto* const of_file : {&pieces.tets, &pieces.boundary}) {
    for (mesh::MeshArrays& piece : *of_file) {
      piece.point_ids.clear();
      piece.cell_ids.clear();
      piece.cell_longs.clear();
    }
  }
}

// What all ranks have, put together by looking at everything.
struct Gathered {
  std::map<GlobalIndex, std::vector<Rank>> ranks_of_vertex{};
  std::map<GlobalIndex, std::set<std::vector<double>>> positions{};
  std::multiset<GlobalIndex> tet_ids{};
  std::multiset<GlobalIndex> boundary_ids{};
};

Gathered gather(const comm::Communicator& comm, const DistributedMesh& mesh)
{
  Gathered all;
  Rank rank = 0;
  for (const MeshBlock& block : comm.all_gather_values<MeshBlock>(mesh)) {
    for (LocalIndex v = 0; v < block.num_vertices(); ++v) {
      const auto position = block.position(v);
      all.ranks_of_vertex[block.vertex_ids[at(v)]].push_back(rank);
      all.positions[block.vertex_ids[at(v)]].insert({position.begin(), position.end()});
    }
    all.tet_ids.insert(block.tet_ids.begin(), block.tet_ids.end());
    all.boundary_ids.insert(block.boundary_ids.begin(), block.boundary_ids.end());
    ++rank;
  }
  return all;
}

void expect_dense(const std::multiset<GlobalIndex>& ids, GlobalIndex num)
{
  GlobalIndex expected = 0;
  for (const GlobalIndex id : ids) EXPECT_EQ(id, expected++);
  EXPECT_EQ(expected, num);
}

// Tables, ids and boundary of the box, whoever numbered it.
void expect_box(const comm::Communicator& comm, const DistributedMesh& mesh)
{
  const Gathered all = gather(comm, mesh);
  EXPECT_EQ(all.ranks_of_vertex.size(), 125U);
  EXPECT_EQ(all.ranks_of_vertex.rbegin()->first, 124);
  std::set<std::vector<double>> positions;
  for (const auto& [id, of_id] : all.positions) {
    EXPECT_EQ(of_id.size(), 1U) << "vertex " << id;
    positions.insert(of_id.begin(), of_id.end());
  }
  EXPECT_EQ(positions.size(), 125U);
  for (LocalIndex v = 0; v < mesh.num_vertices(); ++v) {
    std::vector<Rank> ranks = all.ranks_of_vertex.at(mesh.vertex_ids[at(v)]);
    if (ranks.size() == 1) ranks.clear();
    const auto sharers = mesh.vertex_sharers[v];
    EXPECT_EQ(std::vector<Rank>(sharers.begin(), sharers.end()), ranks);
  }
  expect_dense(all.tet_ids, 384);
  expect_dense(all.boundary_ids, 192);
  EXPECT_TRUE(std::ranges::is_sorted(mesh.vertex_ids));
  EXPECT_TRUE(std::ranges::is_sorted(mesh.tet_ids));
}

TEST(Assemble, PiecesWithIdsKeepThem)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  const AssembledMesh assembled = assemble(comm, box_pieces(comm));
  EXPECT_TRUE(assembled.notes.empty());
  expect_box(comm, assembled.mesh);
  ASSERT_EQ(assembled.columns.size(), 1U);
  EXPECT_EQ(assembled.columns[0].name, "number");
  for (LocalIndex t = 0; t < assembled.mesh.num_tets(); ++t) {
    const auto piece = static_cast<Rank>(assembled.mesh.tet_ids[at(t)] / kBox.tets_per_piece());
    EXPECT_EQ(piece % comm.size(), comm.rank());
    EXPECT_EQ(std::bit_cast<double>(assembled.mesh.tet_columns[0][at(t)]),
              0.5 * static_cast<double>(assembled.mesh.tet_ids[at(t)]));
  }
}

TEST(Assemble, PatchesAreOnTheRightFaces)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  for (const bool with_ids : {true, false}) {
    MeshPieces pieces = box_pieces(comm);
    if (!with_ids) drop_ids(pieces);
    const DistributedMesh mesh = assemble(comm, pieces).mesh;
    EXPECT_GT(comm.sum(mesh.num_boundary()), 0);
    for (LocalIndex b = 0; b < mesh.num_boundary(); ++b) {
      const std::int32_t patch = mesh.boundary_patch[at(b)];  // x=0, x=1, y=0, …
      for (LocalIndex c = 0; c < 4; ++c) {
        if (c == mesh.boundary_corner[at(b)]) continue;
        const LocalIndex v = mesh.tet(mesh.boundary_tet[at(b)])[at(c)];
        EXPECT_EQ(mesh.position(v)[at(patch / 2)], patch % 2 == 0 ? 0.0 : 1.0);
      }
    }
  }
}

TEST(Assemble, PiecesWithoutIdsAreMatchedByPosition)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  MeshPieces pieces = box_pieces(comm);
  drop_ids(pieces);
  const AssembledMesh assembled = assemble(comm, pieces);
  EXPECT_EQ(assembled.notes.size(), 1U);
  expect_box(comm, assembled.mesh);
}

TEST(Assemble, IdsThatEachPieceCountsForItselfAreNotUsed)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  MeshPieces pieces = box_pieces(comm);
  pieces.boundary.clear();
  pieces.has_boundary = false;
  for (mesh::MeshArrays& piece : pieces.tets) {
    GlobalIndex next = 0;
    for (GlobalIndex& id : piece.point_ids) id = next++;
  }
  const AssembledMesh assembled = assemble(comm, pieces);
  EXPECT_EQ(assembled.notes.size(), 1U);
  expect_box(comm, assembled.mesh);  // With a boundary that was not given.
}

TEST(Assemble, ZerosOfDifferentSignBecomeTheOwners)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  MeshPieces pieces = box_pieces(comm);
  for (mesh::MeshArrays& piece : pieces.tets) {
    for (double& x : piece.point_xyz) x = x == 0.0 && comm.rank() % 2 == 1 ? -0.0 : x;
  }
  const AssembledMesh assembled = assemble(comm, pieces);
  EXPECT_TRUE(assembled.notes.empty());
  std::map<GlobalIndex, std::set<std::array<std::uint64_t, 3>>> bits;
  for (const MeshBlock& block : comm.all_gather_values<MeshBlock>(assembled.mesh)) {
    for (LocalIndex v = 0; v < block.num_vertices(); ++v) {
      bits[block.vertex_ids[at(v)]].insert(
          std::bit_cast<std::array<std::uint64_t, 3>>(block.position(v)));
    }
  }
  for (const auto& [id, positions] : bits) EXPECT_EQ(positions.size(), 1U) << id;
}

TEST(Assemble, MissingPieceIsAnErrorOnAllRanks)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  MeshPieces pieces = box_pieces(comm);
  if (comm.rank() == 0) pieces.tets.pop_back();
  EXPECT_THROW(static_cast<void>(assemble(comm, pieces)), comm::Collective<InputError>);
}

TEST(Assemble, BoundaryTriangleThatIsListedTwiceIsAnError)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  MeshPieces pieces = box_pieces(comm);
  if (comm.rank() == 0) pieces.boundary.push_back(pieces.boundary.front());
  EXPECT_THROW(static_cast<void>(assemble(comm, pieces)), comm::Collective<InputError>);
}

// A build without PT-Scotch makes one part only.
bool can_make(LocalIndex num_parts) { return num_parts == 1 || scotch_version() != "none"; }

TEST(CutIntoParts, MorePartsThanTheBuildCanMakeAreAnErrorOnAllRanks)
{
  if (can_make(2)) GTEST_SKIP() << "this build has PT-Scotch";
  const comm::Communicator comm(MPI_COMM_WORLD);
  const DistributedMesh mesh = assemble(comm, box_pieces(comm)).mesh;
  Traffic traffic;
  EXPECT_THROW(static_cast<void>(cut_into_parts(comm, mesh, {2, 1.03}, traffic)),
               comm::Collective<ConfigError>);
}

TEST(CutIntoParts, PartsAreConnectedBalancedAndComplete)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  const DistributedMesh mesh = assemble(comm, box_pieces(comm)).mesh;
  for (const LocalIndex num_parts : {1, 2, 5, 12}) {
    if (!can_make(num_parts)) continue;
    Traffic traffic;
    const RepartitionResult cut = cut_into_parts(comm, mesh, {num_parts, 1.03}, traffic);
    const auto neighbours = find_neighbours(comm, cut.mesh);
    const auto parts = measure_parts(comm, cut.mesh, neighbours, num_parts);
    GlobalIndex num_tets = 0;
    double volume = 0.0;
    for (const PartFigures& part : parts) {
      EXPECT_EQ(part.num_components, 1);
      EXPECT_LE(part.num_tets, largest_allowed(384, num_parts, 1.03));
      num_tets += part.num_tets;
      volume += part.volume;
    }
    EXPECT_EQ(num_tets, 384);
    EXPECT_NEAR(volume, 1.0, 1e-12);
    expect_box(comm, cut.mesh);
  }
}

TEST(CutIntoParts, GroupsOfTetsStayInOnePart)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  constexpr GlobalIndex kSize = 6;  // The tets of a small cube follow one another.
  const auto first_of_cubes = [](const MeshBlock& block) {
    std::vector<LocalIndex> first;
    for (LocalIndex t = 0; t < block.num_tets(); ++t) {
      const bool is_new =
          t == 0 || block.tet_ids[at(t)] / kSize != block.tet_ids[at(t - 1)] / kSize;
      first.push_back(is_new ? t : first.back());
    }
    return first;
  };
  for (const LocalIndex num_parts : {2, 5, 12}) {
    if (!can_make(num_parts)) continue;
    Traffic traffic;
    const RepartitionResult cut =
        cut_into_parts(comm, assemble(comm, box_pieces(comm)).mesh,
                       {.num_parts = num_parts, .groups_of = first_of_cubes}, traffic);
    const std::vector<LocalIndex> first = first_of_cubes(cut.mesh);
    for (LocalIndex t = 0; t < cut.mesh.num_tets(); ++t) {
      EXPECT_EQ(cut.mesh.tet_part[at(t)], cut.mesh.tet_part[at(first[at(t)])]);
    }
    EXPECT_EQ(cut.mesh.num_tets() % kSize, 0);
    expect_box(comm, cut.mesh);
  }
}

TEST(CutIntoParts, TwoBodiesInOnePartStayApart)
{
  const comm::Communicator comm(MPI_COMM_WORLD);
  MeshPieces pieces;
  if (comm.rank() == comm.size() - 1) {
    for (const LocalIndex corner : {0, 7}) {  // They touch at a point.
      pieces.tets.push_back(kBox.tets(corner));
    }
  }
  Traffic traffic;
  const RepartitionResult cut =
      cut_into_parts(comm, assemble(comm, pieces).mesh, {1, 1.03}, traffic);
  const auto parts = measure_parts(comm, cut.mesh, find_neighbours(comm, cut.mesh), 1);
  EXPECT_EQ(parts[0].num_components, 2);
  EXPECT_EQ(parts[0].num_tets, 96);
}

}  // namespace
}  // namespace tessera::migrate
