// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/jobs/worker_messages.hpp"

#include <cmath>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

namespace tessera::pipeline {

Bytes load_model_message(const model::ModelSource& source, double scale)
{
  return to_bytes(Load(ModelLoad{scale, source}));
}

Bytes load_segment_message(const SegmentName& segment)
{
  return to_bytes(Load(SegmentLoad{segment}));
}

Bytes load_numbers_message(const std::vector<number::PieceCounts>& counts,
                           const std::string& length_unit, const io::OutputOptions& options)
{
  return to_bytes(
      Load(NumbersLoad{counts, length_unit, options.compression, options.cell_quality}));
}

Bytes load_limiter_message(const mesh::ProjectionLimiter& limiter)
{
  return to_bytes(Load(LimiterLoad{limiter}));
}

Bytes load_improvement_message(const improve::ImproveOptions& options,
                               std::optional<bool> split_corners,
                               const std::vector<fill::KernelKind>& kernels)
{
  return to_bytes(Load(ImprovementLoad{options, split_corners, kernels}));
}

Bytes import_request(const std::filesystem::path& file, const model::ImportOptions& options,
                     model::StepReader reader)
{
  return to_bytes(Request(ImportRequest{file.string(), options, reader}));
}

Bytes places_request(const std::filesystem::path& file)
{
  return to_bytes(Request(PlacesRequest{file.string()}));
}

Bytes box_request() { return to_bytes(Request(BoxRequest{})); }

double box_diagonal_from_bytes(std::span<const std::byte> result)
{
  const auto diagonal = from_bytes<double>(result);
  if (diagonal > 0.0 && std::isfinite(diagonal)) return diagonal;
  throw InputError("the model's box has no size");
}

Bytes describe_request(surface::SurfaceMesher mesher)
{
  return to_bytes(Request(DescribeRequest{mesher}));
}

model::ModelDescription description_from_bytes(std::span<const std::byte> result)
{
  auto description = from_bytes<model::ModelDescription>(result);
  description.require_sound();
  return description;
}

Bytes figures_request() { return to_bytes(Request(FiguresRequest{})); }

Bytes coarse_surface_request(const surface::CoarseOptions& options, const cut::CutTree& planes,
                             LocalIndex rung)
{
  return to_bytes(Request(CoarseSurfaceRequest{options, planes, rung}));
}

Bytes coarse_domain_request(surface::DomainSkin skin, const surface::CoarseOptions& options)
{
  return to_bytes(Request(CoarseDomainRequest{std::move(skin), options}));
}

Bytes coarse_mesh_request(surface::CoarseSurface surface, std::vector<surface::DomainTets> filled,
                          const surface::CoarseOptions& options, const cut::CutTree& planes)
{
  return to_bytes(
      Request(CoarseMeshRequest{std::move(surface), std::move(filled), options, planes}));
}

Bytes layer_request(const mesh::CoarseMesh& mesh, const std::vector<layers::LayerOptions>& layers,
                    bool keep_tets)
{
  return to_bytes(Request(LayerRequest{mesh, layers, keep_tets}));
}

Bytes rim_request(const mesh::CoarseMesh& mesh, const topology::SplitOptions& splits)
{
  return to_bytes(Request(RimRequest{mesh, splits}));
}

Bytes untangle_request(const std::vector<UntangleTest>& tests,
                       const mesh::ProjectionLimiter& limiter)
{
  return to_bytes(Request(UntangleRequest{tests, limiter}));
}

Bytes fill_request(const FillTask& task) { return to_bytes(Request(task)); }

Bytes improve_request(std::vector<RegionToImprove> regions)
{
  return to_bytes(Request(ImproveRequest{std::move(regions)}));
}

improve::RegionMesh region_mesh(const std::vector<Bytes>& bands,
                                const improve::SeamRegions& regions, LocalIndex region)
{
  std::vector<improve::Band> read;
  for (const Bytes& band : bands) read.push_back(from_bytes<improve::Band>(band));
  return improve::extract_region(read, regions, region);
}

Bytes load_refinement_message(const RefineSettings& settings, const io::OutputOptions& options)
{
  return to_bytes(Load(RefinementLoad{settings, options.compression, options.cell_quality}));
}

Bytes refine_request(const RefineTask& task) { return to_bytes(Request(task)); }

Bytes skin_request(LocalIndex subdomain) { return to_bytes(Request(SkinRequest{subdomain})); }

}  // namespace tessera::pipeline
