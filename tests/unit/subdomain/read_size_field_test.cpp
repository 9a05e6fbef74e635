// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/read_size_field.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::subdomain {
namespace {

using testing::kuhn_cube;
using testing::message_of;
using testing::TemporaryFolder;
using testing::write_bytes;

// A grid around the unit cube whose array "h" grows from 1 at x = 0 to 2 at x = 1.
constexpr const char* kImage =
    "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"0 1 0 1 0 1\">"
    "<Piece Extent=\"0 1 0 1 0 1\"><PointData><DataArray type=\"Float64\" Name=\"h\" "
    "format=\"ascii\">1 2 1 2 1 2 1 2</DataArray></PointData></Piece></ImageData></VTKFile>\n";

TEST(ReadSizeField, TakesTheArrayOfTheFile)
{
  const TemporaryFolder folder;
  write_bytes(folder / "f.vti", kImage);
  const sizing::SizeOptions options{
      .target = 1.75, .grading = 1.0, .field = folder / "f.vti", .field_array = "h"};
  const sizing::SizeField sizes = read_size_field(options, kuhn_cube(1));
  EXPECT_DOUBLE_EQ(sizes.at(Vec3{0.5, 0.2, 0.9}).front(), 1.5);
  EXPECT_DOUBLE_EQ(sizes.at(Vec3{0.9, 0.2, 0.9}).front(), 1.75);
  EXPECT_NE(sizes.field_content(), Hash128{});
}

TEST(ReadSizeField, NeedsNoFile)
{
  const sizing::SizeField sizes = read_size_field({.target = 0.5}, kuhn_cube(1));
  EXPECT_EQ(sizes.at(Vec3{0.5, 0.2, 0.9}).front(), 0.5);
}

TEST(ReadSizeField, NamesTheKeyOfAFileThatCannotBeUsed)
{
  const TemporaryFolder folder;
  write_bytes(folder / "f.vti", kImage);
  const auto error_of = [&](const char* file, const char* array) {
    return message_of<InputError>([&] {
      (void)read_size_field({.field = folder / file, .field_array = array}, kuhn_cube(1));
    });
  };
  EXPECT_TRUE(error_of("none.vti", "h").starts_with("size.field: ")) << error_of("none.vti", "h");
  EXPECT_NE(error_of("f.vti", "x").find("no point array \"x\" with one component; it has \"h\""),
            std::string::npos);
}

}  // namespace
}  // namespace tessera::subdomain
