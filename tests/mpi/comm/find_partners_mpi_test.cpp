// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/comm/communicator.hpp"
#include "tessera/comm/find_partners.hpp"

namespace tessera::comm {
namespace {

constexpr GlobalIndex kNumPoints = 3000;
constexpr GlobalIndex kImage = 1'000'000;  // What labels of images begin with.

// Somewhere in a cube of length 2.
Vec3 place_of(GlobalIndex number)
{
  const auto part = [&](double step) {
    return 2.0 * std::fmod(step * static_cast<double>(number + 1), 1.0);
  };
  return {part(0.618033988749895), part(0.754877666246693), part(0.819172513396164)};
}

class FindPartners : public ::testing::Test {
 protected:
  [[nodiscard]] bool is_mine(GlobalIndex number) const
  {
    return number % comm_.size() == comm_.rank();
  }

  const Communicator comm_{MPI_COMM_WORLD};
};

TEST_F(FindPartners, AreWherePointsAreWhoeverHasThem)
{
  std::vector<SidePoint> points;
  for (GlobalIndex i = 0; i < kNumPoints; ++i) {
    const Vec3 place = place_of(i);
    if (is_mine(i)) points.push_back({.place = place, .label = i});
    const Vec3 image = place + Vec3{1e-10, -1e-10, 1e-10};
    if (is_mine(i / 7)) points.push_back({.place = image, .label = kImage + i, .is_image = true});
  }
  const std::vector<GlobalIndex> partners = find_partners(points, comm_);
  EXPECT_EQ(partners.size(), points.size());
  for (std::size_t p = 0; p < partners.size(); ++p) {
    const GlobalIndex label = points[p].label;
    EXPECT_EQ(partners[p], points[p].is_image ? label - kImage : label + kImage);
  }
}

TEST_F(FindPartners, AreOfOneGroupOnTheOtherSideAndNear)
{
  // Rank 0 asks; the others have what may be a partner.
  constexpr Vec3 kPlace{1.0, 2.0, 3.0};
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<SidePoint> points;
  if (comm_.rank() == 0) {
    points = {{.place = kPlace, .label = 0},
              {.place = kPlace, .label = 1, .group = 1},
              {.place = kPlace, .label = 2, .group = 2},
              {.place = {kNan, 2.0, 3.0}, .label = 3}};
  }
  if (comm_.rank() + 1 == comm_.size()) {
    points.push_back({.place = kPlace + Vec3{2e-9, 0.0, 0.0}, .label = 8, .is_image = true});
    points.push_back({.place = kPlace + Vec3{1e-9, 0.0, 0.0}, .label = 9, .is_image = true});
    points.push_back({.place = kPlace, .label = 10, .group = 1});
    points.push_back(
        {.place = kPlace + Vec3{4e-9, 0.0, 0.0}, .label = 11, .group = 2, .is_image = true});
  }
  const std::vector<GlobalIndex> partners = find_partners(points, comm_);
  if (comm_.rank() == 0) {
    const std::vector<GlobalIndex> first(partners.begin(), partners.begin() + 4);
    EXPECT_EQ(first, (std::vector<GlobalIndex>{9, kNoPartner, kNoPartner, kNoPartner}));
  }
  if (comm_.rank() + 1 == comm_.size()) {
    const std::vector<GlobalIndex> last(partners.end() - 4, partners.end());
    EXPECT_EQ(last, (std::vector<GlobalIndex>{0, 0, kNoPartner, kNoPartner}));
  }
}

TEST_F(FindPartners, OfTwoAtOnePlaceIsTheOneOfTheLeastLabel)
{
  std::vector<SidePoint> points{{.place = {1.0, 1.0, 1.0}, .label = comm_.rank() + 5}};
  points.push_back({.place = {1.0, 1.0, 1.0}, .label = 50 - comm_.rank(), .is_image = true});
  const std::vector<GlobalIndex> partners = find_partners(points, comm_);
  EXPECT_EQ(partners, (std::vector<GlobalIndex>{51 - comm_.size(), 5}));
}

TEST_F(FindPartners, OfNothingIsNothing) { EXPECT_TRUE(find_partners({}, comm_).empty()); }

}  // namespace
}  // namespace tessera::comm
