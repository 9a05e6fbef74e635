// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/migrate/partition.hpp"
#include "tessera/subdomain/read_mesh.hpp"

#include "support/box_pieces.hpp"
#include "support/shared_folder.hpp"

namespace tessera::subdomain {
namespace {

namespace fs = std::filesystem;

const testing::BoxPieces kBox(1, 2);  // 8 pieces of 48 tets, 125 points.

mesh::MeshArrays with_names(mesh::MeshArrays piece)
{
  piece.field_texts = {
      {"material_names", {"steel"}}, {"patch_names", {"skin"}}, {"length_unit", {"mm"}}};
  return piece;
}

// Ids of triangles follow the order of the pieces.
mesh::MeshArrays boundary_of(LocalIndex piece)
{
  GlobalIndex first = 0;
  for (LocalIndex p = 0; p < piece; ++p) first += kBox.boundary(p).num_cells();
  mesh::MeshArrays arrays = kBox.boundary(piece);
  arrays.cell_ids.resize(static_cast<std::size_t>(arrays.num_cells()));
  std::iota(arrays.cell_ids.begin(), arrays.cell_ids.end(), first);
  return arrays;
}

// The box as a run leaves it, in a folder that all ranks see.
class ReadMesh : public ::testing::Test {
 protected:
  ReadMesh()
  {
    if (comm_.rank() == 0) {
      fs::create_directories(folder_ / "mesh");
      fs::create_directories(folder_ / "boundary");
      std::vector<fs::path> tets;
      std::vector<fs::path> boundary;
      for (LocalIndex p = 0; p < kBox.num_pieces(); ++p) {
        const std::string name = "piece_" + std::to_string(p) + ".vtu";
        tets.push_back(fs::path("mesh") / name);
        boundary.push_back(fs::path("boundary") / name);
        io::write_vtu(with_names(kBox.tets(p)), folder_ / tets.back(), io::Compression::none);
        io::write_vtu(with_names(boundary_of(p)), folder_ / boundary.back(), io::Compression::none);
      }
      io::write_pvtu(folder_ / "mesh.pvtu", tets, with_names(kBox.tets(0)));
      io::write_pvtu(folder_ / "boundary.pvtu", boundary, with_names(boundary_of(0)));
    }
    comm_.barrier();
  }

  [[nodiscard]] MeshShare read(const ReadOptions& options = {}) const
  {
    return read_mesh(folder_.path(), comm_, options);
  }

  comm::Communicator comm_{MPI_COMM_WORLD};
  testing::SharedFolder folder_{comm_};
};

using Corner = std::array<double, 3>;

struct Tet {
  std::array<GlobalIndex, 4> points{};
  std::int32_t material = 0;
  LocalIndex piece = 0;
};

struct Triangle {
  std::array<GlobalIndex, 3> points{};  // Ascending.
  std::int32_t patch = 0;
  GlobalIndex tet = 0;

  friend bool operator==(const Triangle&, const Triangle&) = default;
};

// The whole mesh, from all of its pieces.
struct Whole {
  std::map<GlobalIndex, Corner> points{};
  std::map<GlobalIndex, Tet> tets{};
  std::map<GlobalIndex, Triangle> triangles{};

  Whole()
  {
    for (LocalIndex p = 0; p < kBox.num_pieces(); ++p) {
      add_tets(kBox.tets(p), p);
      add_triangles(boundary_of(p));
    }
  }

  void add_tets(const mesh::MeshArrays& piece, LocalIndex number)
  {
    for (std::size_t v = 0; v < piece.point_ids.size(); ++v) {
      points[piece.point_ids[v]] = {piece.point_xyz[3 * v], piece.point_xyz[3 * v + 1],
                                    piece.point_xyz[3 * v + 2]};
    }
    for (std::size_t t = 0; t < piece.cell_ids.size(); ++t) {
      Tet& tet = tets[piece.cell_ids[t]];
      for (std::size_t c = 0; c < 4; ++c) {
        tet.points[c] = piece.point_ids[at(piece.cell_points[4 * t + c])];
      }
      tet.material = piece.cell_ints.at("attribute")[t];
      tet.piece = number;
    }
  }

  void add_triangles(const mesh::MeshArrays& piece)
  {
    for (std::size_t f = 0; f < piece.cell_ids.size(); ++f) {
      Triangle& triangle = triangles[piece.cell_ids[f]];
      for (std::size_t c = 0; c < 3; ++c) {
        triangle.points[c] = piece.point_ids[at(piece.cell_points[3 * f + c])];
      }
      std::ranges::sort(triangle.points);
      triangle.patch = piece.cell_ints.at("patch")[f];
      triangle.tet = piece.cell_longs.at("tet")[f];
    }
  }
};

const Whole& whole()
{
  static const Whole box;
  return box;
}

// Which ranks have each tet as their own, which have each point on such a tet.
struct Holders {
  std::map<GlobalIndex, std::vector<Rank>> of_tet{};
  std::map<GlobalIndex, std::vector<Rank>> of_triangle{};
  std::map<GlobalIndex, std::set<Rank>> of_point{};
};

// The ids of what a rank has as its own.
struct OwnIds {
  std::vector<GlobalIndex> tets{};
  std::vector<GlobalIndex> triangles{};

  static auto fields(auto& self) { return std::tie(self.tets, self.triangles); }
};

Holders holders_of(const MeshShare& share, const comm::Communicator& comm)
{
  const OwnIds own{{share.tet_ids.begin(), share.tet_ids.end() - share.num_ghost_tets},
                   share.triangle_ids};
  Holders holders;
  Rank rank = 0;
  for (const OwnIds& ids : comm.all_gather_values(own)) {
    for (const GlobalIndex tet : ids.tets) {
      holders.of_tet[tet].push_back(rank);
      for (const GlobalIndex point : whole().tets.at(tet).points) {
        holders.of_point[point].insert(rank);
      }
    }
    for (const GlobalIndex f : ids.triangles) {
      holders.of_triangle[f].push_back(rank);
    }
    ++rank;
  }
  return holders;
}

GlobalIndex point_id(const MeshShare& share, LocalIndex row) { return share.point_ids[at(row)]; }

void expect_tets_and_points_of_whole(const MeshShare& share)
{
  for (std::size_t p = 0; p < share.point_ids.size(); ++p) {
    const Corner corner{share.point_xyz[3 * p], share.point_xyz[3 * p + 1],
                        share.point_xyz[3 * p + 2]};
    EXPECT_EQ(corner, whole().points.at(share.point_ids[p]));
  }
  for (std::size_t t = 0; t < share.tet_ids.size(); ++t) {
    const Tet& tet = whole().tets.at(share.tet_ids[t]);
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_EQ(point_id(share, share.tet_points[4 * t + c]), tet.points[c]);
    }
    EXPECT_EQ(share.tet_material[t], tet.material);
  }
}

void expect_triangles_of_whole(const MeshShare& share)
{
  for (std::size_t f = 0; f < share.triangle_ids.size(); ++f) {
    Triangle triangle{.patch = share.triangle_patch[f],
                      .tet = share.tet_ids[at(share.triangle_tet[f])]};
    for (std::size_t c = 0; c < 3; ++c) {
      triangle.points[c] = point_id(share, share.triangle_points[3 * f + c]);
    }
    std::ranges::sort(triangle.points);
    EXPECT_EQ(triangle, whole().triangles.at(share.triangle_ids[f]));
    EXPECT_LT(share.triangle_tet[f], share.num_tets() - share.num_ghost_tets);
  }
}

// Owners and sharers of the points on own tets, and owners of ghost points.
void expect_owners(const MeshShare& share, const Holders& holders, Rank rank)
{
  const LocalIndex num_own = share.num_points() - share.num_ghost_points;
  ASSERT_EQ(share.point_sharers.num_lists(), num_own);
  for (LocalIndex p = 0; p < share.num_points(); ++p) {
    const std::set<Rank>& ranks = holders.of_point.at(point_id(share, p));
    EXPECT_EQ(share.point_owner[at(p)], *ranks.begin());
    EXPECT_EQ(ranks.contains(rank), p < num_own);
    if (p >= num_own) continue;
    std::vector<Rank> others(ranks.begin(), ranks.end());
    std::erase(others, rank);
    EXPECT_TRUE(std::ranges::equal(share.point_sharers[p], others));
  }
}

// The tets of others within some layers, found by looking at all tets.
std::set<GlobalIndex> tets_around(const MeshShare& share, int num_layers)
{
  std::set<GlobalIndex> points;
  std::set<GlobalIndex> found;
  const LocalIndex num_own = share.num_tets() - share.num_ghost_tets;
  const std::set<GlobalIndex> own(share.tet_ids.begin(), share.tet_ids.begin() + num_own);
  for (const GlobalIndex tet : own) {
    for (const GlobalIndex p : whole().tets.at(tet).points) points.insert(p);
  }
  for (int layer = 0; layer < num_layers; ++layer) {
    std::set<GlobalIndex> next = points;
    for (const auto& [id, tet] : whole().tets) {
      const auto is_near = [&](GlobalIndex p) { return points.contains(p); };
      if (own.contains(id) || std::ranges::none_of(tet.points, is_near)) continue;
      found.insert(id);
      next.insert(tet.points.begin(), tet.points.end());
    }
    points = std::move(next);
  }
  return found;
}

TEST_F(ReadMesh, EveryTetAndTriangleIsOnOneRankAsInTheFiles)
{
  const MeshShare share = read();
  expect_tets_and_points_of_whole(share);
  expect_triangles_of_whole(share);
  const Holders holders = holders_of(share, comm_);
  EXPECT_EQ(holders.of_tet.size(), whole().tets.size());
  EXPECT_EQ(holders.of_triangle.size(), whole().triangles.size());
  for (const auto& [tet, ranks] : holders.of_tet) EXPECT_EQ(ranks.size(), 1U);
  for (const auto& [triangle, ranks] : holders.of_triangle) EXPECT_EQ(ranks.size(), 1U);
  EXPECT_EQ(share.num_global_tets, static_cast<GlobalIndex>(whole().tets.size()));
  EXPECT_EQ(share.num_global_points, static_cast<GlobalIndex>(whole().points.size()));
  EXPECT_EQ(share.num_global_triangles, static_cast<GlobalIndex>(whole().triangles.size()));
}

TEST_F(ReadMesh, OwnersAndSharersAreThoseOfTheWholeMesh)
{
  const MeshShare share = read();
  expect_owners(share, holders_of(share, comm_), comm_.rank());
  EXPECT_EQ(comm_.sum(std::ranges::count(share.point_owner, comm_.rank())),
            share.num_global_points);
}

TEST_F(ReadMesh, RanksTakePieceFilesInTheirOrder)
{
  const MeshShare share = read();
  const int size = comm_.size();
  const auto first_of = [&](int rank) { return kBox.num_pieces() * rank / size; };
  for (const GlobalIndex id : share.tet_ids) {
    const LocalIndex piece = whole().tets.at(id).piece;
    EXPECT_GE(piece, first_of(comm_.rank()));
    EXPECT_LT(piece, first_of(comm_.rank() + 1));
  }
}

TEST_F(ReadMesh, GhostsAreTheTetsOfOthersWithinTheLayers)
{
  for (const int num_layers : {1, 2}) {
    const MeshShare share = read({.num_ghost_layers = num_layers});
    expect_tets_and_points_of_whole(share);
    expect_triangles_of_whole(share);
    const Holders holders = holders_of(share, comm_);
    expect_owners(share, holders, comm_.rank());
    const LocalIndex num_own = share.num_tets() - share.num_ghost_tets;
    const std::set<GlobalIndex> ghosts(share.tet_ids.begin() + num_own, share.tet_ids.end());
    EXPECT_EQ(ghosts, tets_around(share, num_layers));
    EXPECT_EQ(std::cmp_equal(ghosts.size(), share.num_ghost_tets), true);
    for (LocalIndex t = 0; t < share.num_tets(); ++t) {
      EXPECT_EQ(share.tet_rank[at(t)], holders.of_tet.at(share.tet_ids[at(t)]).front());
    }
  }
}

TEST_F(ReadMesh, NumbersOfPointsFollowTheRanks)
{
  const MeshShare share = read({.consecutive_points = true, .num_ghost_layers = 1});
  ASSERT_EQ(share.point_numbers.size(), share.point_ids.size());
  GlobalIndex next = share.first_own_number;
  std::vector<std::array<GlobalIndex, 2>> ids;  // With numbers.
  for (std::size_t p = 0; p < share.point_ids.size(); ++p) {
    ids.push_back({share.point_ids[p], share.point_numbers[p]});
    if (share.point_owner[p] != comm_.rank()) continue;
    EXPECT_EQ(share.point_numbers[p], next++);
  }
  std::map<GlobalIndex, GlobalIndex> number_of;
  std::set<GlobalIndex> numbers;
  for (const auto& [id, number] : comm_.all_gather_rows(ids)) {
    EXPECT_EQ(number_of.emplace(id, number).first->second, number);
    numbers.insert(number);
  }
  EXPECT_EQ(number_of.size(), 125U);
  EXPECT_EQ(numbers.size(), 125U);
  EXPECT_EQ(*numbers.begin(), 0);
  EXPECT_EQ(*numbers.rbegin(), 124);
  EXPECT_TRUE(read().point_numbers.empty());
}

TEST_F(ReadMesh, BalancedGivesEveryRankAnEqualShare)
{
  if (comm_.size() > 1 && migrate::scotch_version() == "none") GTEST_SKIP() << "without PT-Scotch";
  const MeshShare share = read({.partition = ReadPartition::balanced, .num_ghost_layers = 1});
  expect_tets_and_points_of_whole(share);
  expect_triangles_of_whole(share);
  const Holders holders = holders_of(share, comm_);
  expect_owners(share, holders, comm_.rank());
  EXPECT_EQ(holders.of_tet.size(), whole().tets.size());
  for (const auto& [tet, ranks] : holders.of_tet) EXPECT_EQ(ranks.size(), 1U);
  const double average = static_cast<double>(whole().tets.size()) / comm_.size();
  EXPECT_LT(share.num_tets() - share.num_ghost_tets, 1.03 * average + 1.0);
}

TEST_F(ReadMesh, NamesAndUnitComeAlongAlsoWhereThereAreNoTets)
{
  const MeshShare share = read();
  EXPECT_EQ(share.material_names, std::vector<std::string>{"steel"});
  EXPECT_EQ(share.patch_names, std::vector<std::string>{"skin"});
  EXPECT_EQ(share.length_unit, "mm");
  EXPECT_TRUE(share.notes.empty());
}

TEST_F(ReadMesh, AnIndexCanBeNamedInsteadOfItsFolder)
{
  const MeshShare share = read_mesh(folder_ / "mesh.pvtu", comm_);
  EXPECT_EQ(share.tet_ids, read().tet_ids);
}

TEST_F(ReadMesh, MissingAndDamagedFilesAreErrorsOfAllRanks)
{
  EXPECT_THROW(static_cast<void>(read_mesh(folder_ / "nowhere", comm_)),
               comm::Collective<InputError>);
  if (comm_.rank() == 0) std::ofstream(folder_ / "mesh/piece_7.vtu") << "cut off";
  comm_.barrier();
  EXPECT_THROW(static_cast<void>(read()), comm::Collective<InputError>);
  if (comm_.rank() == 0)
    fs::copy_file(folder_ / "mesh/piece_0.vtu", folder_ / "mesh/piece_7.vtu",
                  fs::copy_options::overwrite_existing);
  comm_.barrier();
  EXPECT_THROW(static_cast<void>(read()), comm::Collective<InputError>);
}

}  // namespace
}  // namespace tessera::subdomain
