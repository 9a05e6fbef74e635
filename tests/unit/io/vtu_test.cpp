// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/vtu.hpp"

#include <fstream>
#include <iterator>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkStringOutputWindow.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "tessera/base/error.hpp"

#include "support/temporary_folder.hpp"

#include "mesh_samples.hpp"

namespace tessera::io {
namespace {

using mesh::MeshArrays;
using testing::FullDisk;
using testing::message_of;
using testing::TemporaryFolder;

/// @brief While it lives, what any VTK object warns of is kept in place of being printed.
class VtkListener {
 public:
  VtkListener() { vtkOutputWindow::SetInstance(window_); }
  ~VtkListener() { vtkOutputWindow::SetInstance(nullptr); }
  VtkListener(const VtkListener&) = delete;
  VtkListener& operator=(const VtkListener&) = delete;

  [[nodiscard]] std::string heard() { return window_->GetOutput(); }

 private:
  vtkNew<vtkStringOutputWindow> window_{};
};

/// @brief Reads with VTK's own reader, which must have nothing to warn of.
template <class Reader>
[[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> read_with_vtk(const std::filesystem::path& path)
{
  VtkListener listener;
  const vtkNew<Reader> reader;
  EXPECT_TRUE(reader->CanReadFile(path.c_str()));
  reader->SetFileName(path.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetErrorCode(), 0U);
  EXPECT_EQ(listener.heard(), "");
  return reader->GetOutput();
}

class WithCompression : public ::testing::TestWithParam<Compression> {};
INSTANTIATE_TEST_SUITE_P(All, WithCompression,
                         ::testing::Values(Compression::none, Compression::lz4, Compression::zlib));

TEST_P(WithCompression, WhatIsReadHasTheBitsThatWereWritten)
{
  const TemporaryFolder folder;
  for (const MeshArrays& mesh : {testing::sample_tets(8), testing::sample_triangles(8)}) {
    write_vtu(mesh, folder / "piece 1.vtu", GetParam());
    testing::expect_same_bits(read_vtu(folder / "piece 1.vtu"), mesh);
  }
}

TEST_P(WithCompression, EdgesOfBothOrdersAreReadBack)
{
  const TemporaryFolder folder;
  for (const int num_points : {2, 3}) {
    MeshArrays edges{.vertices_per_cell = num_points, .are_edges = true};
    edges.point_xyz = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0};
    edges.point_ids = {5, 7, 8, 9};
    edges.cell_points = num_points == 2 ? std::vector<LocalIndex>{0, 1, 2, 3}
                                        : std::vector<LocalIndex>{0, 2, 1, 2, 0, 3};
    edges.cell_ids = {0, 1};
    edges.cell_ints["line"] = {0, 1};
    edges.field_texts["line_names"] = {"well", "track"};
    write_vtu(edges, folder / "edges.vtu", GetParam());
    const MeshArrays read = read_vtu(folder / "edges.vtu", CellOrder::edges);
    EXPECT_TRUE(read.are_edges);
    testing::expect_same_bits(read, edges);
    EXPECT_EQ(read_vtu(folder / "edges.vtu").num_cells(), 0);  // Neither tets nor triangles.
  }
}

TEST_P(WithCompression, EqualArraysGiveEqualBytes)
{
  const TemporaryFolder folder;
  write_vtu(testing::sample_tets(3), folder / "a.vtu", GetParam());
  write_vtu(testing::sample_tets(3), folder / "b.vtu", GetParam());
  EXPECT_EQ(testing::file_bytes(folder / "a.vtu"), testing::file_bytes(folder / "b.vtu"));
  EXPECT_EQ(testing::file_bytes(folder / "a.vtu").find(folder.path().string()), std::string::npos);
}

TEST_P(WithCompression, VtkReadsAPieceWithoutAWarning)
{
  const TemporaryFolder folder;
  const MeshArrays mesh = testing::sample_tets(4);
  write_vtu(mesh, folder / "piece.vtu", GetParam());
  const auto grid = read_with_vtk<vtkXMLUnstructuredGridReader>(folder / "piece.vtu");

  ASSERT_EQ(grid->GetNumberOfPoints(), mesh.num_points());
  ASSERT_EQ(grid->GetNumberOfCells(), mesh.num_cells());
  EXPECT_FALSE(grid->GetCells()->IsStorage64Bit());
  EXPECT_STREQ(grid->GetPointData()->GetArray("owner")->GetDataTypeAsString(), "int");
  ASSERT_NE(grid->GetPointData()->GetGlobalIds(), nullptr);
  ASSERT_NE(grid->GetCellData()->GetGlobalIds(), nullptr);
  EXPECT_EQ(grid->GetCellData()->GetGlobalIds()->GetVariantValue(5).ToLongLong(), mesh.cell_ids[5]);
  auto* const names =
      vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("patch_names"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->GetValue(2), mesh.field_texts.at("patch_names")[2]);
}

TEST(WriteVtu, AnEmptyPieceIsReadBackEmpty)
{
  const TemporaryFolder folder;
  MeshArrays mesh;
  mesh.point_ints["owner"];
  mesh.cell_ints["attribute"];
  write_vtu(mesh, folder / "piece.vtu", Compression::lz4);
  testing::expect_same_bits(read_vtu(folder / "piece.vtu"), mesh);
  const auto grid = read_with_vtk<vtkXMLUnstructuredGridReader>(folder / "piece.vtu");
  EXPECT_EQ(grid->GetNumberOfCells(), 0);
}

TEST(WriteVtu, PositionsKeepTheirBitsEvenIfTheyAreNoNumbers)
{
  const TemporaryFolder folder;
  MeshArrays mesh = testing::sample_tets(1);
  mesh.point_xyz[0] = -0.0;
  mesh.point_xyz[1] = std::numeric_limits<double>::quiet_NaN();
  mesh.point_xyz[2] = std::numeric_limits<double>::denorm_min();
  mesh.point_xyz[3] = std::numeric_limits<double>::infinity();
  write_vtu(mesh, folder / "piece.vtu", Compression::lz4);
  testing::expect_same_bits(read_vtu(folder / "piece.vtu"), mesh);
}

TEST(WriteVtu, RefusesArraysThatDoNotFitTogether)
{
  const TemporaryFolder folder;
  MeshArrays wrong_size = testing::sample_tets(1);
  wrong_size.cell_ints["attribute"].pop_back();
  EXPECT_THROW(write_vtu(wrong_size, folder / "a.vtu", Compression::none), MeshError);
  MeshArrays wrong_point = testing::sample_tets(1);
  wrong_point.cell_points[3] = static_cast<LocalIndex>(wrong_point.num_points());
  EXPECT_THROW(write_vtu(wrong_point, folder / "a.vtu", Compression::none), MeshError);
  EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(WriteVtu, AFullDiskIsAnOutputErrorAndLeavesNothing)
{
  const TemporaryFolder folder;
  const MeshArrays mesh = testing::sample_tets(8);
  for (const rlim_t limit : {0UL, 100UL, 4096UL, 20000UL, 60000UL}) {
    const FullDisk full_disk(limit);
    const std::string message =
        message_of<OutputError>([&] { write_vtu(mesh, folder / "piece.vtu", Compression::none); });
    EXPECT_NE(message.find("piece.vtu: "), std::string::npos) << limit << ": " << message;
    EXPECT_EQ(folder.num_entries(), 0U) << limit;
  }
}

TEST(WriteVtu, ADiskThatIsShortOfTheLastByteIsAnOutputError)
{
  const TemporaryFolder folder;
  const MeshArrays mesh = testing::sample_tets(2);
  write_vtu(mesh, folder / "whole.vtu", Compression::lz4);
  const auto size = std::filesystem::file_size(folder / "whole.vtu");
  {
    const FullDisk full_disk(size - 1);
    EXPECT_THROW(write_vtu(mesh, folder / "piece.vtu", Compression::lz4), OutputError);
  }
  EXPECT_EQ(folder.num_entries(), 1U);
}

TEST(WriteVtu, AFailedWriteKeepsTheOlderFile)
{
  const TemporaryFolder folder;
  write_vtu(testing::sample_tets(1), folder / "piece.vtu", Compression::none);
  {
    const FullDisk full_disk(4096);
    EXPECT_THROW(write_vtu(testing::sample_tets(8), folder / "piece.vtu", Compression::none),
                 OutputError);
  }
  testing::expect_same_bits(read_vtu(folder / "piece.vtu"), testing::sample_tets(1));
}

TEST(WriteVtu, AFolderThatIsMissingIsNamed)
{
  const TemporaryFolder folder;
  const std::string message = message_of<OutputError>(
      [&] { write_vtu(testing::sample_tets(1), folder / "missing/piece.vtu", Compression::none); });
  EXPECT_NE(message.find("missing/piece.vtu: No such file"), std::string::npos) << message;
}

TEST(WritePvtu, VtkReadsAllPiecesWithoutAWarning)
{
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "mesh");
  const MeshArrays mesh = testing::sample_tets(2);
  MeshArrays empty;
  empty.point_ints["owner"];
  empty.cell_ints["attribute"];
  empty.cell_doubles["mean_ratio"];
  write_vtu(mesh, folder / "mesh/piece_000000.vtu", Compression::lz4);
  write_vtu(mesh, folder / "mesh/piece & 1.vtu", Compression::lz4);
  write_pvtu(folder / "mesh.pvtu", {"mesh/piece_000000.vtu", "mesh/piece & 1.vtu"}, mesh);

  const auto grid = read_with_vtk<vtkXMLPUnstructuredGridReader>(folder / "mesh.pvtu");
  EXPECT_EQ(grid->GetNumberOfCells(), 2 * mesh.num_cells());
  EXPECT_EQ(grid->GetNumberOfPoints(), 2 * mesh.num_points());
  EXPECT_NE(grid->GetPointData()->GetGlobalIds(), nullptr);
  EXPECT_NE(grid->GetCellData()->GetGlobalIds(), nullptr);
  EXPECT_NE(grid->GetCellData()->GetArray("mean_ratio"), nullptr);
  auto* const names =
      vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("patch_names"));
  ASSERT_NE(names, nullptr);
  EXPECT_EQ(names->GetValue(2), mesh.field_texts.at("patch_names")[2]);
}

TEST(WritePvtu, NamesNeighboursInTheFieldData)
{
  const TemporaryFolder folder;
  const MeshArrays mesh = testing::sample_tets(1);
  write_vtu(mesh, folder / "a.vtu", Compression::lz4);
  const std::vector<SharedPoints> neighbours{{0, 1, 5}, {0, 2, 5'000'000'000}};
  write_pvtu(folder / "mesh.pvtu", {"a.vtu", "a.vtu", "a.vtu"}, mesh, neighbours);
  const auto grid = read_with_vtk<vtkXMLPUnstructuredGridReader>(folder / "mesh.pvtu");
  EXPECT_EQ(grid->GetNumberOfCells(), 3 * mesh.num_cells());
  std::ifstream file(folder / "mesh.pvtu");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(text.find("0 1 5\n0 2 5000000000\n"), std::string::npos);
  EXPECT_EQ(piece_files(folder / "mesh.pvtu").size(), 3U);
}

TEST(WritePvtu, VtkReadsAnEmptyPieceAmongOthersWithoutAWarning)
{
  const TemporaryFolder folder;
  const MeshArrays mesh = testing::sample_triangles(2);
  MeshArrays empty;
  empty.vertices_per_cell = 3;
  empty.point_ints["owner"];
  empty.cell_ints["patch"];
  empty.cell_longs["tet"];
  write_vtu(mesh, folder / "a.vtu", Compression::lz4);
  write_vtu(empty, folder / "b.vtu", Compression::lz4);
  write_pvtu(folder / "boundary.pvtu", {"a.vtu", "b.vtu"}, mesh);
  const auto grid = read_with_vtk<vtkXMLPUnstructuredGridReader>(folder / "boundary.pvtu");
  EXPECT_EQ(grid->GetNumberOfCells(), mesh.num_cells());
  EXPECT_NE(grid->GetCellData()->GetArray("tet"), nullptr);
}

TEST(PieceFiles, NamesThePiecesOfAnIndexInItsOrder)
{
  const TemporaryFolder folder;
  write_pvtu(folder / "mesh.pvtu", {"mesh/b & c.vtu", "mesh/a.vtu"}, testing::sample_tets(1));
  const std::vector<std::filesystem::path> expected{folder / "mesh/b & c.vtu",
                                                    folder / "mesh/a.vtu"};
  EXPECT_EQ(piece_files(folder / "mesh.pvtu"), expected);
}

TEST(PieceFiles, ASinglePieceIsItsOwnList)
{
  const TemporaryFolder folder;
  write_vtu(testing::sample_tets(1), folder / "a.vtu", Compression::lz4);
  EXPECT_EQ(piece_files(folder / "a.vtu"), std::vector{folder / "a.vtu"});
}

TEST(PieceFiles, RefusesPiecesOutsideOfTheFolderOfTheIndex)
{
  const TemporaryFolder folder;
  for (const char* const outside : {"../other.vtu", "/etc/passwd", "mesh/../../other.vtu", ""}) {
    write_pvtu(folder / "mesh.pvtu", {outside}, MeshArrays{});
    EXPECT_NE(message_of<InputError>([&] { (void)piece_files(folder / "mesh.pvtu"); }), "")
        << outside;
  }
  const std::filesystem::path inside = folder / "mesh/a.vtu";
  write_pvtu(folder / "mesh.pvtu", {inside, "x/../mesh/a.vtu"}, MeshArrays{});
  EXPECT_EQ(piece_files(folder / "mesh.pvtu"), (std::vector{inside, inside}));
}

}  // namespace
}  // namespace tessera::io
