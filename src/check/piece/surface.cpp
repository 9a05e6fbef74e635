// SPDX-License-Identifier: BSD-3-Clause
#include "check/piece/surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "check/piece/named_patches.hpp"
#include "check/piece/second_order.hpp"

namespace tessera::check {
namespace {

// Chooses points of a piece and gives them consecutive rows.
class VertexSelection {
 public:
  VertexSelection(const PieceMesh& mesh, std::vector<SurfaceVertex>& vertices)
      : mesh_(mesh),
        vertices_(vertices),
        row_(static_cast<std::size_t>(mesh.num_points()), kNoIndex)
  {
  }

  LocalIndex add(LocalIndex point, bool is_used, bool is_inner)
  {
    LocalIndex& row = row_[static_cast<std::size_t>(point)];
    if (row != kNoIndex) return row;
    row = static_cast<LocalIndex>(vertices_.size());
    vertices_.push_back({.position = mesh_.position(point),
                         .id = mesh_.point_id(point),
                         .point = point,
                         .is_used = is_used,
                         .is_inner = is_inner});
    return row;
  }

 private:
  const PieceMesh& mesh_;
  std::vector<SurfaceVertex>& vertices_;
  std::vector<LocalIndex> row_;
};

// Finds the row of what a tet has in common with others; fast for that of the tet before.
class RegionSelection {
 public:
  RegionSelection(const PieceMesh& mesh, std::vector<PieceRegion>& regions)
      : mesh_(mesh), regions_(regions)
  {
  }

  LocalIndex add(const SurfaceTriangle& triangle)
  {
    const LocalIndex c = triangle.cell;
    PieceRegion region{.component = triangle.component,
                       .attribute = mesh_.material(c),
                       .subdomain = mesh_.subdomain_of(c),
                       .has_cell_ids = mesh_.has_cell_ids};
    if (mesh_.has_cell_ids)
      region.id_offset =
          static_cast<std::uint64_t>(mesh_.cell_id(c)) - static_cast<std::uint64_t>(c);
    if (!regions_.empty() && regions_[static_cast<std::size_t>(last_)] == region) return last_;
    const auto [found, is_new] = row_.try_emplace(region, static_cast<LocalIndex>(regions_.size()));
    if (is_new) regions_.push_back(region);
    return last_ = found->second;
  }

 private:
  const PieceMesh& mesh_;
  std::vector<PieceRegion>& regions_;
  std::map<PieceRegion, LocalIndex> row_{};
  LocalIndex last_ = 0;
};

// With the nodes of its edges, those of second order: so both sides must agree on them. @param[in]
// keys Of the vertices; ascending.
TriangleKey key_of_triangle(const PieceMesh& mesh, std::span<const LocalIndex> vertices,
                            LocalIndex cell, const std::array<VertexKey, 3>& keys)
{
  if (!mesh.is_of_second_order()) return key_of_vertices(keys);
  std::array<VertexKey, 6> all{keys[0], keys[1], keys[2]};
  for (std::size_t i = 0; i < 3; ++i) {  // The node opposite to each vertex, in their order.
    const auto row = std::ranges::find(keys, mesh.key(vertices[i])) - keys.begin();
    all[3 + static_cast<std::size_t>(row)] =
        mesh.key(node_between(mesh, cell, vertices[(i + 1) % 3], vertices[(i + 2) % 3]));
  }
  return key_of_vertices(all);
}

struct KeyOfTriangle {
  TriangleKey key{};
  bool is_odd = false;
};

// Of vertices with these keys in outward order.
KeyOfTriangle key_and_parity(std::array<VertexKey, 3> keys)
{
  const bool odd = is_odd(keys[0], keys[1], keys[2]);
  std::sort(keys.begin(), keys.end());
  return {key_of_vertices(keys), odd};
}

std::array<float, 3> centroid_of(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 sum = a + b + c;
  std::array<float, 3> centroid{};
  for (std::size_t i = 0; i < 3; ++i) centroid[i] = static_cast<float>(sum[i] / 3.0);
  return centroid;
}

// Key, parity and centroid of a triangle.
TriangleRecord record_of(const PieceMesh& mesh, std::span<const LocalIndex> vertices,
                         LocalIndex cell)
{
  TriangleRecord record;
  std::array<VertexKey, 3> keys{mesh.key(vertices[0]), mesh.key(vertices[1]),
                                mesh.key(vertices[2])};
  record.is_odd = is_odd(keys[0], keys[1], keys[2]);
  std::sort(keys.begin(), keys.end());
  record.key = key_of_triangle(mesh, vertices, cell, keys);
  record.centroid = centroid_of(mesh.position(vertices[0]), mesh.position(vertices[1]),
                                mesh.position(vertices[2]));
  record.piece = mesh.name.piece;
  record.cell = cell;
  record.subdomain = mesh.subdomain_of(cell);
  record.is_listed = mesh.name.is_boundary;
  return record;
}

TriangleRecord inner_record(const PieceMesh& mesh, const SurfaceTriangle& triangle)
{
  TriangleRecord record = record_of(mesh, triangle.vertices, triangle.cell);
  record.component = triangle.component;
  record.attribute = mesh.material(triangle.cell);
  record.cell_id = mesh.cell_id(triangle.cell);
  return record;
}

void reserve_triangles(PieceSurface& surface, std::size_t num_triangles)
{
  surface.triangles.reserve(num_triangles);
  surface.rows.reserve(num_triangles);
  surface.cells.reserve(num_triangles);
  surface.region.reserve(num_triangles);
}

void add_triangle(PieceSurface& surface, const SurfaceTriangle& triangle,
                  const std::array<LocalIndex, 3>& vertices, LocalIndex region)
{
  surface.rows.push_back(static_cast<LocalIndex>(surface.triangles.size()));
  surface.triangles.push_back(vertices);
  surface.cells.push_back(triangle.cell);
  surface.region.push_back(region);
}

void mark_seam(PieceSurface& surface, const std::array<LocalIndex, 3>& triangle,
               std::vector<VertexKey>& seam_keys)
{
  for (const LocalIndex v : triangle) {
    SurfaceVertex& vertex = surface.vertices[static_cast<std::size_t>(v)];
    if (vertex.is_on_seam) continue;
    vertex.is_on_seam = true;
    surface.seam_points.push_back(vertex.point);
    seam_keys.push_back(surface.key(v));
  }
}

// Keeps the rows of `values` that are marked.
template <class T>
void keep(std::vector<T>& values, const std::vector<bool>& is_kept)
{
  std::vector<T> kept;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (is_kept[i]) kept.push_back(values[i]);
  kept.shrink_to_fit();
  values = std::move(kept);
}

// Drops the vertices that no triangle has.
void shrink_vertices(PieceSurface& surface)
{
  std::vector<LocalIndex> new_row(surface.vertices.size(), kNoIndex);
  std::vector<SurfaceVertex> kept;
  for (auto& triangle : surface.triangles) {
    for (LocalIndex& v : triangle) {
      LocalIndex& row = new_row[static_cast<std::size_t>(v)];
      if (row == kNoIndex) {
        row = static_cast<LocalIndex>(kept.size());
        kept.push_back(surface.vertices[static_cast<std::size_t>(v)]);
      }
      v = row;
    }
  }
  kept.shrink_to_fit();
  surface.vertices = std::move(kept);
}

// Drops the regions that no triangle has. Without ascending ids of cells there is one a triangle.
void shrink_regions(PieceSurface& surface)
{
  if (surface.region.empty()) return;
  std::vector<LocalIndex> new_row(surface.regions.size(), kNoIndex);
  std::vector<PieceRegion> kept;
  for (LocalIndex& region : surface.region) {
    LocalIndex& row = new_row[static_cast<std::size_t>(region)];
    if (row == kNoIndex) {
      row = static_cast<LocalIndex>(kept.size());
      kept.push_back(surface.regions[static_cast<std::size_t>(region)]);
    }
    region = row;
  }
  kept.shrink_to_fit();
  surface.regions = std::move(kept);
}

}  // namespace

TriangleKey PieceSurface::triangle_key(std::size_t t) const
{
  if (!keys.empty()) return keys[t];
  const auto& v = triangles[t];
  return key_and_parity({key(v[0]), key(v[1]), key(v[2])}).key;
}

TriangleSide PieceSurface::side(std::size_t t) const
{
  const auto& v = triangles[t];
  const KeyOfTriangle by_vertices = key_and_parity({key(v[0]), key(v[1]), key(v[2])});
  const PieceRegion& of = region_of(t);
  return {.key = keys.empty() ? by_vertices.key : keys[t],
          .piece = name.piece,
          .row = rows[t],
          .component = of.component,
          .attribute = of.attribute,
          .subdomain = of.subdomain,
          .is_odd = by_vertices.is_odd};
}

TriangleRecord PieceSurface::record(std::size_t t) const
{
  const TriangleSide side = this->side(t);
  const auto& v = triangles[t];
  const auto id = region_of(t).id_offset + static_cast<std::uint64_t>(cells[t]);
  return {.key = side.key,
          .cell_id = region_of(t).has_cell_ids ? static_cast<GlobalIndex>(id) : kNoId,
          .centroid = centroid_of(position(v[0]), position(v[1]), position(v[2])),
          .piece = side.piece,
          .cell = cells[t],
          .row = side.row,
          .component = side.component,
          .attribute = side.attribute,
          .subdomain = side.subdomain,
          .is_odd = side.is_odd};
}

std::vector<VertexRecord> PieceSurface::vertex_records() const
{
  std::vector<VertexRecord> records;
  records.reserve(vertices.size());
  for (const SurfaceVertex& vertex : vertices) {
    records.push_back({.position = vertex.position,
                       .id = vertex.id,
                       .piece = name.piece,
                       .point = vertex.point,
                       .is_used = vertex.is_used,
                       .is_inner = vertex.is_inner,
                       .is_on_seam = vertex.is_on_seam,
                       .is_listed = name.is_boundary,
                       .is_on_plus = vertex.is_on_plus,
                       .is_on_minus = vertex.is_on_minus});
  }
  return records;
}

PieceSurface make_surface(const PieceMesh& mesh, const PieceTopology& topology,
                          std::vector<TriangleRecord>& inner, std::vector<VertexKey>& seam_keys)
{
  PieceSurface surface;
  surface.name = mesh.name;
  surface.identity = mesh.identity;
  reserve_triangles(surface, static_cast<std::size_t>(std::ranges::count_if(
                                 topology.surface, &SurfaceTriangle::is_open)));
  VertexSelection selection(mesh, surface.vertices);
  RegionSelection regions(mesh, surface.regions);
  for (const SurfaceTriangle& triangle : topology.surface) {
    const auto& v = triangle.vertices;
    const std::array rows{selection.add(v[0], true, false), selection.add(v[1], true, false),
                          selection.add(v[2], true, false)};
    if (triangle.is_open) {
      add_triangle(surface, triangle, rows, regions.add(triangle));
      if (mesh.is_of_second_order()) surface.keys.push_back(record_of(mesh, v, triangle.cell).key);
    } else {
      if (triangle.is_seam) mark_seam(surface, rows, seam_keys);
      inner.push_back(inner_record(mesh, triangle));
    }
    for (std::size_t i = 0; mesh.is_of_second_order() && i < 3; ++i) {
      selection.add(node_between(mesh, triangle.cell, v[i], v[(i + 1) % 3]), true, false);
    }
  }
  surface.roles.assign(surface.triangles.size(), TriangleRole::unknown);
  surface.partners.assign(surface.triangles.size(), kNoPiece);
  surface.closed_edges.assign(surface.triangles.size(), 0);
  if (mesh.identity == VertexIdentity::ids) {
    for (const LocalIndex p : mesh.unused_points) selection.add(p, false, false);
  } else {
    for_each_used_vertex(mesh, [&](LocalIndex v) { selection.add(v, true, true); });
  }
  surface.vertices.shrink_to_fit();
  surface.regions.shrink_to_fit();
  if (surface.regions.size() == 1) surface.region = std::vector<LocalIndex>();
  return surface;
}

std::vector<VertexRecord> listed_vertices(const PieceMesh& mesh)
{
  PieceSurface points;
  points.name = mesh.name;
  VertexSelection selection(mesh, points.vertices);
  const NamedPatches plus = patches_of_splits(mesh, 0);
  const NamedPatches minus = patches_of_splits(mesh, 1);
  for (LocalIndex c = 0; c < mesh.num_cells(); ++c) {
    if (mesh.is_left_out(c)) continue;
    const auto list = [&](LocalIndex point) {
      SurfaceVertex& vertex =
          points.vertices[static_cast<std::size_t>(selection.add(point, false, false))];
      vertex.is_on_plus = vertex.is_on_plus || plus.have(c);
      vertex.is_on_minus = vertex.is_on_minus || minus.have(c);
    };
    for (const LocalIndex v : mesh.cell(c)) list(v);
    for (std::size_t i = 0; mesh.is_of_second_order() && i < 3; ++i)
      list(node_between(mesh, c, mesh.cell(c)[i], mesh.cell(c)[(i + 1) % 3]));
  }
  return points.vertex_records();
}

void for_each_listed(const PieceMesh& mesh, const std::function<void(const TriangleRecord&)>& visit)
{
  const auto tet = mesh.arrays.cell_longs.find("tet");
  const NamedPatches inside = patches_inside(mesh);
  for (LocalIndex c = 0; c < mesh.num_cells(); ++c) {
    if (mesh.is_left_out(c)) continue;
    TriangleRecord record = record_of(mesh, mesh.cell(c), c);
    record.is_inside = inside.have(c);
    if (tet != mesh.arrays.cell_longs.end())
      record.cell_id = tet->second[static_cast<std::size_t>(c)];
    visit(record);
  }
}

std::vector<bool> points_of_surface(const PieceMesh& mesh, const PieceSurface& surface)
{
  std::vector<bool> is_on_surface(static_cast<std::size_t>(mesh.num_points()), false);
  for (const SurfaceVertex& vertex : surface.vertices)
    is_on_surface[static_cast<std::size_t>(vertex.point)] = true;
  return is_on_surface;
}

void report_equal_points_inside(const PieceMesh& mesh, const PieceSurface& surface,
                                Findings& findings)
{
  if (mesh.equal_points.empty()) return;
  const std::vector<bool> is_on_surface = points_of_surface(mesh, surface);
  for (const auto& [lowest, p] : mesh.equal_points) {
    const bool may_be_of_split = is_on_surface[static_cast<std::size_t>(lowest)]
                                 && is_on_surface[static_cast<std::size_t>(p)];
    if (!may_be_of_split) report_equal_points(mesh, Kind::duplicate_point, p, lowest, findings);
  }
}

void apply(const TriangleVerdict& verdict, PieceSurface& surface, std::vector<VertexKey>& seam_keys)
{
  const auto found = std::lower_bound(surface.rows.begin(), surface.rows.end(), verdict.row);
  const auto t = static_cast<std::size_t>(found - surface.rows.begin());
  surface.roles[t] = verdict.role;
  surface.partners[t] = verdict.partner;
  if (verdict.role == TriangleRole::seam || verdict.role == TriangleRole::open_seam)
    mark_seam(surface, surface.triangles[t], seam_keys);
}

void add_outside_areas(const PieceSurface& surface, PieceRecords& records)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.roles[t] != TriangleRole::outside) continue;
    const auto& v = surface.triangles[t];
    const Vec3& origin = surface.position(v[0]);
    const double area =
        0.5 * norm(cross(surface.position(v[1]) - origin, surface.position(v[2]) - origin));
    if (std::isfinite(area)) records.of(surface.region_of(t).subdomain).boundary_area += area;
  }
}

void shrink(PieceSurface& surface)
{
  constexpr std::uint8_t kAllEdges = 7;
  std::vector<bool> is_kept(surface.triangles.size());
  const auto is_seam_vertex = [&](LocalIndex v) {
    return surface.vertices[static_cast<std::size_t>(v)].is_on_seam;
  };
  for (std::size_t t = 0; t < is_kept.size(); ++t) {
    const auto& v = surface.triangles[t];
    is_kept[t] =
        surface.closed_edges[t] != kAllEdges || !std::all_of(v.begin(), v.end(), is_seam_vertex);
  }
  keep(surface.triangles, is_kept);
  keep(surface.rows, is_kept);
  keep(surface.cells, is_kept);
  if (!surface.region.empty()) keep(surface.region, is_kept);
  if (!surface.keys.empty()) keep(surface.keys, is_kept);
  keep(surface.roles, is_kept);
  keep(surface.partners, is_kept);
  keep(surface.closed_edges, is_kept);
  surface.seam_points.shrink_to_fit();
  shrink_vertices(surface);
  shrink_regions(surface);
}

}  // namespace tessera::check
