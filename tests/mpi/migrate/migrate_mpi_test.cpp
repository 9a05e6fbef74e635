// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/migrate.hpp"

#include "support/distributed_meshes.hpp"
#include "support/meshes.hpp"

namespace tessera::migrate {
namespace {

using testing::share_of_mesh;

// A mesh that is moved about; every rank knows where every tet is, and what each must hold.
class Wanderer {
 public:
  explicit Wanderer(mesh::CoarseMesh mesh, std::size_t max_count = comm::kMaxMpiCount)
      : comm_(MPI_COMM_WORLD, max_count), mesh_(std::move(mesh))
  {
    for (LocalIndex t = 0; t < mesh_.num_tets(); ++t) {
      tet_rank_.push_back(static_cast<Rank>(GlobalIndex{t} * comm_.size() / mesh_.num_tets()));
    }
    share_ = expected();
  }

  [[nodiscard]] DistributedMesh expected() const
  {
    return share_of_mesh(mesh_, tet_rank_, comm_.rank());
  }

  // @param[in] tet_rank Of all tets.
  void move_to(std::vector<Rank> tet_rank, Traffic* traffic = nullptr)
  {
    tet_rank_ = std::move(tet_rank);
    std::vector<Rank> mine;
    for (const GlobalIndex id : share_.tet_ids)
      mine.push_back(tet_rank_[at(testing::tet_of_id(id))]);
    share_ = migrate(comm_, share_, mine, traffic);
  }

  [[nodiscard]] const DistributedMesh& share() const { return share_; }
  [[nodiscard]] const std::vector<Rank>& tet_rank() const { return tet_rank_; }
  [[nodiscard]] const comm::Communicator& comm() const { return comm_; }

 private:
  comm::Communicator comm_;
  mesh::CoarseMesh mesh_;
  std::vector<Rank> tet_rank_{};  // Of the whole mesh.
  DistributedMesh share_{};
};

// Some of the tets to random ones of some of the ranks. The generator is the same on all ranks.
std::vector<Rank> random_ranks(std::vector<Rank> tet_rank, int num_ranks, std::mt19937& random)
{
  const auto below = [&](int end) {
    return static_cast<int>(random() % static_cast<unsigned>(end));
  };
  const int num_targets = 1 + below(num_ranks);
  const int first_target = below(num_ranks);
  const int percent = below(4) == 0 ? 100 : 1 + below(60);
  for (Rank& rank : tet_rank) {
    if (below(100) < percent) rank = (first_target + below(num_targets)) % num_ranks;
  }
  return tet_rank;
}

void expect_right_after_random_moves(Wanderer& mesh, int num_moves, unsigned seed)
{
  std::mt19937 random(seed);
  EXPECT_EQ(mesh.share(), mesh.expected());
  int num_empty = 0;
  for (int i = 0; i < num_moves; ++i) {
    mesh.move_to(random_ranks(mesh.tet_rank(), mesh.comm().size(), random));
    EXPECT_EQ(mesh.share(), mesh.expected()) << "after move " << i;
    if (mesh.share().tet_ids.empty()) ++num_empty;
  }
  if (num_moves < 100 || mesh.comm().size() == 1) return;
  EXPECT_GT(mesh.comm().sum(num_empty), 0) << "no rank was ever empty: that was not tested";
}

TEST(Migrate, TablesAreRightAfterHundredRandomMigrations)
{
  Wanderer mesh(testing::kuhn_cube(3));
  expect_right_after_random_moves(mesh, 100, 1);
}

TEST(Migrate, BoundaryBetweenMaterialsStaysWithItsTets)
{
  Wanderer mesh(testing::two_material_cube(2));
  expect_right_after_random_moves(mesh, 20, 2);
}

TEST(Migrate, MessagesInSmallPieces)
{
  constexpr std::size_t kTinyPieces = 1001;
  Wanderer mesh(testing::kuhn_cube(3), kTinyPieces);
  expect_right_after_random_moves(mesh, 10, 3);
}

TEST(Migrate, FewerTetsThanRanks)
{
  Wanderer mesh(testing::kuhn_cube(1));
  expect_right_after_random_moves(mesh, 20, 4);
}

TEST(Migrate, StayingChangesNothingAndSendsNoTet)
{
  Wanderer mesh(testing::kuhn_cube(3));
  const DistributedMesh before = mesh.share();
  Traffic traffic;
  mesh.move_to(mesh.tet_rank(), &traffic);
  EXPECT_EQ(mesh.share(), before);
  // Lists of shared vertices only: some words a sharer of each.
  const auto num_sharers = static_cast<GlobalIndex>(before.vertex_sharers.values.size());
  EXPECT_LE(traffic.num_bytes, 2000 * mesh.comm().size() + 40 * num_sharers);
}

TEST(Migrate, SameTetsBeforeAndAfter)
{
  Wanderer mesh(testing::two_material_cube(2));
  const auto digest = [&] {
    const Hash128 mine = digest_of_tets(mesh.share());
    std::vector<std::uint64_t> halves{mine.low, mine.high};
    mesh.comm().sum_in_place(halves);
    return halves;
  };
  const auto before = digest();
  std::mt19937 random(5);
  mesh.move_to(random_ranks(mesh.tet_rank(), mesh.comm().size(), random));
  EXPECT_EQ(digest(), before);
}

TEST(Migrate, RankThatDoesNotExistIsAnErrorOnAllRanks)
{
  const Wanderer mesh(testing::kuhn_cube(2));
  const bool is_last = mesh.comm().rank() == mesh.comm().size() - 1;
  std::vector<Rank> ranks(mesh.share().tet_ids.size(), 0);
  if (is_last) ranks.back() = mesh.comm().size();
  EXPECT_THROW(static_cast<void>(migrate(mesh.comm(), mesh.share(), ranks)),
               comm::Collective<MeshError>);
  if (is_last) ranks.pop_back();
  EXPECT_THROW(static_cast<void>(migrate(mesh.comm(), mesh.share(), ranks)),
               comm::Collective<MeshError>);
}

}  // namespace
}  // namespace tessera::migrate
