// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/config/case.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::config {
namespace {

constexpr const char* kContact = "[[geometry.contact]]\nbody = 'shaft'\nother = '2'\n";

Case parsed(const std::string& lines, const std::string& model = "a.step")
{
  return parse_case("geometry.file = '" + model + "'\n" + lines, "/cases/case.toml", {});
}

std::string error_of(const std::string& lines, const std::string& model = "a.step")
{
  return testing::message_of<ConfigError>([&] { (void)parsed(lines, model); });
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST(Assemblies, AreThoseOfTheCase)
{
  const Case loaded = parsed(std::string("size.target = 1\ngeometry.overlap = 'last'\n")
                             + "geometry.gap = 0.5\n" + kContact);
  EXPECT_EQ(loaded.geometry.assembly,
            (model::AssemblyOptions{.overlap = model::Overlap::last, .gap = 0.5}));
  EXPECT_EQ(loaded.splits, (topology::SplitOptions{.contacts = {{"shaft", "2"}}}));
  EXPECT_EQ(parse_case(to_toml(loaded), "/cases/case.toml", {}), loaded);
}

TEST(Assemblies, AreRefusedToOverlapUnlessTheCaseSaysMore)
{
  const Case loaded = parsed("size.target = 1\n");
  EXPECT_EQ(loaded.geometry.assembly.overlap, model::Overlap::error);
  EXPECT_LT(loaded.geometry.assembly.gap, 0.0);
  EXPECT_FALSE(contains(to_toml(loaded), "gap = "));
}

TEST(Assemblies, AreOfModelsWithSolids)
{
  for (const char* model : {"a.geo", "a.STL", "a.msh"}) {
    const std::string size = model[2] == 'm' ? "" : "size.target = 1\n";
    for (const char* lines : {"geometry.overlap = 'cut'\n", "geometry.gap = 0\n"}) {
      EXPECT_TRUE(contains(error_of(size + lines, model), "are for .step, .iges and .brep"))
          << model << lines;
    }
  }
  EXPECT_EQ(parsed("geometry.cad = 'a.step'\ngeometry.overlap = 'first'\n", "a.msh")
                .geometry.assembly.overlap,
            model::Overlap::first);
}

TEST(Assemblies, MayHaveContactsWhateverTheModel)
{
  for (const char* model : {"a.geo", "a.stl", "a.step"}) {
    EXPECT_EQ(parsed(std::string("size.target = 1\n") + kContact, model).splits.contacts.size(),
              1U);
  }
  EXPECT_TRUE(contains(error_of("size.target = 1\n[[geometry.contact]]\nbody = 'a'\n"),
                       "no geometry.contact.other"));
}

}  // namespace
}  // namespace tessera::config
