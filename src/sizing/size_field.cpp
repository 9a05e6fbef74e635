// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/sizing/size_field.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/morton_order.hpp"

#include "sizing/box_text.hpp"
#include "sizing/grid_sizes.hpp"
#include "sizing/region_sizes.hpp"
#include "sizing/tet_sizes.hpp"

namespace tessera::sizing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using FieldSizes = std::variant<TetSizes, GridSizes>;

FieldSizes sizes_of(const mesh::TetField& field, double grading)
{
  return TetSizes(field, grading);
}
FieldSizes sizes_of(const mesh::GridField& field, double grading)
{
  return GridSizes(field, grading);
}

void require_meeting(const FieldSizes& field, const mesh::CoarseMesh& coarse)
{
  const tessera::Box model = bounding_box(coarse.vertex_xyz);
  const tessera::Box box = std::visit([](const auto& sizes) { return sizes.box(); }, field);
  if (box.touches(model)) return;
  throw InputError(fmt::format(
      "its box is {}, which does not meet the model's, {}; it must be in output length units, so "
      "geometry.scale counts",
      box_text(box), box_text(model)));
}

FieldSizes field_sizes(const SizeOptions& options, const mesh::CoarseMesh& coarse,
                       const mesh::PointField& field)
{
  try {
    FieldSizes sizes =
        std::visit([&](const auto& values) { return sizes_of(values, options.grading); }, field);
    require_meeting(sizes, coarse);
    return sizes;
  } catch (const InputError& error) {
    throw InputError(fmt::format("size.field = \"{}\", array \"{}\": {}", options.field.string(),
                                 options.field_array, error.what()));
  }
}

std::vector<RegionSizes> region_sizes(const SizeOptions& options, const mesh::CoarseMesh& coarse)
{
  std::vector<RegionSizes> regions;
  for (const SizeRegion& region : options.regions) {
    const std::string defect = defect_of(region);
    try {
      if (!defect.empty()) throw ConfigError(defect);
      regions.emplace_back(region, options.grading, coarse);
    } catch (const ConfigError& error) {
      throw ConfigError(fmt::format("[[size.region]] number {} ({}): {}", regions.size() + 1,
                                    word_of(region.shape), error.what()));
    }
  }
  return regions;
}

double or_infinity(double size) { return size > 0.0 ? size : kInfinity; }

}  // namespace

struct SizeField::Parts {
  double target = kInfinity;
  double least = 0.0;
  double greatest = kInfinity;
  double steepest = 0.0;
  std::optional<FieldSizes> field{};
  std::vector<RegionSizes> regions{};

  [[nodiscard]] std::vector<double> sizes_at(std::span<const double> xyz) const
  {
    std::vector<double> sizes(xyz.size() / 3, target);
    for (const RegionSizes& region : regions) region.lower(xyz, sizes);
    if (field) std::visit([&](const auto& values) { values.lower(xyz, sizes); }, *field);
    for (double& size : sizes) size = std::max(std::min(size, greatest), least);
    return sizes;
  }
};

SizeField::SizeField(const SizeOptions& options, const mesh::CoarseMesh& coarse,
                     const mesh::PointField* field)
{
  if (options.field.empty() != (field == nullptr)) {
    throw UsageError("a SizeField takes the field that its options name, and no other");
  }
  auto parts = std::make_unique<Parts>();
  parts->target = or_infinity(options.target);
  parts->least = options.min;
  parts->greatest = or_infinity(options.max);
  parts->regions = region_sizes(options, coarse);
  for (const RegionSizes& region : parts->regions) {
    parts->steepest = std::max(parts->steepest, region.growth());
  }
  if (field != nullptr) {
    parts->field = field_sizes(options, coarse, *field);
    parts->steepest = std::max(parts->steepest, options.grading);
  }
  parts_ = std::move(parts);
}

SizeField::~SizeField() = default;
SizeField::SizeField(SizeField&&) noexcept = default;
SizeField& SizeField::operator=(SizeField&&) noexcept = default;

std::vector<double> SizeField::at(std::span<const double> xyz) const
{
  if (parts_->steepest == 0.0) return parts_->sizes_at(xyz);
  // Along a curve, searches find what they need in the cache: a fifth of the time.
  const std::vector<LocalIndex> order = morton_order(xyz);
  std::vector<double> ordered_xyz;
  ordered_xyz.reserve(xyz.size());
  for (const LocalIndex row : order) {
    const Vec3 point = point_at(xyz, row);
    ordered_xyz.insert(ordered_xyz.end(), point.begin(), point.end());
  }
  const std::vector<double> ordered = parts_->sizes_at(ordered_xyz);
  std::vector<double> sizes(ordered.size());
  for (std::size_t i = 0; i < order.size(); ++i) sizes[tessera::at(order[i])] = ordered[i];
  return sizes;
}

double SizeField::steepest() const noexcept { return parts_->steepest; }

}  // namespace tessera::sizing
