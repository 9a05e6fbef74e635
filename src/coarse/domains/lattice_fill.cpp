// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/domains/lattice_fill.hpp"

#include <cmath>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "tessera/base/enclosed_volume.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/given_up.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/base/vec3.hpp"

#include "coarse/domains/kept_tets.hpp"
#include "coarse/domains/lattice_points.hpp"

namespace tessera::coarse {
namespace {

// A hole that was not filled in four sizes was not in more either, on the corpus.
constexpr int kMostRounds = 4;

double volume_of(const surface::DomainTets& tets)
{
  double volume = 0.0;
  for (std::size_t t = 0; 4 * t < tets.tet_vertices.size(); ++t) {
    volume += tet_volume(corners_at<4>(tets.vertex_xyz, tets.tet_vertices, t));
  }
  return volume;
}

// The tets of a hole; nothing if it cannot be filled, or with too much or too little.
std::optional<surface::DomainTets> fill_hole(const surface::DomainSkin& hole,
                                             const HoleFiller& filler)
{
  constexpr double kRounding = 1e-6;
  try {
    surface::DomainTets tets = filler(hole);
    const double volume = enclosed_volume(hole.vertex_xyz, hole.triangle_vertices);
    if (std::abs(volume_of(tets) - volume) <= kRounding * volume) return tets;
  } catch (const NetgenError& error) {  // There are other ways to fill it: fill_with_lattice().
    note_given_up("tets in a hole of the lattice", error);
  }
  return std::nullopt;
}

// Tets by rows of all points, and points that fillers have put into holes.
struct FilledHoles {
  std::vector<double> new_xyz{};
  std::vector<LocalIndex> tet_vertices{};
  std::vector<LocalIndex> unfilled{};  // Vertices of the holes that could not be filled.
};

FilledHoles fill_holes(const std::vector<surface::DomainSkin>& holes, std::size_t num_points,
                       const HoleFiller& filler)
{
  FilledHoles filled;
  for (const surface::DomainSkin& hole : holes) {
    const auto tets = fill_hole(hole, filler);
    if (!tets) {
      filled.unfilled.insert(filled.unfilled.end(), hole.vertex.begin(), hole.vertex.end());
      continue;
    }
    const std::size_t num_old = hole.vertex.size();
    const std::size_t first_new = num_points + filled.new_xyz.size() / 3;
    filled.new_xyz.insert(filled.new_xyz.end(),
                          tets->vertex_xyz.begin() + static_cast<std::ptrdiff_t>(3 * num_old),
                          tets->vertex_xyz.end());
    for (const LocalIndex v : tets->tet_vertices) {
      filled.tet_vertices.push_back(at(v) < num_old
                                        ? hole.vertex[at(v)]
                                        : static_cast<LocalIndex>(first_new + at(v) - num_old));
    }
  }
  return filled;
}

// Vertices of the skin keep their places; others are there if a tet has them.
surface::DomainTets without_unused(const surface::DomainSkin& skin, std::span<const double> xyz,
                                   std::vector<LocalIndex> tet_vertices)
{
  surface::DomainTets tets{skin.vertex_xyz, std::move(tet_vertices)};
  std::vector<LocalIndex> row(xyz.size() / 3, kNoIndex);
  std::iota(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(skin.vertex.size()), 0);
  for (LocalIndex& v : tets.tet_vertices) {
    if (row[at(v)] == kNoIndex) {
      row[at(v)] = static_cast<LocalIndex>(tets.vertex_xyz.size() / 3);
      const Vec3 point = point_at(xyz, v);
      tets.vertex_xyz.insert(tets.vertex_xyz.end(), point.begin(), point.end());
    }
    v = row[at(v)];
  }
  return tets;
}

std::optional<surface::DomainTets> filled(const surface::DomainSkin& skin, std::vector<double> xyz,
                                          KeptTets& kept, const HoleFiller& filler)
{
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<surface::DomainSkin> holes = kept.holes();
    if (!holes.empty() && is_left_out(Repair::lattice_holes)) return std::nullopt;
    const FilledHoles in_holes = fill_holes(holes, xyz.size() / 3, filler);
    if (!in_holes.unfilled.empty()) {
      kept.take_out_around(in_holes.unfilled);
      continue;
    }
    note_repair(Repair::lattice_holes, static_cast<GlobalIndex>(holes.size()));
    xyz.insert(xyz.end(), in_holes.new_xyz.begin(), in_holes.new_xyz.end());
    std::vector<LocalIndex> tet_vertices = kept.tet_vertices();
    tet_vertices.insert(tet_vertices.end(), in_holes.tet_vertices.begin(),
                        in_holes.tet_vertices.end());
    return without_unused(skin, xyz, std::move(tet_vertices));
  }
  return std::nullopt;
}

}  // namespace

std::optional<surface::DomainTets> fill_with_lattice(const surface::DomainSkin& skin,
                                                     const surface::CoarseOptions& options,
                                                     const HoleFiller& filler)
{
  std::vector<double> xyz = skin.vertex_xyz;
  std::vector<double> lattice_side(skin.vertex.size(), 0.0);
  const InsidePoints inside = lattice_points(skin, options);
  xyz.insert(xyz.end(), inside.xyz.begin(), inside.xyz.end());
  lattice_side.insert(lattice_side.end(), inside.side.begin(), inside.side.end());
  try {
    KeptTets kept(skin, xyz, lattice_side);
    kept.take_out_flat();
    return filled(skin, xyz, kept, filler);
  } catch (
      const MeshError& error) {  // The skin cuts itself, as exact tests see it; NETGEN may not.
    note_given_up("tets from a lattice", error);
    return std::nullopt;
  }
}

}  // namespace tessera::coarse
