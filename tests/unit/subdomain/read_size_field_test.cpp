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
}

TEST(SizeFieldContent, IsThatOfAllValues)
{
  const TemporaryFolder folder;
  const auto content_of = [&](const std::string& image) {
    write_bytes(folder / "f.vti", image);
    return size_field_content({.field = folder / "f.vti", .field_array = "h"});
  };
  const std::string image = kImage;
  const Hash128 content = content_of(image);
  EXPECT_NE(content, Hash128{});
  EXPECT_EQ(content_of(image), content);
  const std::size_t last = image.rfind("2</DataArray>");
  EXPECT_NE(content_of(std::string(image).replace(last, 1, "3")), content);
  EXPECT_EQ(size_field_content({.target = 1.0}), Hash128{});
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
