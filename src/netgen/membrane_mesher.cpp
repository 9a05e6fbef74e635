// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/membrane_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <meshing.hpp>

#include "tessera/base/box_diagonal.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

#include "netgen/netgen_session.hpp"
#include "netgen/netgen_versions.hpp"
#include "netgen/skin_mesh.hpp"

namespace tessera::netgen {
namespace {

using ::netgen::PointIndex;

constexpr int kNumImprovements = 3;

// NETGEN's own 200 tries at an edge take minutes where no triangles can be made.
constexpr int kMostTriesAtEdge = 30;

// Coordinates in which a plane is z = 0 and looks up, and lengths are NETGEN's.
class PlaneFrame {
 public:
  PlaneFrame(const cut::Plane& plane, double scale) : plane_(plane), scale_(scale)
  {
    Vec3 axis{};
    const Vec3& n = plane.normal;
    const auto least = std::ranges::min_element(n, {}, [](double x) { return std::abs(x); });
    axis[static_cast<std::size_t>(least - n.begin())] = 1.0;
    right_ = cross(axis, n);
    right_ = (1.0 / norm(right_)) * right_;
    forward_ = cross(n, right_);
  }

  [[nodiscard]] Vec3 to(const Vec3& p) const
  {
    return scale_ * Vec3{dot(right_, p), dot(forward_, p), plane_.height(p)};
  }

  [[nodiscard]] Vec3 in_plane(double x, double y) const
  {
    return (1.0 / scale_) * (x * right_ + y * forward_) + plane_.offset * plane_.normal;
  }

  [[nodiscard]] std::vector<double> to(std::vector<double> xyz) const
  {
    for (std::size_t v = 0; v < xyz.size() / 3; ++v) {
      std::ranges::copy(to(point_at(std::span(xyz), v)), &xyz[3 * v]);
    }
    return xyz;
  }

 private:
  cut::Plane plane_;
  double scale_;
  Vec3 right_{};
  Vec3 forward_{};
};

// The plane mesh in the making: in a mesh that has the skin for its sizes.
class PlaneMesh {
 public:
  PlaneMesh(const coarse::DomainSkin& skin, const PlaneFrame& frame, NetgenSession& session)
      : frame_(frame), session_(session), num_skin_(static_cast<LocalIndex>(skin.vertex.size()))
  {
    coarse::DomainSkin turned = skin;
    turned.vertex_xyz = frame.to(std::move(turned.vertex_xyz));
    add_skin(mesh_, turned);
    set_sizes(mesh_, bounding_box(turned.vertex_xyz), session.parameters());
    face_ = mesh_.GetNFD() + 1;
    mesh_.AddFaceDescriptor(::netgen::FaceDescriptor(face_, 1, 0, 0));
  }

  // False if NETGEN gives up.
  bool fill(const coarse::MembraneBorder& border)
  {
    ::netgen::Box<3> box(::netgen::Box<3>::EMPTY_BOX);
    for (const auto& edge : border.edges) box.Add(mesh_[border_point(edge[0])]);
    ::netgen::Meshing2 mesher = plane_mesher(session_.parameters(), box);
    for (const LocalIndex v : of_border_) mesher.AddPoint(mesh_[border_point(v)], border_point(v));
    ::netgen::PointGeomInfo anywhere;
    anywhere.trignum = 1;
    for (const auto& [from, to] : border.edges) {
      mesher.AddBoundaryElement(1 + row(from), 1 + row(to), anywhere, anywhere);
    }
    const double max_size = session_.parameters().maxh;
    return mesher.GenerateMesh(mesh_, session_.parameters(), max_size, face_)
           == ::netgen::MESHING2_OK;
  }

  void improve()
  {
    for (int p = first_inner(); p < end(); ++p)
      mesh_[PointIndex(p)].SetType(::netgen::SURFACEPOINT);
    mesh_.CalcSurfacesOfNode();
    for (int round = 0; round < kNumImprovements; ++round) {
      PlaneOptimizer optimizer(mesh_);
      optimizer.SetFaceIndex(face_);
      optimizer.SetImproveEdges(0);
      optimizer.SetMetricWeight(session_.parameters().elsizeweight);
      optimizer.SetWriteStatus(0);
      optimizer.swap_edges(round > 0);
      optimizer.smooth(session_.parameters());
    }
  }

  [[nodiscard]] coarse::Membrane membrane() const
  {
    coarse::Membrane result;
    for (int p = first_inner(); p < end(); ++p) {
      const auto& point = mesh_[PointIndex(p)];
      const Vec3 place = frame_.in_plane(point(0), point(1));
      result.vertex_xyz.insert(result.vertex_xyz.end(), place.begin(), place.end());
    }
    for (const auto& triangle : mesh_.SurfaceElements()) {
      if (triangle.GetIndex() != face_) continue;
      for (int c = 0; c < 3; ++c) result.triangle_vertices.push_back(number_of(triangle[c]));
    }
    return result;
  }

 private:
  // Vertices of the border come behind the skin's, once more and in the plane.
  LocalIndex row(LocalIndex vertex)
  {
    const auto [place, is_new] =
        row_.try_emplace(vertex, static_cast<LocalIndex>(of_border_.size()));
    if (is_new) {
      of_border_.push_back(vertex);
      const auto at_height = mesh_[PointIndex(vertex + PointIndex::BASE)];
      mesh_.AddPoint({at_height(0), at_height(1), 0.0}, 1, ::netgen::EDGEPOINT);
    }
    return place->second;
  }

  PointIndex border_point(LocalIndex vertex) { return num_skin_ + row(vertex) + PointIndex::BASE; }

  [[nodiscard]] int first_inner() const
  {
    return num_skin_ + static_cast<int>(of_border_.size()) + PointIndex::BASE;
  }
  [[nodiscard]] int end() const { return static_cast<int>(mesh_.GetNP()) + PointIndex::BASE; }

  [[nodiscard]] LocalIndex number_of(PointIndex point) const
  {
    if (point < first_inner()) return of_border_[at(point - PointIndex::BASE - num_skin_)];
    return num_skin_ + (point - first_inner());
  }

  const PlaneFrame& frame_;
  NetgenSession& session_;
  LocalIndex num_skin_;
  int face_ = 0;
  ::netgen::Mesh mesh_{};
  std::vector<LocalIndex> of_border_{};
  std::map<LocalIndex, LocalIndex> row_{};  // Of a vertex of the skin in `of_border_`.
};

}  // namespace

coarse::Membrane mesh_membrane(const coarse::DomainSkin& skin, const coarse::MembraneBorder& border,
                               const coarse::CoarseOptions& options)
{
  const double scale = scale_for_netgen(box_diagonal(skin.vertex_xyz));
  const PlaneFrame frame(border.plane, scale);
  coarse::CoarseOptions scaled = options;
  scaled.max_size = scale * std::min(options.max_size, skin.max_size);
  scaled.points.xyz = frame.to(options.points.xyz);
  for (double& size : scaled.points.size) size *= scale;
  ::netgen::MeshingParameters parameters = coarse_parameters(scaled);
  parameters.giveuptol2d = kMostTriesAtEdge;
  NetgenSession session(parameters);
  try {
    return session.run("membrane", [&]() -> coarse::Membrane {
      PlaneMesh mesh(skin, frame, session);
      if (!mesh.fill(border)) return {};
      mesh.improve();
      return mesh.membrane();
    });
  } catch (const NetgenError&) {
    return {};
  }
}

}  // namespace tessera::netgen
