// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/piece_file.hpp"

#include <filesystem>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/io/vtu.hpp"

#include "support/filled_cube.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::subdomain {
namespace {

// All pieces of a cube go into one file.
struct FileOfPieces : testing::FilledCube {
  const testing::TemporaryFolder folder{};
  const WriteContext mesh = context();
  const io::OutputOptions options{};
  PieceFile file{mesh, options};

  FileOfPieces()
  {
    std::filesystem::create_directories(folder / "mesh");
    std::filesystem::create_directories(folder / "boundary");
  }

  [[nodiscard]] mesh::MeshArrays written(const std::string& kind, LocalIndex number) const
  {
    static_cast<void>(file.write(folder.path(), number));
    return io::read_vtu(folder.path() / piece_path(kind, number));
  }
};

void expect_every_point_once(const mesh::MeshArrays& arrays)
{
  const std::set<GlobalIndex> ids(arrays.point_ids.begin(), arrays.point_ids.end());
  EXPECT_EQ(static_cast<GlobalIndex>(ids.size()), arrays.num_points());
  const std::set<LocalIndex> used(arrays.cell_points.begin(), arrays.cell_points.end());
  EXPECT_EQ(static_cast<GlobalIndex>(used.size()), arrays.num_points());
}

TEST_F(FileOfPieces, HoldsPointsThatPiecesShareOnce)
{
  for (const FilledPiece& filled : pieces()) static_cast<void>(file.add(filled.piece));
  const mesh::MeshArrays tets = written("mesh", 7);
  EXPECT_EQ(tets.num_cells(), ids().num_tets());
  EXPECT_EQ(tets.num_points(), ids().num_vertices());
  expect_every_point_once(tets);
  const mesh::MeshArrays boundary = written("boundary", 7);
  EXPECT_EQ(boundary.num_cells(), ids().num_boundary_triangles());
  expect_every_point_once(boundary);
}

TEST_F(FileOfPieces, HoldsTheTetsOfItsPieces)
{
  Hash128 digest;
  Hash128 of_pieces;
  for (const FilledPiece& filled : pieces()) {
    digest += file.add(filled.piece);
    of_pieces += digest_of(piece_arrays(filled.piece, mesh, false).tets);
  }
  EXPECT_EQ(digest, of_pieces);
  EXPECT_EQ(digest_of(written("mesh", 0)), of_pieces);
}

TEST_F(FileOfPieces, OfOnePieceHasItsOrder)
{
  static_cast<void>(file.add(pieces()[2].piece));
  const mesh::MeshArrays arrays = piece_arrays(pieces()[2].piece, mesh, false).tets;
  EXPECT_EQ(written("mesh", 0).point_xyz, arrays.point_xyz);
  EXPECT_EQ(written("mesh", 0).cell_points, arrays.cell_points);
}

TEST_F(FileOfPieces, WithoutBoundaryHasNoBoundaryFile)
{
  mesh::Piece inner = pieces()[1].piece;
  inner.boundary_vertices.clear();
  inner.boundary_patch.clear();
  inner.boundary_tet.clear();
  static_cast<void>(file.add(inner));
  static_cast<void>(file.write(folder.path(), 3));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / piece_path("mesh", 3)));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / piece_path("boundary", 3)));
}

TEST(FileRanges, AreContiguousAndOfAlmostEqualLength)
{
  for (const LocalIndex num_subdomains : {1, 2, 7, 64}) {
    for (const LocalIndex files : {1, 2, 3, 7, 64}) {
      LocalIndex next = 0;
      LocalIndex number = 0;
      for (const SubdomainRange& range : file_ranges(num_subdomains, files)) {
        EXPECT_EQ(range.number, number++);
        EXPECT_EQ(range.first, next);
        next = range.last;
        const LocalIndex num_files = std::min(files, num_subdomains);
        EXPECT_GE(range.last - range.first, num_subdomains / num_files);
        EXPECT_LE(range.last - range.first, (num_subdomains - 1) / num_files + 1);
      }
      EXPECT_EQ(next, num_subdomains);
      EXPECT_EQ(number, std::min(files, num_subdomains));
    }
  }
}

TEST(FileRanges, ZeroMeansAFileForEachSubdomain) { EXPECT_EQ(file_ranges(5, 0).size(), 5U); }

struct PieceFiles : testing::FilledCube {
  const testing::TemporaryFolder folder{};

  PieceFiles()
  {
    std::filesystem::create_directory(folder / "mesh");
    std::filesystem::create_directory(folder / "boundary");
  }

  [[nodiscard]] std::vector<std::filesystem::path> write(const io::OutputOptions& options) const
  {
    const WriteContext context = this->context();
    PieceFile file(context, options);
    for (const FilledPiece& filled : pieces()) file.add(filled.piece);
    return file.write(folder.path(), 7);
  }
};

TEST_F(PieceFiles, AreThoseThatWriteNames)
{
  const std::vector<std::filesystem::path> written = write({});
  EXPECT_EQ(written, (std::vector<std::filesystem::path>{"mesh/piece_000007.vtu",
                                                         "boundary/piece_000007.vtu"}));
  EXPECT_EQ(io::read_vtu(folder.path() / written[0]).num_cells(), ids().num_tets());
  EXPECT_EQ(io::read_vtu(folder.path() / written[1]).num_cells(), ids().num_boundary_triangles());
}

TEST_F(PieceFiles, AreOfTheFormatsAskedForAndNoOthers)
{
  EXPECT_TRUE(std::filesystem::is_empty(folder / "mesh"));
  EXPECT_TRUE(std::filesystem::is_empty(folder / "boundary"));
}

}  // namespace
}  // namespace tessera::subdomain
