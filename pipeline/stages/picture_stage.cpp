// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/picture_stage.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/io/vtu.hpp"

#include "pipeline/jobs/for_each_dynamic.hpp"

namespace tessera::pipeline {
namespace {

// What a core reads and draws in about a second.
constexpr GlobalIndex kMostTriangles = 1'500'000;
constexpr GlobalIndex kMostTets = 4'000'000;
// Files are drawn in so many lots: no more ranks have canvases, of 20 MB. All of it is two seconds
// of work of one core.
constexpr std::size_t kMostDrawing = 16;
// Of one file: a rank needs some 130 bytes a tet to read it.
constexpr GlobalIndex kMostTetsOfAFile = 1'000'000;

enum class Content { boundary, tets };

struct FileToDraw {
  std::filesystem::path path{};
  Content content = Content::boundary;
};

// What is drawn from files, and what from the coarse mesh.
struct DrawingPlan {
  std::vector<FileToDraw> files{};
  std::vector<LocalIndex> coarse_cut{};  // Subdomains whose tets would take too long.
  bool is_coarse_boundary = false;
};

class PlanMaker {
 public:
  PlanMaker(const RunResult& run, const subdomain::PartitionedMesh& cut, const MeshScene& scene)
      : pieces_(at(cut.num_subdomains())), cut_(cut), scene_(scene)
  {
    for (const subdomain::PieceSummary& piece : run.filled.pieces) {
      pieces_[at(piece.subdomain)] = &piece;
    }
    has_all_ = run.only_subdomains.empty();
  }

  [[nodiscard]] DrawingPlan plan(const std::vector<subdomain::SubdomainRange>& files)
  {
    for (const subdomain::SubdomainRange& file : files) add_tets(file);
    if (files.empty()) plan_.coarse_cut = cut_subdomains(0, cut_.num_subdomains());
    GlobalIndex num_triangles = 0;
    for (const subdomain::SubdomainRange& file : files) {
      num_triangles += sum(file, &subdomain::PieceSummary::num_boundary);
    }
    // The open sides of a part of the mesh are in no file.
    plan_.is_coarse_boundary = files.empty() || !has_all_ || num_triangles > kMostTriangles;
    if (plan_.is_coarse_boundary) return std::move(plan_);
    for (const subdomain::SubdomainRange& file : files) {
      if (sum(file, &subdomain::PieceSummary::num_boundary) == 0) continue;
      plan_.files.push_back({subdomain::piece_path("boundary", file.number), Content::boundary});
    }
    return std::move(plan_);
  }

 private:
  [[nodiscard]] GlobalIndex sum(const subdomain::SubdomainRange& file,
                                GlobalIndex subdomain::PieceSummary::*figure) const
  {
    GlobalIndex sum = 0;
    for (LocalIndex s = file.first; s < file.last; ++s) {
      if (pieces_[at(s)] != nullptr) sum += pieces_[at(s)]->*figure;
    }
    return sum;
  }

  [[nodiscard]] std::vector<LocalIndex> cut_subdomains(LocalIndex first, LocalIndex last) const
  {
    std::vector<LocalIndex> subdomains;
    for (LocalIndex s = first; s < last; ++s) {
      if (pieces_[at(s)] != nullptr && scene_.is_cut(cut_, s)) subdomains.push_back(s);
    }
    return subdomains;
  }

  void add_tets(const subdomain::SubdomainRange& file)
  {
    const std::vector<LocalIndex> subdomains = cut_subdomains(file.first, file.last);
    if (subdomains.empty()) return;
    const GlobalIndex num_tets = sum(file, &subdomain::PieceSummary::num_tets);
    if (num_tets > kMostTetsOfAFile || num_tets_ + num_tets > kMostTets) {
      plan_.coarse_cut.insert(plan_.coarse_cut.end(), subdomains.begin(), subdomains.end());
      return;
    }
    num_tets_ += num_tets;
    plan_.files.push_back({subdomain::piece_path("mesh", file.number), Content::tets});
  }

  std::vector<const subdomain::PieceSummary*> pieces_;
  const subdomain::PartitionedMesh& cut_;
  const MeshScene& scene_;
  bool has_all_ = true;
  GlobalIndex num_tets_ = 0;
  DrawingPlan plan_{};
};

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

void draw_file(const FileToDraw& file, const std::filesystem::path& folder, MeshScene& scene)
{
  const mesh::MeshArrays arrays = io::read_vtu(folder / file.path, io::CellOrder::up_to_second);
  if (file.content == Content::boundary) {
    scene.draw_boundary(arrays);
  } else {
    scene.draw_cut_tets(arrays);
  }
}

// A picture with a hole is better than no mesh: what cannot be read is told, not thrown.
void draw_files(const DrawingPlan& plan, MeshScene& scene, StageScope& stage, RunContext& context)
{
  GlobalIndex num_unread = 0;
  const std::size_t num_lots = std::min(plan.files.size(), kMostDrawing);
  for_each_dynamic(in_order(num_lots), in_thread([&](LocalIndex lot) {
                     for (std::size_t row = at(lot); row < plan.files.size(); row += num_lots) {
                       try {
                         draw_file(plan.files[row], context.folder, scene);
                       } catch (const InputError&) {
                         ++num_unread;
                       }
                     }
                   }),
                   stage, context);
  num_unread = context.comm.sum(num_unread);
  if (num_unread > 0) {
    context.log.warn("{} files could not be read back: the pictures lack what is in them",
                     num_unread);
  }
}

// On rank 0. Strip by strip: who has drawn nothing needs no canvas.
void put_together(Canvas& canvas, const comm::Communicator& comm)
{
  constexpr std::size_t kStrip = std::size_t{1} << 16;
  std::vector<std::uint64_t>& pixels = canvas.pixels();
  if (comm.rank() == 0) pixels.resize(canvas.num_pixels());
  for (std::size_t first = 0; first < canvas.num_pixels(); first += kStrip) {
    std::vector<std::uint64_t> strip(std::min(kStrip, canvas.num_pixels() - first));
    const auto begin = pixels.begin() + static_cast<std::ptrdiff_t>(pixels.empty() ? 0 : first);
    if (!pixels.empty()) std::copy_n(begin, strip.size(), strip.begin());
    comm.max_in_place(strip);
    if (comm.rank() == 0) std::ranges::copy(strip, begin);
  }
}

}  // namespace

std::vector<MeshPicture> run_picture_stage(const RunResult& run,
                                           const subdomain::PartitionedMesh& cut,
                                           const std::vector<subdomain::SubdomainRange>& files,
                                           RunContext& context)
{
  if (!run.resolved.output.report_html) return {};
  MeshScene scene(cut.coarse.vertex_xyz);
  const DrawingPlan plan = PlanMaker(run, cut, scene).plan(files);
  const auto num_lots = static_cast<std::int64_t>(std::min(plan.files.size(), kMostDrawing));
  StageScope stage(context, "pictures", num_lots, "lots of files");
  if (context.comm.rank() == 0) draw_coarse(run, cut, plan, scene);
  draw_files(plan, scene, stage, context);
  for (Canvas* const canvas : scene.canvases()) put_together(*canvas, context.comm);
  std::vector<MeshPicture> pictures;
  if (context.comm.rank() == 0) {
    pictures = scene.pictures();
    stage.work_is_done();
  }
  stage.finish(fmt::format("from {} files", plan.files.size()));
  return pictures;
}

}  // namespace tessera::pipeline
