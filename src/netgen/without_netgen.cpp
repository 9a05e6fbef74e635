// SPDX-License-Identifier: BSD-3-Clause
// Stands in for all other files of this module in a build with TESSERA_WITH_NETGEN=OFF.
#include "tessera/base/error.hpp"
#include "tessera/netgen/factory.hpp"

namespace tessera::netgen {
namespace {

[[noreturn]] void refuse()
{
  throw ConfigError(
      "this build of tessera has no NETGEN (it was configured with -DTESSERA_WITH_NETGEN=OFF), so "
      "it can neither read a CAD model nor mesh one; it can check and repartition meshes");
}

}  // namespace

void load_library() {}  // There is none.

void require_model_file(const std::filesystem::path& /*file*/) { refuse(); }

bool is_model_name(const std::filesystem::path& /*file*/) { return false; }

model::ModelSource import_model(const std::filesystem::path& /*file*/,
                                const model::ImportOptions& /*options*/, StepReader /*reader*/)
{
  refuse();
}

std::unique_ptr<model::Model> load_model(const model::ModelSource& /*source*/) { refuse(); }

model::ModelDescription describe_model(const model::Model& /*model*/,
                                       surface::SurfaceMesher /*mesher*/)
{
  refuse();
}

coarse::ModelFigures measure_model(const model::Model& /*model*/) { refuse(); }

void name_curves(const model::Model& /*model*/, mesh::CoarseMesh& /*mesh*/) { refuse(); }

std::unique_ptr<coarse::CoarseMesher> make_coarse_mesher(const model::Model& /*model*/)
{
  refuse();
}

std::unique_ptr<fill::Kernel> make_fill_kernel() { refuse(); }

bool skin_overlaps(const fill::FillInput& /*skin*/) { refuse(); }

std::string netgen_version() { return "none"; }

}  // namespace tessera::netgen
