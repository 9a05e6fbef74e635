// SPDX-License-Identifier: BSD-3-Clause
// Writes assemblies for whole programs, each as STEP with names and as BREP without:
//   assembly_models FOLDER
#include <cstdio>
#include <exception>
#include <filesystem>

#include <BRepTools.hxx>

#include "netgen/cad/assemblies.hpp"

namespace {

namespace fs = std::filesystem;
namespace models = tessera::testing;

void write(const fs::path& folder, const models::AssemblyModel& model)
{
  models::write_step(model, folder / (model.name + ".step"));
  BRepTools::Write(models::compound_of(model), (folder / (model.name + ".brep")).c_str());
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::fputs("usage: assembly_models FOLDER\n", stderr);
    return 64;
  }
  try {
    fs::create_directories(argv[1]);
    for (const models::AssemblyModel& model : models::assemblies()) write(argv[1], model);
    write(argv[1], models::boxes_with_gap(1e-3));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "assembly_models: %s\n", error.what());
    return 1;
  }
}
