// SPDX-License-Identifier: BSD-3-Clause
// Writes models for the corpus, one for each thing that once went wrong with CAD of others:
//   hard_models FOLDER
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <Standard_Failure.hxx>
#include <StlAPI_Writer.hxx>

#include "netgen/cad/hard_shapes.hpp"

namespace {

namespace fs = std::filesystem;
namespace shapes = tessera::testing;

void write(const fs::path& folder, const std::string& name, const TopoDS_Shape& shape)
{
  const std::string file = (folder / (name + ".brep")).string();
  if (!BRepTools::Write(shape, file.c_str())) throw std::runtime_error(file + " cannot be written");
}

// All solids in one `solid` of the file.
void write_stl(const fs::path& folder, const std::string& name, const TopoDS_Shape& shape)
{
  const BRepMesh_IncrementalMesh triangles(shape, 0.01);
  const std::string file = (folder / (name + ".stl")).string();
  if (!StlAPI_Writer().Write(shape, file.c_str())) {
    throw std::runtime_error(file + " cannot be written");
  }
}

void write_all(const fs::path& folder)
{
  fs::create_directories(folder);
  write(folder, "bearing", shapes::bearing({0.3, 3.7}));
  write(folder, "overlapping_boxes", shapes::overlapping_boxes(1e-6));
  write(folder, "cusp", shapes::cusp());
  write(folder, "rounded_block", shapes::rounded_block(0.05));
  write(folder, "narrow_shoulder", shapes::shoulder(0.05));
  write(folder, "touching_edges", shapes::shoulder(2e-6));
  write_stl(folder, "flat_bodies", shapes::overlapping_boxes(0.0));
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::fputs("usage: hard_models FOLDER\n", stderr);
    return 64;
  }
  try {
    write_all(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hard_models: %s\n", error.what());
  } catch (const Standard_Failure& error) {
    std::fprintf(stderr, "hard_models: %s\n", error.GetMessageString());
  }
  return 1;
}
