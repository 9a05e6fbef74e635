// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/gmsh_mesher.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <system_error>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/coarse/fit_to_cad.hpp"
#include "tessera/jobs/run_program.hpp"
#include "tessera/model/tet_mesh_file.hpp"

namespace tessera::geometry {
namespace {

namespace fs = std::filesystem;

constexpr double kStall_s = 60.0;
constexpr double kMemory_gib = 16.0;

// A folder for one run of Gmsh, which goes with this object.
class ScratchFolder {
 public:
  ScratchFolder()
  {
    std::string name = (fs::temp_directory_path() / "tessera-gmsh-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw OutputError(name + ": cannot be made; set TMPDIR to a folder that can be written");
    }
    path_ = name;
  }
  ~ScratchFolder()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] fs::path file(const char* name) const { return path_ / name; }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_{};
};

// What the mesh depends on stands here, so that a user's own settings of Gmsh change nothing.
std::string script_for(const surface::CoarseOptions& options)
{
  return fmt::format(
      "General.NumThreads = 1;\n"
      "Geometry.Tolerance = 1e-8;\n"
      "Geometry.OCCTargetUnit = \"\";\n"
      "Mesh.Algorithm = 6;\n"
      "Mesh.Algorithm3D = 1;\n"
      "Mesh.ElementOrder = 1;\n"
      "Mesh.MeshSizeMin = 0;\n"
      "Mesh.MeshSizeMax = {:.17g};\n"
      "Mesh.MeshSizeFromCurvature = {:.17g};\n"
      "Mesh.Optimize = 1;\n"
      "Mesh.RandomSeed = 1;\n"
      "Mesh.MshFileVersion = 4.1;\n"
      "Mesh.Binary = 1;\n"
      "Mesh.SaveAll = 1;\n"
      "Merge \"model.brep\";\n",
      options.max_size, 2.0 * std::numbers::pi * options.curvature);
}

// Its last errors, or its last line.
std::string words_of(const fs::path& log)
{
  std::ifstream in(log);
  std::string errors;
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("Error")) errors += (errors.empty() ? "" : "; ") + line;
    if (!line.empty()) last = line;
  }
  constexpr std::size_t kLongest = 500;
  return (errors.empty() ? last : errors).substr(0, kLongest);
}

void run_gmsh(const ScratchFolder& folder, const surface::CoarseOptions& options)
{
  const fs::path log = folder.file("log.txt");
  const jobs::JobLimits limits{
      .cpu_s = options.timeout_s, .stall_s = kStall_s, .memory_gib = kMemory_gib};
  const jobs::ProgramOutcome outcome =
      jobs::run_program({"gmsh", "-3", "-nopopup", "-v", "3", "-setnumber", "General.Terminal", "1",
                         "model.geo", "-o", "mesh.msh"},
                        folder.path(), log, limits);
  if (outcome.is_missing) {
    throw ConfigError(
        "coarse.mesher = \"gmsh\" needs the program gmsh, and there is none on the PATH; install "
        "it (Debian: apt install gmsh), or set coarse.mesher = \"netgen\"");
  }
  switch (outcome.status) {
    case jobs::JobStatus::ok:
      return;
    case jobs::JobStatus::out_of_time:
      throw NetgenError(fmt::format("Gmsh used more than {:g} s of CPU time", limits.cpu_s));
    case jobs::JobStatus::stalled:
      throw NetgenError(fmt::format("Gmsh used no CPU time for {:g} s", limits.stall_s));
    case jobs::JobStatus::out_of_memory:
      throw NetgenError(fmt::format("Gmsh used more than {:g} GiB of memory", limits.memory_gib));
    case jobs::JobStatus::crashed:
      throw NetgenError(fmt::format("Gmsh was ended by signal {}; its last words: {}", outcome.code,
                                    words_of(log)));
    default:
      throw NetgenError(fmt::format("Gmsh gave up: {}", words_of(log)));
  }
}

coarse::OwnMesh read_result(const ScratchFolder& folder, const surface::CoarseOptions& options)
{
  const fs::path file = folder.file("mesh.msh");
  if (!fs::exists(file)) {
    throw NetgenError("Gmsh wrote no mesh: " + words_of(folder.file("log.txt")));
  }
  return coarse::make_own_mesh(model::read_msh(file), "Gmsh's mesh", options.feature_angle_deg);
}

}  // namespace

mesh::CoarseMesh fitted_mesh(const coarse::OwnMesh& own, const LoadedModel& cad,
                             const std::string& name)
{
  const coarse::CadSurface surface = cad.triangles_for_fit(coarse::size_for_fit(own.mesh));
  const surface::SurfaceReference reference(surface.triangles);
  mesh::CoarseMesh mesh = coarse::fit_to_cad(own, surface, reference, cad, name);
  cad.add_parameters(reference, mesh);
  mesh::validate(mesh);
  return mesh;
}

mesh::CoarseMesh mesh_with_gmsh(const LoadedModel& model, const surface::CoarseOptions& options)
{
  const ScratchFolder folder;
  model.write_brep(folder.file("model.brep"));
  std::ofstream(folder.file("model.geo")) << script_for(options);
  run_gmsh(folder, options);
  try {
    return fitted_mesh(read_result(folder, options), model, "Gmsh's mesh");
  } catch (const InputError& error) {
    throw NetgenError(error.what());  // Another size may do better.
  }
}

}  // namespace tessera::geometry
