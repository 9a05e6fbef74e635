// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/hash.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <set>
#include <string>

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
