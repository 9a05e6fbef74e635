// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/mesh/periodic_pairs.hpp"

#include "support/periodic_box.hpp"
#include "support/shared_folder.hpp"

#include "formats/foam/cyclic.hpp"
#include "formats/foam/faces.hpp"
#include "formats/link/match_periodic.hpp"

namespace tessera::formats {
namespace {

struct Found {
  std::int32_t patch = 0;
  GlobalIndex number = 0;
  LocalIndex piece = 0;
  LocalIndex other_piece = 0;
  std::array<Vec3, 3> corners{};

  static auto fields(auto& self)
  {
    return std::tie(self.patch, self.number, self.piece, self.other_piece, self.corners);
  }
};

class MatchCyclic : public ::testing::Test {
 protected:
  // Collective. The faces that all ranks find, by patch and number.
  [[nodiscard]] std::vector<Found> match(const std::vector<mesh::PeriodicPair>& pairs)
  {
    testing::write_periodic_box(folder_, mesh::to_texts(pairs), comm_);
    const PieceSource source(folder_ / "mesh.pvtu", comm_);
    LinkedMesh mesh = link_pieces(source, comm_, [] {}, {.patch_points = true});
    all_or_none(comm_,
                [&] { mesh.outline.periodic = periodic_patches(source.names(), mesh.outline); });
    const auto cyclic = match_cyclic_faces(source, mesh, comm_, [] {});
    std::vector<Found> own;
    for (std::size_t i = 0; i < mesh.links.size(); ++i) {
      const LocalIndex number = source.first_of(comm_.rank()) + static_cast<LocalIndex>(i);
      Piece piece = build_piece(source.load(number), number, mesh.links[i], mesh);
      piece.cyclic_faces = cyclic[i];
      for (std::int32_t tag = 1; tag <= 5; ++tag) append_found(piece, tag, own);
    }
    std::vector<Found> found = comm_.all_gather_rows(own);
    std::ranges::sort(found, {}, [](const Found& one) { return std::pair(one.patch, one.number); });
    return found;
  }

  const comm::Communicator comm_{MPI_COMM_WORLD};
  testing::SharedFolder folder_{comm_};

 private:
  static void append_found(const Piece& piece, std::int32_t tag, std::vector<Found>& found)
  {
    const auto cyclic = cyclic_faces_of(piece, tag);
    const std::vector<FoamFace> faces = foam_cyclic_faces(piece, cyclic);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto corner = [&](std::size_t i) {
        return point_at(std::span<const double>(piece.point_xyz), faces[f].points[i]);
      };
      found.push_back({tag,
                       cyclic[f].number,
                       piece.number,
                       cyclic[f].other_piece,
                       {corner(0), corner(1), corner(2)}});
    }
  }
};

TEST_F(MatchCyclic, PartnersHaveOneNumberAndBeginWithPartners)
{
  const std::vector<Vec3> shifts{{1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}};
  const std::vector<Found> found =
      match({{"left", "right", {.shift = shifts[0]}}, {"back", "front", {.shift = shifts[1]}}});
  std::map<std::int32_t, std::vector<Found>> of_patch;
  for (const Found& one : found) of_patch[one.patch].push_back(one);
  ASSERT_EQ(of_patch.size(), 4U);
  for (const auto& [from, to, shift] : {std::tuple{1, 2, shifts[0]}, std::tuple{4, 3, shifts[1]}}) {
    const std::vector<Found>& originals = of_patch[from];
    const std::vector<Found>& images = of_patch[to];
    ASSERT_EQ(originals.size(), 32U);
    ASSERT_EQ(images.size(), 32U);
    for (std::size_t i = 0; i < originals.size(); ++i) {
      const auto& [a, b, c] = originals[i].corners;
      EXPECT_EQ(originals[i].number, static_cast<GlobalIndex>(i));
      EXPECT_EQ(images[i].number, static_cast<GlobalIndex>(i));
      EXPECT_EQ(images[i].corners, (std::array{a + shift, c + shift, b + shift}));
      EXPECT_EQ(originals[i].other_piece, images[i].piece);
      EXPECT_EQ(images[i].other_piece, originals[i].piece);
    }
  }
}

TEST_F(MatchCyclic, RefusesAFaceWithoutAPartner)
{
  try {
    static_cast<void>(match({{"left", "right", {.shift = {1.0, 0.25, 0.0}}}}));
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    const std::string said = error.what();
    for (const char* const word : {"no partner", "\"left\"", "\"right\"", "tessera check"})
      EXPECT_NE(said.find(word), std::string::npos) << word << " in: " << said;
  }
}

TEST_F(MatchCyclic, RefusesAPatchWithTwoPartners)
{
  try {
    static_cast<void>(match({{"left", "right", {.shift = {1.0, 0.0, 0.0}}},
                             {"left", "back", {.shift = {0.0, 1.0, 0.0}}}}));
    ADD_FAILURE() << "nothing was thrown";
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("\"left\" is in two pairs"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace tessera::formats
