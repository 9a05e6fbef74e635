// SPDX-License-Identifier: BSD-3-Clause
// In place of csg_crossings, csg_cut, csg_numbers, csg_remesh, csg_solids and csg_triangles with
// NETGEN 6.2.2501, whose library hides the solids of CSG: they cannot be cut,
// walked through, or made with OpenCASCADE.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tessera/base/error.hpp"

#include "netgen/csg_crossings.hpp"
#include "netgen/csg_cut.hpp"
#include "netgen/csg_remesh.hpp"
#include "netgen/csg_solids.hpp"
#include "netgen/netgen_versions.hpp"

namespace tessera::netgen {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHidden =
    "the library of this version of NETGEN hides the solids of CSG (6.2.1905 does not)";

// A folder in memory, while this lives.
class MemoryFolder {
 public:
  MemoryFolder()
  {
    if (mkdtemp(name_.data()) == nullptr)
      throw OutputError("/dev/shm: no folder can be made there");
  }
  ~MemoryFolder()
  {
    std::error_code error;
    fs::remove_all(name_, error);
  }
  MemoryFolder(const MemoryFolder&) = delete;
  MemoryFolder& operator=(const MemoryFolder&) = delete;

  [[nodiscard]] fs::path path() const { return name_; }

 private:
  std::string name_ = "/dev/shm/tessera_XXXXXX";
};

}  // namespace

std::unique_ptr<::netgen::CSGeometry> read_csg(const std::string& text)
{
  // NETGEN throws where it is none.
  if (text.find("algebraic3d") == std::string::npos) return nullptr;
  const MemoryFolder folder;
  const fs::path file = folder.path() / "model.geo";
  std::ofstream(file) << text;
  for (const auto& reader : ::netgen::geometryregister) {
    if (auto* const geometry = reader->Load(file)) {
      return std::unique_ptr<::netgen::CSGeometry>(static_cast<::netgen::CSGeometry*>(geometry));
    }
  }
  return nullptr;
}

void describe_cones_by_circles(::netgen::CSGeometry& /*geometry*/) {}

bool has_apex(::netgen::CSGeometry& /*geometry*/, double /*tolerance*/) { return false; }

std::string why_only_netgen(::netgen::CSGeometry& /*geometry*/) { return kHidden; }

std::vector<int> unseen_solids(::netgen::CSGeometry& /*geometry*/) { return {}; }

CsgSolids solids_of_csg(::netgen::CSGeometry& /*geometry*/, const ::netgen::Box<3>& /*box*/)
{
  throw GeometryError(kHidden);
}

::netgen::Box<3> box_of_solids(const TopoDS_Shape& /*shape*/, const ::netgen::Box<3>& /*bound*/)
{
  throw GeometryError(kHidden);
}

coarse::CoarseSurface remesh_csg(const model::Model& /*csg*/,
                                 const ::netgen::CSGeometry& /*geometry*/, CadFile /*solids*/,
                                 const ::netgen::Box<3>& /*box*/,
                                 const coarse::CoarseOptions& /*options*/,
                                 const std::string& /*file_name*/)
{
  throw GeometryError(kHidden);
}

CutObjects cut_geometry(::netgen::CSGeometry& /*geometry*/, const cut::CutTree& /*tree*/)
{
  throw ConfigError(std::string("decompose.method = \"geometry\": ") + kHidden
                    + "; leave the key out");
}

void add_crossings(::netgen::CSGeometry& /*geometry*/, const CutObjects& /*objects*/,
                   const ::netgen::Box<3>& /*box*/)
{
}

}  // namespace tessera::netgen
