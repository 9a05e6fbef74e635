// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/topology/split_patches.hpp"

#include "topology/split_faces.hpp"

namespace tessera::topology {
namespace {

// Two or three vertices of a split face, ascending: an edge or the face itself.
using Simplex = std::vector<LocalIndex>;

std::array<LocalIndex, 3> corners_of(const mesh::CoarseMesh& mesh, LocalIndex face)
{
  const LocalIndex* v = &mesh.face_vertices[3 * at(face)];
  return mesh::sorted_triangle(v[0], v[1], v[2]);
}

// What cannot open as it is: edges inside of the split faces, and faces, that are parted at none of
// their vertices. Ascending.
std::vector<Simplex> find_closed(const mesh::CoarseMesh& mesh, const SplitFaces& split)
{
  std::map<Simplex, std::vector<LocalIndex>> faces_of_edge;
  for (const LocalIndex f : split.faces()) {
    const auto v = corners_of(mesh, f);
    for (const auto& [a, b] : {std::pair(0U, 1U), std::pair(0U, 2U), std::pair(1U, 2U)}) {
      faces_of_edge[{v[a], v[b]}].push_back(f);
    }
  }
  std::vector<Simplex> closed;
  std::vector<LocalIndex> opened_by_edges;
  for (const auto& [edge, faces] : faces_of_edge) {
    const auto is_closed_at = [&split, &ends = edge](LocalIndex f) {
      return !split.is_parted(f, ends[0]) && !split.is_parted(f, ends[1]);
    };
    if (faces.size() < 2 || std::ranges::none_of(faces, is_closed_at)) continue;
    closed.push_back(edge);
    opened_by_edges.insert(opened_by_edges.end(), faces.begin(), faces.end());
  }
  std::ranges::sort(opened_by_edges);
  for (const LocalIndex f : split.faces()) {
    const auto v = corners_of(mesh, f);
    const bool is_open =
        std::ranges::any_of(v, [&](LocalIndex corner) { return split.is_parted(f, corner); })
        || std::ranges::binary_search(opened_by_edges, f);
    if (!is_open) closed.emplace_back(v.begin(), v.end());
  }
  return closed;
}

// Puts vertices into simplices no two of which have a tet in common.
class Inserter {
 public:
  Inserter(mesh::CoarseMesh& mesh, const model::Model& model)
      : mesh_(mesh),
        model_(model),
        tets_at_(rows_by_key(mesh.tet_vertices, mesh.num_vertices(), 4)),
        faces_at_(rows_by_key(mesh.face_vertices, mesh.num_vertices(), 3)),
        segments_at_(rows_by_key(mesh.segment_vertices, mesh.num_vertices(), 2)),
        is_touched_(at(mesh.num_tets()), false)
  {
  }

  void insert_into(const Simplex& simplex)
  {
    const auto tets = around(tets_at_, simplex);
    if (std::ranges::any_of(tets, [&](LocalIndex t) { return is_touched_[at(t)]; })) return;
    for (const LocalIndex t : tets) is_touched_[at(t)] = true;
    const auto faces = around(faces_at_, simplex);
    const auto segments =
        simplex.size() == 2 ? around(segments_at_, simplex) : std::vector<LocalIndex>{};
    const Vec3 wanted = on_geometry(simplex, faces, segments);
    const Vec3 point = as_far_as_possible(simplex, tets, wanted);
    const LocalIndex vertex = mesh_.num_vertices();
    mesh_.vertex_xyz.insert(mesh_.vertex_xyz.end(), point.begin(), point.end());
    for (const LocalIndex s : segments) divide_segment(s, vertex, point);
    for (const LocalIndex f : faces) divide_face(f, simplex, vertex, point);
    for (const LocalIndex t : tets) divide_tet(t, simplex, vertex);
  }

 private:
  // Rows of cells that had all vertices of the simplex before anything was inserted.
  static std::vector<LocalIndex> around(const IndexLists& at_vertex, const Simplex& simplex)
  {
    std::vector<LocalIndex> rows;
    for (const LocalIndex row : at_vertex[simplex[0]]) {
      const bool has_all = std::ranges::all_of(simplex, [&](LocalIndex v) {
        return std::ranges::find(at_vertex[v], row) != at_vertex[v].end();
      });
      if (has_all) rows.push_back(row);
    }
    return rows;
  }

  [[nodiscard]] Vec3 middle(const Simplex& simplex) const
  {
    Vec3 sum{};
    for (const LocalIndex v : simplex) sum = sum + mesh_.position(v);
    return (1.0 / static_cast<double>(simplex.size())) * sum;
  }

  [[nodiscard]] double middle_t(LocalIndex segment) const
  {
    if (mesh_.segment_t.empty()) return 0.0;
    return 0.5 * (mesh_.segment_t[2 * at(segment)] + mesh_.segment_t[2 * at(segment) + 1]);
  }

  [[nodiscard]] model::SurfaceParameters middle_uv(LocalIndex face, const Simplex& simplex) const
  {
    model::SurfaceParameters uv{};
    if (mesh_.face_uv.empty()) return uv;
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::ranges::find(simplex, mesh_.face_vertices[3 * at(face) + c]) == simplex.end()) {
        continue;
      }
      for (std::size_t d = 0; d < 2; ++d) {
        uv[d] += mesh_.face_uv[2 * (3 * at(face) + c) + d] / static_cast<double>(simplex.size());
      }
    }
    return uv;
  }

  [[nodiscard]] model::SurfacePoint on_patch(LocalIndex face, const Simplex& simplex,
                                             const Vec3& point) const
  {
    const LocalIndex surface = mesh_.patch_surface[at(mesh_.face_patch[at(face)])];
    return model_.project_to_surface(surface, point, middle_uv(face, simplex));
  }

  [[nodiscard]] Vec3 on_geometry(const Simplex& simplex, const std::vector<LocalIndex>& faces,
                                 const std::vector<LocalIndex>& segments) const
  {
    const Vec3 point = middle(simplex);
    if (segments.empty()) return on_patch(faces.front(), simplex, point).xyz;
    const LocalIndex segment = segments.front();
    return model_.project_to_curve(mesh_.segment_curve[at(segment)], point, middle_t(segment)).xyz;
  }

  // On the way from the middle of the simplex, where every part of a tet is as large as the others.
  [[nodiscard]] Vec3 as_far_as_possible(const Simplex& simplex, const std::vector<LocalIndex>& tets,
                                        const Vec3& wanted) const
  {
    constexpr double kLeastShare = 0.2;  // Of the volume that a part has with the middle.
    const Vec3 from = middle(simplex);
    for (const double factor : {1.0, 0.5, 0.25}) {
      const Vec3 point = from + factor * (wanted - from);
      const auto is_good = [&](LocalIndex t) {
        const auto v = mesh_.tet(t);
        auto corners = corners_at<4>(mesh_.vertex_xyz, mesh_.tet_vertices, t);
        const double least =
            kLeastShare * tet_volume(corners) / static_cast<double>(simplex.size());
        return std::ranges::all_of(simplex, [&](LocalIndex one) {
          const auto c = static_cast<std::size_t>(std::ranges::find(v, one) - v.begin());
          const Vec3 before = std::exchange(corners[c], point);
          const bool is_large = tet_volume(corners) > least;
          corners[c] = before;
          return is_large;
        });
      };
      if (std::ranges::all_of(tets, is_good)) return point;
    }
    return from;
  }

  void divide_segment(LocalIndex s, LocalIndex vertex, const Vec3& point)
  {
    const LocalIndex curve = mesh_.segment_curve[at(s)];
    const double t =
        mesh_.segment_t.empty() ? 0.0 : model_.project_to_curve(curve, point, middle_t(s)).t;
    const LocalIndex end = std::exchange(mesh_.segment_vertices[2 * at(s) + 1], vertex);
    mesh_.segment_vertices.push_back(vertex);
    mesh_.segment_vertices.push_back(end);
    mesh_.segment_curve.push_back(curve);
    if (mesh_.segment_t.empty()) return;
    const double end_t = std::exchange(mesh_.segment_t[2 * at(s) + 1], t);
    mesh_.segment_t.push_back(t);
    mesh_.segment_t.push_back(end_t);
  }

  // The parts of a face, or of a tet below, have the new vertex in place of one of the simplex.
  void divide_face(LocalIndex f, const Simplex& simplex, LocalIndex vertex, const Vec3& point)
  {
    const model::SurfaceParameters uv =
        mesh_.face_uv.empty() ? model::SurfaceParameters{} : on_patch(f, simplex, point).uv;
    const std::vector<LocalIndex> corners(&mesh_.face_vertices[3 * at(f)],
                                          &mesh_.face_vertices[3 * at(f)] + 3);
    const std::vector<double> parameters =
        mesh_.face_uv.empty()
            ? std::vector<double>{}
            : std::vector<double>(&mesh_.face_uv[6 * at(f)], &mesh_.face_uv[6 * at(f)] + 6);
    for (std::size_t part = 0; part < simplex.size(); ++part) {
      const LocalIndex row = part == 0 ? f : mesh_.num_faces();
      if (part > 0) {
        mesh_.face_vertices.insert(mesh_.face_vertices.end(), corners.begin(), corners.end());
        mesh_.face_uv.insert(mesh_.face_uv.end(), parameters.begin(), parameters.end());
        mesh_.face_patch.push_back(LocalIndex{mesh_.face_patch[at(f)]});
        if (!mesh_.images.are_none()) mesh_.images.face_origin.push_back(kNoIndex);
      }
      const auto c =
          static_cast<std::size_t>(std::ranges::find(corners, simplex[part]) - corners.begin());
      mesh_.face_vertices[3 * at(row) + c] = vertex;
      if (!parameters.empty()) std::ranges::copy(uv, &mesh_.face_uv[2 * (3 * at(row) + c)]);
    }
  }

  void divide_tet(LocalIndex t, const Simplex& simplex, LocalIndex vertex)
  {
    const std::vector<LocalIndex> corners(mesh_.tet(t).begin(), mesh_.tet(t).end());
    for (std::size_t part = 0; part < simplex.size(); ++part) {
      const LocalIndex row = part == 0 ? t : mesh_.num_tets();
      if (part > 0) {
        mesh_.tet_vertices.insert(mesh_.tet_vertices.end(), corners.begin(), corners.end());
        mesh_.tet_material.push_back(LocalIndex{mesh_.tet_material[at(t)]});
      }
      const auto c = std::ranges::find(corners, simplex[part]) - corners.begin();
      mesh_.tet_vertices[4 * at(row) + static_cast<std::size_t>(c)] = vertex;
    }
  }

  mesh::CoarseMesh& mesh_;
  const model::Model& model_;
  IndexLists tets_at_;
  IndexLists faces_at_;
  IndexLists segments_at_;
  std::vector<bool> is_touched_;
};

}  // namespace

bool are_rims_near(const mesh::CoarseMesh& mesh, const SplitOptions& options)
{
  return !find_closed(mesh, SplitFaces(mesh, options)).empty();
}

void divide_at_rims(mesh::CoarseMesh& mesh, const SplitOptions& options, const model::Model& model)
{
  for (;;) {
    const SplitFaces split(mesh, options);
    const std::vector<Simplex> closed = find_closed(mesh, split);
    if (closed.empty()) break;
    Inserter inserter(mesh, model);
    for (const Simplex& simplex : closed) inserter.insert_into(simplex);
  }
  mesh::validate(mesh);
}

}  // namespace tessera::topology
