// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/msh.hpp"

#include <filesystem>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "formats/writers/msh2.hpp"
#include "formats/writers/msh_sections.hpp"

namespace tessera::formats {
namespace {

// A mesh of one piece that only its counts tell of.
Outline outline_of(GlobalIndex num_tets, GlobalIndex num_triangles)
{
  Outline outline;
  PieceCounts piece{.num_own_points = 4, .num_points = 4, .num_tets = num_tets};
  piece.elements[Shape::tet] = {{1, num_tets}};
  piece.elements[Shape::triangle] = {{1, num_triangles}};
  piece.box.include({{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  outline.pieces = {piece};
  outline.first_point = {0, 4};
  outline.first_tet = {0, num_tets};
  outline.first_cell = {0, num_tets};
  for (const Shape shape : kShapes) outline.first_of[shape] = {0, 0};
  outline.first_of[Shape::tet] = {0, num_tets};
  outline.first_of[Shape::triangle] = {0, num_triangles};
  outline.material_names = {"steel"};
  outline.patch_names = {"skin"};
  return outline;
}

TEST(Msh2Writer, RefusesMoreElementsThanItHasNumbersForAndNamesOtherFormats)
{
  constexpr GlobalIndex kMost = std::numeric_limits<std::int32_t>::max();
  const std::filesystem::path folder = "nowhere";
  const Outline fits = outline_of(kMost - 10, 10);
  EXPECT_NE(make_msh2_writer({fits, folder}), nullptr);
  const Outline too_large = outline_of(kMost - 10, 11);
  EXPECT_NE(make_msh_writer({too_large, folder}), nullptr);
  try {
    static_cast<void>(make_msh2_writer({too_large, folder}));
    ADD_FAILURE() << "not refused";
  } catch (const ConfigError& error) {
    const std::string said = error.what();
    for (const char* const word : {"msh2", "2147483647", "2147483637 cells", "11 faces", "xdmf"})
      EXPECT_NE(said.find(word), std::string::npos) << word << " in: " << said;
  }
}

TEST(MshEntities, HaveNamesThatNoOtherGroupHasWhateverTheDimension)
{
  Outline outline = outline_of(1, 1);
  outline.material_names = {"a\"b", "rotor", "empty"};
  outline.patch_names = {"rotor", "a_b"};
  std::vector<std::string> names;
  for (const MshEntity& entity : msh_entities(outline)) names.push_back(entity.name);
  EXPECT_EQ(names, (std::vector<std::string>{"rotor_2", "a_b_2", "a_b", "rotor", "empty"}));
}

TEST(MshEntities, WithoutCellsHaveTheBoxOfTheMesh)
{
  Outline outline = outline_of(1, 1);
  outline.material_names.emplace_back("empty");
  for (const MshEntity& entity : msh_entities(outline)) {
    EXPECT_EQ(entity.box.low, (Vec3{0.0, 0.0, 0.0})) << entity.name;
    EXPECT_EQ(entity.box.high, (Vec3{1.0, 1.0, 1.0})) << entity.name;
  }
}

}  // namespace
}  // namespace tessera::formats
