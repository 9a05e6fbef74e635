// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/output/drawing_plan.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace tessera::pipeline {
namespace {

// What a core reads and draws in about a second.
constexpr GlobalIndex kMostTriangles = 1'500'000;
constexpr GlobalIndex kMostTets = 4'000'000;
// Of one file: a rank needs some 130 bytes a tet to read it.
constexpr GlobalIndex kMostTetsOfAFile = 1'000'000;

class PlanMaker {
 public:
  PlanMaker(const RunResult& run, const subdomain::PartitionedMesh& cut, const MeshScene& scene)
      : pieces_(at(cut.num_subdomains())),
        cut_(cut),
        scene_(scene),
        has_all_(run.only_subdomains.empty()),
        triangles_a_face_(run.resolved.output.order == 2 ? 4 : 1)
  {
    for (const subdomain::PieceSummary& piece : run.filled.pieces) {
      pieces_[at(piece.subdomain)] = &piece;
    }
  }

  [[nodiscard]] DrawingPlan plan(const std::vector<subdomain::SubdomainRange>& files)
  {
    GlobalIndex num_triangles = 0;
    for (const subdomain::SubdomainRange& file : files) {
      num_triangles += sum(file, &subdomain::PieceSummary::num_all_boundary);
      plan_.files.push_back({.number = file.number});
    }
    if (files.empty()) plan_.coarse_cut = cut_subdomains(0, cut_.num_subdomains());
    // The open sides of a part of the mesh are in no file.
    plan_.is_coarse_boundary = files.empty() || !has_all_ || num_triangles > kMostTriangles;
    plan_.is_coarse_surface =
        plan_.is_coarse_boundary || triangles_a_face_ * num_triangles > Surface::kMostTriangles;
    for (std::size_t row = 0; row < files.size(); ++row) add_cut(files[row], plan_.files[row]);
    for (std::size_t row = 0; row < files.size(); ++row) add_boundary(files[row], plan_.files[row]);
    std::erase_if(plan_.files, [](const FileToDraw& file) {
      return !file.reads_boundary() && !file.reads_tets();
    });
    return std::move(plan_);
  }

 private:
  // @param[in] figure A member of PieceSummary.
  template <class Figure>
  [[nodiscard]] GlobalIndex sum(const subdomain::SubdomainRange& file, Figure figure) const
  {
    GlobalIndex sum = 0;
    for (LocalIndex s = file.first; s < file.last; ++s) {
      if (pieces_[at(s)] != nullptr) sum += std::invoke(figure, *pieces_[at(s)]);
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

  // Whether the tets of a file may be read; if so, they are counted.
  bool takes_tets(const subdomain::SubdomainRange& file)
  {
    const GlobalIndex num_tets = sum(file, &subdomain::PieceSummary::num_tets);
    if (num_tets > kMostTetsOfAFile || plan_.num_tets + num_tets > kMostTets) return false;
    plan_.num_tets += num_tets;
    return true;
  }

  void add_cut(const subdomain::SubdomainRange& file, FileToDraw& drawn)
  {
    const std::vector<LocalIndex> subdomains = cut_subdomains(file.first, file.last);
    if (subdomains.empty()) return;
    drawn.is_cut = takes_tets(file);
    if (drawn.is_cut) return;
    plan_.coarse_cut.insert(plan_.coarse_cut.end(), subdomains.begin(), subdomains.end());
  }

  void add_boundary(const subdomain::SubdomainRange& file, FileToDraw& drawn)
  {
    if (sum(file, &subdomain::PieceSummary::num_all_boundary) == 0) return;
    drawn.has_boundary = !plan_.is_coarse_boundary;
    drawn.has_surface = !plan_.is_coarse_surface;
    drawn.has_quality = drawn.has_surface && (drawn.is_cut || takes_tets(file));
  }

  std::vector<const subdomain::PieceSummary*> pieces_;
  const subdomain::PartitionedMesh& cut_;
  const MeshScene& scene_;
  bool has_all_;
  GlobalIndex triangles_a_face_;
  DrawingPlan plan_{};
};

}  // namespace

DrawingPlan plan_drawing(const RunResult& run, const subdomain::PartitionedMesh& cut,
                         const MeshScene& scene,
                         const std::vector<subdomain::SubdomainRange>& files)
{
  return PlanMaker(run, cut, scene).plan(files);
}

}  // namespace tessera::pipeline
