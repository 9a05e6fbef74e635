// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/estimate/disk_space.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"

namespace tessera::pipeline {
FolderSize size_of_folders(const std::filesystem::path& parent,
                           const std::vector<std::string>& names)
{
  FolderSize size;
  std::error_code error;
  for (const std::string& name : names) {
    for (std::filesystem::recursive_directory_iterator entry(parent / name, error), end;
         !error && entry != end; entry.increment(error)) {
      if (!entry->is_regular_file(error)) continue;
      size.num_files += 1.0;
      size.bytes += static_cast<double>(entry->file_size(error));
    }
  }
  return size;
}

DiskNeed disk_need(const RunOutline& outline, const Rates& rates)
{
  // Beside the filled pieces there are bands, rims and updates. On shaft they are 0.8 times as much
  // with pieces of 72,000 tets, 1.4 times with 9,000 and 3.1 times with 2,400.
  const double copies = outline.improves_seams ? 3.0 : 1.0;
  DiskNeed need;
  for (const subdomain::SubdomainRange& file : outline.files) {
    for (LocalIndex s = file.first; s < file.last; ++s) {
      const KernelRates& kernel = rates.of(outline.kernels[at(s)]);
      const auto tets = static_cast<double>(outline.pieces[at(s)].tets);
      if (outline.has_files) need.file_bytes += kernel.file_bytes_per_tet * tets;
      if (!outline.is_one_pass) {
        need.store_bytes += copies * kernel.store_bytes_per_tet * outline.filled_share() * tets;
      }
      if (outline.splits_pieces() && !outline.has_files) {  // They wait there to be handed over.
        need.store_bytes += kernel.store_bytes_per_tet * tets;
      }
    }
    if (!outline.has_files) continue;
    const GlobalIndex triangles = outline.boundary_triangles_of(file);
    need.num_files += triangles > 0 ? 2 : 1;
    need.file_bytes += rates.file_bytes_per_boundary_triangle * static_cast<double>(triangles);
  }
  need.file_bytes += rates.file_header_bytes * static_cast<double>(need.num_files);
  return need;
}

void require_disk_space(const RunOutline& outline, const io::OutputOptions& options,
                        RunContext& context)
{
  const DiskNeed need = disk_need(outline, built_in_rates(options));
  all_or_none(context.comm, [&] {
    if (context.comm.rank() != 0) return;
    // What an earlier try has left there need not be written again.
    const double free =
        static_cast<double>(std::filesystem::space(context.folder).available)
        + size_of_folders(context.folder, {"mesh", "boundary", "lines", "pieces"}).bytes;
    if (need.file_bytes + need.store_bytes <= free) return;
    throw OutputError(fmt::format(
        "{}: about {:.3g} GB are needed and {:.3g} GB are free; choose another output.directory, "
        "output.compression = \"{}\", or fewer refine.levels",
        context.folder.string(), 1e-9 * (need.file_bytes + need.store_bytes), 1e-9 * free,
        word_of(io::Compression::zlib)));
  });
}

}  // namespace tessera::pipeline
