// SPDX-License-Identifier: BSD-3-Clause
#include <tuple>

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "tessera/base/error.hpp"
#include "tessera/io/vtu.hpp"

#include "support/temporary_folder.hpp"

#include "mesh_samples.hpp"

namespace tessera::io {
namespace {

using mesh::MeshArrays;
using testing::message_of;
using testing::TemporaryFolder;

/// @brief VTK grid of tets with the points, cells and ids of `mesh`, made without our writer.
[[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> vtk_grid_of(const MeshArrays& mesh)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (GlobalIndex i = 0; i < mesh.num_points(); ++i) {
    points->InsertNextPoint(&mesh.point_xyz[3 * static_cast<std::size_t>(i)]);
  }
  grid->SetPoints(points);
  for (GlobalIndex cell = 0; cell < mesh.num_cells(); ++cell) {
    vtkIdType corners[4];
    for (std::size_t i = 0; i < 4; ++i) {
      corners[i] = mesh.cell_points[4 * static_cast<std::size_t>(cell) + i];
    }
    grid->InsertNextCell(VTK_TETRA, 4, corners);
  }
  const vtkNew<vtkLongLongArray> ids;
  ids->SetName("GlobalNodeID");
  for (const GlobalIndex id : mesh.point_ids) ids->InsertNextValue(id);
  grid->GetPointData()->AddArray(ids);
  return grid;
}

using Format =
    std::tuple<int, int, bool, bool>;  // Data mode, compressor, 64-bit sizes, big endian.
class EveryEncoding : public ::testing::TestWithParam<Format> {};
INSTANTIATE_TEST_SUITE_P(All, EveryEncoding,
                         ::testing::Combine(::testing::Range(0, 4), ::testing::Range(0, 4),
                                            ::testing::Bool(), ::testing::Bool()));

void set_format(vtkXMLUnstructuredGridWriter& writer, const Format& format)
{
  const auto& [mode, compressor, is_64_bit, is_big_endian] = format;
  writer.SetDataMode(mode == 0   ? vtkXMLWriter::Ascii
                     : mode == 1 ? vtkXMLWriter::Binary
                                 : vtkXMLWriter::Appended);
  writer.SetEncodeAppendedData(mode == 2);
  writer.SetCompressorType(compressor);
  writer.SetHeaderType(is_64_bit ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
  if (is_big_endian) {
    writer.SetByteOrderToBigEndian();
  } else {
    writer.SetByteOrderToLittleEndian();
  }
}

TEST_P(EveryEncoding, GivesTheSameArrays)
{
  const TemporaryFolder folder;
  const MeshArrays mesh = testing::sample_tets(6);
  const vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName((folder / "a.vtu").c_str());
  writer->SetInputData(vtk_grid_of(mesh));
  set_format(*writer, GetParam());
  ASSERT_EQ(writer->Write(), 1);

  MeshArrays expected;
  expected.point_xyz = mesh.point_xyz;
  expected.cell_points = mesh.cell_points;
  expected.point_ids = mesh.point_ids;
  MeshArrays actual = read_vtu(folder / "a.vtu");
  if (std::get<0>(GetParam()) == 0) {  // VTK's text form does not keep the last bits.
    ASSERT_EQ(actual.point_xyz.size(), expected.point_xyz.size());
    for (std::size_t i = 0; i < expected.point_xyz.size(); ++i) {
      EXPECT_NEAR(actual.point_xyz[i], expected.point_xyz[i], 1e-9);
    }
    expected.point_xyz = actual.point_xyz;
  }
  testing::expect_same_bits(actual, expected);
}

TEST(ReadVtu, BlocksMayBeMuchLargerThanTheData)
{
  const TemporaryFolder folder;
  const MeshArrays mesh = testing::sample_tets(2);
  const vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName((folder / "a.vtu").c_str());
  writer->SetInputData(vtk_grid_of(mesh));
  writer->SetCompressorType(vtkXMLWriter::ZLIB);
  writer->SetBlockSize(std::size_t{1} << 28U);
  ASSERT_EQ(writer->Write(), 1);
  EXPECT_EQ(read_vtu(folder / "a.vtu").cell_points, mesh.cell_points);
}

void insert_cell(vtkUnstructuredGrid& grid, int type, const std::vector<vtkIdType>& points)
{
  grid.InsertNextCell(type, static_cast<vtkIdType>(points.size()), points.data());
}

/// @brief Ten points, two tets with other cells before, between and behind, floats for positions.
[[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> mixed_grid(bool with_tets)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  const vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  for (int i = 0; i < 10; ++i) points->InsertNextPoint(0.1F * static_cast<float>(i), i % 3, i % 2);
  grid->SetPoints(points);
  insert_cell(*grid, VTK_TRIANGLE, {0, 1, 2});
  if (with_tets) insert_cell(*grid, VTK_TETRA, {0, 1, 2, 3});
  insert_cell(*grid, VTK_QUADRATIC_TETRA, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  insert_cell(*grid, VTK_VERTEX, {4});
  if (with_tets) insert_cell(*grid, VTK_TETRA, {4, 5, 6, 9});
  return grid;
}

template <class VtkArray>
void add_numbers(vtkDataSetAttributes& data, const char* name, vtkIdType size, int num_components)
{
  const vtkNew<VtkArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(num_components);
  array->SetNumberOfTuples(size);
  for (vtkIdType i = 0; i < size * num_components; ++i) {
    array->SetValue(i, static_cast<typename VtkArray::ValueType>(i));
  }
  data.AddArray(array);
}

void write_with_vtk(vtkUnstructuredGrid* grid, const std::filesystem::path& path,
                    int num_pieces = 1)
{
  const vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid);
  writer->SetNumberOfPieces(num_pieces);
  ASSERT_EQ(writer->Write(), 1);
}

TEST(ReadVtu, LeavesOutCellsOfOtherKindsWithTheirData)
{
  const TemporaryFolder folder;
  const auto grid = mixed_grid(true);
  add_numbers<vtkIntArray>(*grid->GetCellData(), "attribute", 5, 1);
  add_numbers<vtkUnsignedCharArray>(*grid->GetCellData(), "byte", 5, 1);
  add_numbers<vtkLongLongArray>(*grid->GetCellData(), "GlobalElementID", 5, 1);
  add_numbers<vtkFloatArray>(*grid->GetCellData(), "quality", 5, 1);
  add_numbers<vtkDoubleArray>(*grid->GetCellData(), "vector", 5, 3);
  write_with_vtk(grid, folder / "a.vtu");

  const MeshArrays mesh = read_vtu(folder / "a.vtu");
  EXPECT_EQ(mesh.vertices_per_cell, 4);
  EXPECT_EQ(mesh.num_other_cells, 3);
  EXPECT_EQ(mesh.cell_points, (std::vector<LocalIndex>{0, 1, 2, 3, 4, 5, 6, 9}));
  EXPECT_EQ(mesh.cell_ids, (std::vector<GlobalIndex>{1, 4}));
  EXPECT_EQ(mesh.cell_ints.at("attribute"), (std::vector<std::int32_t>{1, 4}));
  EXPECT_EQ(mesh.cell_ints.at("byte"), (std::vector<std::int32_t>{1, 4}));
  EXPECT_EQ(mesh.cell_doubles.at("quality"), (std::vector{1.0, 4.0}));
  EXPECT_FALSE(mesh.cell_doubles.contains("vector"));
  EXPECT_EQ(mesh.point_xyz[3], static_cast<double>(0.1F));
}

TEST(ReadVtu, ReadsTrianglesWhereThereAreNoTets)
{
  const TemporaryFolder folder;
  write_with_vtk(mixed_grid(false), folder / "a.vtu");
  const MeshArrays mesh = read_vtu(folder / "a.vtu");
  EXPECT_EQ(mesh.vertices_per_cell, 3);
  EXPECT_EQ(mesh.num_other_cells, 2);
  EXPECT_EQ(mesh.cell_points, (std::vector<LocalIndex>{0, 1, 2}));
  EXPECT_TRUE(mesh.point_ids.empty());
}

TEST(ReadVtu, PrefersTheFlaggedIdsToOthersWithAUsualName)
{
  const TemporaryFolder folder;
  const auto grid = mixed_grid(true);
  add_numbers<vtkIntArray>(*grid->GetPointData(), "GlobalNodeID", 10, 1);
  const vtkNew<vtkLongLongArray> ids;
  ids->SetName("my numbers");
  for (long long i = 0; i < 10; ++i) ids->InsertNextValue(100 - i);
  grid->GetPointData()->SetGlobalIds(ids);
  write_with_vtk(grid, folder / "a.vtu");
  const MeshArrays mesh = read_vtu(folder / "a.vtu");
  ASSERT_EQ(mesh.point_ids.size(), 10U);
  EXPECT_EQ(mesh.point_ids[9], 91);
  EXPECT_TRUE(mesh.point_ints.contains("GlobalNodeID"));
}

[[nodiscard]] std::string two_piece_text(const std::string& second_ids)
{
  const std::string cells = R"(<Cells>
    <DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
    <DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
    <DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells>)";
  const std::string points = R"(<Points><DataArray type="Float64" NumberOfComponents="3"
    format="ascii"> 0 0 0 +1 0 0 0 1e0 0 0 0 1 </DataArray></Points>)";
  const std::string begin = R"(<Piece NumberOfPoints='4' NumberOfCells="1">)";
  return R"(<?xml version="1.0"?><!-- two pieces <in> one file -->
    <VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid>)"
         + begin + points + cells
         + R"(<PointData GlobalIds="ids"><DataArray type="Int64" Name="ids" format="ascii">
           0 1 2 3</DataArray></PointData></Piece>)"
         + begin + points + cells + second_ids + "</Piece></UnstructuredGrid></VTKFile>\n";
}

TEST(ReadVtu, NarrowsTheNumbersThatHave32BitsHere)
{
  const TemporaryFolder folder;
  const auto grid = mixed_grid(true);
  add_numbers<vtkLongLongArray>(*grid->GetCellData(), "attribute", 5, 1);
  add_numbers<vtkLongLongArray>(*grid->GetCellData(), "other", 5, 1);
  const vtkNew<vtkLongLongArray> large;
  large->SetName("patch");
  for (int i = 0; i < 5; ++i) large->InsertNextValue(1LL << 40);
  grid->GetCellData()->AddArray(large);
  write_with_vtk(grid, folder / "a.vtu");
  const MeshArrays mesh = read_vtu(folder / "a.vtu");
  EXPECT_TRUE(mesh.cell_ints.contains("attribute"));
  EXPECT_FALSE(mesh.cell_longs.contains("attribute"));
  EXPECT_TRUE(mesh.cell_longs.contains("patch")) << "they do not fit";
  EXPECT_TRUE(mesh.cell_longs.contains("other"));
}

TEST(ReadVtu, JoinsThePiecesOfOneFile)
{
  const TemporaryFolder folder;
  testing::write_bytes(folder / "a.vtu", two_piece_text(R"(<PointData GlobalIds="ids">
    <DataArray type="Int64" Name="ids" format="ascii">3 4 5 6</DataArray></PointData>)"));
  const MeshArrays mesh = read_vtu(folder / "a.vtu");
  EXPECT_EQ(mesh.cell_points, (std::vector<LocalIndex>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(mesh.point_ids, (std::vector<GlobalIndex>{0, 1, 2, 3, 3, 4, 5, 6}));
}

TEST(ReadVtu, HasNoIdsWhereOnlySomePiecesOfAFileHaveThem)
{
  const TemporaryFolder folder;
  testing::write_bytes(folder / "a.vtu", two_piece_text(""));
  const MeshArrays mesh = read_vtu(folder / "a.vtu");
  EXPECT_EQ(mesh.num_points(), 8);
  EXPECT_TRUE(mesh.point_ids.empty());
}

}  // namespace
}  // namespace tessera::io
