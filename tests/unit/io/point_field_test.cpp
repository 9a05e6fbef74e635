// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/io/point_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "tessera/base/error.hpp"

#include "support/temporary_folder.hpp"

namespace tessera::io {
namespace {

using mesh::GridField;
using mesh::TetField;
using testing::message_of;
using testing::TemporaryFolder;
using testing::write_bytes;

constexpr const char* kArray = "size";

double value_at(const Vec3& p) { return 1.0 + p[0] + 10.0 * p[1] + 100.0 * p[2]; }

template <class Array = vtkDoubleArray>
void add_array(vtkDataSet& data, const char* name)
{
  const vtkNew<Array> values;
  values->SetName(name);
  for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i) {
    const double* p = data.GetPoint(i);
    values->InsertNextValue(static_cast<typename Array::ValueType>(value_at({p[0], p[1], p[2]})));
  }
  data.GetPointData()->AddArray(values);
}

void write(vtkUnstructuredGrid& grid, const std::filesystem::path& path)
{
  const vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  writer->SetFileName(path.c_str());
  ASSERT_EQ(writer->Write(), 1);
}

void write(vtkImageData& image, const std::filesystem::path& path)
{
  const vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(&image);
  writer->SetFileName(path.c_str());
  ASSERT_EQ(writer->Write(), 1);
}

// One cell, its corners at those of the unit cube that are named by bits (x, y, z from the lowest),
// in the order of their numbers' permutation.
struct OneCell {
  int type;
  std::vector<int> corners;  // In VTK's order.
  double volume;
  std::size_t num_extra_points = 0;  // Of higher order, at the middle of the cube.
};

void add_cell(const OneCell& cell, const std::vector<int>& numbers, vtkUnstructuredGrid& grid)
{
  const std::size_t num_corners = cell.corners.size();
  std::vector<Vec3> points(num_corners);
  std::vector<vtkIdType> ids;
  for (std::size_t i = 0; i < num_corners; ++i) {
    const int bits = cell.corners[i];
    points[static_cast<std::size_t>(numbers[i])] = {1.0 * (bits & 1), 1.0 * (bits >> 1 & 1),
                                                    1.0 * (bits >> 2)};
    ids.push_back(numbers[i]);
  }
  for (std::size_t i = 0; i < cell.num_extra_points; ++i) {
    ids.push_back(static_cast<vtkIdType>(points.size()));
    points.push_back({0.5, 0.5, 0.5});
  }
  const vtkNew<vtkPoints> vtk_points;
  vtk_points->SetDataTypeToDouble();
  for (const Vec3& p : points) vtk_points->InsertNextPoint(p.data());
  grid.SetPoints(vtk_points);
  grid.InsertNextCell(cell.type, static_cast<vtkIdType>(ids.size()), ids.data());
  add_array(grid, kArray);
}

double volume_of(const TetField& field)
{
  double volume = 0.0;
  for (std::size_t t = 0; t < field.tet_points.size(); t += 4) {
    const auto corner = [&](std::size_t i) {
      return point_at(std::span<const double>(field.point_xyz), field.tet_points[t + i]);
    };
    volume += std::abs(tet_volume(corner(0), corner(1), corner(2), corner(3)));
  }
  return volume;
}

void expect_values_of_points(const TetField& field)
{
  ASSERT_EQ(3 * field.values.size(), field.point_xyz.size());
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    EXPECT_EQ(field.values[i], value_at(point_at(std::span<const double>(field.point_xyz), i)));
  }
}

TEST(PointFieldFile, CellsOfEveryKindBecomeTetsThatFillThemWhateverTheirNumbers)
{
  const std::vector<int> hex{0, 1, 3, 2, 4, 5, 7, 6};
  const std::vector<OneCell> cells{{VTK_TETRA, {0, 1, 2, 4}, 1.0 / 6.0},
                                   {VTK_QUADRATIC_TETRA, {0, 1, 2, 4}, 1.0 / 6.0, 6},
                                   {VTK_LAGRANGE_TETRAHEDRON, {0, 1, 2, 4}, 1.0 / 6.0, 6},
                                   {VTK_VOXEL, {0, 1, 2, 3, 4, 5, 6, 7}, 1.0},
                                   {VTK_HEXAHEDRON, hex, 1.0},
                                   {VTK_QUADRATIC_HEXAHEDRON, hex, 1.0, 12},
                                   {VTK_TRIQUADRATIC_HEXAHEDRON, hex, 1.0, 19},
                                   {VTK_WEDGE, {0, 1, 2, 4, 5, 6}, 0.5},
                                   {VTK_QUADRATIC_WEDGE, {0, 1, 2, 4, 5, 6}, 0.5, 9},
                                   {VTK_PYRAMID, {0, 1, 3, 2, 4}, 1.0 / 3.0},
                                   {VTK_QUADRATIC_PYRAMID, {0, 1, 3, 2, 4}, 1.0 / 3.0, 8}};
  const TemporaryFolder folder;
  for (const OneCell& cell : cells) {
    std::vector<int> numbers(cell.corners.size());
    for (std::size_t turn = 0; turn < numbers.size(); ++turn) {
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        numbers[i] = static_cast<int>((3 * i + turn) % numbers.size());
      }
      if (numbers.size() % 3 == 0) {
        for (std::size_t i = 0; i < numbers.size(); ++i) {
          numbers[i] = static_cast<int>((5 * i + turn) % numbers.size());
        }
      }
      const vtkNew<vtkUnstructuredGrid> grid;
      add_cell(cell, numbers, *grid);
      write(*grid, folder / "a.vtu");
      const auto field = std::get<TetField>(read_point_field(folder / "a.vtu", kArray));
      EXPECT_NEAR(volume_of(field), cell.volume, 1e-14) << cell.type << " " << turn;
      expect_values_of_points(field);
    }
  }
}

// Two hexahedra beside each other in x, with points in no order.
void add_two_cells(vtkUnstructuredGrid& grid)
{
  const vtkNew<vtkPoints> points;
  const std::array<int, 12> numbers{7, 2, 9, 4, 0, 11, 5, 1, 10, 3, 8, 6};
  points->SetNumberOfPoints(12);
  const auto number = [&](int i, int j, int k) {
    return numbers.at(static_cast<std::size_t>(4 * i + 2 * j + k));
  };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 2; ++j) {
      for (int k = 0; k < 2; ++k) points->SetPoint(number(i, j, k), i, j, k);
    }
  }
  grid.SetPoints(points);
  for (int i = 0; i < 2; ++i) {
    const std::array<vtkIdType, 8> ids{
        number(i, 0, 0), number(i + 1, 0, 0), number(i + 1, 1, 0), number(i, 1, 0),
        number(i, 0, 1), number(i + 1, 0, 1), number(i + 1, 1, 1), number(i, 1, 1)};
    grid.InsertNextCell(VTK_HEXAHEDRON, 8, ids.data());
  }
}

TEST(PointFieldFile, SidesOfNeighboursAreCutAlike)
{
  // The triangles of tets on the common side, x = 1, must be there twice.
  const TemporaryFolder folder;
  const vtkNew<vtkUnstructuredGrid> grid;
  add_two_cells(*grid);
  add_array(*grid, kArray);
  write(*grid, folder / "a.vtu");
  const auto field = std::get<TetField>(read_point_field(folder / "a.vtu", kArray));
  EXPECT_NEAR(volume_of(field), 2.0, 1e-14);
  std::vector<std::vector<LocalIndex>> common;
  for (std::size_t t = 0; t < field.tet_points.size(); t += 4) {
    std::vector<LocalIndex> on_side;
    for (std::size_t c = t; c < t + 4; ++c) {
      const LocalIndex point = field.tet_points[c];
      if (field.point_xyz[3 * static_cast<std::size_t>(point)] == 1.0) on_side.push_back(point);
    }
    std::ranges::sort(on_side);
    if (on_side.size() == 3) common.push_back(on_side);
  }
  std::ranges::sort(common);
  ASSERT_EQ(common.size(), 4U);
  EXPECT_EQ(common[0], common[1]);
  EXPECT_EQ(common[2], common[3]);
}

TEST(PointFieldFile, OtherCellsAreLeftOutAndFloatsWidened)
{
  const TemporaryFolder folder;
  const vtkNew<vtkUnstructuredGrid> grid;
  add_cell({VTK_TETRA, {0, 1, 2, 4}, 1.0 / 6.0}, {0, 1, 2, 3}, *grid);
  const std::array<vtkIdType, 3> triangle{0, 1, 2};
  grid->InsertNextCell(VTK_TRIANGLE, 3, triangle.data());
  add_array<vtkFloatArray>(*grid, "h");
  write(*grid, folder / "a.vtu");
  const auto field = std::get<TetField>(read_point_field(folder / "a.vtu", "h"));
  EXPECT_EQ(field.tet_points.size(), 4U);
  expect_values_of_points(field);
}

TEST(PointFieldFile, AnIndexGivesThePointsOfAllItsPieces)
{
  const TemporaryFolder folder;
  for (const char* name : {"a.vtu", "b.vtu"}) {
    const vtkNew<vtkUnstructuredGrid> grid;
    add_cell({VTK_TETRA, {0, 1, 2, 4}, 1.0 / 6.0}, {0, 1, 2, 3}, *grid);
    write(*grid, folder / name);
  }
  write_bytes(folder / "all.pvtu",
              "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\">"
              "<PUnstructuredGrid GhostLevel=\"0\"><Piece Source=\"a.vtu\"/>"
              "<Piece Source=\"b.vtu\"/></PUnstructuredGrid></VTKFile>\n");
  const auto field = std::get<TetField>(read_point_field(folder / "all.pvtu", kArray));
  EXPECT_EQ(field.values.size(), 8U);
  ASSERT_EQ(field.tet_points.size(), 8U);
  EXPECT_GE(*std::min_element(field.tet_points.begin() + 4, field.tet_points.end()), 4);
  EXPECT_NEAR(volume_of(field), 2.0 / 6.0, 1e-14);
  expect_values_of_points(field);
}

TEST(PointFieldFile, AnImageGivesATurnedGrid)
{
  const TemporaryFolder folder;
  const vtkNew<vtkImageData> image;
  image->SetExtent(2, 4, -1, 2, 5, 6);
  image->SetOrigin(1.0, 2.0, 3.0);
  image->SetSpacing(0.5, 0.25, 2.0);
  const double quarter_turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  image->SetDirectionMatrix(quarter_turn);
  add_array(*image, kArray);
  write(*image, folder / "a.vti");
  const auto grid = std::get<GridField>(read_point_field(folder / "a.vti", kArray));
  EXPECT_EQ(grid.counts, (std::array<LocalIndex, 3>{3, 4, 2}));
  ASSERT_EQ(grid.values.size(), 24U);
  for (LocalIndex k = 0; k < 2; ++k) {
    for (LocalIndex j = 0; j < 4; ++j) {
      for (LocalIndex i = 0; i < 3; ++i) {
        const Vec3 p = grid.origin + double(i) * grid.steps[0] + double(j) * grid.steps[1]
                       + double(k) * grid.steps[2];
        const auto number = static_cast<std::size_t>((k * 4 + j) * 3 + i);
        const double* wanted = image->GetPoint(static_cast<vtkIdType>(number));
        EXPECT_NEAR(norm(p - Vec3{wanted[0], wanted[1], wanted[2]}), 0.0, 1e-14);
        EXPECT_NEAR(grid.values[number], value_at(p), 1e-12);
      }
    }
  }
}

TEST(PointFieldFile, AnImageInPiecesIsPutTogether)
{
  const TemporaryFolder folder;
  const auto piece = [](int first, int last, const char* values) {
    return "<Piece Extent=\"" + std::to_string(first) + " " + std::to_string(last)
           + " 0 1 0 1\"><PointData><DataArray type=\"Float64\" Name=\"size\" format=\"ascii\">"
           + values + "</DataArray></PointData></Piece>";
  };
  const std::string head =
      "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"0 2 0 1 0 1\" "
      "Origin=\"0 0 0\" Spacing=\"1 1 1\">";
  const std::string tail = "</ImageData></VTKFile>\n";
  write_bytes(folder / "a.vti",
              head + piece(1, 2, "2 3 5 6 8 9 11 12") + piece(0, 1, "1 2 4 5 7 8 10 11") + tail);
  const auto grid = std::get<GridField>(read_point_field(folder / "a.vti", kArray));
  EXPECT_EQ(grid.values, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));

  const auto error_of = [&](const std::string& text) {
    write_bytes(folder / "b.vti", text);
    return message_of<InputError>([&] { (void)read_point_field(folder / "b.vti", kArray); });
  };
  EXPECT_NE(error_of(head + piece(0, 1, "1 2 4 5 7 8 10 11") + tail).find("do not cover"),
            std::string::npos);
  EXPECT_NE(error_of(head + piece(0, 1, "1 2") + tail).find("has not the size it should"),
            std::string::npos);
  EXPECT_NE(error_of(head + piece(1, 3, "1 2 3 4 5 6 7 8 9 10 11 12") + tail).find("outside"),
            std::string::npos);
  EXPECT_NE(error_of("<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 9 0 9 0 0\"/>"
                     "</VTKFile>")
                .find("no cells with a volume"),
            std::string::npos);
  EXPECT_NE(error_of("<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 9 0 9\"/></VTKFile>")
                .find("is not 6 numbers"),
            std::string::npos);
  EXPECT_NE(error_of("<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 9 0 9 0 9\" "
                     "Direction=\"1 1 0 0 1 0 0 0 1\"/></VTKFile>")
                .find("no rotation"),
            std::string::npos);
}

TEST(PointFieldFile, AMissingArrayIsNamedWithThoseThatThereAre)
{
  const TemporaryFolder folder;
  const vtkNew<vtkUnstructuredGrid> grid;
  add_cell({VTK_TETRA, {0, 1, 2, 4}, 1.0 / 6.0}, {0, 1, 2, 3}, *grid);
  add_array(*grid, "other one");
  const vtkNew<vtkDoubleArray> of_cells;
  of_cells->SetName("h");
  of_cells->InsertNextValue(1.0);
  grid->GetCellData()->AddArray(of_cells);
  write(*grid, folder / "a.vtu");
  const auto error_of = [&](const std::string& array) {
    return message_of<InputError>([&] { (void)read_point_field(folder / "a.vtu", array); });
  };
  EXPECT_EQ(error_of("x"), (folder / "a.vtu").string()
                               + ": it has no point array \"x\" with one component; it has "
                                 "\"size\", \"other one\"");
  EXPECT_NE(error_of("h").find("(\"h\" is an array of cells"), std::string::npos);
}

TEST(PointFieldFile, FilesThatCannotBeReadAreNamed)
{
  const TemporaryFolder folder;
  const auto error_of = [&](const char* name) {
    return message_of<InputError>([&] { (void)read_point_field(folder / name, kArray); });
  };
  for (const char* name : {"none.vtu", "none.vti", "none.pvtu"}) {
    EXPECT_NE(error_of(name).find(name), std::string::npos);
  }
  write_bytes(folder / "text.vtu", "text");
  write_bytes(folder / "text.vti", "text");
  EXPECT_NE(error_of("text.vtu").find("text.vtu: "), std::string::npos);
  EXPECT_NE(error_of("text.vti").find("text.vti: "), std::string::npos);

  const vtkNew<vtkUnstructuredGrid> triangle;
  add_cell({VTK_TRIANGLE, {0, 1, 2}, 0.0}, {0, 1, 2}, *triangle);
  write(*triangle, folder / "flat.vtu");
  EXPECT_NE(error_of("flat.vtu").find("it has no cells with a volume"), std::string::npos);
}

// What is read of damaged bytes is consistent, or an InputError with the name.
void expect_sound_or_refused(const std::filesystem::path& path, const std::string& bytes)
{
  write_bytes(path, bytes);
  try {
    const mesh::PointField field = read_point_field(path, kArray);
    if (const auto* grid = std::get_if<GridField>(&field)) {
      std::size_t num_points = 1;
      for (const LocalIndex count : grid->counts) num_points *= static_cast<std::size_t>(count);
      EXPECT_EQ(grid->values.size(), num_points);
      return;
    }
    const auto& tets = std::get<TetField>(field);
    EXPECT_EQ(3 * tets.values.size(), tets.point_xyz.size());
    EXPECT_TRUE(std::ranges::all_of(tets.tet_points, [&](LocalIndex point) {
      return point >= 0 && static_cast<std::size_t>(point) < tets.values.size();
    }));
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
  }
}

TEST(PointFieldFile, DamagedFilesAreSoundOrRefused)
{
  const TemporaryFolder folder;
  const vtkNew<vtkUnstructuredGrid> cells;
  add_two_cells(*cells);
  add_array(*cells, kArray);
  write(*cells, folder / "a.vtu");
  const vtkNew<vtkImageData> image;
  image->SetDimensions(3, 4, 5);
  add_array(*image, kArray);
  write(*image, folder / "a.vti");
  for (const char* name : {"a.vtu", "a.vti"}) {
    const std::string bytes = testing::file_bytes(folder / name);
    ASSERT_GT(bytes.size(), 500U);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << i % 7));
      expect_sound_or_refused(folder / name, damaged);
      if (i % 9 == 0) expect_sound_or_refused(folder / name, bytes.substr(0, i));
    }
  }
}

}  // namespace
}  // namespace tessera::io
