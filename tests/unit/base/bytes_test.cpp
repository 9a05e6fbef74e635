// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/bytes.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "support/byte_image.hpp"

namespace tessera {
namespace {

enum class Colour : std::int32_t { red, green, blue };
constexpr Colour last_value(Colour /*type*/) { return Colour::blue; }

// Two doubles and two ints: no padding.
struct Packed {
  double x = 0.0;
  double y = 0.0;
  std::int32_t row = 0;
  std::int32_t column = 0;

  static auto fields(auto& self) { return std::tie(self.x, self.y, self.row, self.column); }
};

struct Padded {
  bool flag = false;
  double x = 0.0;
  Colour colour = Colour::red;

  static auto fields(auto& self) { return std::tie(self.flag, self.x, self.colour); }
};

struct OneOfEach {
  std::int32_t number = 0;
  std::string name{};
  std::vector<double> values{};
  std::vector<std::string> names{};
  std::vector<Packed> packed{};
  std::vector<Padded> padded{};
  std::array<float, 3> place{};
  std::optional<std::int64_t> id{};
  std::map<std::string, std::int32_t> counts{};
  std::variant<std::int32_t, Padded, std::string> choice{};
  std::vector<std::vector<std::uint64_t>> columns{};

  static auto fields(auto& self)
  {
    return std::tie(self.number, self.name, self.values, self.names, self.packed, self.padded,
                    self.place, self.id, self.counts, self.choice, self.columns);
  }
};

// Even numbers only.
class Even {
 public:
  Even() = default;
  explicit Even(int value) : value_(value) {}

  [[nodiscard]] int value() const { return value_; }
  void require_sound() const
  {
    if (value_ % 2 != 0) throw InputError("an odd number");
  }

 private:
  friend FieldAccess;
  static auto fields(auto& self) { return std::tie(self.value_); }

  int value_ = 0;
};

// Travels as a text of as many letters.
class Tally {
 public:
  using Image = std::string;

  [[nodiscard]] Image image() const { return std::string(count, 'x'); }
  void set_image(const Image& image)
  {
    if (image.find_first_not_of('x') != std::string::npos) throw InputError("other letters");
    count = image.size();
  }

  std::size_t count = 0;
};

static_assert(kIsPlain<double> && kIsPlain<std::byte> && kIsPlain<std::array<float, 3>>);
static_assert(kIsPlain<Packed> && !kIsPlain<Padded>);
static_assert(!kIsPlain<bool> && !kIsPlain<Colour>, "not every byte is a value of these");
static_assert(!HasFields<std::string> && !BoundedEnum<std::byte>);
static_assert(kLeastSize<Padded> == 13 && kLeastSize<OneOfEach> == 77);

OneOfEach one_of_each()
{
  return {.number = -7,
          .name = std::string("na\0me", 5),
          .values = {1.5, -0.0, std::numeric_limits<double>::infinity()},
          .names = {"", "two"},
          .packed = {{1.0, 2.0, 3, 4}, {5.0, 6.0, 7, 8}},
          .padded = {{true, 0.25, Colour::blue}},
          .place = {1.0F, 2.0F, 3.0F},
          .id = 1'000'000'000'000,
          .counts = {{"a", 1}, {"b", 2}},
          .choice = Padded{true, 0.5, Colour::green},
          .columns = {{}, {1, 2}}};
}

TEST(Bytes, ComeBackAsTheyWereWritten)
{
  const auto back = from_bytes<OneOfEach>(to_bytes(one_of_each()));
  EXPECT_EQ(back.number, -7);
  EXPECT_EQ(back.name, std::string("na\0me", 5));
  EXPECT_EQ(back.values, one_of_each().values);
  EXPECT_TRUE(std::signbit(back.values.at(1)));
  EXPECT_EQ(back.names, (std::vector<std::string>{"", "two"}));
  EXPECT_EQ(back.packed.at(1).column, 8);
  EXPECT_EQ(back.padded.at(0).colour, Colour::blue);
  EXPECT_EQ(back.place, (std::array<float, 3>{1.0F, 2.0F, 3.0F}));
  EXPECT_EQ(back.id, 1'000'000'000'000);
  EXPECT_EQ(back.counts, one_of_each().counts);
  EXPECT_EQ(std::get<Padded>(back.choice).x, 0.5);
  EXPECT_EQ(back.columns, one_of_each().columns);
}

TEST(Bytes, OfPartOfAValueNothingIsRead)
{
  testing::expect_round_trip(one_of_each());
  testing::expect_round_trip(OneOfEach{});
}

TEST(Bytes, GarbageIsRefusedOrAnotherValue) { testing::expect_garbage_is_harmless(one_of_each()); }

TEST(Bytes, EmptyThingsComeBackEmpty)
{
  EXPECT_EQ(to_bytes(std::vector<std::int64_t>{}).size(), 8U);
  EXPECT_TRUE(from_bytes<std::vector<std::int64_t>>(to_bytes(std::vector<std::int64_t>{})).empty());
  EXPECT_TRUE(from_bytes<std::string>(to_bytes(std::string())).empty());
  EXPECT_FALSE(from_bytes<std::optional<double>>(to_bytes(std::optional<double>())).has_value());
}

// What is longer than the rest is refused before memory is asked for.
TEST(Bytes, CountsBeyondTheEndAreRefused)
{
  for (const std::uint64_t count : {std::uint64_t{9}, std::uint64_t{1} << 40,
                                    std::uint64_t{1} << 61,  // Times 8 it wraps around to 0.
                                    std::numeric_limits<std::uint64_t>::max()}) {
    const Bytes bytes = to_bytes(std::array<std::uint64_t, 2>{count, 1});
    EXPECT_THROW(static_cast<void>(from_bytes<std::vector<double>>(bytes)), InputError) << count;
    EXPECT_THROW(static_cast<void>(from_bytes<std::vector<Padded>>(bytes)), InputError) << count;
    EXPECT_THROW(static_cast<void>(from_bytes<std::vector<Tally>>(bytes)), InputError) << count;
    EXPECT_THROW(static_cast<void>(from_bytes<std::string>(bytes)), InputError) << count;
    using Map = std::map<std::string, std::int32_t>;
    EXPECT_THROW(static_cast<void>(from_bytes<Map>(bytes)), InputError) << count;
  }
}

TEST(Bytes, ValuesOutOfRangeAreRefused)
{
  for (const std::int32_t number : {-1, 3, std::numeric_limits<std::int32_t>::max()}) {
    EXPECT_THROW(static_cast<void>(from_bytes<Colour>(to_bytes(number))), InputError) << number;
  }
  EXPECT_EQ(from_bytes<Colour>(to_bytes(std::int32_t{2})), Colour::blue);
  EXPECT_THROW(static_cast<void>(from_bytes<bool>(to_bytes(std::uint8_t{2}))), InputError);
  using Choice = std::variant<std::int32_t, double>;
  EXPECT_THROW(static_cast<void>(from_bytes<Choice>(to_bytes(std::uint32_t{2}))), InputError);
}

TEST(Bytes, AValueThatBreaksItsInvariantIsRefused)
{
  EXPECT_EQ(from_bytes<Even>(to_bytes(Even(6))).value(), 6);
  EXPECT_THROW(static_cast<void>(from_bytes<std::vector<Even>>(to_bytes(std::vector{Even(3)}))),
               InputError);
}

TEST(Bytes, AnImageTakesTheClassesPlace)
{
  const Tally five{.count = 5};
  EXPECT_EQ(to_bytes(five), to_bytes(std::string("xxxxx")));
  EXPECT_EQ(from_bytes<Tally>(to_bytes(five)).count, 5U);
  EXPECT_THROW(static_cast<void>(from_bytes<Tally>(to_bytes(std::string("xyx")))), InputError);
}

// Padding is nobody's: two equal values have equal bytes.
TEST(Bytes, HoldFieldsAndNoPadding)
{
  EXPECT_EQ(to_bytes(Padded{}).size(), sizeof(bool) + sizeof(double) + sizeof(Colour));
  EXPECT_EQ(to_bytes(std::vector<Padded>(3)).size(), 8U + 3U * 13U);
  EXPECT_EQ(to_bytes(std::vector<Packed>(3)).size(), 8U + 3U * sizeof(Packed));
}

}  // namespace
}  // namespace tessera
