// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "tessera/io/vtu.hpp"
#include "tessera/subdomain/piece_file.hpp"

#include "support/filled_cube.hpp"
#include "support/temporary_folder.hpp"

namespace tessera::subdomain {
namespace {

namespace fs = std::filesystem;

struct PieceFiles : testing::FilledCube {
  const testing::TemporaryFolder folder{};

  PieceFiles()
  {
    fs::create_directory(folder / "mesh");
    fs::create_directory(folder / "boundary");
  }

  [[nodiscard]] std::vector<fs::path> write(const io::OutputOptions& options) const
  {
    const WriteContext context = this->context();
    PieceFile file(context, options);
    for (const FilledPiece& filled : pieces()) file.add(filled.piece);
    return file.write(folder.path(), 7);
  }
};

TEST_F(PieceFiles, AreThoseThatWriteNames)
{
  const std::vector<fs::path> written = write({});
  EXPECT_EQ(written, (std::vector<fs::path>{"mesh/piece_000007.vtu", "boundary/piece_000007.vtu"}));
  EXPECT_EQ(io::read_vtu(folder.path() / written[0]).num_cells(), ids().num_tets());
  EXPECT_EQ(io::read_vtu(folder.path() / written[1]).num_cells(), ids().num_boundary_triangles());
}

TEST_F(PieceFiles, AreOfTheFormatsAskedForAndNoOthers)
{
  EXPECT_EQ(write({.formats = {}}), std::vector<fs::path>{});
  EXPECT_TRUE(fs::is_empty(folder / "mesh"));
  EXPECT_TRUE(fs::is_empty(folder / "boundary"));
}

}  // namespace
}  // namespace tessera::subdomain
