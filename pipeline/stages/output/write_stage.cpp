// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/output/write_stage.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/comm/all_or_none.hpp"
#include "tessera/formats/export_mesh.hpp"
#include "tessera/io/record_store.hpp"
#include "tessera/io/vtu.hpp"
#include "tessera/subdomain/periodic_partners.hpp"
#include "tessera/subdomain/piece_arrays.hpp"

#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/run_result.hpp"
#include "pipeline/store/fill_record.hpp"
#include "pipeline/store/improved_pieces.hpp"

namespace tessera::pipeline {
namespace {

// Whether one of the pieces in a file has some. They are in the order of subdomains.
template <class HasSome>
bool any_in(const subdomain::SubdomainRange& range,
            const std::vector<subdomain::PieceSummary>& pieces, const HasSome& has_some)
{
  auto piece = std::lower_bound(pieces.begin(), pieces.end(), range.first,
                                [](const subdomain::PieceSummary& p, LocalIndex subdomain) {
                                  return p.subdomain < subdomain;
                                });
  for (; piece != pieces.end() && piece->subdomain < range.last; ++piece) {
    if (has_some(*piece)) return true;
  }
  return false;
}

// Files of a folder whose pieces have some, relative to the output folder.
template <class HasSome>
std::vector<std::filesystem::path> files_with(const char* folder,
                                              const std::vector<subdomain::SubdomainRange>& files,
                                              const std::vector<subdomain::PieceSummary>& pieces,
                                              const HasSome& has_some)
{
  std::vector<std::filesystem::path> paths;
  for (const subdomain::SubdomainRange& range : files) {
    if (any_in(range, pieces, has_some))
      paths.push_back(subdomain::piece_path(folder, range.number));
  }
  return paths;
}

// An index without pieces is valid: a schema from an empty piece.
void write_pvtu_indices(const std::vector<subdomain::SubdomainRange>& files, const RunResult& run,
                        const subdomain::PieceArrays& schema, const std::filesystem::path& folder)
{
  std::vector<std::filesystem::path> tets;
  for (const subdomain::SubdomainRange& range : files) {
    tets.push_back(subdomain::piece_path("mesh", range.number));
  }
  io::write_pvtu(folder / "mesh.pvtu", tets, schema.tets, formats::shared_points(run.files));
  mesh::MeshArrays boundary = schema.boundary;
  subdomain::name_periodic_partners(boundary);
  io::write_pvtu(folder / "boundary.pvtu", boundary_files(files, run.filled.pieces), boundary);
  const auto has_lines = [](const auto& piece) { return !piece.lines.empty(); };
  const auto lines = files_with("lines", files, run.filled.pieces, has_lines);
  if (!lines.empty()) io::write_pvtu(folder / "lines.pvtu", lines, schema.lines);
}

}  // namespace

std::vector<std::filesystem::path> boundary_files(
    const std::vector<subdomain::SubdomainRange>& files,
    const std::vector<subdomain::PieceSummary>& pieces)
{
  return files_with("boundary", files, pieces,
                    [](const auto& piece) { return piece.num_all_boundary() > 0; });
}

GatheredFile gather_file(const subdomain::SubdomainRange& range, const io::OutputOptions& options,
                         const subdomain::WriteContext& mesh, const PieceStore& pieces)
{
  GatheredFile gathered{.file = {mesh, options}};
  for (LocalIndex s = range.first; s < range.last; ++s) {
    gathered.digests.push_back(gathered.file.add(stored_piece(pieces, s)));
  }
  return gathered;
}

std::vector<Hash128> write_file(const subdomain::SubdomainRange& range,
                                const io::OutputOptions& options,
                                const subdomain::WriteContext& mesh, const PieceStore& pieces)
{
  GatheredFile gathered = gather_file(range, options, mesh, pieces);
  static_cast<void>(gathered.file.write(pieces.folder, range.number));
  return std::move(gathered.digests);
}

std::vector<Hash128> run_write_stage(const config::Case& run_case,
                                     const std::vector<subdomain::SubdomainRange>& files,
                                     const subdomain::WriteContext& mesh,
                                     const FilledPieces& filled, RunContext& context)
{
  const auto num_files = static_cast<LocalIndex>(files.size());
  StageScope stage(context, Stage::write, num_files, "files");
  const PieceStore pieces = store_of(filled, context.folder);
  std::vector<Hash128> digests(filled.pieces.size());
  for_each_dynamic(in_order(files.size()), in_thread([&](LocalIndex file) {
                     const subdomain::SubdomainRange& range = files[at(file)];
                     std::ranges::copy(write_file(range, run_case.output, mesh, pieces),
                                       digests.begin() + range.first);
                   }),
                   stage, context);
  context.comm.sum_in_place(digests);
  stage.finish(fmt::format("{} files", num_files));
  return digests;
}

void write_indices(const RunResult& run, const std::vector<subdomain::SubdomainRange>& files,
                   const subdomain::WriteContext& mesh, RunContext& context)
{
  all_or_none(context.comm, [&] {
    if (context.comm.rank() != 0) return;
    const subdomain::PieceArrays schema =
        subdomain::piece_arrays({}, mesh, run.resolved.output.cell_quality);
    write_pvtu_indices(files, run, schema, context.folder);
  });
}

}  // namespace tessera::pipeline
