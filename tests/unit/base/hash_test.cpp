// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/hash.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

struct Tet {
  std::array<GlobalIndex, 4> ids{0, 1, 2, 3};
  std::array<double, 12> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::int32_t material = 1;

  [[nodiscard]] std::string hash() const { return to_hex(hash_tet(ids, xyz, material)); }
};

template <class T>
void flip_bit(T& value, int bit)
{
  std::uint64_t image = 0;
  std::memcpy(&image, &value, sizeof(T));
  image ^= std::uint64_t{1} << bit;
  std::memcpy(&value, &image, sizeof(T));
}

TEST(HashTet, ChangesWithEveryBit)
{
  std::set<std::string> hashes{Tet().hash()};
  std::size_t made = 1;
  for (int bit = 0; bit < 64; ++bit) {
    for (std::size_t i = 0; i < 4; ++i, ++made) {
      Tet tet;
      flip_bit(tet.ids[i], bit);
      hashes.insert(tet.hash());
    }
    for (std::size_t i = 0; i < 12; ++i, ++made) {
      Tet tet;
      flip_bit(tet.xyz[i], bit);  // Bit 63 of a zero: -0.0 is another position.
      hashes.insert(tet.hash());
    }
  }
  for (int bit = 0; bit < 32; ++bit, ++made) {
    Tet tet;
    flip_bit(tet.material, bit);
    hashes.insert(tet.hash());
  }
  EXPECT_EQ(hashes.size(), made);
}

TEST(HashTet, IsThatOfItsRecordOnEveryMachine)
{
  struct Record {
    std::array<std::int64_t, 4> ids{0, 1, 2, 3};
    std::array<double, 12> xyz = Tet().xyz;
    std::int64_t material = 1;
  };
  const Record record;
  EXPECT_EQ(to_hex(hash_bytes(std::as_bytes(std::span(&record, 1)))), Tet().hash());
  // From the published test of XXH3: nothing hashes to this.
  EXPECT_EQ(to_hex(hash_bytes({})), "99aa06d3014798d86001c324468d497f");
}

TEST(HashTets, IsTheSumOverTheTets)
{
  const std::vector<LocalIndex> tet_vertices{0, 1, 2, 3, 4, 3, 2, 1};
  const std::vector<GlobalIndex> vertex_ids{10, 7, 8, 1LL << 40, 3};
  const std::vector<double> xyz{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 2, 2, 2};
  const Tet first{{10, 7, 8, 1LL << 40}, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 5};
  const Tet second{{3, 1LL << 40, 8, 7}, {2, 2, 2, 0, 0, 1, 0, 1, 0, 1, 0, 0}, -1};
  Hash128 sum = hash_tet(first.ids, first.xyz, first.material);
  sum += hash_tet(second.ids, second.xyz, second.material);
  EXPECT_EQ(hash_tets(tet_vertices, vertex_ids, xyz, std::vector{5, -1}), sum);
  EXPECT_EQ(hash_tets({}, {}, {}, {}), Hash128{});
}

TEST(Hash128, SumsDoNotDependOnOrderAndWrapAround)
{
  const Hash128 a{std::numeric_limits<std::uint64_t>::max(), 7};
  const Hash128 b{2, std::numeric_limits<std::uint64_t>::max()};
  Hash128 ab = a;
  ab += b;
  Hash128 ba = b;
  ba += a;
  EXPECT_EQ(ab, ba);
  EXPECT_EQ(ab, (Hash128{1, 6}));
  ab -= a;
  ab -= b;
  EXPECT_EQ(ab, Hash128{});
}

TEST(Hash128, HexHasTheHighHalfFirst)
{
  EXPECT_EQ(to_hex({0x1, 0xABCDEF0000000000U}), "abcdef00000000000000000000000001");
  EXPECT_EQ(to_hex({}), std::string(32, '0'));
}

}  // namespace
}  // namespace tessera
