// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/disk_space.hpp"

#include <filesystem>

#include <spdlog/fmt/fmt.h>

#include "tessera/base/error.hpp"

#include "pipeline/exit_code.hpp"

namespace tessera::pipeline {
namespace {

// Measured on subdivided and re-meshed shaft, mesh and boundary files together.
double file_bytes_a_tet(io::Compression compression)
{
  switch (compression) {
    case io::Compression::none:
      return 52.0;
    case io::Compression::zlib:
      return 13.0;
    case io::Compression::lz4:
      return 25.0;
  }
  return 52.0;
}

constexpr double kStoreBytesATet = 28.0;
constexpr double kQualityBytesATet = 8.0;

// What an earlier try has left there need not be written again.
double bytes_in(const std::filesystem::path& folder)
{
  std::error_code error;
  double bytes = 0.0;
  for (std::filesystem::recursive_directory_iterator entry(folder, error), end;
       !error && entry != end; entry.increment(error)) {
    if (entry->is_regular_file(error)) bytes += static_cast<double>(entry->file_size(error));
  }
  return bytes;
}

}  // namespace

DiskNeed predict_disk_need(double num_tets, bool is_one_pass, const io::OutputOptions& options)
{
  const double a_tet =
      file_bytes_a_tet(options.compression) + (options.cell_quality ? kQualityBytesATet : 0.0);
  return {.files = a_tet * num_tets, .store = is_one_pass ? 0.0 : kStoreBytesATet * num_tets};
}

void require_disk_space(const RunResult& run, const std::vector<SubdomainRange>& ranges,
                        RunContext& context)
{
  double num_tets = 0.0;
  for (const SubdomainRange& range : ranges) {
    for (LocalIndex s = range.first; s < range.last; ++s) {
      num_tets += run.decomposition.decomposition.subdomain_weight[at(s)];
    }
  }
  const DiskNeed need = predict_disk_need(num_tets, are_counts_known(run), run.resolved.output);
  all_or_none(context.comm, [&] {
    if (context.comm.rank() != 0) return;
    const double free = static_cast<double>(std::filesystem::space(context.folder).available)
                        + bytes_in(context.folder);
    if (need.files + need.store <= free) return;
    throw OutputError(fmt::format(
        "{}: about {:.3g} GB are needed for {:.3g} tets and {:.3g} GB are free; choose another "
        "output.directory, output.compression = \"zlib\", or fewer refine.levels",
        context.folder.string(), 1e-9 * (need.files + need.store), num_tets, 1e-9 * free));
  });
}

}  // namespace tessera::pipeline
