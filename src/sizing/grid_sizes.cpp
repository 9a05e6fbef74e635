// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/grid_sizes.hpp"

#include <array>
#include <vector>

#include "tessera/base/types.hpp"

#include "sizing/limit_growth.hpp"
#include "sizing/require_size.hpp"

namespace tessera::sizing {
namespace {

using mesh::GridField;
using Triple = std::array<LocalIndex, 3>;

std::size_t point_number(const GridField& field, const Triple& triple)
{
  return (at(triple[2]) * at(field.counts[1]) + at(triple[1])) * at(field.counts[0])
         + at(triple[0]);
}

Triple triple_of(const GridField& field, std::size_t point)
{
  const std::size_t row = at(field.counts[0]);
  const std::size_t layer = row * at(field.counts[1]);
  return {static_cast<LocalIndex>(point % row), static_cast<LocalIndex>(point % layer / row),
          static_cast<LocalIndex>(point / layer)};
}

Vec3 position_of(const GridField& field, const Triple& triple)
{
  Vec3 position = field.origin;
  for (std::size_t i = 0; i < 3; ++i) position = position + double(triple[i]) * field.steps[i];
  return position;
}

// The 26 neighbours within the cells around a point.
struct Offset {
  Triple triple{};
  double length = 0.0;
};

std::vector<Offset> offsets_of(const GridField& field)
{
  std::vector<Offset> offsets;
  for (LocalIndex k = -1; k <= 1; ++k) {
    for (LocalIndex j = -1; j <= 1; ++j) {
      for (LocalIndex i = -1; i <= 1; ++i) {
        if (i == 0 && j == 0 && k == 0) continue;
        const Triple triple{i, j, k};
        offsets.push_back({triple, norm(position_of(field, triple) - field.origin)});
      }
    }
  }
  return offsets;
}

void limit_growth_in_cells(double grading, GridField& field)
{
  const std::vector<Offset> offsets = offsets_of(field);
  const auto for_each_neighbour = [&](std::size_t point, const auto& visit) {
    const Triple from = triple_of(field, point);
    for (const Offset& offset : offsets) {
      Triple to{};
      bool is_inside = true;
      for (std::size_t i = 0; i < 3; ++i) {
        to[i] = from[i] + offset.triple[i];
        is_inside = is_inside && to[i] >= 0 && to[i] < field.counts[i];
      }
      if (is_inside) visit(point_number(field, to), offset.length);
    }
  };
  limit_growth(grading, for_each_neighbour, field.values);
}

}  // namespace

GridSizes::GridSizes(const GridField& field, double grading) : grading_(grading), field_(field)
{
  for (std::size_t i = 0; i < 3; ++i) step_lengths_[i] = norm(field_.steps[i]);
  for (std::size_t point = 0; point < field_.values.size(); ++point) {
    const Vec3 position = position_of(field_, triple_of(field_, point));
    require_size(field_.values[point], position);
    box_.include(position);
  }
  limit_growth_in_cells(grading, field_);
}

double GridSizes::size_at(const Vec3& point) const
{
  Triple cell{};
  Vec3 weight{};  // Of the upper corner in each direction.
  Vec3 outside{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double length = step_lengths_[i];
    const double place = dot(point - field_.origin, field_.steps[i]) / (length * length);
    const double inside = std::clamp(place, 0.0, double(field_.counts[i] - 1));
    cell[i] = std::min(static_cast<LocalIndex>(inside), field_.counts[i] - 2);
    weight[i] = inside - double(cell[i]);
    outside[i] = (place - inside) * length;
  }
  double value = 0.0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Triple triple = cell;
    double product = 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_upper = (corner >> i & 1U) != 0;
      triple[i] += is_upper ? 1 : 0;
      product *= is_upper ? weight[i] : 1.0 - weight[i];
    }
    value += product * field_.values[point_number(field_, triple)];
  }
  return value + grading_ * norm(outside);
}

void GridSizes::lower(std::span<const double> xyz, std::span<double> sizes) const
{
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    sizes[i] = std::min(sizes[i], size_at(point_at(xyz, i)));
  }
}

}  // namespace tessera::sizing
