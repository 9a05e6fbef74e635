// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/improve_job.hpp"

#include <span>
#include <utility>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "tessera/quality/statistics.hpp"

#include "pipeline/improved_pieces.hpp"

namespace tessera::pipeline {
namespace {

improve::ShapeSummary measure_shapes(const improve::TetMesh& mesh)
{
  const std::span<const double> xyz(mesh.vertex_xyz);
  quality::Histogram unused(0.0, 1.0, 1);
  quality::ShapeSum sum(unused);
  for (std::size_t t = 0; 4 * t < mesh.tet_vertices.size(); ++t) {
    const LocalIndex* v = &mesh.tet_vertices[4 * t];
    sum.add(quality::shape_of(
        {point_at(xyz, v[0]), point_at(xyz, v[1]), point_at(xyz, v[2]), point_at(xyz, v[3])}));
  }
  const quality::TetStatistics shapes = sum.statistics();
  return {shapes.min_dihedral_deg, shapes.min_mean_ratio, shapes.mean_mean_ratio()};
}

}  // namespace

Bytes to_bytes(const RegionRecord& record)
{
  ByteWriter out;
  out.put(record.is_improved);
  out.put(record.has_failed);
  out.put(record.was_limited);
  out.put(record.reason);
  out.put(improve::to_bytes(record.patch));
  return std::move(out).take();
}

RegionRecord region_record_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  RegionRecord record;
  record.is_improved = in.get<bool>();
  record.has_failed = in.get<bool>();
  record.was_limited = in.get<bool>();
  record.reason = in.get_string();
  record.patch = improve::patch_from_bytes(in.get_vector<std::byte>());
  return record;
}

std::string region_name(LocalIndex region) { return fmt::format("region_{:06}", region); }

std::vector<mesh::Piece> pieces_around(const ImproveContext& context, LocalIndex region)
{
  std::vector<mesh::Piece> pieces;
  for (const LocalIndex s : context.regions.subdomains_of(region)) {
    pieces.push_back(stored_piece(context.store, s, context.generation));
  }
  return pieces;
}

improve::RegionMesh region_mesh(const std::vector<mesh::Piece>& pieces,
                                const improve::Regions& regions, LocalIndex region)
{
  const int phase = regions.phase_of(region);
  std::vector<std::vector<LocalIndex>> labels;
  for (const mesh::Piece& piece : pieces) {
    labels.push_back(improve::label_tets(piece, regions, phase, improve::kDefaultLayers));
  }
  std::vector<improve::LabelledPiece> labelled;
  for (std::size_t i = 0; i < pieces.size(); ++i) labelled.push_back({pieces[i], labels[i]});
  return improve::extract_region(labelled, regions, region);
}

RegionRecord improve_tets(const improve::RegionMesh& mesh, int rounds,
                          const improve::Optimizer& optimizer)
{
  RegionRecord record;
  if (mesh.num_tets() == 0) {
    record.reason = "other regions have all its tets";
  } else {
    improve::OptimizeSettings settings;
    settings.rounds = rounds;
    improve::RegionOutcome outcome =
        improve::improve_region(mesh, optimizer, settings, measure_shapes);
    record.is_improved = outcome.is_accepted;
    record.reason = std::move(outcome.reason);
    record.patch = std::move(outcome.patch);
  }
  return record;
}

mesh::Piece merge_regions(const ImproveContext& context, LocalIndex subdomain, int phase)
{
  mesh::Piece piece = stored_piece(context.store, subdomain, context.generation);
  std::vector<improve::Patch> patches;
  for (const LocalIndex region : context.regions.regions_of(subdomain, phase)) {
    const std::string name = region_name(region);
    if (!context.store.contains(name)) continue;  // A region that is not to be improved.
    RegionRecord record = region_record_from_bytes(context.store.get(name));
    if (record.is_improved) patches.push_back(std::move(record.patch));
  }
  if (patches.empty()) return piece;
  const auto labels = improve::label_tets(piece, context.regions, phase, improve::kDefaultLayers);
  return improve::apply_patches(piece, labels, patches);
}

}  // namespace tessera::pipeline
