// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkLongLongArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "tessera/base/error.hpp"
#include "tessera/io/vtu.hpp"

#include "io/atomic_file.hpp"
#include "io/vtu/arrays.hpp"
#include "io/vtu/vtk_messages.hpp"
#include "io/vtu/vtu_ghosts.hpp"
#include "io/vtu/vtu_writers.hpp"

namespace tessera::io {
namespace {

using mesh::MeshArrays;

static_assert(sizeof(vtkIdType) == sizeof(GlobalIndex), "ids are written without conversion");

/// @brief A grid whose cells are all of the type of the first. The writer asks for the types of the
/// cells, and VTK looks at every cell to find them: 7 % of a job that subdivides.
class OneTypeGrid final : public vtkUnstructuredGrid {
 public:
  static vtkSmartPointer<OneTypeGrid> make()
  {
    auto grid = vtkSmartPointer<OneTypeGrid>::Take(new OneTypeGrid);
    grid->InitializeObjectBase();  // As VTK's own New() does.
    return grid;
  }

  void GetCellTypes(vtkCellTypes* types) override
  {
    types->Reset();
    if (GetNumberOfCells() > 0) types->InsertNextType(static_cast<unsigned char>(GetCellType(0)));
  }
};

/// @brief A VTK array on the memory of `values`, which must outlive it and is only read.
template <class VtkArray, class T>
[[nodiscard]] vtkSmartPointer<VtkArray> view_of(const char* name, const std::vector<T>& values,
                                                int num_components = 1)
{
  auto array = vtkSmartPointer<VtkArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(num_components);
  constexpr int kKeepMemory = 1;
  array->SetVoidArray(const_cast<T*>(values.data()), static_cast<vtkIdType>(values.size()),
                      kKeepMemory);
  return array;
}

template <class VtkArray, class T>
void add_arrays(vtkFieldData& data, const std::map<std::string, std::vector<T>>& arrays)
{
  for (const auto& [name, values] : arrays) {
    data.AddArray(view_of<VtkArray>(name.c_str(), values));
  }
}

void add_texts(vtkFieldData& data, const std::map<std::string, std::vector<std::string>>& texts)
{
  for (const auto& [name, values] : texts) {
    const vtkNew<vtkStringArray> array;
    array->SetName(name.c_str());
    for (const std::string& value : values) array->InsertNextValue(value);
    data.AddArray(array);
  }
}

[[nodiscard]] vtkSmartPointer<vtkCellArray> make_cells(const MeshArrays& piece)
{
  const vtkNew<vtkCellArray::ArrayType32> offsets;
  const auto num_cells = piece.num_cells();
  offsets->SetNumberOfValues(num_cells + 1);
  for (GlobalIndex cell = 0; cell <= num_cells; ++cell) {
    offsets->SetValue(cell, static_cast<vtkTypeInt32>(cell * piece.vertices_per_cell));
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, view_of<vtkCellArray::ArrayType32>("connectivity", piece.cell_points));
  return cells;
}

[[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> make_grid(const MeshArrays& piece)
{
  auto grid = OneTypeGrid::make();
  const vtkNew<vtkPoints> points;
  points->SetData(view_of<vtkDoubleArray>("Points", piece.point_xyz, 3));
  grid->SetPoints(points);
  grid->SetCells(vtk_cell_type(piece), make_cells(piece));

  vtkPointData& point_data = *grid->GetPointData();
  vtkCellData& cell_data = *grid->GetCellData();
  if (has_point_ids(piece)) {
    point_data.SetGlobalIds(view_of<vtkIdTypeArray>(kPointIdsName, piece.point_ids));
  }
  if (has_cell_ids(piece)) {
    cell_data.SetGlobalIds(view_of<vtkIdTypeArray>(kCellIdsName, piece.cell_ids));
  }
  add_arrays<vtkIntArray>(point_data, piece.point_ints);
  add_arrays<vtkLongLongArray>(point_data, piece.point_longs);
  add_arrays<vtkIntArray>(cell_data, piece.cell_ints);
  add_arrays<vtkLongLongArray>(cell_data, piece.cell_longs);
  add_arrays<vtkDoubleArray>(cell_data, piece.cell_doubles);
  if (piece.num_ghost_layers > 0) {
    point_data.AddArray(view_of<vtkUnsignedCharArray>(kGhostName, piece.point_ghost));
    cell_data.AddArray(view_of<vtkUnsignedCharArray>(kGhostName, piece.cell_ghost));
  }
  add_texts(*grid->GetFieldData(), piece.field_texts);
  return grid;
}

void set_compression(vtkXMLWriter& writer, Compression compression)
{
  switch (compression) {
    case Compression::none:
      return writer.SetCompressorTypeToNone();
    case Compression::lz4:
      return writer.SetCompressorTypeToLZ4();
    case Compression::zlib:
      return writer.SetCompressorTypeToZLib();
  }
}

/// @brief What went wrong: VTK's error code is a system error number or one of its own.
[[nodiscard]] std::string cause_of(unsigned long error_code, const std::string& messages)
{
  if (error_code == vtkErrorCode::OutOfDiskSpaceError) return "no space left on the disk";
  if (error_code != vtkErrorCode::NoError && error_code < vtkErrorCode::FirstVTKErrorCode) {
    return system_error_text(static_cast<int>(error_code));
  }
  return messages.empty() ? vtkErrorCode::GetStringFromErrorCode(error_code) : messages;
}

/// @brief The first error code of a writer. It deletes the file that it cannot finish, and what it
/// finds wrong after that has the last code.
class FirstErrorCode {
 public:
  explicit FirstErrorCode(vtkXMLWriter& writer)
      : writer_(writer),
        observer_(writer.AddObserver(vtkCommand::ModifiedEvent, this, &FirstErrorCode::look))
  {
  }
  ~FirstErrorCode() { writer_.RemoveObserver(observer_); }
  FirstErrorCode(const FirstErrorCode&) = delete;
  FirstErrorCode& operator=(const FirstErrorCode&) = delete;

  [[nodiscard]] unsigned long get() const noexcept { return code_; }

 private:
  void look()
  {
    if (code_ == vtkErrorCode::NoError) code_ = writer_.GetErrorCode();
  }

  vtkXMLWriter& writer_;
  unsigned long observer_;
  unsigned long code_ = vtkErrorCode::NoError;
};

}  // namespace

bool can_compress() { return true; }

void write_compressed_vtu(const MeshArrays& piece, const std::filesystem::path& path,
                          Compression compression)
{
  const auto grid = make_grid(piece);
  AtomicFile file(path);

  const vtkNew<vtkXMLUnstructuredGridWriter> writer;
  const VtkMessages messages(*writer);
  const VtkMessages pipeline_messages(*writer->GetExecutive());  // Says again what the writer said.
  writer->SetFileName(file.temporary_path().c_str());
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  set_compression(*writer, compression);
  const FirstErrorCode error_code(*writer);
  const bool written = writer->Write() == 1;
  if (!written || error_code.get() != vtkErrorCode::NoError || !messages.text().empty()) {
    throw OutputError(fmt::format("cannot write {}: {}", path.string(),
                                  cause_of(error_code.get(), messages.text())));
  }
  file.commit();
}

}  // namespace tessera::io
