// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"

#include "formats/writer.hpp"

namespace tessera::formats {
namespace {

// Two pieces side by side, each with so many tets and no open face.
Outline two_pieces(GlobalIndex num_tets)
{
  Outline outline;
  for (const LocalIndex other : {1, 0}) {
    PieceCounts piece;
    piece.num_own_points = piece.num_points = num_tets / 5;
    piece.num_tets = num_tets;
    piece.elements[Shape::tet] = {{1, num_tets}};
    piece.neighbours = {{other, 100, 0}};
    outline.pieces.push_back(piece);
    outline.first_point.push_back(outline.first_point.back() + piece.num_own_points);
    outline.first_tet.push_back(outline.first_tet.back() + num_tets);
    outline.first_cell.push_back(outline.first_tet.back());
    for (const Shape shape : kShapes)
      outline.first_of[shape].push_back(shape == Shape::tet ? outline.first_tet.back() : 0);
  }
  outline.material_names = {"steel"};
  return outline;
}

std::string refusal(io::Format format, GlobalIndex num_tets)
{
  const Outline outline = two_pieces(num_tets);
  const std::filesystem::path folder = "nowhere";
  try {
    static_cast<void>(make_writer(format, {outline, folder}));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

// A tet has two faces; OpenFOAM counts their corners with 32 bits.
constexpr GlobalIndex kFoamTets = INT32_MAX / 6;

TEST(LargeMesh, OpenfoamNeedsPiecesOfNoMoreThanItsLabelsCount)
{
  EXPECT_EQ(refusal(io::Format::openfoam, kFoamTets), "");
  const std::string message = refusal(io::Format::openfoam, kFoamTets + 1);
  EXPECT_NE(message.find("piece 0 has"), std::string::npos) << message;
  EXPECT_NE(message.find("output.parts"), std::string::npos) << message;
}

TEST(LargeMesh, SerialOpenfoamNeedsAMeshOfNoMore)
{
  EXPECT_EQ(refusal(io::Format::openfoam_serial, kFoamTets / 2), "");
  const std::string message = refusal(io::Format::openfoam_serial, kFoamTets);
  EXPECT_NE(message.find("take openfoam, with output.parts"), std::string::npos) << message;
}

TEST(LargeMesh, ElmerNeedsNumbersOf32Bits)
{
  EXPECT_EQ(refusal(io::Format::elmer, 1000000000), "");
  const std::string message = refusal(io::Format::elmer, 2000000000);
  EXPECT_NE(message.find("4000000000 cells"), std::string::npos) << message;
  EXPECT_NE(message.find("mfem"), std::string::npos) << message;
}

TEST(LargeMesh, MfemCountsOnlyWithinAPiece)
{
  EXPECT_EQ(refusal(io::Format::mfem, 2000000000), "");
}

}  // namespace
}  // namespace tessera::formats
