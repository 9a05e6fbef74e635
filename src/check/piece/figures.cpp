// SPDX-License-Identifier: BSD-3-Clause
#include "check/piece/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "tessera/base/hash.hpp"
#include "tessera/base/quadratic_tet.hpp"

#include "check/piece/second_order.hpp"

namespace tessera::check {
namespace {

std::array<Vec3, 4> corner_positions(const PieceMesh& mesh, LocalIndex cell)
{
  const auto tet = mesh.cell(cell);
  return {mesh.position(tet[0]), mesh.position(tet[1]), mesh.position(tet[2]),
          mesh.position(tet[3])};
}

bool is_finite(const std::array<Vec3, 4>& corners)
{
  for (const Vec3& corner : corners)
    for (const double x : corner)
      if (!std::isfinite(x)) return false;
  return true;
}

// The points as the file has them: of points with one id each keeps its own position.
Hash128 digest_of(const PieceMesh& mesh, LocalIndex cell)
{
  std::array<GlobalIndex, 4> ids{};
  std::array<double, 12> xyz{};
  for (std::size_t i = 0; i < 4; ++i) {
    const LocalIndex p = mesh.arrays.cell_points[4 * static_cast<std::size_t>(cell) + i];
    ids[i] = mesh.point_id(p);
    const Vec3 x = mesh.position(p);
    std::copy(x.begin(), x.end(), xyz.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  return hash_tet(ids, xyz, mesh.material(cell));
}

void report_volume(const PieceMesh& mesh, LocalIndex cell, double volume, Findings& findings)
{
  findings.add(Kind::non_positive_volume, {mesh.name.piece, cell}, [&] {
    std::string text = fmt::format("{} has volume {:g}:", describe_cell(mesh, cell), volume);
    for (const LocalIndex v : mesh.cell(cell))
      text += fmt::format(" [{}]", describe_point(mesh, v));
    return text;
  });
}

Hash128 digest_of_nodes(const PieceMesh& mesh, LocalIndex cell)
{
  std::array<GlobalIndex, 10> ids{};
  std::array<double, 30> xyz{};
  const QuadraticTet positions = node_positions(mesh, cell);
  const std::size_t row = static_cast<std::size_t>(cell);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = mesh.point_id(i < 4 ? mesh.cell(cell)[i] : mesh.cell_nodes[6 * row + i - 4]);
    std::ranges::copy(positions[i], &xyz[3 * i]);
  }
  return hash_quadratic_tet(ids, xyz, mesh.material(cell));
}

// Volume of a tet of second order; its Jacobian must be positive everywhere.
double measure_nodes(const PieceMesh& mesh, LocalIndex cell, PieceRecord& record,
                     Findings& findings)
{
  const QuadraticTet nodes = node_positions(mesh, cell);
  const JacobianBounds bounds = jacobian_bounds(nodes);
  record.min_scaled_jacobian = std::min(record.min_scaled_jacobian, bounds.scaled_jacobian());
  if (!bounds.is_positive()) {
    findings.add(Kind::non_positive_jacobian, {mesh.name.piece, cell}, [&] {
      return fmt::format("{}: its Jacobian is between {:g} and {:g}", describe_cell(mesh, cell),
                         bounds.smallest, bounds.largest);
    });
  }
  if (mesh.has_point_ids) record.figures.digest += digest_of_nodes(mesh, cell);
  return curved_volume(nodes);
}

double measure_corners(const PieceMesh& mesh, LocalIndex cell, PieceRecord& record,
                       Findings& findings)
{
  const auto corners = corner_positions(mesh, cell);
  const double volume = tet_volume(corners[0], corners[1], corners[2], corners[3]);
  if (!(volume > 0.0)) report_volume(mesh, cell, volume, findings);
  if (mesh.has_point_ids) record.figures.digest += digest_of(mesh, cell);
  return volume;
}

// Whether a cell of four different points that exist has one on a seam.
bool has_seam_point(std::span<const LocalIndex, 4> points, const std::vector<bool>& is_on_seam)
{
  const auto num_points = static_cast<GlobalIndex>(is_on_seam.size());
  bool is_seam_tet = false;
  for (std::size_t i = 0; i < 4; ++i) {
    if (points[i] < 0 || points[i] >= num_points) return false;
    is_seam_tet = is_seam_tet || is_on_seam[static_cast<std::size_t>(points[i])];
    for (std::size_t j = 0; j < i; ++j)
      if (points[i] == points[j]) return false;
  }
  return is_seam_tet;
}

}  // namespace

PieceRecord& PieceRecords::of(std::int32_t subdomain)
{
  if (last_ < records_.size() && records_[last_].figures.id == subdomain) return records_[last_];
  const auto [entry, is_new] = row_.emplace(subdomain, records_.size());
  last_ = entry->second;
  if (is_new) {
    PieceRecord& record = records_.emplace_back();
    record.figures.id = subdomain;
    record.piece = piece_;
  }
  return records_[last_];
}

PieceRecords measure(const PieceMesh& mesh, MeanRatioCounts& counts, Findings& findings)
{
  PieceRecords records(mesh.name.piece);
  for (LocalIndex c = 0; c < mesh.num_cells(); ++c) {
    PieceRecord& record = records.of(mesh.subdomain_of(c));
    if (record.figures.num_tets++ == 0) record.figures.material = mesh.material(c);
    if (mesh.is_left_out(c)) continue;
    const double volume = mesh.is_of_second_order() ? measure_nodes(mesh, c, record, findings)
                                                    : measure_corners(mesh, c, record, findings);
    if (std::isfinite(volume)) record.figures.volume += volume;
    const auto corners = corner_positions(mesh, c);
    if (!is_finite(corners)) continue;
    const TetShape shape = shape_of(corners);
    record.shapes.add(shape);
    counts.add(shape.mean_ratio);
  }
  return records;
}

void measure_seam_tets(const mesh::MeshArrays& arrays, const std::vector<bool>& is_on_seam,
                       PieceRecords& records, MeanRatioCounts& counts)
{
  const auto subdomain = arrays.cell_ints.find("subdomain");
  const std::span<const double> xyz(arrays.point_xyz);
  for (std::size_t c = 0; 4 * c < arrays.cell_points.size(); ++c) {
    const auto points = std::span(arrays.cell_points).subspan(4 * c).first<4>();
    if (!has_seam_point(points, is_on_seam)) continue;
    const std::array corners{point_at(xyz, points[0]), point_at(xyz, points[1]),
                             point_at(xyz, points[2]), point_at(xyz, points[3])};
    if (!is_finite(corners)) continue;
    const TetShape shape = shape_of(corners);
    const bool has_subdomain = subdomain != arrays.cell_ints.end()
                               && 4 * subdomain->second.size() == arrays.cell_points.size();
    records.of(has_subdomain ? subdomain->second[c] : records.piece()).seam_shapes.add(shape);
    counts.add(shape.mean_ratio);
  }
}

std::vector<PieceRecord> all_records(std::span<const PieceRecords> own,
                                     const comm::Communicator& comm)
{
  std::vector<PieceRecord> sent;
  for (const PieceRecords& records : own)
    sent.insert(sent.end(), records.all().begin(), records.all().end());
  std::vector<PieceRecord> all = comm.all_gather_rows(sent);
  std::sort(all.begin(), all.end(), [](const PieceRecord& a, const PieceRecord& b) {
    return std::tie(a.figures.id, a.piece) < std::tie(b.figures.id, b.piece);
  });
  return all;
}

}  // namespace tessera::check
