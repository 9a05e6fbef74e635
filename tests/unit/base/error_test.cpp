// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/error.hpp"

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <typeinfo>

#include <gtest/gtest.h>

namespace tessera {
namespace {

// The class and text of what throw_error() throws.
std::string thrown(ErrorKind kind, const std::string& text)
{
  try {
    throw_error(kind, text);
  } catch (const Error& error) {
    return std::string(typeid(error).name()) + ": " + error.what();
  }
}

template <class E>
void expect_kept()
{
  for (const std::string text : {"no solid", "", "64 solids"}) {
    EXPECT_EQ(thrown(kind_of(E(text)), text), std::string(typeid(E).name()) + ": " + text);
  }
}

TEST(ErrorKind, EveryClassIsThrownAgainAsItself)
{
  expect_kept<Error>();
  expect_kept<ConfigError>();
  expect_kept<InputError>();
  expect_kept<GeometryError>();
  expect_kept<MeshError>();
  expect_kept<NetgenError>();
  expect_kept<OutputError>();
  expect_kept<Interrupted>();
  expect_kept<UsageError>();
}

TEST(ErrorKind, OfAClassDerivedElsewhereIsThatOfItsBase)
{
  struct NoTets : MeshError {
    using MeshError::MeshError;
  };
  EXPECT_EQ(kind_of(NoTets("")), ErrorKind::mesh);
}

TEST(ErrorKind, OfOtherExceptionsIsOtherButForFiles)
{
  EXPECT_EQ(kind_of(std::logic_error("")), ErrorKind::other);
  EXPECT_EQ(kind_of(std::bad_alloc()), ErrorKind::other);
  const auto no_space = std::make_error_code(std::errc::no_space_on_device);
  EXPECT_EQ(kind_of(std::filesystem::filesystem_error("", no_space)), ErrorKind::output);
}

// What a job sends may have been damaged by the third-party code that it ran.
TEST(ErrorKind, ANumberThatIsNoneStillThrows)
{
  EXPECT_EQ(thrown(static_cast<ErrorKind>(1234), "lost"),
            std::string(typeid(Error).name()) + ": lost");
}

}  // namespace
}  // namespace tessera
