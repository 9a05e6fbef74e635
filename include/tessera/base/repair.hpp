// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "tessera/base/enum_words.hpp"
#include "tessera/base/types.hpp"

namespace tessera {

/// @brief What changes a model, a surface, sizes or tets because the plain way has failed or would
/// be bad. This is the one list of them: a run counts which ones changed something, and the bench
/// leaves them out one by one to see which files need them.
enum class Repair : int {
  // Import of STEP, IGES and BREP.
  plain_reader,       ///< OpenCASCADE's reader has died, and its plain one is taken.
  closed_wires,       ///< Wires are moved by periods until they close in a face's parameters.
  fixed_shapes,       ///< ShapeFix on solids that are invalid or open.
  sewn_faces,         ///< Faces are sewn to solids.
  turned_solids,      ///< Solids that are inside out are turned.
  overlapping_edges,  ///< Edges of a solid that lie on each other become one.
  glued_solids,       ///< Touching solids get common faces.
  flaps,              ///< Faces that bound a solid from both sides are taken away.
  wider_glue_gap,     ///< Solids are glued over a gap, as they would else be cut into films.
  closed_gaps,        ///< Solids that nearly touch get common faces.
  // Triangles of OpenCASCADE.
  face_from_boundary,  ///< A face that it cannot triangulate is triangulated from its boundary.
  sampled_face,        ///< A face without triangles gets some, for NETGEN's sizes only.
  finer_tessellation,  ///< Finer triangles, as sheets of coarse ones cut each other.
  separated_sheets,    ///< Sheets that share an edge on no curve are parted there.
  merged_points,       ///< Both ends of an edge are one point where some face says so.
  // Import of STL.
  dropped_triangles,  ///< Triangles with less than three corners, or given twice, are dropped.
  welded_vertices,    ///< Vertices of open edges are joined over a gap.
  turned_triangles,   ///< Triangles and shells that look the wrong way are turned.
  flat_triangles,     ///< Triangles without a height, and folds onto others, are taken out.
  flat_contacts,      ///< Surfaces that lie flat on each other become one.
  wrapped_surface,    ///< A closed surface is made around triangles that bound no body.
  // Import of CSG.
  csg_by_occ,  ///< OpenCASCADE makes the solids that NETGEN's CSG cannot mesh.
  // Sizes.
  round_places,  ///< The remesher has shorter edges where a surface goes round, as on wires.
  wall_sizes,    ///< The remesher has shorter edges where a wall is thin.
  // The coarse surface.
  mend_surface,    ///< Bad triangles are made better.
  mend_folds,      ///< Triangles are changed that would fold when they are refined.
  mend_needles,    ///< The same of triangles whose children would be needles.
  finer_at_cuts,   ///< The remesher has shorter edges where its surface cuts itself.
  finer_at_folds,  ///< The same where its surface would fold.
  // Tries at the coarse mesh.
  finer_coarse_size,  ///< A smaller coarse.max_size.
  netgen_surface,     ///< NETGEN's surface mesher takes the place of the remesher.
  gmsh_mesh,          ///< Gmsh takes the place of all.
  uncut_model,        ///< The model is meshed as a whole, as its parts cannot be.
  // Coarse tets.
  lattice_holes,     ///< NETGEN fills holes where triangles of the surface are no faces of Delaunay
                     ///< tets.
  netgen_tets,       ///< NETGEN fills a domain, as that cannot be done with a lattice.
  illegal_tets,      ///< Tets with two faces on one patch are divided.
  worst_tets,        ///< Vertices are put into the worst tets.
  snapped_vertices,  ///< Vertices that are off the geometry are put onto it.
  room_for_arcs,     ///< Vertices go, or come, where children of fine levels would fold at an arc.
  // Fills.
  fill_tries,        ///< A subdomain is filled once more, as a try failed or was poor.
  subdivided_fills,  ///< Subdivision takes the place of a kernel that could not fill.
  held_back_points,  ///< Points are kept off the geometry where the surface would fold.
};
[[nodiscard]] constexpr Repair last_value(Repair /*type*/) { return Repair::held_back_points; }
inline constexpr std::size_t kNumRepairs = static_cast<std::size_t>(last_value(Repair{})) + 1;

/// @brief How often each repair has changed something: steps, faces, tets or whatever it counts.
class RepairCounts {
 public:
  void add(Repair repair, GlobalIndex times = 1) { counts_[row_of(repair)] += times; }
  RepairCounts& operator+=(const RepairCounts& other);
  [[nodiscard]] GlobalIndex operator[](Repair repair) const { return counts_[row_of(repair)]; }
  friend bool operator==(const RepairCounts&, const RepairCounts&) = default;

  static auto fields(auto& self) { return std::tie(self.counts_); }

 private:
  static std::size_t row_of(Repair repair) { return static_cast<std::size_t>(repair); }

  std::array<GlobalIndex, kNumRepairs> counts_{};
};

/// @brief Says that a repair has changed something in what this process makes. What comes of it and
/// is dropped afterwards should not be noted. What a job notes that ends well is noted in the
/// process that had it done as well. Local.
void note_repair(Repair repair, GlobalIndex times = 1);
void note_repairs(const RepairCounts& counts);

/// @brief What this process has noted since the last call. Local.
[[nodiscard]] RepairCounts take_noted_repairs();

/// @brief Reads names that commas separate. Local. @throws ConfigError naming what is no repair.
[[nodiscard]] std::vector<Repair> parse_repairs(std::string_view names);

/// @brief Names that commas separate. Local.
[[nodiscard]] std::string names_of(const std::vector<Repair>& repairs);

/// @brief The repairs of the environment variable TESSERA_LEAVE_OUT, ascending. It is for benches
/// and tests, and is read once. Local. @throws ConfigError as parse_repairs().
[[nodiscard]] const std::vector<Repair>& left_out_repairs();

/// @brief Whether a repair is not to be made. Local. @throws ConfigError as parse_repairs().
[[nodiscard]] bool is_left_out(Repair repair);

/// @brief The names of repairs, in report.json and TESSERA_LEAVE_OUT.
constexpr auto enum_words(Repair /*type*/)
{
  using enum Repair;
  return std::to_array<EnumWord<Repair>>({
      {plain_reader, "plain_reader"},
      {closed_wires, "closed_wires"},
      {fixed_shapes, "fixed_shapes"},
      {sewn_faces, "sewn_faces"},
      {turned_solids, "turned_solids"},
      {overlapping_edges, "overlapping_edges"},
      {glued_solids, "glued_solids"},
      {flaps, "flaps"},
      {wider_glue_gap, "wider_glue_gap"},
      {closed_gaps, "closed_gaps"},
      {face_from_boundary, "face_from_boundary"},
      {sampled_face, "sampled_face"},
      {finer_tessellation, "finer_tessellation"},
      {separated_sheets, "separated_sheets"},
      {merged_points, "merged_points"},
      {dropped_triangles, "dropped_triangles"},
      {welded_vertices, "welded_vertices"},
      {turned_triangles, "turned_triangles"},
      {flat_triangles, "flat_triangles"},
      {flat_contacts, "flat_contacts"},
      {wrapped_surface, "wrapped_surface"},
      {csg_by_occ, "csg_by_occ"},
      {round_places, "round_places"},
      {wall_sizes, "wall_sizes"},
      {mend_surface, "mend_surface"},
      {mend_folds, "mend_folds"},
      {mend_needles, "mend_needles"},
      {finer_at_cuts, "finer_at_cuts"},
      {finer_at_folds, "finer_at_folds"},
      {finer_coarse_size, "finer_coarse_size"},
      {netgen_surface, "netgen_surface"},
      {gmsh_mesh, "gmsh_mesh"},
      {uncut_model, "uncut_model"},
      {lattice_holes, "lattice_holes"},
      {netgen_tets, "netgen_tets"},
      {illegal_tets, "illegal_tets"},
      {worst_tets, "worst_tets"},
      {snapped_vertices, "snapped_vertices"},
      {room_for_arcs, "room_for_arcs"},
      {fill_tries, "fill_tries"},
      {subdivided_fills, "subdivided_fills"},
      {held_back_points, "held_back_points"},
  });
}

}  // namespace tessera
