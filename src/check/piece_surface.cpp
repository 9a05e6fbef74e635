// SPDX-License-Identifier: BSD-3-Clause
#include "check/piece_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "check/second_order.hpp"

namespace tessera::check {
namespace {

// Chooses points of a piece and gives them consecutive rows.
class VertexSelection {
 public:
  VertexSelection(const PieceMesh& mesh, std::vector<VertexRecord>& vertices)
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
    VertexRecord record;
    record.position = mesh_.position(point);
    record.id = mesh_.point_id(point);
    record.piece = mesh_.name.piece;
    record.point = point;
    record.is_used = is_used;
    record.is_inner = is_inner;
    record.is_listed = mesh_.name.is_boundary;
    vertices_.push_back(record);
    return row;
  }

 private:
  const PieceMesh& mesh_;
  std::vector<VertexRecord>& vertices_;
  std::vector<LocalIndex> row_;
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
  const Vec3 sum =
      mesh.position(vertices[0]) + mesh.position(vertices[1]) + mesh.position(vertices[2]);
  for (std::size_t i = 0; i < 3; ++i) record.centroid[i] = static_cast<float>(sum[i] / 3.0);
  record.piece = mesh.name.piece;
  record.cell = cell;
  record.subdomain = mesh.subdomain_of(cell);
  record.is_listed = mesh.name.is_boundary;
  return record;
}

void add_triangle(PieceSurface& surface, const SurfaceTriangle& triangle,
                  const std::array<LocalIndex, 3>& vertices, std::int32_t subdomain)
{
  surface.rows.push_back(static_cast<LocalIndex>(surface.triangles.size()));
  surface.triangles.push_back(vertices);
  surface.cells.push_back(triangle.cell);
  surface.subdomains.push_back(subdomain);
  surface.roles.push_back(TriangleRole::unknown);
  surface.partners.push_back(kNoPiece);
  surface.closed_edges.push_back(0);
}

void mark_seam(PieceSurface& surface, const std::array<LocalIndex, 3>& triangle,
               std::vector<VertexKey>& seam_keys)
{
  for (const LocalIndex v : triangle) {
    VertexRecord& vertex = surface.vertices[static_cast<std::size_t>(v)];
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
  std::vector<VertexRecord> kept;
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

}  // namespace

VertexKey PieceSurface::key(LocalIndex v) const
{
  return key_of(vertices[static_cast<std::size_t>(v)], identity);
}

PieceSurface make_surface(const PieceMesh& mesh, const PieceTopology& topology, ShownRecords& shown,
                          std::vector<VertexKey>& seam_keys)
{
  PieceSurface surface;
  surface.name = mesh.name;
  surface.identity = mesh.identity;
  VertexSelection selection(mesh, surface.vertices);
  for (const SurfaceTriangle& triangle : topology.surface) {
    const auto& v = triangle.vertices;
    const std::array rows{selection.add(v[0], true, false), selection.add(v[1], true, false),
                          selection.add(v[2], true, false)};
    TriangleRecord record = record_of(mesh, v, triangle.cell);
    record.component = triangle.component;
    record.attribute = mesh.material(triangle.cell);
    record.cell_id = mesh.cell_id(triangle.cell);
    if (triangle.is_open) {
      record.row = static_cast<LocalIndex>(surface.triangles.size());
      add_triangle(surface, triangle, rows, record.subdomain);
    } else if (triangle.is_seam) {
      mark_seam(surface, rows, seam_keys);
    }
    shown.triangles.push_back(record);
    for (std::size_t i = 0; mesh.is_of_second_order() && i < 3; ++i) {
      selection.add(node_between(mesh, triangle.cell, v[i], v[(i + 1) % 3]), true, false);
    }
  }
  if (mesh.identity == VertexIdentity::ids) {
    for (const LocalIndex p : mesh.unused_points) selection.add(p, false, false);
  } else {
    for_each_used_vertex(mesh, [&](LocalIndex v) { selection.add(v, true, true); });
  }
  shown.vertices.insert(shown.vertices.end(), surface.vertices.begin(), surface.vertices.end());
  return surface;
}

void append_boundary(const PieceMesh& mesh, ShownRecords& shown)
{
  VertexSelection selection(mesh, shown.vertices);
  const auto tet = mesh.arrays.cell_longs.find("tet");
  for (LocalIndex c = 0; c < mesh.num_cells(); ++c) {
    if (mesh.is_left_out(c)) continue;
    for (const LocalIndex v : mesh.cell(c)) selection.add(v, false, false);
    for (std::size_t i = 0; mesh.is_of_second_order() && i < 3; ++i) {
      selection.add(node_between(mesh, c, mesh.cell(c)[i], mesh.cell(c)[(i + 1) % 3]), false,
                    false);
    }
    TriangleRecord record = record_of(mesh, mesh.cell(c), c);
    if (tet != mesh.arrays.cell_longs.end())
      record.cell_id = tet->second[static_cast<std::size_t>(c)];
    shown.triangles.push_back(record);
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
    if (std::isfinite(area)) records.of(surface.subdomains[t]).boundary_area += area;
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
  keep(surface.subdomains, is_kept);
  keep(surface.roles, is_kept);
  keep(surface.partners, is_kept);
  keep(surface.closed_edges, is_kept);
  surface.seam_points.shrink_to_fit();
  shrink_vertices(surface);
}

}  // namespace tessera::check
