// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/bytes.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace tessera {
namespace {

Bytes one_of_each()
{
  ByteWriter out;
  out.put(std::int32_t{-7});
  out.put(std::vector<double>{1.5, -0.0, std::numeric_limits<double>::infinity()});
  out.put(std::string("na\0me", 5));
  out.put(std::vector<std::string>{"", "two"});
  return std::move(out).take();
}

void read_one_of_each(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  EXPECT_EQ(in.get<std::int32_t>(), -7);
  const auto values = in.get_vector<double>();
  EXPECT_EQ(values, (std::vector<double>{1.5, -0.0, std::numeric_limits<double>::infinity()}));
  EXPECT_TRUE(std::signbit(values.at(1)));
  EXPECT_EQ(in.get_string(), std::string("na\0me", 5));
  EXPECT_EQ(in.get_strings(), (std::vector<std::string>{"", "two"}));
  EXPECT_TRUE(in.at_end());
}

TEST(Bytes, ComeBackAsTheyWereWritten) { read_one_of_each(one_of_each()); }

TEST(Bytes, EmptyThingsComeBackEmpty)
{
  ByteWriter out;
  out.put(std::vector<std::int64_t>{});
  out.put(std::string());
  out.put(std::vector<std::string>{});
  const Bytes bytes = std::move(out).take();
  EXPECT_EQ(bytes.size(), 24U);
  ByteReader in(bytes);
  EXPECT_TRUE(in.get_vector<std::int64_t>().empty());
  EXPECT_TRUE(in.get_string().empty());
  EXPECT_TRUE(in.get_strings().empty());
  EXPECT_TRUE(in.at_end());
  EXPECT_THROW(static_cast<void>(in.get<char>()), InputError);
}

TEST(Bytes, EveryTruncationIsAnInputError)
{
  const Bytes whole = one_of_each();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(read_one_of_each(std::span(whole).first(size)), InputError) << size;
  }
}

// What is longer than the rest is refused before memory is asked for.
TEST(Bytes, SizesBeyondTheEndAreRefused)
{
  for (const std::uint64_t size : {std::uint64_t{2}, std::uint64_t{1} << 40,
                                   std::uint64_t{1} << 61,  // Times 8 it wraps around to 0.
                                   std::numeric_limits<std::uint64_t>::max()}) {
    ByteWriter out;
    out.put(size);
    out.put(1.0);
    const Bytes bytes = std::move(out).take();
    EXPECT_THROW(static_cast<void>(ByteReader(bytes).get_vector<double>()), InputError) << size;
    EXPECT_THROW(static_cast<void>(ByteReader(bytes).get_strings()), InputError) << size;
  }
}

TEST(Bytes, ReaderTakesValuesAtOddPlaces)
{
  ByteWriter out;
  out.put('x');
  out.put(2.25);
  out.put(std::vector<std::int64_t>{-1, 5});
  const Bytes bytes = std::move(out).take();
  ByteReader in(bytes);
  EXPECT_EQ(in.get<char>(), 'x');
  EXPECT_EQ(in.get<double>(), 2.25);
  EXPECT_EQ(in.get_vector<std::int64_t>(), (std::vector<std::int64_t>{-1, 5}));
}

}  // namespace
}  // namespace tessera
