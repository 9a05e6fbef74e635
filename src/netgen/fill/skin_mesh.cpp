// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/fill/skin_mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/base/rows.hpp"

#include "netgen/mesh_conversion.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::PointIndex;

PointIndex number_of(LocalIndex v) { return {v + PointIndex::BASE}; }

}  // namespace

std::vector<LocalIndex> point_order(LocalIndex num_vertices, unsigned seed)
{
  std::vector<LocalIndex> order(static_cast<std::size_t>(num_vertices));
  std::iota(order.begin(), order.end(), 0);
  if (seed == 0) return order;
  // Own shuffle and generator: those of the standard library differ between its makers.
  std::uint64_t state = seed;
  for (std::size_t left = order.size(); left > 1; --left) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    std::swap(order[left - 1], order[static_cast<std::size_t>((state >> 33) % left)]);
  }
  return order;
}

::netgen::Point3d to_point3d(const Vec3& p) { return {p[0], p[1], p[2]}; }

void add_surface(::netgen::Mesh& mesh, const std::vector<double>& vertex_xyz,
                 const std::vector<LocalIndex>& triangle_vertices,
                 const std::vector<LocalIndex>& order)
{
  for (const LocalIndex v : order) {
    mesh.AddPoint(to_point3d(point_at(std::span(vertex_xyz), v)));
  }
  mesh.AddFaceDescriptor(
      ::netgen::FaceDescriptor(1, 1, 0, 0));  // Domain 1 inside, nothing outside.
  const std::vector<LocalIndex> place = inverse_of(order);
  const auto number = [&](std::size_t at) {
    return place[static_cast<std::size_t>(triangle_vertices[at])] + PointIndex::BASE;
  };
  for (std::size_t t = 0; t < triangle_vertices.size(); t += 3) {
    ::netgen::Element2d triangle(number(t), number(t + 1), number(t + 2));
    triangle.SetIndex(1);
    mesh.AddSurfaceElement(triangle);
  }
}

void add_skin(::netgen::Mesh& mesh, const surface::DomainSkin& skin)
{
  for (std::size_t v = 0; v < skin.vertex.size(); ++v) {
    mesh.AddPoint(to_point3d(point_at(std::span(skin.vertex_xyz), v)));
  }
  const LocalIndex num_patches = 1 + *std::ranges::max_element(skin.triangle_patch);
  for (LocalIndex p = 0; p < num_patches; ++p) {
    mesh.AddFaceDescriptor(::netgen::FaceDescriptor(p + 1, 1, 0, 0));
  }
  for (std::size_t t = 0; t < skin.triangle_patch.size(); ++t) {
    const LocalIndex* v = &skin.triangle_vertices[3 * t];
    ::netgen::Element2d triangle(number_of(v[0]), number_of(v[1]), number_of(v[2]));
    triangle.SetIndex(skin.triangle_patch[t] + 1);
    mesh.AddSurfaceElement(triangle);
  }
  for (std::size_t e = 0; e < skin.edge_vertices.size(); e += 2) {
    ::netgen::Segment segment;
    segment[0] = number_of(skin.edge_vertices[e]);
    segment[1] = number_of(skin.edge_vertices[e + 1]);
    mesh.AddSegment(segment);
  }
}

void set_sizes(::netgen::Mesh& mesh, const Box& box, const ::netgen::MeshingParameters& parameters)
{
  mesh.SetLocalH(to_point3d(box.low), to_point3d(box.high), parameters.grading);
  mesh.CalcLocalH(parameters.grading);
  for (const auto& wanted : parameters.meshsize_points) mesh.RestrictLocalH(wanted.pnt, wanted.h);
}

OrderedTets tets_of(const ::netgen::Mesh& mesh, const std::vector<LocalIndex>& order)
{
  OrderedTets output;
  const std::size_t num_ordered = order.size();
  if (mesh.GetNP() < num_ordered) throw NetgenError("NETGEN dropped vertices of the surface");
  output.vertex_xyz.resize(3 * mesh.GetNP());
  const auto vertex = [&](int number) {
    const auto at = static_cast<std::size_t>(number - PointIndex::BASE);
    return at < num_ordered ? order[at] : static_cast<LocalIndex>(at);
  };
  for (int p = PointIndex::BASE; p < static_cast<int>(mesh.GetNP()) + PointIndex::BASE; ++p) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = 3 * static_cast<std::size_t>(vertex(p)) + static_cast<std::size_t>(axis);
      output.vertex_xyz[at] = mesh[PointIndex(p)](axis);
    }
  }
  output.tet_vertices.reserve(4 * mesh.GetNE());
  for (const auto& element : mesh.VolumeElements()) {
    for (const int c : kNetgenTetOrder) output.tet_vertices.push_back(vertex(element[c]));
  }
  return output;
}

}  // namespace tessera::netgen
