// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/volume_mesher.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <meshing.hpp>

#include "tessera/base/error.hpp"
#include "tessera/surface/touching_faces.hpp"

#include "netgen/fill/skin_mesh.hpp"
#include "netgen/mesh_conversion.hpp"
#include "netgen/session.hpp"
#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

// Attempts of NETGEN to fill what its front has left open. Holes that can be filled need one or
// two.
constexpr int kMostStepsOfHole = 2;

surface::DomainTets tets_in(::netgen::Mesh& mesh, const surface::DomainSkin& skin)
{
  mesh.Compress();
  const auto num_fixed = static_cast<LocalIndex>(skin.vertex.size());
  OrderedTets tets = tets_of(mesh, point_order(num_fixed, 0));
  if (tets.tet_vertices.empty()) throw NetgenError("NETGEN made no tets");
  return {std::move(tets.vertex_xyz), std::move(tets.tet_vertices)};
}

// What NETGEN does not say of a skin that it cannot fill; empty if the skin touches itself nowhere.
std::string touching_words(const surface::DomainSkin& skin)
{
  constexpr double kTouching = 1e-7;  // Of the model's diagonal.
  std::vector<std::array<LocalIndex, 3>> triangles;
  for (std::size_t c = 0; c < skin.triangle_vertices.size(); c += 3) {
    const LocalIndex* const v = &skin.triangle_vertices[c];
    triangles.push_back({v[0], v[1], v[2]});
  }
  const double tolerance = kTouching * skin.model_box.diagonal();
  const auto touching = surface::find_touching_faces(skin.vertex_xyz, triangles, tolerance);
  if (!touching) return {};
  return fmt::format(
      "; the surface touches itself at ({:g}): if that is the model's, its wall has no thickness "
      "there; give it some, or make the hole go through",
      fmt::join(touching->place, ", "));
}

surface::DomainTets first_tets(const surface::DomainSkin& skin, NetgenSession& session)
{
  ::netgen::Mesh mesh;
  add_skin(mesh, skin);
  set_sizes(mesh, skin.model_box, session.parameters());
  mesh_volume(session.parameters(), mesh);
  return tets_in(mesh, skin);
}

}  // namespace

surface::DomainTets fill_domain(const surface::DomainSkin& skin,
                                const surface::CoarseOptions& options)
{
  if (skin.vertex.empty()) return {};
  const double scale = scale_for_netgen(skin.model_box.diagonal());
  surface::CoarseOptions scaled = options;
  scaled.max_size = scale * std::min(options.max_size, skin.max_size);
  scaled.points = options.points.scaled(scale);
  surface::DomainSkin scaled_skin = skin;
  for (double& x : scaled_skin.vertex_xyz) x *= scale;
  scaled_skin.model_box = {scale * skin.model_box.low, scale * skin.model_box.high};
  ::netgen::MeshingParameters parameters = coarse_parameters(scaled);
  if (skin.is_hole) parameters.maxoutersteps = kMostStepsOfHole;
  NetgenSession session(parameters);
  try {
    surface::DomainTets tets =
        session.run("coarse volume mesh", [&] { return first_tets(scaled_skin, session); });
    for (double& x : tets.vertex_xyz) x /= scale;
    return tets;
  } catch (const NetgenError& error) {
    throw NetgenError(error.what() + touching_words(skin));
  }
}

}  // namespace tessera::netgen
