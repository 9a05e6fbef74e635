// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/mesh/periodic_pairs.hpp"

#include "support/periodic_box.hpp"
#include "support/shared_folder.hpp"

#include "formats/link/match_periodic.hpp"

namespace tessera::formats {
namespace {

using testing::kPeriodicBox;

Affine shifted(const Vec3& by)
{
  Affine there;
  there.shift = by;
  return there;
}

struct NumberedPoint {
  GlobalIndex number = 0;
  Vec3 position{};

  static auto fields(auto& self) { return std::tie(self.number, self.position); }
};

struct Found {
  std::int32_t patch = 0;
  LocalIndex piece = 0;
  GlobalIndex number = 0;
  GlobalIndex of_number = 0;

  static auto fields(auto& self)
  {
    return std::tie(self.patch, self.piece, self.number, self.of_number);
  }
};

class MatchPeriodic : public ::testing::Test {
 protected:
  void write_files(const std::vector<std::string>& texts) const
  {
    testing::write_periodic_box(folder_, texts, comm_);
  }

  // Collective. What all ranks find.
  void match()
  {
    const PieceSource source(folder_ / "mesh.pvtu", comm_);
    LinkedMesh mesh = link_pieces(source, comm_, [] {}, {.patch_points = true});
    all_or_none(comm_,
                [&] { mesh.outline.periodic = periodic_patches(source.names(), mesh.outline); });
    const auto points = match_periodic_points(source, mesh, comm_, [] {});
    std::vector<NumberedPoint> numbered;
    std::vector<Found> found;
    for (std::size_t i = 0; i < mesh.links.size(); ++i) {
      const LocalIndex number = source.first_of(comm_.rank()) + static_cast<LocalIndex>(i);
      const Piece piece = build_piece(source.load(number), number, mesh.links[i], mesh);
      for (LocalIndex row = 0; row < piece.num_points(); ++row)
        numbered.push_back({piece.point_numbers[at(row)],
                            point_at(std::span<const double>(piece.point_xyz), row)});
      if (points.empty()) continue;
      for (const PeriodicPoint& one : points[i])
        found.push_back({one.patch, number, piece.point_numbers[at(one.point)], one.of_number});
    }
    for (const NumberedPoint& one : comm_.all_gather_rows(numbered))
      position_of_[one.number] = one.position;
    found_ = comm_.all_gather_rows(found);
    outline_ = std::move(mesh.outline);
  }

  // Collective.
  [[nodiscard]] std::optional<std::string> refusal()
  {
    try {
      match();
    } catch (const InputError& error) {
      EXPECT_NE(dynamic_cast<const comm::ThrownOnAllRanks*>(&error), nullptr);
      return error.what();
    }
    return std::nullopt;
  }

  const comm::Communicator comm_{MPI_COMM_WORLD};
  testing::SharedFolder folder_{comm_};
  Outline outline_{};
  std::map<GlobalIndex, Vec3> position_of_{};
  std::vector<Found> found_{};
};

TEST_F(MatchPeriodic, EachPointOfAPatchIsTheImageOfOne)
{
  const std::vector<Vec3> shifts{{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}};
  write_files(mesh::to_texts(std::vector<mesh::PeriodicPair>{
      {"left", "right", shifted(shifts[0])}, {"back", "front", shifted(shifts[1])}}));
  match();
  EXPECT_EQ(outline_.periodic.size(), 2U);
  EXPECT_EQ(outline_.periodic[1].from, 4);
  EXPECT_EQ(outline_.periodic[1].to, 3);
  EXPECT_EQ(found_.size(), 50U);
  std::set<std::tuple<std::int32_t, GlobalIndex>> seen;
  std::map<std::tuple<std::int32_t, LocalIndex>, GlobalIndex> counts;
  for (const Found& one : found_) {
    EXPECT_TRUE(seen.insert({one.patch, one.number}).second);
    ++counts[{one.patch, one.piece}];
    const Vec3& position = position_of_.at(one.number);
    EXPECT_EQ(position[at(one.patch)], one.patch == 0 ? 1.0 : 0.0);
    EXPECT_EQ(position_of_.at(one.of_number) + shifts[at(one.patch)], position);
  }
  for (std::int32_t patch = 0; patch < 2; ++patch) {
    const std::vector<GlobalIndex>& first = outline_.periodic[at(patch)].first_point;
    EXPECT_EQ(first.size(), at(kPeriodicBox.num_pieces() + 1));
    EXPECT_EQ(first.back(), 25);
    for (LocalIndex p = 0; p < kPeriodicBox.num_pieces(); ++p)
      EXPECT_EQ(first[at(p + 1)] - first[at(p)], (counts[{patch, p}]));
  }
}

TEST_F(MatchPeriodic, LeavesOutPatchesThatTheMeshHasNot)
{
  write_files(mesh::to_texts(
      std::vector<mesh::PeriodicPair>{{"left", "nowhere", shifted({1.0, 0.0, 0.0})}}));
  match();
  EXPECT_TRUE(outline_.periodic.empty());
  EXPECT_TRUE(found_.empty());
}

TEST_F(MatchPeriodic, RefusesAPointThatIsTheImageOfNone)
{
  write_files(mesh::to_texts(
      std::vector<mesh::PeriodicPair>{{"left", "right", shifted({1.0, 0.25, 0.0})}}));
  const std::string said = refusal().value_or("");
  for (const char* const word : {"the point at (1, 0, ", "\"right\"", "\"left\"", "tessera check"})
    EXPECT_NE(said.find(word), std::string::npos) << word << " in: " << said;
}

TEST_F(MatchPeriodic, RefusesTextsThatAreNone)
{
  write_files({"left", "right", "1 0 0"});
  EXPECT_NE(refusal().value_or("").find("3 x 4"), std::string::npos);
}

}  // namespace
}  // namespace tessera::formats
