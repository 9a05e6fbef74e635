// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/runtime/installed.hpp"

#include <cstdlib>
#include <system_error>

namespace tessera::pipeline {
namespace {

constexpr const char* kPrefix = "OPAL_PREFIX";

void set(const char* name, const std::filesystem::path& value) { ::setenv(name, value.c_str(), 1); }

}  // namespace

std::filesystem::path install_prefix()
{
  std::error_code failed;
  return std::filesystem::read_symlink("/proc/self/exe", failed).parent_path().parent_path();
}

std::optional<std::filesystem::path> mpi_inside()
{
  std::filesystem::path folder = install_prefix() / "libexec/tessera-mpi";
  std::error_code failed;
  if (!std::filesystem::is_directory(folder, failed)) return std::nullopt;
  return folder;
}

// The folders of Debian's Open MPI, PMIx and hwloc are compiled in, and may be there, of another
// version. What is named here and does not exist is not needed: plugins of PMIx and hwloc.
void use_mpi_inside(const std::filesystem::path& folder)
{
  set(kPrefix, folder);
  set("OPAL_LIBDIR", folder / "lib");
  set("OPAL_SYSCONFDIR", folder / "etc");
  set("PMIX_PKGLIBDIR", folder / "lib/pmix");
  set("PMIX_SYSCONFDIR", folder / "etc");
  set("PMIX_MCA_pcompress_base_silence_warning", "1");
  set("HWLOC_PLUGINS_PATH", folder / "lib/hwloc");
  // One process without mpirun needs no daemon beside it.
  set("OMPI_MCA_ess_singleton_isolated", "1");
}

bool is_rank_of_other_mpi(const std::filesystem::path& folder)
{
  const bool is_rank = std::getenv("PMI_RANK") != nullptr || std::getenv("PMIX_RANK") != nullptr;
  const char* const prefix = std::getenv(kPrefix);
  return is_rank && (prefix == nullptr || folder != prefix);
}

}  // namespace tessera::pipeline
