// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/mesh/coarse_mesh.hpp"
#include "tessera/mesh/host_layout.hpp"
#include "tessera/mesh/lattice_levels.hpp"
#include "tessera/mesh/piece.hpp"
#include "tessera/mesh/skeleton.hpp"
#include "tessera/subdomain/partitioned_mesh.hpp"

/// Layers on walls as parts of pieces: which points and cells there are, and their places among all
/// others. Points are counted under the host entity of the vertex that their column stands on. In a
/// triangle of the skeleton that was split, vertices have the numbers of mesh::SplitPointNumbers.
/// At a joint the copies of a vertex end at one point: that of the copy without a column, or of the
/// lowest one.
namespace tessera::subdomain {

/// @brief What layers add to a piece.
struct LayerCounts {
  GlobalIndex tets = 0;
  GlobalIndex side_triangles = 0;  ///< On patches without layers; owned as those of such patches.

  friend bool operator==(const LayerCounts&, const LayerCounts&) = default;
};

/// @brief A side of layers, on a patch without layers.
struct LayerSide {
  LocalIndex patch = kNoIndex;
  bool is_outside = true;  ///< Else it lies between two materials.
};

/// @brief Number of layers of the columns on the fine vertices of a host: the most that a coarse
/// vertex of it has. 0: it lies on no wall, or no column of a coarse vertex of it has a length.
/// Local. @pre host is the skeleton's; the mesh has layers.
[[nodiscard]] LocalIndex num_layers_on(const mesh::CoarseMesh& coarse,
                                       const mesh::Skeleton& skeleton,
                                       const mesh::HostLayout& hosts, mesh::HostEntity host);

/// @brief Counts of all layers, in closed form. Made by every process for itself.
class LayerTables {
 public:
  /// @param[in] coarse, skeleton Borrowed. @param[in] levels Of the skeleton, on which pieces are
  /// filled. @param[in] splits On how many levels they are split afterwards.
  /// @pre The mesh has layers.
  LayerTables(const mesh::CoarseMesh& coarse, const mesh::Skeleton& skeleton,
              const mesh::LatticeLevels& levels, int splits = 0);

  /// @brief Of any column, the most.
  [[nodiscard]] LocalIndex most_layers() const { return coarse_->layers.most_layers; }

  /// @brief As num_layers_on().
  [[nodiscard]] LocalIndex num_layers(mesh::HostEntity host) const { return num_layers_[at(host)]; }

  [[nodiscard]] bool has_columns(mesh::HostEntity host) const { return num_layers(host) > 0; }

  /// @brief Points of all columns.
  [[nodiscard]] GlobalIndex num_points() const { return first_point_.back(); }

  /// @brief Whether columns end at points of other hosts.
  [[nodiscard]] bool has_joints() const { return has_joints_; }

  /// @brief Points of a column of its own: without the last one if that is another host's.
  [[nodiscard]] LocalIndex num_own_points(mesh::HostEntity host) const
  {
    return num_layers(host) - (end_host(host) == host ? 0 : 1);
  }

  /// @brief The host whose points the columns of a host end at: itself, unless at a joint.
  [[nodiscard]] mesh::HostEntity end_host(mesh::HostEntity host) const
  {
    return end_host_[at(host)];
  }

  /// @brief Where the column over a vertex ends, if that is at tets on the other side of a joint;
  /// else the vertex itself. @param[in] vertex Any; only the skeleton's have columns.
  [[nodiscard]] mesh::HostPoint end_at_tets(const mesh::HostPoint& vertex) const
  {
    const bool ends_there = vertex.host < hosts_.num_on_skeleton() && has_columns(vertex.host)
                            && !has_columns(end_host(vertex.host));
    return ends_there ? mesh::HostPoint{end_host(vertex.host), vertex.index} : vertex;
  }

  /// @brief Vertices of the skeleton around which columns of a subdomain end at tets across joints;
  /// ascending. O(its triangles).
  [[nodiscard]] std::vector<LocalIndex> vertices_of_ends(LocalIndex subdomain) const;

  /// @brief Number of the first point of a column among them, next to the tets; the others follow.
  /// @pre num_own_points(vertex.host) > 0
  [[nodiscard]] GlobalIndex first_point(const mesh::HostPoint& vertex) const
  {
    return first_point_[at(vertex.host)] + GlobalIndex{vertex.index} * num_own_points(vertex.host);
  }

  [[nodiscard]] const LayerCounts& counts(LocalIndex subdomain) const
  {
    return counts_[at(subdomain)];
  }

  /// @brief Whether a patch has layers.
  [[nodiscard]] bool is_wall(LocalIndex patch) const { return coarse_->layers.is_wall(patch); }

  /// @brief Whether a wall lies inside of the model: at a joint.
  [[nodiscard]] bool is_inside(LocalIndex wall) const { return coarse_->images.is_joint(wall); }

  /// @brief Whether files have the triangles of a patch from the other side of a joint, or not at
  /// all.
  [[nodiscard]] bool is_hidden(LocalIndex patch) const
  {
    return coarse_->images.is_minus_of_joint(patch) || coarse_->is_wake(patch);
  }

  /// @brief The side of layers that stands on a small edge between two vertices of walls, if it
  /// lies on a patch and the subdomain owns it. None: there is another prism, or another owner.
  [[nodiscard]] std::optional<LayerSide> side(const mesh::HostPoint& a, const mesh::HostPoint& b,
                                              LocalIndex subdomain) const;

  /// @brief Lowest subdomain that has the columns of a host, so a prism there.
  /// @pre has_columns(host)
  [[nodiscard]] LocalIndex owner(mesh::HostEntity host) const { return column_owner_[at(host)]; }

  /// @brief Whether columns of other hosts end at the points of a host that has none.
  /// @param[in] host Any, or kNoIndex; only the skeleton's are such.
  [[nodiscard]] bool is_end_elsewhere(mesh::HostEntity host) const
  {
    return host != kNoIndex && host < hosts_.num_on_skeleton() && !has_columns(host)
           && end_owner_[at(host)] != kNoIndex;
  }

  /// @brief Lowest subdomain with columns that end at the points of a host; kNoIndex if there are
  /// none.
  [[nodiscard]] LocalIndex owner_of_ends(mesh::HostEntity host) const
  {
    return end_owner_[at(host)];
  }

 private:
  void find_layers();
  void find_ends();
  void count_columns(const mesh::LatticeLevels& levels);
  void find_owners();
  void find_owners_of_ends();
  void mark_inner_sides(LocalIndex triangle);
  void count_cells(const mesh::LatticeLevels& levels);
  [[nodiscard]] LocalIndex num_columns_in(LocalIndex triangle,
                                          const mesh::LatticeLevels& levels) const;
  [[nodiscard]] GlobalIndex num_tets_on(LocalIndex triangle,
                                        const mesh::LatticeLevels& levels) const;
  [[nodiscard]] GlobalIndex num_tets_of_layer(LocalIndex triangle,
                                              const std::array<bool, 3>& on_corner,
                                              const mesh::LatticeLevels& levels) const;
  [[nodiscard]] GlobalIndex num_side_triangles_on(LocalIndex edge, LocalIndex intervals) const;
  [[nodiscard]] bool is_wall_triangle(LocalIndex triangle) const
  {
    return is_wall(skeleton_->triangle_patch[at(triangle)]);
  }
  [[nodiscard]] LocalIndex common_edge(const mesh::HostPoint& a, const mesh::HostPoint& b) const;
  [[nodiscard]] bool is_end(LocalIndex edge, mesh::HostEntity vertex) const;

  const mesh::CoarseMesh* coarse_;
  const mesh::Skeleton* skeleton_;
  LocalIndex parts_;  ///< Of a small edge: intervals of its split.
  mesh::HostLayout hosts_;
  std::vector<LocalIndex> num_layers_{};     ///< Shape (num_on_skeleton).
  std::vector<GlobalIndex> first_point_{0};  ///< Shape (num_on_skeleton + 1).
  std::vector<char> has_inner_side_{};       ///< Shape (num_edges): side between two materials.
  std::vector<LocalIndex> column_owner_{};   ///< Shape (num_on_skeleton): lowest with a wall there.
  std::vector<mesh::HostEntity> end_host_{};  ///< Shape (num_on_skeleton).
  bool has_joints_ = false;
  std::vector<LocalIndex> end_owner_{};  ///< Shape (num_on_skeleton).
  std::vector<LayerCounts> counts_{};    ///< Shape (num_subdomains).
};

/// @brief The tables of a mesh with layers; none without. Local. Arguments are those of
/// LayerTables.
[[nodiscard]] std::optional<LayerTables> layer_tables(const mesh::CoarseMesh& coarse,
                                                      const mesh::Skeleton& skeleton,
                                                      const mesh::LatticeLevels& levels,
                                                      int splits = 0);

/// @brief The same of a mesh that is cut, on the levels that pieces are filled on.
[[nodiscard]] std::optional<LayerTables> layer_tables(const PartitionedMesh& cut, int splits = 0);

/// @brief A piece with its layers.
struct LayeredPiece {
  mesh::Piece piece{};  ///< Points and tets of layers come last; its boundary is the geometry.
  std::vector<mesh::HostPoint> columns{};  ///< Ascending; their points are the last vertices, each
                                           ///< time from the tets outwards. At a joint, the last
                                           ///< one may be there already.
  std::vector<LocalIndex> first_point{};   ///< Shape (num_columns + 1): vertex.
  std::vector<LocalIndex> end{};           ///< Shape (num_columns): vertex, on the wall.
  LocalIndex num_vertices = 0;             ///< Without these.
  std::vector<LocalIndex> tet_layer{};     ///< Shape (num_tets): from 1 at the wall; 0: in none.
  double outside_area = 0.0;  ///< What layers add to that of the outside: walls are in front of
                              ///< them, and sides beside them. Output length unit squared.
  std::vector<LocalIndex> tet_of_prism{};  ///< Shape (num_tets): from 0; above it, the tet is of
                                           ///< the same prism as the one before it.

  /// @brief Whether the last point of a column is its own in this piece: ends of others come before
  /// its points.
  [[nodiscard]] bool has_own_end(std::size_t column) const
  {
    return end[column] >= first_point[column];
  }
};

/// @brief Puts layers onto a piece. Local.
/// @pre The piece has columns over all vertices of its walls.
/// @throws MeshError if one is missing.
[[nodiscard]] LayeredPiece with_layers(mesh::Piece piece, const LayerTables& tables);

}  // namespace tessera::subdomain
