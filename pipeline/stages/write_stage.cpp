// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/write_stage.hpp"

#include <numeric>
#include <optional>
#include <string>

#include <spdlog/fmt/fmt.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/work_queue.hpp"
#include "tessera/io/piece_store.hpp"
#include "tessera/io/vtu.hpp"

#include "pipeline/exit_code.hpp"
#include "pipeline/piece_arrays.hpp"
#include "pipeline/piece_folder.hpp"
#include "pipeline/stop_signal.hpp"

namespace tessera::pipeline {
namespace {

std::filesystem::path piece_name(const std::string& folder, LocalIndex subdomain)
{
  return std::filesystem::path(folder) / fmt::format("piece_{:06}.vtu", subdomain);
}

void write_piece(LocalIndex subdomain, const config::Case& run_case, const WriteContext& mesh,
                 const std::filesystem::path& folder, Hash128& digest)
{
  const mesh::Piece piece =
      mesh::piece_from_bytes(io::PieceStore(piece_folder(folder)).get(subdomain));
  const PieceArrays arrays = piece_arrays(piece, mesh, run_case.output.cell_quality);
  digest = digest_of(arrays.tets);
  io::write_vtu(arrays.tets, folder / piece_name("mesh", subdomain), run_case.output.compression);
  if (arrays.boundary.num_cells() == 0) return;
  io::write_vtu(arrays.boundary, folder / piece_name("boundary", subdomain),
                run_case.output.compression);
}

// An index without pieces is valid: a schema from an empty piece.
void write_indices(const config::Case& run_case, const WriteContext& mesh,
                   const std::vector<PieceSummary>& pieces, const std::filesystem::path& folder)
{
  std::vector<std::filesystem::path> tets;
  std::vector<std::filesystem::path> boundary;
  for (const PieceSummary& piece : pieces) {
    tets.push_back(piece_name("mesh", piece.subdomain));
    if (piece.num_boundary > 0) boundary.push_back(piece_name("boundary", piece.subdomain));
  }
  const PieceArrays schema = piece_arrays({}, mesh, run_case.output.cell_quality);
  io::write_pvtu(folder / "mesh.pvtu", tets, schema.tets);
  io::write_pvtu(folder / "boundary.pvtu", boundary, schema.boundary);
}

}  // namespace

std::vector<Hash128> run_write_stage(const config::Case& run_case,
                                     const std::vector<PieceSummary>& pieces,
                                     const WriteContext& mesh, RunContext& context)
{
  const auto num_pieces = static_cast<LocalIndex>(pieces.size());
  StageScope stage(context, "write", num_pieces, "pieces");
  all_or_none(context.comm, [&] {
    if (context.comm.rank() != 0) return;
    std::filesystem::create_directories(context.folder / "mesh");
    std::filesystem::create_directories(context.folder / "boundary");
  });
  std::vector<std::uint64_t> halves(2 * pieces.size());
  std::vector<LocalIndex> order(pieces.size());
  std::iota(order.begin(), order.end(), 0);
  std::exception_ptr defect;
  comm::WorkQueue queue(context.comm, order);
  while (const auto subdomain = queue.next()) {
    try {
      if (stop_requested()) throw Interrupted("stopped by a signal");
      Hash128 digest;
      write_piece(*subdomain, run_case, mesh, context.folder, digest);
      halves[2 * at(*subdomain)] = digest.low;
      halves[2 * at(*subdomain) + 1] = digest.high;
    } catch (...) {
      defect = std::current_exception();
      queue.request_stop();
    }
    static_cast<void>(queue.progress());
    context.progress.update(queue.num_handed_out());
  }
  static_cast<void>(queue.finish());
  all_or_none(context.comm, [&] {
    if (defect) std::rethrow_exception(defect);
    if (context.comm.rank() == 0) write_indices(run_case, mesh, pieces, context.folder);
  });
  all_or_none(context.comm, [&] {
    if (context.comm.rank() == 0) io::PieceStore(piece_folder(context.folder)).remove_all();
  });
  context.comm.sum_in_place(halves);
  std::vector<Hash128> digests;
  for (std::size_t i = 0; i < halves.size(); i += 2) digests.push_back({halves[i], halves[i + 1]});
  stage.work_is_done();
  stage.finish((context.folder / "mesh.pvtu").string());
  return digests;
}

}  // namespace tessera::pipeline
