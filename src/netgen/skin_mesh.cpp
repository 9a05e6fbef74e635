// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/skin_mesh.hpp"

#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "tessera/base/error.hpp"

#include "netgen/mesh_conversion.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::PointIndex;

std::vector<LocalIndex> inverse(const std::vector<LocalIndex>& order)
{
  std::vector<LocalIndex> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[static_cast<std::size_t>(order[i])] = static_cast<LocalIndex>(i);
  }
  return place;
}

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

::netgen::Point3d to_netgen(const Vec3& p) { return {p[0], p[1], p[2]}; }

void add_surface(::netgen::Mesh& mesh, const std::vector<double>& vertex_xyz,
                 const std::vector<LocalIndex>& triangle_vertices,
                 const std::vector<LocalIndex>& order)
{
  for (const LocalIndex v : order) {
    mesh.AddPoint(to_netgen(point_at(std::span(vertex_xyz), v)));
  }
  mesh.AddFaceDescriptor(
      ::netgen::FaceDescriptor(1, 1, 0, 0));  // Domain 1 inside, nothing outside.
  const std::vector<LocalIndex> place = inverse(order);
  const auto number = [&](std::size_t at) {
    return place[static_cast<std::size_t>(triangle_vertices[at])] + PointIndex::BASE;
  };
  for (std::size_t t = 0; t < triangle_vertices.size(); t += 3) {
    ::netgen::Element2d triangle(number(t), number(t + 1), number(t + 2));
    triangle.SetIndex(1);
    mesh.AddSurfaceElement(triangle);
  }
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
