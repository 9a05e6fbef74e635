// SPDX-License-Identifier: BSD-3-Clause
#include "surface/groups.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "tessera/mesh/tet_topology.hpp"

namespace tessera::surface {
namespace {

template <class Key>
LocalIndex row_of(std::map<Key, LocalIndex>& rows, const Key& key)
{
  return rows.try_emplace(key, static_cast<LocalIndex>(rows.size())).first->second;
}

}  // namespace

SurfaceGroups::SurfaceGroups(const CoarseSurface& surface, const model::Model& model)
    : given_(surface), model_(model)
{
  for (LocalIndex v = 0; v < surface.mesh.num_vertices(); ++v) {
    groups_.vertex_xyz.push_back(surface.mesh.position(v));
  }
  groups_.vertex_is_fixed.assign(groups_.vertex_xyz.size(), 0);
  add_triangles();
  add_segments();
  add_other_edges();
}

void SurfaceGroups::add_triangles()
{
  const mesh::CoarseMesh& mesh = given_.mesh;
  std::map<std::array<LocalIndex, 3>, LocalIndex> rows;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    const auto& [out_of, into] = given_.face_domains[at(f)];
    const std::array<LocalIndex, 3> key{mesh.face_patch[at(f)], out_of, into};
    const LocalIndex group = row_of(rows, key);
    if (at(group) == group_.size()) {
      group_.push_back(key);
      groups_.patch_materials.push_back({out_of, into});
    }
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    groups_.triangles.push_back({v[0], v[1], v[2]});
    groups_.triangle_patch.push_back(group);
    for (std::size_t c = 0; has_uv() && c < 3; ++c) {
      const double* uv = &mesh.face_uv[6 * at(f) + 2 * c];
      uv_.try_emplace({group, v[c]}, Uv{uv[0], uv[1]});
    }
  }
}

void SurfaceGroups::add_edge(const Edge& edge, LocalIndex curve, bool is_fixed)
{
  if (edges_.insert(edge).second) {
    groups_.edges.push_back(edge);
    groups_.edge_curve.push_back(curve);
  }
  if (!is_fixed) return;
  for (const LocalIndex v : edge) groups_.vertex_is_fixed[at(v)] = 1;
}

// An edge stands once for each side. Two curves at one edge lie in each other; it stays.
void SurfaceGroups::add_segments()
{
  const mesh::CoarseMesh& mesh = given_.mesh;
  std::map<LocalIndex, LocalIndex> rows;
  std::map<Edge, std::set<LocalIndex>> curves;
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {
    const LocalIndex curve = row_of(rows, mesh.segment_curve[at(s)]);
    if (at(curve) == curve_number_.size()) curve_number_.push_back(mesh.segment_curve[at(s)]);
    const LocalIndex* ends = &mesh.segment_vertices[2 * at(s)];
    curves[mesh::sorted_edge(ends[0], ends[1])].insert(curve);
    for (std::size_t end = 0; has_t() && end < 2; ++end) {
      t_[{curve, ends[end]}].push_back(mesh.segment_t[2 * at(s) + end]);
    }
  }
  for (const auto& [edge, on] : curves) {
    const LocalIndex curve = *on.begin();
    if (on.size() > 1) on_several_curves_.insert(edge);
    add_edge(edge, curve, on.size() > 1 || model_curve(curve) == kNoIndex);
  }
}

// Between groups without a curve, and where more than two triangles meet.
void SurfaceGroups::add_other_edges()
{
  std::map<Edge, std::vector<LocalIndex>> groups;
  for (std::size_t t = 0; t < groups_.triangles.size(); ++t) {
    const auto& v = groups_.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) {
      groups[mesh::sorted_edge(v[c], v[(c + 1) % 3])].push_back(groups_.triangle_patch[t]);
    }
  }
  const auto none = static_cast<LocalIndex>(curve_number_.size());
  curve_number_.push_back(kNoIndex);
  for (const auto& [edge, of] : groups) {
    if (edges_.contains(edge) || (of.size() == 2 && of[0] == of[1])) continue;
    add_edge(edge, none, true);
  }
}

LocalIndex SurfaceGroups::model_surface(LocalIndex group) const
{
  const LocalIndex patch = group_[at(group)][0];
  return patch == kNoIndex ? kNoIndex : given_.mesh.patch_surface[at(patch)];
}

SurfaceGroups::Uv SurfaceGroups::uv_near(LocalIndex group, LocalIndex v) const
{
  const auto found = uv_.find({group, v});
  return found == uv_.end() ? Uv{} : found->second;
}

double SurfaceGroups::t_near(LocalIndex curve, LocalIndex v) const
{
  const auto found = t_.find({curve, v});
  return found == t_.end() ? 0.0 : found->second.front();
}

Vec3 SurfaceGroups::on_group(LocalIndex group, LocalIndex near, const Vec3& point) const
{
  const LocalIndex surface = model_surface(group);
  if (surface == kNoIndex) return point;
  return model_.project_to_surface(surface, point, uv_near(group, near)).xyz;
}

Vec3 SurfaceGroups::on_curve(LocalIndex curve, LocalIndex near, const Vec3& point) const
{
  const LocalIndex number = model_curve(curve);
  if (number == kNoIndex) return point;
  return model_.project_to_curve(number, point, t_near(curve, near)).xyz;
}

void SurfaceGroups::place_on_group(LocalIndex group, LocalIndex v, LocalIndex near,
                                   const Vec3& point)
{
  changed_.insert(v);
  const LocalIndex surface = model_surface(group);
  if (surface == kNoIndex || !has_uv()) return;
  uv_[{group, v}] = model_.project_to_surface(surface, point, uv_near(group, near)).uv;
}

void SurfaceGroups::place_on_curve(LocalIndex curve, LocalIndex v, LocalIndex near,
                                   const Vec3& point)
{
  changed_.insert(v);
  const LocalIndex number = model_curve(curve);
  if (number == kNoIndex || !has_t()) return;
  t_[{curve, v}] = {model_.project_to_curve(number, point, t_near(curve, near)).t};
}

bool SurfaceGroups::is_seam(LocalIndex curve, LocalIndex v) const
{
  constexpr double kSame = 1e-6;  // Segments on either side of a vertex give it twice.
  const auto known = t_.find({curve, v});
  if (known == t_.end()) return false;
  const auto [least, most] = std::ranges::minmax(known->second);
  return most - least > kSame * (1.0 + std::abs(most));
}

void SurfaceGroups::merge(LocalIndex gone, LocalIndex kept, const Vec3& point)
{
  changed_.insert({gone, kept});
  for (std::size_t c = 0; has_t() && c < curve_number_.size(); ++c) {
    const auto curve = static_cast<LocalIndex>(c);
    const auto known = t_.find({curve, gone});
    if (known == t_.end() || model_curve(curve) == kNoIndex) continue;
    std::vector<double> found;
    for (const double t : known->second) {
      found.push_back(model_.project_to_curve(model_curve(curve), point, t).t);
    }
    t_.try_emplace({curve, kept}, std::move(found));
  }
}

CoarseSurface SurfaceGroups::take(const EditableSurface& edited) const
{
  CoarseSurface to = given_;
  to.face_domains.clear();
  to.mesh.vertex_xyz.clear();
  for (LocalIndex v = 0; v < edited.num_vertices(); ++v) {
    const Vec3& p = edited.xyz(v);
    to.mesh.vertex_xyz.insert(to.mesh.vertex_xyz.end(), p.begin(), p.end());
  }
  to.mesh.face_vertices.clear();
  to.mesh.face_patch.clear();
  to.mesh.face_uv.clear();
  for (LocalIndex t = 0; t < edited.num_triangles(); ++t) {
    if (edited.triangle(t)[0] != kNoIndex) take_face(edited, t, to);
  }
  take_segments(edited, to);
  return to;
}

void SurfaceGroups::take_face(const EditableSurface& edited, LocalIndex t, CoarseSurface& to) const
{
  const auto& [patch, out_of, into] = group_[at(edited.patch(t))];
  to.mesh.face_patch.push_back(patch);
  to.face_domains.push_back({out_of, into});
  const auto& v = edited.triangle(t);
  to.mesh.face_vertices.insert(to.mesh.face_vertices.end(), v.begin(), v.end());
  if (!has_uv()) return;
  const bool was_given = at(t) < groups_.triangles.size() && groups_.triangles[at(t)] == v;
  const bool is_same = was_given && std::ranges::none_of(v, [this](LocalIndex corner) {
                         return changed_.contains(corner);
                       });
  if (is_same) {
    const double* uv = &given_.mesh.face_uv[6 * at(t)];
    to.mesh.face_uv.insert(to.mesh.face_uv.end(), uv, uv + 6);
    return;
  }
  for (const LocalIndex corner : v) {
    Uv uv = uv_near(edited.patch(t), corner);
    const LocalIndex surface = model_surface(edited.patch(t));
    if (surface != kNoIndex && !uv_.contains({edited.patch(t), corner})) {
      const auto known = std::ranges::find_if(v, [&](LocalIndex other) {
        return uv_.contains({edited.patch(t), other});
      });
      if (known != v.end()) uv = uv_near(edited.patch(t), *known);
      uv = model_.project_to_surface(surface, edited.xyz(corner), uv).uv;
    }
    to.mesh.face_uv.insert(to.mesh.face_uv.end(), uv.begin(), uv.end());
  }
}

// Of an end of a closed curve that parameter counts that is nearer to the other end's.
std::array<double, 2> SurfaceGroups::ends_on(LocalIndex curve, const Edge& edge) const
{
  std::array<double, 2> best{};
  double least = -1.0;
  const auto first = t_.find({curve, edge[0]});
  const auto second = t_.find({curve, edge[1]});
  if (first == t_.end() || second == t_.end())
    return {t_near(curve, edge[0]), t_near(curve, edge[1])};
  for (const double a : first->second) {
    for (const double b : second->second) {
      if (least >= 0.0 && std::abs(b - a) >= least) continue;
      least = std::abs(b - a);
      best = {a, b};
    }
  }
  return best;
}

void SurfaceGroups::take_segments(const EditableSurface& edited, CoarseSurface& to) const
{
  const mesh::CoarseMesh& from = given_.mesh;
  mesh::CoarseMesh& mesh = to.mesh;
  mesh.segment_vertices.clear();
  mesh.segment_curve.clear();
  mesh.segment_t.clear();
  const auto add = [&](const LocalIndex* ends, LocalIndex curve, const double* t) {
    mesh.segment_vertices.insert(mesh.segment_vertices.end(), ends, ends + 2);
    mesh.segment_curve.push_back(curve);
    if (has_t()) mesh.segment_t.insert(mesh.segment_t.end(), t, t + 2);
  };
  std::set<Edge> kept;
  for (LocalIndex s = 0; s < from.num_segments(); ++s) {
    const LocalIndex* ends = &from.segment_vertices[2 * at(s)];
    if (changed_.contains(ends[0]) || changed_.contains(ends[1])) continue;
    if (edited.curve(ends[0], ends[1]) == kNoIndex) continue;
    kept.insert(mesh::sorted_edge(ends[0], ends[1]));
    add(ends, from.segment_curve[at(s)], has_t() ? &from.segment_t[2 * at(s)] : nullptr);
  }
  for (const auto& [edge, curve] : edited.curves()) {
    if (kept.contains(edge) || model_curve(curve) == kNoIndex) continue;
    const std::array<double, 2> t = ends_on(curve, edge);
    add(edge.data(), model_curve(curve), t.data());
  }
}

}  // namespace tessera::surface
