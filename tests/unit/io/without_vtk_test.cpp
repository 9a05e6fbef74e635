// SPDX-License-Identifier: BSD-3-Clause
// Built only with TESSERA_WITH_VTK=OFF.
#include <fstream>

#include <gtest/gtest.h>

#include "tessera/base/error.hpp"
#include "tessera/io/vtu.hpp"

#include "support/temporary_folder.hpp"

#include "mesh_samples.hpp"

namespace tessera::io {
namespace {

using mesh::MeshArrays;
using testing::FullDisk;
using testing::message_of;
using testing::TemporaryFolder;

TEST(WithoutVtk, WhatIsReadHasTheBitsThatWereWritten)
{
  const TemporaryFolder folder;
  for (const MeshArrays& mesh : {testing::sample_tets(8), testing::sample_triangles(8)}) {
    write_vtu(mesh, folder / "piece.vtu", usual_compression());
    testing::expect_same_bits(read_vtu(folder / "piece.vtu"), mesh);
  }
}

TEST(WithoutVtk, AFullDiskIsAnOutputErrorAndLeavesNothing)
{
  const TemporaryFolder folder;
  for (const rlim_t limit : {0UL, 100UL, 4096UL, 60000UL}) {
    const FullDisk full_disk(limit);
    EXPECT_THROW(write_vtu(testing::sample_tets(8), folder / "piece.vtu", Compression::none),
                 OutputError)
        << limit;
    EXPECT_EQ(folder.num_entries(), 0U) << limit;
  }
}

TEST(WithoutVtk, CompressionIsRefusedWithTheWayOut)
{
  const TemporaryFolder folder;
  for (const Compression compression : {Compression::lz4, Compression::zlib}) {
    const std::string message = message_of<ConfigError>(
        [&] { write_vtu(testing::sample_tets(1), folder / "piece.vtu", compression); });
    EXPECT_NE(message.find("output.compression = \"none\""), std::string::npos) << message;
    EXPECT_EQ(folder.num_entries(), 0U);
  }
}

TEST(WithoutVtk, CompressedArraysAreRefusedWithTheWayOut)
{
  const TemporaryFolder folder;
  std::ofstream(folder / "piece.vtu")
      << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n"
         "<UnstructuredGrid><Piece NumberOfPoints=\"1\" NumberOfCells=\"0\">\n"
         "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"binary\">"
         "AQAAABgAAAAYAAAACwAAAA==eNpjYEAHAAAYAAE=</DataArray></Points>\n"
         "</Piece></UnstructuredGrid></VTKFile>\n";
  const std::string message =
      message_of<InputError>([&] { static_cast<void>(read_vtu(folder / "piece.vtu")); });
  EXPECT_NE(message.find("TESSERA_WITH_VTK=OFF"), std::string::npos) << message;
}

}  // namespace
}  // namespace tessera::io
