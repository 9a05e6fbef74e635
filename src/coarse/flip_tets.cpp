// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/flip_tets.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "tessera/base/cheapest_triangulation.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "coarse/child_energy.hpp"

namespace tessera::coarse {
namespace {

constexpr std::size_t kLargestRing = 7;  // Of the tets around an edge; larger ones seldom pay.
using RingTriangulation = CheapestTriangulation<kLargestRing>;

// More than any sum over a ring of fair tets: first of all such tets become fewer.
constexpr double kCostOfTwoFacesOnAPatch = 1000.0;

constexpr double kLeastGain = 1e-6;  // Relative; less is rounding.

std::array<LocalIndex, 2> edge_key(LocalIndex a, LocalIndex b)
{
  return {std::min(a, b), std::max(a, b)};
}

// The tets around an edge (a, b): corners of the ring in order, such that (a, b, ring[i],
// ring[i+1]) is positive.
struct Ring {
  LocalIndex material = kNoIndex;
  LocalIndex a = kNoIndex;
  LocalIndex b = kNoIndex;
  std::vector<LocalIndex> corners{};
};

class Flipper {
 public:
  Flipper(mesh::CoarseMesh& mesh, const Geometry& geometry)
      : mesh_(mesh), geometry_(geometry), changes_(mesh)
  {
    collect_edges();
  }

  LocalIndex run()
  {
    LocalIndex flips = 0;
    for (std::size_t first = 0; first < edges_.size();) {
      std::size_t last = first + 1;
      while (last < edges_.size() && edges_[last].ends == edges_[first].ends) ++last;
      flips += remove_edge(std::span(edges_).subspan(first, last - first)) ? 1 : 0;
      first = last;
    }
    for (const mesh::TriangleTets& triangle : mesh::triangles_of_tets(mesh_.tet_vertices)) {
      flips += exchange_face(triangle) ? 1 : 0;
    }
    changes_.apply(mesh_);
    return flips;
  }

 private:
  struct EdgeOfTet {
    std::array<LocalIndex, 2> ends{};
    LocalIndex tet = kNoIndex;
    friend auto operator<=>(const EdgeOfTet&, const EdgeOfTet&) = default;
  };

  void collect_edges()
  {
    for (LocalIndex t = 0; t < mesh_.num_tets(); ++t) {
      const auto tet = mesh_.tet(t);
      for (const auto& [i, j] : mesh::kTetEdgeCorners) {
        edges_.push_back({edge_key(tet[i], tet[j]), t});
      }
    }
    std::ranges::sort(edges_);
  }

  [[nodiscard]] bool is_edge(LocalIndex a, LocalIndex b) const
  {
    const EdgeOfTet wanted{edge_key(a, b), kNoIndex};
    const auto found = std::ranges::lower_bound(edges_, wanted);
    return found != edges_.end() && found->ends == wanted.ends;
  }

  // The sum of these is what flips make smaller. The root keeps one bad tet from hiding the others.
  [[nodiscard]] double cost(LocalIndex a, LocalIndex b, LocalIndex c, LocalIndex d) const
  {
    const double energy =
        child_energy({mesh_.position(a), mesh_.position(b), mesh_.position(c), mesh_.position(d)});
    const bool is_bad = geometry_.has_two_faces_on_a_patch({a, b, c, d});
    return std::sqrt(energy) + (is_bad ? kCostOfTwoFacesOnAPatch : 0.0);
  }

  // No corners if the tets do not close around the edge, or one of them is gone or of another
  // material: what parts a body need not be a face.
  [[nodiscard]] Ring ring_of(std::span<const EdgeOfTet> around) const
  {
    Ring ring{mesh_.tet_material[at(around.front().tet)],
              around.front().ends[0],
              around.front().ends[1],
              {}};
    std::vector<std::array<LocalIndex, 2>> steps;
    for (const EdgeOfTet& one : around) {
      if (changes_.is_gone(one.tet) || mesh_.tet_material[at(one.tet)] != ring.material)
        return ring;
      steps.push_back(step_of(one));
    }
    std::vector<LocalIndex> corners{steps.front()[0]};
    LocalIndex next = steps.front()[1];
    while (next != corners.front() && corners.size() < steps.size()) {
      corners.push_back(next);
      const auto step = std::ranges::find(steps, next, [](const auto& s) { return s[0]; });
      if (step == steps.end()) return ring;
      next = (*step)[1];
    }
    if (next == corners.front() && corners.size() == steps.size()) ring.corners = corners;
    return ring;
  }

  // The tet's two other corners, in the order in which they follow in the ring.
  [[nodiscard]] std::array<LocalIndex, 2> step_of(const EdgeOfTet& one) const
  {
    std::array<LocalIndex, 2> others{};
    std::size_t found = 0;
    for (const LocalIndex v : mesh_.tet(one.tet)) {
      if (v != one.ends[0] && v != one.ends[1]) others[found++] = v;
    }
    const double volume = tet_volume(mesh_.position(one.ends[0]), mesh_.position(one.ends[1]),
                                     mesh_.position(others[0]), mesh_.position(others[1]));
    if (volume < 0.0) std::swap(others[0], others[1]);
    return others;
  }

  bool remove_edge(std::span<const EdgeOfTet> around)
  {
    if (around.size() < 3 || around.size() > kLargestRing) return false;
    if (geometry_.has_edge(around.front().ends[0], around.front().ends[1])) return false;
    const Ring ring = ring_of(around);
    const std::size_t n = ring.corners.size();
    if (n == 0) return false;
    double before = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      before += cost(ring.a, ring.b, ring.corners[i], ring.corners[(i + 1) % n]);
    }
    const RingTriangulation cheapest = cheapest_triangulation(ring);
    if (!(cheapest.cost() < (1.0 - kLeastGain) * before)) return false;
    for (const EdgeOfTet& one : around) changes_.remove(one.tet);
    const LocalIndex old = around.front().tet;
    const std::vector<LocalIndex>& c = ring.corners;
    cheapest.for_each_triangle([&](std::size_t i, std::size_t j, std::size_t k) {
      changes_.add({ring.a, c[i], c[j], c[k]}, old);
      changes_.add({ring.b, c[k], c[j], c[i]}, old);
    });
    return true;
  }

  // To fill the ring's cavity without its edge, each triangle gets a tet on either side.
  [[nodiscard]] RingTriangulation cheapest_triangulation(const Ring& ring) const
  {
    const std::vector<LocalIndex>& c = ring.corners;
    // An edge of other tets must not come a second time.
    const auto is_new = [&](std::size_t i, std::size_t k) { return !is_edge(c[i], c[k]); };
    return {c.size(), is_new, [&](double behind, std::size_t i, std::size_t j, std::size_t k) {
              return behind + cost(ring.a, c[i], c[j], c[k]) + cost(ring.b, c[k], c[j], c[i]);
            }};
  }

  // Two tets at a triangle become three around the edge between their opposite corners.
  bool exchange_face(const mesh::TriangleTets& triangle)
  {
    const auto& [first, second] = triangle.tets;
    if (second == kNoIndex || changes_.is_gone(first) || changes_.is_gone(second)) return false;
    if (mesh_.tet_material[at(first)] != mesh_.tet_material[at(second)]) return false;
    const auto& corner = mesh::kTetFaceCorners[at(triangle.corners[0])];
    const auto tet = mesh_.tet(first);
    const std::array<LocalIndex, 3> f{tet[corner[0]], tet[corner[1]], tet[corner[2]]};
    if (geometry_.patch_of(f[0], f[1], f[2]) != kNoIndex) return false;
    const LocalIndex above =
        mesh_.tet(second)[at(triangle.corners[1])];  // Where the normal points.
    const LocalIndex below = tet[at(triangle.corners[0])];
    if (is_edge(above, below)) return false;
    double after = 0.0;
    for (std::size_t i = 0; i < 3; ++i) after += cost(below, above, f[i], f[(i + 1) % 3]);
    const double before = cost(f[0], f[2], f[1], below) + cost(f[0], f[1], f[2], above);
    if (!(after < (1.0 - kLeastGain) * before)) return false;
    changes_.remove(first);
    changes_.remove(second);
    for (std::size_t i = 0; i < 3; ++i) changes_.add({below, above, f[i], f[(i + 1) % 3]}, first);
    return true;
  }

  mesh::CoarseMesh& mesh_;
  const Geometry& geometry_;
  TetChanges changes_;
  std::vector<EdgeOfTet> edges_{};  // Ascending.
};

}  // namespace

Geometry::Geometry(const mesh::CoarseMesh& mesh) : has_vertex_(at(mesh.num_vertices()), 0)
{
  for (std::size_t f = 0; f < mesh.face_patch.size(); ++f) {
    const LocalIndex* corners = &mesh.face_vertices[3 * f];
    faces_.push_back(
        {mesh::sorted_triangle(corners[0], corners[1], corners[2]), mesh.face_patch[f]});
    for (std::size_t c = 0; c < 3; ++c) {
      has_vertex_[at(corners[c])] = 1;
      edges_.push_back(edge_key(corners[c], corners[(c + 1) % 3]));
    }
  }
  for (LocalIndex s = 0; s < mesh.num_segments(); ++s) {
    const LocalIndex* ends = &mesh.segment_vertices[2 * at(s)];
    for (std::size_t end = 0; end < 2; ++end) has_vertex_[at(ends[end])] = 1;
    edges_.push_back(edge_key(ends[0], ends[1]));
  }
  std::ranges::sort(faces_);
  std::ranges::sort(edges_);
}

bool Geometry::has_edge(LocalIndex a, LocalIndex b) const
{
  return std::ranges::binary_search(edges_, edge_key(a, b));
}

LocalIndex Geometry::patch_of(LocalIndex a, LocalIndex b, LocalIndex c) const
{
  if (!has_vertex(a) || !has_vertex(b) || !has_vertex(c)) return kNoIndex;
  const Face wanted{mesh::sorted_triangle(a, b, c), kNoIndex};
  const auto found = std::ranges::lower_bound(faces_, wanted);
  return found != faces_.end() && found->vertices == wanted.vertices ? found->patch : kNoIndex;
}

bool Geometry::has_two_faces_on_a_patch(const Tet& tet) const
{
  std::array<LocalIndex, 4> patches{};
  for (std::size_t c = 0; c < 4; ++c) {
    const auto& [i, j, k] = mesh::kTetFaceCorners[c];
    patches[c] = patch_of(tet[i], tet[j], tet[k]);
    const auto before = std::span(patches).first(c);
    if (patches[c] != kNoIndex && std::ranges::find(before, patches[c]) != before.end())
      return true;
  }
  return false;
}

LocalIndex flip_tets(mesh::CoarseMesh& mesh, const Geometry& geometry)
{
  return Flipper(mesh, geometry).run();
}

}  // namespace tessera::coarse
