// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/viewer/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>

#include "tessera/base/tet.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/quality/tet_quality.hpp"

#include "pipeline/drawing/coarse_boundary.hpp"
#include "pipeline/drawing/flat_triangles.hpp"

namespace tessera::pipeline {
namespace {

// Rows of tets by their ids, which ascend in files of this program, but not in all others.
class TetRows {
 public:
  explicit TetRows(const std::vector<GlobalIndex>& ids) : ids_(ids), rows_(ids.size())
  {
    std::iota(rows_.begin(), rows_.end(), std::size_t{0});
    if (std::ranges::is_sorted(ids)) return;
    std::ranges::sort(rows_, {}, [this](std::size_t row) { return ids_[row]; });
  }

  // The number of tets if there is none.
  [[nodiscard]] std::size_t row_of(GlobalIndex id) const
  {
    const auto found =
        std::ranges::lower_bound(rows_, id, {}, [this](std::size_t row) { return ids_[row]; });
    return found == rows_.end() || ids_[*found] != id ? rows_.size() : *found;
  }

 private:
  const std::vector<GlobalIndex>& ids_;
  std::vector<std::size_t> rows_;
};

std::uint8_t quality_of(const mesh::MeshArrays& tets, std::size_t row)
{
  const auto points =
      std::span(tets.cell_points).subspan(row * static_cast<std::size_t>(tets.vertices_per_cell));
  return quality_byte(quality::mean_ratio(corners_at<4>(tets.point_xyz, points, 0)));
}

// Of each boundary cell.
std::vector<std::uint32_t> qualities_behind(const mesh::MeshArrays& boundary,
                                            const mesh::MeshArrays* tets)
{
  std::vector<std::uint32_t> qualities(static_cast<std::size_t>(boundary.num_cells()),
                                       kUnknownQuality);
  const auto behind = boundary.cell_longs.find("tet");
  if (tets == nullptr || behind == boundary.cell_longs.end()) return qualities;
  const TetRows rows(tets->cell_ids);
  for (std::size_t cell = 0; cell < qualities.size(); ++cell) {
    const std::size_t row = rows.row_of(behind->second[cell]);
    if (row < tets->cell_ids.size()) qualities[cell] = quality_of(*tets, row);
  }
  return qualities;
}

// Arrays of a boundary file, and what they are called here. A cell array of another name, such as
// the layer of a boundary layer, needs a line here and a colouring where the page is described.
constexpr std::array<std::pair<const char*, const char*>, 2> kCellArrays{
    {{"patch", "face"}, {"subdomain", "subdomain"}}};

// Of each boundary cell.
CellValues values_of(const mesh::MeshArrays& boundary, const mesh::MeshArrays* tets)
{
  CellValues values;
  for (const auto& [array, name] : kCellArrays) {
    const auto found = boundary.cell_ints.find(array);
    if (found == boundary.cell_ints.end()) continue;
    values[name].assign(found->second.begin(), found->second.end());
  }
  values["quality"] = qualities_behind(boundary, tets);
  return values;
}

}  // namespace

std::uint8_t quality_byte(double mean_ratio)
{
  constexpr double kSteps = 250.0;
  return static_cast<std::uint8_t>(std::lround(kSteps * std::clamp(mean_ratio, 0.0, 1.0)));
}

SurfacePart surface_part(LocalIndex number, const mesh::MeshArrays& boundary,
                         const mesh::MeshArrays* tets)
{
  SurfacePart part{
      .number = number, .point_ids = boundary.point_ids, .point_xyz = boundary.point_xyz};
  const CellValues values = values_of(boundary, tets);
  for_each_flat_triangle(boundary, [&](std::size_t cell, const std::array<LocalIndex, 3>& points) {
    part.corners.insert(part.corners.end(), points.begin(), points.end());
    for (const auto& [name, of_cell] : values) part.cells[name].push_back(of_cell[cell]);
  });
  return part;
}

Surface joined(std::vector<SurfacePart> parts)
{
  std::ranges::sort(parts, {}, &SurfacePart::number);
  Surface surface;
  std::unordered_map<GlobalIndex, LocalIndex> point_of_id;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const SurfacePart& part : parts) {
    std::vector<LocalIndex> new_point;
    for (std::size_t p = 0; p < part.point_ids.size(); ++p) {
      const auto next = static_cast<LocalIndex>(surface.point_xyz.size() / 3);
      const auto [place, is_new] = point_of_id.emplace(part.point_ids[p], next);
      new_point.push_back(place->second);
      if (is_new) append(surface.point_xyz, std::span(part.point_xyz).subspan(3 * p, 3));
    }
    for (const LocalIndex point : part.corners) surface.corners.push_back(new_point[at(point)]);
    for (const auto& [name, values] : part.cells) append(surface.cells[name], values);
  }
  // What not all files have is shown of none.
  std::erase_if(surface.cells,
                [&](const auto& array) { return array.second.size() != surface.num_triangles(); });
  return surface;
}

Surface coarse_surface(const subdomain::PartitionedMesh& cut,
                       const std::vector<subdomain::PieceSummary>& pieces)
{
  std::vector<char> is_made(at(cut.num_subdomains()));
  std::vector<std::uint8_t> quality(at(cut.num_subdomains()), kUnknownQuality);
  for (const subdomain::PieceSummary& piece : pieces) {
    is_made[at(piece.subdomain)] = 1;
    quality[at(piece.subdomain)] = quality_byte(piece.tets.mean_mean_ratio());
  }
  Surface surface{.is_coarse = true};
  std::vector<LocalIndex> new_point(at(cut.coarse.num_vertices()), kNoIndex);
  for (const CoarseTriangle& triangle : coarse_boundary(cut, is_made)) {
    for (const LocalIndex v : triangle.vertices) {
      if (new_point[at(v)] == kNoIndex) {
        new_point[at(v)] = static_cast<LocalIndex>(surface.point_xyz.size() / 3);
        const Vec3 place = cut.coarse.position(v);
        surface.point_xyz.insert(surface.point_xyz.end(), place.begin(), place.end());
      }
      surface.corners.push_back(new_point[at(v)]);
    }
    surface.cells["face"].push_back(static_cast<std::uint32_t>(triangle.patch));
    surface.cells["subdomain"].push_back(static_cast<std::uint32_t>(triangle.subdomain));
    surface.cells["quality"].push_back(quality[at(triangle.subdomain)]);
  }
  return surface;
}

}  // namespace tessera::pipeline
