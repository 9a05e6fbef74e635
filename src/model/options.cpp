// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/options.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tessera/base/single_precision.hpp"

namespace tessera::model {
namespace {

bool is_colour(const std::string& text)
{
  constexpr std::string_view kDigits = "0123456789abcdefABCDEF";
  return text.size() == 7 && text.front() == '#'
         && text.find_first_not_of(kDigits, 1) == std::string::npos;
}

std::string defect_of_box(const Vec3& min, const Vec3& max)
{
  if ((min == kNoPoint) != (max == kNoPoint)) return "box needs both box.min and box.max";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (min[axis] > max[axis]) return "box.min must not be above box.max";
  }
  return {};
}

std::string defect(const FaceCriteria& of)
{
  const bool has_normal = of.normal != kNoPoint;
  if (of.faces.empty() && of.pattern.empty() && of.colour.empty() && !has_normal
      && of.box_min == kNoPoint && of.box_max == kNoPoint) {
    return "patch needs one of faces, pattern, colour, normal, box";
  }
  if (!of.colour.empty() && !is_colour(of.colour)) {
    return "patch.colour must be \"#RRGGBB\", as tessera info prints it";
  }
  if (of.normal == Vec3{}) return "patch.normal must not be zero";
  if (of.tolerance_deg > 0.0 && !has_normal) return "patch.tolerance_deg is of a patch.normal";
  return defect_of_box(of.box_min, of.box_max);
}

std::string defect(const SolidCriteria& of) { return defect_of_box(of.box_min, of.box_max); }

std::string defect(const Polygon& of)
{
  if (of.corners.size() < 3) return "polygon needs three corners or more";
  for (std::size_t i = 0; i < of.corners.size(); ++i) {
    if (of.corners[i] == of.corners[(i + 1) % of.corners.size()])
      return "polygon has two equal corners in turn; the last one is joined to the first";
  }
  const Vec3& first = of.corners.front();
  const Vec3 normal = of.normal();
  double size = 0.0;
  for (const Vec3& corner : of.corners) size = std::max(size, norm(corner - first));
  constexpr double kLeastArea = 1e-12;  // Of a square of that size: rounding.
  if (!(norm(normal) > kLeastArea * size * size)) return "polygon has no area";
  for (const Vec3& corner : of.corners) {
    const double off = std::abs(dot(corner - first, normal)) / norm(normal);
    if (off <= kSinglePrecisionNoise * size) continue;
    return fmt::format("polygon must lie in one plane; corner [{:g}] is off it by {:.3g}",
                       fmt::join(corner, ", "), off);
  }
  return {};
}

std::string defect(const Disk& of)
{
  return of.normal == Vec3{} ? "disk.normal must not be zero" : "";
}

std::string defect(const Polyline& of)
{
  if (of.points.size() < 2) return "polyline needs two points or more";
  for (std::size_t i = 1; i < of.points.size(); ++i) {
    if (of.points[i] != of.points[i - 1]) continue;
    return fmt::format("polyline has the point [{:g}] twice in turn",
                       fmt::join(of.points[i], ", "));
  }
  return {};
}

Polygon scaled_by(double factor, Polygon polygon)
{
  for (Vec3& corner : polygon.corners) corner = factor * corner;
  return polygon;
}

Disk scaled_by(double factor, Disk disk)
{
  disk.centre = factor * disk.centre;
  disk.radius *= factor;
  return disk;
}

Polyline scaled_by(double factor, Polyline line)
{
  for (Vec3& point : line.points) point = factor * point;
  return line;
}

}  // namespace

std::string lower_case_extension(const std::filesystem::path& file)
{
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool is_mesh_name(const std::filesystem::path& file)
{
  const std::string extension = lower_case_extension(file);
  return extension == ".msh" || extension == ".vol" || extension == ".vtu";
}

Vec3 Polygon::normal() const
{
  Vec3 sum{};
  for (std::size_t i = 2; i < corners.size(); ++i) {
    sum = sum + cross(corners[i - 1] - corners.front(), corners[i] - corners.front());
  }
  return sum;
}

std::string defect_of(const EmbeddedShape& embedded)
{
  return std::visit([](const auto& shape) { return defect(shape); }, embedded.shape);
}

AssemblyOptions AssemblyOptions::scaled(double factor) const
{
  AssemblyOptions other = *this;
  if (gap >= 0.0) other.gap *= factor;
  for (auto& [name, shape] : other.embedded) {
    std::visit([&](auto& one) { one = scaled_by(factor, one); }, shape);
  }
  return other;
}

std::string defect_of(const PartName& name)
{
  return std::visit([](const auto& of) { return defect(of); }, name.of);
}

}  // namespace tessera::model
