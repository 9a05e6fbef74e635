// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/triangle_surface.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/box.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/repair.hpp"
#include "tessera/base/single_precision.hpp"
#include "tessera/mesh/half_edges.hpp"

#include "flat_triangles.hpp"
#include "surface_orientation.hpp"
#include "surface_weld.hpp"

namespace tessera::model {
namespace {

std::string counted(LocalIndex count, const std::string& one, const std::string& many)
{
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

// "3 edges, first (0, 0, 0) - (1, 0, 0), …" for the edges whose number of triangles is `bad`.
template <class Predicate>
std::string describe_edges(const TriangleSurface& surface, const IndexLists& edges, Predicate bad)
{
  constexpr LocalIndex kNumShown = 3;
  LocalIndex count = 0;
  std::string shown;
  for (LocalIndex e = 0; e < edges.num_lists(); ++e) {
    if (!bad(edges[e].size())) continue;
    if (count++ >= kNumShown) continue;
    const LocalIndex h = edges[e][0];
    const Vec3 from = surface.position(surface.triangle_vertices[at(h)]);
    const Vec3 to = surface.position(surface.triangle_vertices[at(mesh::next_in_triangle(h))]);
    shown += fmt::format("{}({:.9g}) - ({:.9g})", count == 1 ? ", first " : ", ",
                         fmt::join(from, ", "), fmt::join(to, ", "));
  }
  if (count == 0) return {};
  return fmt::format("{}{}{}", counted(count, "edge", "edges"), shown,
                     count > kNumShown ? ", …" : "");
}

std::string open_edges(const TriangleSurface& surface)
{
  return describe_edges(surface, mesh::half_edges_of_edges(surface.triangle_vertices),
                        [](std::size_t triangles) { return triangles == 1; });
}

void require_triangles(const TriangleSurface& surface, const std::string& name)
{
  if (surface.num_triangles() == 0) throw GeometryError(name + ": holds no triangle with an area");
}

void require_two_triangles_per_edge(const TriangleSurface& surface, const std::string& name)
{
  const std::string crowded =
      describe_edges(surface, mesh::half_edges_of_edges(surface.triangle_vertices),
                     [](std::size_t triangles) { return triangles > 2; });
  if (!crowded.empty()) {
    throw GeometryError(
        fmt::format("{}: surface bounds no body: more than two triangles at {}", name, crowded));
  }
  const std::string open = open_edges(surface);
  if (!open.empty()) {
    throw GeometryError(
        fmt::format("{}: surface is not closed: only one triangle at {}", name, open));
  }
}

// "1 body …, near (0, 0, 0)" with the places of the first ones.
void record_lost_bodies(const std::vector<Vec3>& places, const std::string& what,
                        CheckedSurface& checked)
{
  constexpr std::size_t kNumShown = 3;
  if (places.empty()) return;
  std::string shown;
  for (std::size_t i = 0; i < std::min(kNumShown, places.size()); ++i) {
    shown += fmt::format("{}({:.9g})", i == 0 ? "" : ", ", fmt::join(places[i], ", "));
  }
  checked.repairs.push_back(fmt::format(
      "{} {} dropped, near {}{}",
      counted(static_cast<LocalIndex>(places.size()), "body or cavity", "bodies or cavities"), what,
      shown, places.size() > kNumShown ? ", …" : ""));
}

void drop_and_record(CheckedSurface& checked)
{
  if (is_left_out(Repair::dropped_triangles)) return;
  const DroppedTriangles dropped = drop_bad_triangles(checked.surface);
  record_lost_bodies(dropped.bodies, "without a size", checked);
  checked.counted_repairs.add(Repair::dropped_triangles, dropped.degenerate + dropped.repeated);
  if (dropped.degenerate > 0) {
    checked.repairs.push_back(counted(dropped.degenerate, "triangle", "triangles")
                              + " with fewer than three different corners dropped");
  }
  if (dropped.repeated > 0) {
    checked.repairs.push_back(counted(dropped.repeated, "repeated triangle", "repeated triangles")
                              + " dropped");
  }
}

void weld_and_record(CheckedSurface& checked)
{
  if (open_edges(checked.surface).empty() || is_left_out(Repair::welded_vertices)) return;
  const double tolerance = kSinglePrecisionNoise * box_diagonal(checked.surface);
  const LocalIndex num_joined = weld_open_vertices(checked.surface, tolerance);
  if (num_joined == 0) return;
  checked.counted_repairs.add(Repair::welded_vertices, num_joined);
  checked.repairs.push_back(fmt::format(
      "{} joined to a neighbour closer than {:g}",
      counted(num_joined, "vertex of an open edge", "vertices of open edges"), tolerance));
  drop_and_record(checked);
}

CheckedSurface welded(const TriangleSoup& soup)
{
  CheckedSurface checked;
  checked.surface = weld_equal_corners(soup);
  drop_and_record(checked);
  weld_and_record(checked);
  return checked;
}

void record_turns(CheckedSurface& checked, const Orientation& orientation)
{
  checked.counted_repairs.add(Repair::turned_triangles,
                              orientation.num_turned + orientation.num_turned_shells);
  if (orientation.num_turned > 0) {
    checked.repairs.push_back(counted(orientation.num_turned, "triangle", "triangles")
                              + " turned to agree with the neighbours");
  }
  if (orientation.num_turned_shells > 0) {
    checked.repairs.push_back(fmt::format("{} of {} turned: the inside was out",
                                          counted(orientation.num_turned_shells, "shell", "shells"),
                                          orientation.shells.size()));
  }
}

Orientation oriented(TriangleSurface& surface, const std::string& name)
{
  const std::vector<LocalIndex> given = surface.triangle_vertices;
  const auto opposite =
      mesh::opposite_half_edges(mesh::half_edges_of_edges(surface.triangle_vertices));
  Orientation orientation = orient(surface, opposite, name);
  if (is_left_out(Repair::turned_triangles)) surface.triangle_vertices = given;
  return orientation;
}

std::vector<Vec3> places_of(const std::vector<Shell>& shells, const TriangleSurface& surface)
{
  std::vector<Vec3> places;
  for (const Shell& shell : shells) {
    places.push_back(surface.position(surface.triangle_vertices[3 * at(shell.triangles.front())]));
  }
  return places;
}

// Mesh generators choke on triangles without a height, and refined ones fold there.
bool mend_flat_and_record(CheckedSurface& checked, const std::vector<Shell>& shells,
                          const std::string& name)
{
  if (is_left_out(Repair::flat_triangles)) return false;
  const double height = kSinglePrecisionNoise * box_diagonal(checked.surface);
  const std::vector<Vec3> places = places_of(shells, checked.surface);
  const auto [num_steps, gone] = mend_flat_triangles(checked.surface, height);
  if (num_steps == 0) return false;
  std::vector<Vec3> lost;
  for (std::size_t s = 0; s < shells.size(); ++s) {
    if (std::ranges::includes(gone, shells[s].triangles)) lost.push_back(places[s]);
  }
  record_lost_bodies(lost, fmt::format("thinner than {:g}", height), checked);
  checked.counted_repairs.add(Repair::flat_triangles, num_steps);
  checked.repairs.push_back(
      fmt::format("triangles flatter than {:g}, or folded onto others, mended in {}", height,
                  counted(num_steps, "step", "steps")));
  require_triangles(checked.surface, name);
  return true;
}

// One material a solid, taken from the first triangle of the outer shell. What lies in a shell's
// cavity is another shell. A cavity's own triangles bound the material around it.
void set_materials(TriangleSurface& surface, const std::vector<Shell>& shells)
{
  std::map<LocalIndex, LocalIndex> material_of_solid;
  surface.triangle_material.resize(at(surface.num_triangles()));
  std::vector<bool> has_one_solid;
  for (const Shell& shell : shells) {
    const Shell& outer = shell.depth % 2 == 0 ? shell : shells[at(shell.parent)];
    const LocalIndex solid = surface.triangle_solid[at(outer.triangles.front())];
    const auto next = static_cast<LocalIndex>(material_of_solid.size() + 1);
    const auto [entry, is_new] = material_of_solid.emplace(solid, next);
    if (is_new) {
      surface.material_names.push_back(surface.solid_names[at(solid)]);
      has_one_solid.push_back(true);
    }
    for (const LocalIndex t : shell.triangles) {
      surface.triangle_material[at(t)] = entry->second;
      if (surface.triangle_solid[at(t)] != solid) has_one_solid[at(entry->second) - 1] = false;
    }
  }
  for (std::size_t m = 0; m < surface.material_names.size(); ++m) {
    std::string& name = surface.material_names[m];
    // Several solids around one body name its sides, not the body.
    if (name.empty() || !has_one_solid[m]) name = fmt::format("material_{}", m + 1);
  }
}

bool is_consistent(const TriangleSurface& surface)
{
  const auto all_below = [](const std::vector<LocalIndex>& values, std::size_t end) {
    return std::all_of(values.begin(), values.end(),
                       [&](LocalIndex v) { return v >= 0 && at(v) < end; });
  };
  const std::size_t num_triangles = surface.triangle_vertices.size() / 3;
  return surface.vertex_xyz.size() % 3 == 0 && surface.triangle_vertices.size() % 3 == 0
         && surface.triangle_solid.size() == num_triangles
         && surface.triangle_material.size() == num_triangles
         && all_below(surface.triangle_vertices, surface.vertex_xyz.size() / 3)
         && all_below(surface.triangle_solid, surface.solid_names.size())
         && all_below(surface.triangle_material, surface.material_names.size() + 1);
}

}  // namespace

CheckedSurface check_surface(const TriangleSoup& soup, const std::string& name)
{
  CheckedSurface checked = welded(soup);
  require_triangles(checked.surface, name);
  require_two_triangles_per_edge(checked.surface, name);

  Orientation orientation = oriented(checked.surface, name);
  record_turns(checked, orientation);
  if (mend_flat_and_record(checked, orientation.shells, name))
    orientation = oriented(checked.surface, name);
  set_materials(checked.surface, orientation.shells);
  return checked;
}

TriangleSurface welded_surface(const TriangleSoup& soup) { return welded(soup).surface; }

double box_diagonal(const TriangleSurface& surface)
{
  return tessera::box_diagonal(surface.vertex_xyz);
}

void TriangleSurface::require_sound() const
{
  if (!is_consistent(*this)) throw InputError("record of a surface is damaged");
}

}  // namespace tessera::model
