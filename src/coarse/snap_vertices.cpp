// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/snap_vertices.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "tessera/base/repair.hpp"
#include "tessera/base/tet.hpp"

namespace tessera::coarse {
namespace {

// A tet may lose this part of its volume to a move.
constexpr double kLeastVolume = 0.5;

class Snapper {
 public:
  Snapper(mesh::CoarseMesh& mesh, const model::Model& model, const surface::Defeatured& merged)
      : mesh_(mesh),
        model_(model),
        merged_(merged),
        corners_(at(mesh.num_vertices())),
        ends_(corners_.size()),
        tets_(corners_.size())
  {
    for (std::size_t c = 0; c < mesh_.face_vertices.size(); ++c) {
      corners_[at(mesh_.face_vertices[c])].push_back(c);
    }
    for (std::size_t e = 0; e < mesh_.segment_vertices.size(); ++e) {
      ends_[at(mesh_.segment_vertices[e])].push_back(e);
    }
    for (std::size_t c = 0; c < mesh_.tet_vertices.size(); ++c) {
      tets_[at(mesh_.tet_vertices[c])].push_back(static_cast<LocalIndex>(c / 4));
    }
  }

  VertexDistance run()
  {
    VertexDistance distance;
    const bool may_move = !is_left_out(Repair::snapped_vertices);
    for (LocalIndex v = 0; v < mesh_.num_vertices(); ++v) {
      Off off = measure(v);
      if (off.is_beyond_tolerance && may_move && move(v)) {
        note_repair(Repair::snapped_vertices);
        off = measure(v);
      }
      distance.largest = std::max(distance.largest, off.distance);
      if (off.is_beyond_tolerance) count(v, off, distance);
    }
    return distance;
  }

 private:
  struct Off {
    double distance = 0.0;
    bool is_beyond_tolerance = false;  // That of the surface or curve.
    bool is_beyond_end = false;        // That of the CAD vertex at the end of a curve as well.
  };

  void count(LocalIndex v, const Off& off, VertexDistance& distance) const
  {
    if (off.distance <= merged_.tolerance && is_beside_merged(v)) {
      ++distance.num_merged;
      distance.largest_merged = std::max(distance.largest_merged, off.distance);
    } else if (off.is_beyond_end && off.distance > kMostOfEdgeOff * shortest_edge(v)) {
      ++distance.num_off;
      if (off.distance <= distance.largest_off) return;
      distance.largest_off = off.distance;
      distance.farthest_off = mesh_.position(v);
    } else {
      ++distance.num_within;
      distance.largest_within = std::max(distance.largest_within, off.distance);
    }
  }

  // What is merged lies off the geometry, and edges lead from it back there.
  [[nodiscard]] bool is_beside_merged(LocalIndex v) const
  {
    return std::ranges::any_of(corners_[at(v)], [&](std::size_t corner) {
      const LocalIndex* of_face = &mesh_.face_vertices[corner - corner % 3];
      return std::any_of(of_face, of_face + 3, [&](LocalIndex one) { return is_merged(one); });
    });
  }

  [[nodiscard]] bool is_merged(LocalIndex v) const
  {
    return std::ranges::any_of(merged_.places, [&](const Vec3& place) {
      return norm(mesh_.position(v) - place) <= merged_.tolerance;
    });
  }

  [[nodiscard]] LocalIndex surface_of(std::size_t corner) const
  {
    return mesh_.patch_surface[at(mesh_.face_patch[corner / 3])];
  }

  [[nodiscard]] model::SurfacePoint on_surface(std::size_t corner, const Vec3& point) const
  {
    model::SurfaceParameters guess{};
    if (!mesh_.face_uv.empty()) guess = {mesh_.face_uv[2 * corner], mesh_.face_uv[2 * corner + 1]};
    return model_.project_to_surface(surface_of(corner), point, guess);
  }

  [[nodiscard]] model::CurvePoint on_curve(std::size_t end, const Vec3& point) const
  {
    const double guess = mesh_.segment_t.empty() ? 0.0 : mesh_.segment_t[end];
    return model_.project_to_curve(mesh_.segment_curve[end / 2], point, guess);
  }

  [[nodiscard]] Off measure(LocalIndex v) const
  {
    const Vec3 point = mesh_.position(v);
    Off off;
    const auto add = [&off](double distance, double tolerance, double end_tolerance) {
      off.distance = std::max(off.distance, distance);
      off.is_beyond_tolerance = off.is_beyond_tolerance || distance > tolerance;
      off.is_beyond_end = off.is_beyond_end || distance > end_tolerance;
    };
    for (const std::size_t end : ends_[at(v)]) {
      const LocalIndex curve = mesh_.segment_curve[end / 2];
      add(norm(on_curve(end, point).xyz - point), model_.curve_tolerance(curve),
          model_.end_tolerance(curve, point));
    }
    // On a curve that is all: surfaces meet there as well as the model's makers made them meet.
    if (!ends_[at(v)].empty()) return off;
    for (const std::size_t corner : corners_[at(v)]) {
      const double tolerance = model_.surface_tolerance(surface_of(corner));
      add(norm(on_surface(corner, point).xyz - point), tolerance, tolerance);
    }
    return off;
  }

  // Whether the vertex went to the one place that its only curve or surface has for it.
  bool move(LocalIndex v)
  {
    const std::vector<std::size_t>& ends = ends_[at(v)];
    const std::vector<std::size_t>& corners = corners_[at(v)];
    const Vec3 before = mesh_.position(v);
    if (ends.empty()) {
      const LocalIndex surface = surface_of(corners.front());
      const auto is_there = [&](std::size_t corner) { return surface_of(corner) == surface; };
      if (!std::ranges::all_of(corners, is_there)) return false;
      if (!place(v, on_surface(corners.front(), before).xyz)) return false;
    } else {
      const LocalIndex curve = mesh_.segment_curve[ends.front() / 2];
      const auto is_there = [&](std::size_t end) { return mesh_.segment_curve[end / 2] == curve; };
      if (ends.size() < 2 || !std::ranges::all_of(ends, is_there)) return false;
      if (!place(v, on_curve(ends.front(), before).xyz)) return false;
    }
    take_parameters(v);
    return true;
  }

  bool place(LocalIndex v, const Vec3& target)
  {
    const Vec3 before = mesh_.position(v);
    std::vector<double> volumes;
    for (const LocalIndex t : tets_[at(v)]) volumes.push_back(volume(t));
    set_position(v, target);
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      if (volume(tets_[at(v)][i]) >= kLeastVolume * volumes[i]) continue;
      set_position(v, before);
      return false;
    }
    return true;
  }

  void take_parameters(LocalIndex v)
  {
    const Vec3 point = mesh_.position(v);
    if (!mesh_.face_uv.empty()) {
      for (const std::size_t corner : corners_[at(v)]) {
        const model::SurfaceParameters uv = on_surface(corner, point).uv;
        std::copy(uv.begin(), uv.end(), &mesh_.face_uv[2 * corner]);
      }
    }
    if (mesh_.segment_t.empty()) return;
    for (const std::size_t end : ends_[at(v)]) mesh_.segment_t[end] = on_curve(end, point).t;
  }

  [[nodiscard]] double volume(LocalIndex t) const
  {
    return tet_volume(corners_at<4>(mesh_.vertex_xyz, mesh_.tet_vertices, t));
  }

  [[nodiscard]] double shortest_edge(LocalIndex v) const
  {
    double shortest = std::numeric_limits<double>::infinity();
    for (const LocalIndex t : tets_[at(v)]) {
      for (const LocalIndex other : mesh_.tet(t)) {
        if (other == v) continue;
        shortest = std::min(shortest, norm(mesh_.position(other) - mesh_.position(v)));
      }
    }
    return shortest;
  }

  void set_position(LocalIndex v, const Vec3& point)
  {
    std::ranges::copy(point, mesh_.vertex_xyz.begin() + static_cast<std::ptrdiff_t>(3 * at(v)));
  }

  mesh::CoarseMesh& mesh_;
  const model::Model& model_;
  const surface::Defeatured& merged_;
  std::vector<std::vector<std::size_t>> corners_;  // Of faces, at each vertex.
  std::vector<std::vector<std::size_t>> ends_;     // Of segments, at each vertex.
  std::vector<std::vector<LocalIndex>> tets_;      // Around each vertex.
};

}  // namespace

VertexDistance VertexDistance::scaled(double factor) const
{
  VertexDistance one = *this;
  for (double* const length :
       {&one.largest, &one.largest_off, &one.largest_within, &one.largest_merged}) {
    *length *= factor;
  }
  one.farthest_off = factor * one.farthest_off;
  return one;
}

VertexDistance snap_vertices(mesh::CoarseMesh& mesh, const model::Model& model,
                             const surface::Defeatured& merged)
{
  return Snapper(mesh, model, merged).run();
}

}  // namespace tessera::coarse
