// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/output/picture_stage.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"
#include "tessera/io/vtu.hpp"

#include "pipeline/drawing/mesh_scene.hpp"
#include "pipeline/jobs/for_each_dynamic.hpp"
#include "pipeline/stages/output/drawing_plan.hpp"

namespace tessera::pipeline {
namespace {

// Files are drawn in so many lots: no more ranks have canvases, of 20 MB. All of it is two seconds
// of work of one core. Canvases of a rank more cost as much as to read and draw so many tets.
constexpr std::size_t kMostDrawing = 16;
constexpr GlobalIndex kTetsOfALot = 50'000;

std::size_t num_lots(const DrawingPlan& plan)
{
  const auto worth = static_cast<std::size_t>(1 + plan.num_tets / kTetsOfALot);
  return std::min({plan.files.size(), kMostDrawing, worth});
}

void draw_coarse(const RunResult& run, const subdomain::PartitionedMesh& cut,
                 const DrawingPlan& plan, MeshScene& scene)
{
  std::vector<char> is_made(at(cut.num_subdomains()));
  for (const subdomain::PieceSummary& piece : run.filled.pieces) {
    is_made[at(piece.subdomain)] = 1;
    if (std::ranges::binary_search(plan.coarse_cut, piece.subdomain)) {
      scene.draw_coarse_cut(cut, piece.subdomain, piece.tets.mean_mean_ratio());
    }
  }
  if (plan.is_coarse_boundary) scene.draw_coarse_boundary(cut, is_made);
}

// What a rank has read of files: drawn, and kept for the surface to turn.
class FileDrawer {
 public:
  FileDrawer(const std::filesystem::path& folder, MeshScene& scene) : folder_(folder), scene_(scene)
  {
  }

  // A picture with a hole is better than no mesh: what cannot be read is told, not thrown.
  void draw(const FileToDraw& file)
  {
    const auto boundary = read(file.reads_boundary(), "boundary", file.number);
    const auto tets = read(file.reads_tets(), "mesh", file.number);
    if (file.has_boundary && boundary) scene_.draw_boundary(*boundary);
    if (file.is_cut && tets) scene_.draw_cut_tets(*tets);
    if (!file.has_surface || !boundary) return;
    const bool has_quality = file.has_quality && tets;
    parts_.push_back(surface_part(file.number, *boundary, has_quality ? &*tets : nullptr));
  }

  // Why, one text for each file.
  [[nodiscard]] const std::vector<std::string>& unread() const { return unread_; }
  [[nodiscard]] const std::vector<SurfacePart>& parts() const { return parts_; }

 private:
  std::optional<mesh::MeshArrays> read(bool is_wanted, const std::string& kind, LocalIndex number)
  {
    if (!is_wanted) return std::nullopt;
    try {
      return io::read_vtu(folder_ / subdomain::piece_path(kind, number),
                          io::CellOrder::up_to_second);
    } catch (const InputError& error) {
      unread_.emplace_back(error.what());
      return std::nullopt;
    }
  }

  const std::filesystem::path& folder_;
  MeshScene& scene_;
  std::vector<std::string> unread_{};
  std::vector<SurfacePart> parts_{};
};

// On rank 0 the surface of all files; elsewhere none.
Surface draw_files(const DrawingPlan& plan, MeshScene& scene, StageScope& stage,
                   RunContext& context)
{
  FileDrawer drawer(context.folder, scene);
  const std::size_t lots = num_lots(plan);
  for_each_dynamic(in_order(lots), in_thread([&](LocalIndex lot) {
                     for (std::size_t row = at(lot); row < plan.files.size(); row += lots) {
                       drawer.draw(plan.files[row]);
                     }
                   }),
                   stage, context);
  if (const auto unread = context.comm.all_gather_rows(drawer.unread()); !unread.empty()) {
    context.log.warn(
        fmt::format("{} files could not be read back: the pictures lack what is in them; {}",
                    unread.size(), unread.front()));
  }
  std::vector<SurfacePart> parts;
  for (const Bytes& of_rank : context.comm.gather_to_root(to_bytes(drawer.parts()))) {
    for (SurfacePart& part : from_bytes<std::vector<SurfacePart>>(of_rank)) {
      parts.push_back(std::move(part));
    }
  }
  return joined(std::move(parts));
}

// On rank 0, strip by strip. Who has drawn nothing has no canvas.
void put_together(Canvas& canvas, const comm::Communicator& comm)
{
  constexpr std::size_t kStrip = std::size_t{1} << 16;
  std::vector<std::uint64_t>& pixels = canvas.pixels();
  if (comm.rank() == 0) pixels.resize(canvas.num_pixels());
  for (std::size_t first = 0; first < canvas.num_pixels(); first += kStrip) {
    const std::size_t size = std::min(kStrip, canvas.num_pixels() - first);
    std::span<std::uint64_t> mine;
    if (!pixels.empty()) mine = std::span(pixels).subspan(first, size);
    for (const Bytes& strip : comm.gather_to_root(std::as_bytes(mine))) {
      for (std::size_t i = 0; i < strip.size() / sizeof(std::uint64_t); ++i) {
        std::uint64_t pixel = 0;
        std::memcpy(&pixel, &strip[i * sizeof pixel], sizeof pixel);
        mine[i] = std::max(mine[i], pixel);
      }
    }
  }
}

}  // namespace

Drawings run_picture_stage(const RunResult& run, const subdomain::PartitionedMesh& cut,
                           const std::vector<subdomain::SubdomainRange>& files, RunContext& context)
{
  MeshScene scene(cut.coarse.vertex_xyz);
  const DrawingPlan plan = plan_drawing(run, cut, scene, files);
  StageScope stage(context, Stage::pictures, static_cast<std::int64_t>(num_lots(plan)),
                   "lots of files");
  if (context.comm.rank() == 0) draw_coarse(run, cut, plan, scene);
  Drawings drawings{.surface = draw_files(plan, scene, stage, context)};
  for (Canvas* const canvas : scene.canvases()) put_together(*canvas, context.comm);
  if (context.comm.rank() == 0) {
    drawings.pictures = scene.pictures();
    if (plan.is_coarse_surface) drawings.surface = coarse_surface(cut, run.filled.pieces);
    stage.work_is_done();
  }
  stage.finish(fmt::format("from {} files", plan.files.size()));
  return drawings;
}

}  // namespace tessera::pipeline
