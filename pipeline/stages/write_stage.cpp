// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/write_stage.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "tessera/io/record_store.hpp"
#include "tessera/io/vtu.hpp"

#include "pipeline/exit_code.hpp"
#include "pipeline/fill_record.hpp"
#include "pipeline/piece_arrays.hpp"
#include "pipeline/share_out.hpp"

namespace tessera::pipeline {
namespace {

// Pieces are in the order of subdomains.
bool has_boundary(const SubdomainRange& range, const std::vector<PieceSummary>& pieces)
{
  auto piece = std::lower_bound(
      pieces.begin(), pieces.end(), range.first,
      [](const PieceSummary& p, LocalIndex subdomain) { return p.subdomain < subdomain; });
  for (; piece != pieces.end() && piece->subdomain < range.last; ++piece) {
    if (piece->num_boundary > 0) return true;
  }
  return false;
}

}  // namespace

std::vector<Hash128> write_file(const SubdomainRange& range, const io::OutputOptions& options,
                                const WriteContext& mesh, const std::filesystem::path& folder)
{
  const io::RecordStore store(store_folder(folder));
  PieceFile file(mesh, options);
  std::vector<Hash128> digests;
  for (LocalIndex s = range.first; s < range.last; ++s) {
    digests.push_back(
        file.add(mesh.improved == nullptr ? stored_piece(store, s, 0) : mesh.improved->piece(s)));
  }
  file.write(folder, range.number);
  return digests;
}

void run_write_stage(const config::Case& run_case, const std::vector<SubdomainRange>& files,
                     const WriteContext& mesh, FilledPieces& filled, RunContext& context)
{
  const auto num_files = static_cast<LocalIndex>(files.size());
  StageScope stage(context, "write", num_files, "files");
  std::vector<Hash128> digests(filled.pieces.size());
  share_out(in_order(files.size()), in_thread([&](LocalIndex file) {
              const SubdomainRange& range = files[at(file)];
              std::ranges::copy(write_file(range, run_case.output, mesh, context.folder),
                                digests.begin() + range.first);
            }),
            stage, context);
  context.comm.sum_in_place(digests);
  for (std::size_t s = 0; s < digests.size(); ++s) filled.pieces[s].digest = digests[s];
  stage.finish(std::to_string(num_files) + " files");
}

// An index without pieces is valid: a schema from an empty piece.
void write_indices(const config::Case& run_case, const std::vector<SubdomainRange>& files,
                   const WriteContext& mesh, const FilledPieces& filled, RunContext& context)
{
  all_or_none(context.comm, [&] {
    if (context.comm.rank() != 0) return;
    std::vector<std::filesystem::path> tets;
    std::vector<std::filesystem::path> boundary;
    for (const SubdomainRange& range : files) {
      tets.push_back(piece_path("mesh", range.number));
      if (has_boundary(range, filled.pieces)) {
        boundary.push_back(piece_path("boundary", range.number));
      }
    }
    const PieceArrays schema = piece_arrays({}, mesh, run_case.output.cell_quality);
    io::write_pvtu(context.folder / "mesh.pvtu", tets, schema.tets);
    io::write_pvtu(context.folder / "boundary.pvtu", boundary, schema.boundary);
  });
}

}  // namespace tessera::pipeline
