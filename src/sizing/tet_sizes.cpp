// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/tet_sizes.hpp"

#include <array>
#include <numeric>
#include <vector>

#include "tessera/base/error.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/mesh/tet_edges.hpp"

#include "sizing/limit_growth.hpp"
#include "sizing/require_size.hpp"

namespace tessera::sizing {
namespace {

using mesh::TetField;
using Corners = std::array<Vec3, 4>;

Corners corners_of(const TetField& field, std::size_t tet)
{
  return corners_at<4>(field.point_xyz, field.tet_points, tet);
}

// Nothing can be interpolated in a flat tet, and no point lies in it.
bool has_volume(const Corners& tet)
{
  constexpr double kFlat = 1e-12;
  double longest = 0.0;
  for (std::size_t i = 1; i < 4; ++i) longest = std::max(longest, norm(tet[i] - tet[0]));
  return std::abs(tet_volume(tet[0], tet[1], tet[2], tet[3])) > kFlat * longest * longest * longest;
}

std::vector<LocalIndex> tets_with_volume(const TetField& field)
{
  std::vector<LocalIndex> tets;
  for (std::size_t tet = 0; 4 * tet < field.tet_points.size(); ++tet) {
    if (!has_volume(corners_of(field, tet))) continue;
    const auto points = std::span(field.tet_points).subspan(4 * tet, 4);
    tets.insert(tets.end(), points.begin(), points.end());
  }
  return tets;
}

// Points of tets, by their positions and then values: so the first of equal ones has the least.
std::vector<LocalIndex> sorted_points(const TetField& field, std::span<const LocalIndex> tets)
{
  std::vector<bool> is_used(field.values.size(), false);
  for (const LocalIndex point : tets) is_used[at(point)] = true;
  std::vector<LocalIndex> points;
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (!is_used[i]) continue;
    require_size(field.values[i], point_at(std::span(field.point_xyz), i));
    points.push_back(static_cast<LocalIndex>(i));
  }
  std::ranges::sort(points, {}, [&](LocalIndex point) {
    return std::tuple(point_at(std::span(field.point_xyz), point), field.values[at(point)], point);
  });
  return points;
}

// Pieces of one mesh, and fields that are not continuous, have a position more than once. Joined,
// sizes grow across.
TetField joined(const TetField& field)
{
  TetField result;
  result.tet_points = tets_with_volume(field);
  if (result.tet_points.empty()) throw InputError("none of its cells has a volume");
  std::vector<LocalIndex> new_number(field.values.size(), kNoIndex);
  for (const LocalIndex point : sorted_points(field, result.tet_points)) {
    const Vec3 position = point_at(std::span(field.point_xyz), point);
    const std::size_t num_points = result.values.size();
    const bool is_new =
        num_points == 0
        || point_at(std::span(std::as_const(result.point_xyz)), num_points - 1) != position;
    if (is_new) {
      result.point_xyz.insert(result.point_xyz.end(), position.begin(), position.end());
      result.values.push_back(field.values[at(point)]);
    }
    new_number[at(point)] = static_cast<LocalIndex>(result.values.size() - 1);
  }
  for (LocalIndex& point : result.tet_points) point = new_number[at(point)];
  return result;
}

// Neighbours along edges: those of point p are neighbours[begin[p]] to neighbours[begin[p + 1]].
struct EdgeGraph {
  std::vector<std::size_t> begin{};
  std::vector<LocalIndex> neighbours{};
};

EdgeGraph edge_graph(const TetField& field)
{
  const std::size_t num_points = field.values.size();
  std::vector<std::array<LocalIndex, 2>> edges;
  EdgeGraph graph;
  graph.begin.resize(num_points + 1);
  mesh::for_each_edge(field.tet_points, static_cast<LocalIndex>(num_points),
                      [&](LocalIndex a, LocalIndex b) {
                        edges.push_back({a, b});
                        ++graph.begin[at(a) + 1];
                        ++graph.begin[at(b) + 1];
                      });
  std::partial_sum(graph.begin.begin(), graph.begin.end(), graph.begin.begin());
  std::vector<std::size_t> next = graph.begin;
  graph.neighbours.resize(2 * edges.size());
  for (const auto& [a, b] : edges) {
    graph.neighbours[next[at(a)]++] = b;
    graph.neighbours[next[at(b)]++] = a;
  }
  return graph;
}

void limit_growth_along_edges(double grading, TetField& field)
{
  const EdgeGraph graph = edge_graph(field);
  const std::span<const double> xyz = field.point_xyz;
  const auto for_each_neighbour = [&](std::size_t point, const auto& visit) {
    for (std::size_t i = graph.begin[point]; i < graph.begin[point + 1]; ++i) {
      const LocalIndex neighbour = graph.neighbours[i];
      visit(at(neighbour), norm(point_at(xyz, neighbour) - point_at(xyz, point)));
    }
  };
  limit_growth(grading, for_each_neighbour, field.values);
}

}  // namespace

TetSizes::TetSizes(const TetField& field, double grading) : grading_(grading), field_(joined(field))
{
  limit_growth_along_edges(grading, field_);
  least_ = *std::ranges::min_element(field_.values);
  std::vector<Corners> tets(field_.tet_points.size() / 4);
  for (std::size_t tet = 0; tet < tets.size(); ++tet) {
    tets[tet] = corners_of(field_, tet);
    box_.include(box_of(tets[tet]));
  }
  search_ = std::make_unique<const model::TetSearch>(tets);
}

// By the volumes of the four tets that the point makes with the sides. Rounding may put it outside.
double TetSizes::value_at(const model::NearestPoint& place) const
{
  const Corners corners = corners_of(field_, at(place.simplex));
  const double whole = tet_volume(corners[0], corners[1], corners[2], corners[3]);
  double sum = 0.0;
  double sum_of_weights = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    Corners replaced = corners;
    replaced[i] = place.xyz;
    const double part = tet_volume(replaced[0], replaced[1], replaced[2], replaced[3]);
    const double weight = std::max(0.0, part / whole);
    sum += weight * field_.values[at(field_.tet_points[4 * at(place.simplex) + i])];
    sum_of_weights += weight;
  }
  return sum / sum_of_weights;
}

void TetSizes::lower(std::span<const double> xyz, std::span<double> sizes) const
{
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const Vec3 point = point_at(xyz, i);
    if (least_ + grading_ * std::sqrt(box_.squared_distance(point)) >= sizes[i])
      continue;  // Spares the search.
    const model::NearestPoint place = search_->nearest(point);
    sizes[i] = std::min(sizes[i], value_at(place) + grading_ * std::sqrt(place.squared_distance));
  }
}

}  // namespace tessera::sizing
