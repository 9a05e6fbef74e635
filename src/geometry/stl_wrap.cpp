// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/stl_wrap.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/single_precision.hpp"
#include "tessera/surface/flat_contacts.hpp"
#include "tessera/surface/overlap.hpp"
#include "tessera/surface/wrap_surface.hpp"

#include "geometry/stl_triangles.hpp"

namespace tessera::geometry {
namespace {

constexpr const char* kWayOut =
    "repair it in a CAD program, or let geometry.repair = \"wrap\" make a closed surface around it";

// Why nobody could fill a closed surface; empty if that can be.
std::string what_cuts(const model::TriangleSurface& surface)
{
  const surface::PatchSurface triangles = triangles_of(surface);
  const std::vector<surface::Overlap> overlaps = surface::find_overlaps(triangles);
  if (!overlaps.empty()) {
    return fmt::format("surface cuts itself at {} pairs of triangles, first at ({:.9g})",
                       overlaps.size(), fmt::join(overlaps.front().place, ", "));
  }
  const auto contacts =
      surface::find_flat_contacts(triangles, kSinglePrecisionNoise * model::box_diagonal(surface));
  if (contacts.empty()) return {};
  return fmt::format("surface lies flat on itself at {} pairs of triangles", contacts.size());
}

std::string without_name(const std::string& message, const std::string& name)
{
  const std::string start = name + ": ";
  return message.starts_with(start) ? message.substr(start.size()) : message;
}

StlSurface wrapped(const model::TriangleSoup& soup, double tolerance, const std::string& reason,
                   const std::string& name)
{
  const surface::WrappedSurface made = surface::wrap_surface(soup, tolerance, name);
  StlSurface surface{.checked = model::check_surface(made.soup, name)};
  surface.wrap = {.reason = reason,
                  .num_triangles = surface.checked.surface.num_triangles(),
                  .tolerance = made.tolerance,
                  .distance_max = made.distance_max,
                  .file_distance_max = made.file_distance_max};
  surface.checked.counted_repairs.add(Repair::wrapped_surface);
  surface.checked.repairs.insert(
      surface.checked.repairs.begin(),
      fmt::format("wrapped with a tolerance of {:.4g}, as its {}: {} triangles, at most {:.4g} off "
                  "those of the file, which are at most {:.4g} off these",
                  made.tolerance, reason, surface.wrap.num_triangles, made.distance_max,
                  made.file_distance_max));
  return surface;
}

}  // namespace

StlSurface checked_or_wrapped(const model::TriangleSoup& soup, const model::StlOptions& options,
                              const ShellUniter& unite, const std::string& name)
{
  const bool may_wrap =
      options.repair == model::StlRepair::wrap && !is_left_out(Repair::wrapped_surface);
  std::string reason;
  try {
    StlSurface surface{.checked = model::check_surface(soup, name)};
    if (unite) unite(soup, surface.checked, name);
    if (may_wrap) reason = what_cuts(surface.checked.surface);
    if (reason.empty()) return surface;
  } catch (const GeometryError& error) {
    if (!may_wrap) throw GeometryError(fmt::format("{}; {}", error.what(), kWayOut));
    reason = without_name(error.what(), name);
  }
  return wrapped(soup, options.wrap_tolerance, reason, name);
}

}  // namespace tessera::geometry
