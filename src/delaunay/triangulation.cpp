// SPDX-License-Identifier: BSD-3-Clause
#include "delaunay/triangulation.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/delaunay/predicates.hpp"

namespace tessera::delaunay {
namespace {

constexpr std::size_t kMostTets = (1U << 29) - 1;  // So that corners are numbers.

constexpr LocalIndex kInfinity = -1;  // The vertex of ghosts.
constexpr LocalIndex kNoTet = -2;     // First vertex of a free slot.

// What a test by a vertex has found.
constexpr LocalIndex destroyed_by(LocalIndex vertex) { return 2 * vertex + 1; }
constexpr LocalIndex kept_by(LocalIndex vertex) { return 2 * vertex; }
constexpr LocalIndex kUntested = -1;

// The vertices of a face, ascending.
std::array<LocalIndex, 3> face_key(const std::array<LocalIndex, 4>& tet, std::size_t corner)
{
  std::array<LocalIndex, 3> key{tet[corner ^ 1], tet[corner ^ 2], tet[corner ^ 3]};
  std::ranges::sort(key);
  return key;
}

}  // namespace

Triangulation::Triangulation(std::vector<Vec3> points) : points_(std::move(points))
{
  constexpr std::size_t kTetsAPoint = 7;  // Random points have 6.8.
  tets_.reserve(kTetsAPoint * points_.size());
  tet_tested_.reserve(kTetsAPoint * points_.size());
  add_first_tets(first_tet());
}

std::array<LocalIndex, 4> Triangulation::first_tet() const
{
  const auto size = static_cast<LocalIndex>(points_.size());
  LocalIndex c = 2;
  while (c < size && are_collinear(points_[0], points_[1], points_[at(c)])) ++c;
  for (LocalIndex d = c + 1; d < size; ++d) {
    const int side = orient3d(points_[0], points_[1], points_[at(c)], points_[at(d)]);
    if (side > 0) return {0, 1, c, d};
    if (side < 0) return {1, 0, c, d};
  }
  throw MeshError(fmt::format("no tets: all {} points lie on one plane", size));
}

// The tet, and the ghosts at its faces.
void Triangulation::add_first_tets(const std::array<LocalIndex, 4>& first)
{
  add_tet(first);
  for (std::size_t c = 0; c < 4; ++c) {
    std::array<LocalIndex, 4> ghost = first;
    ghost[c] = kInfinity;
    std::swap(ghost[(c + 1) % 4], ghost[(c + 2) % 4]);  // It lies on the other side of the face.
    add_tet(ghost);
  }
  for (Corner a = 0; a < 20; ++a) {
    for (Corner b = 0; b < a; ++b) {
      const auto key = [&](Corner corner) {
        return face_key(tets_[at(tet_of(corner))].vertices, at(corner & 3));
      };
      if (key(a) == key(b)) link(a, b);
    }
  }
}

LocalIndex Triangulation::add_tet(const std::array<LocalIndex, 4>& vertices)
{
  if (free_slots_.empty()) {
    if (tet_tested_.size() == kMostTets) throw MeshError("there would be 2^29 tets or more");
    tets_.push_back({vertices});
    tet_tested_.push_back(kUntested);
    return num_slots() - 1;
  }
  const LocalIndex slot = free_slots_.back();
  free_slots_.pop_back();
  tets_[at(slot)] = {vertices};
  tet_tested_[at(slot)] = kUntested;
  return slot;
}

void Triangulation::link(Corner a, Corner b)
{
  across(a) = b;
  across(b) = a;
}

bool Triangulation::is_ghost(LocalIndex tet) const { return place_of(kInfinity, tet) != kNoIndex; }

bool Triangulation::has_tet(LocalIndex slot) const
{
  return vertices(slot)[0] != kNoTet && !is_ghost(slot);
}

// The orientation of a tet with the point in the place of a corner: where the point lies as seen
// from the face opposite to it. @pre No other corner is at infinity.
int Triangulation::side_with(const Vec3& point, Corner corner) const
{
  std::array<const Vec3*, 4> p{};
  const auto tet = vertices(tet_of(corner));
  for (std::size_t c = 0; c < 4; ++c) {
    p[c] = c == at(corner & 3) ? &point : &points_[at(tet[c])];
  }
  return orient3d(*p[0], *p[1], *p[2], *p[3]);
}

bool Triangulation::is_in_sphere(LocalIndex tet, const Vec3& point) const
{
  const auto v = vertices(tet);
  return insphere_untied(points_[at(v[0])], points_[at(v[1])], points_[at(v[2])], points_[at(v[3])],
                         point)
         > 0;
}

// The sphere of a ghost is the half-space beyond its face, and on the plane of the face the circle
// through its corners. The sphere of the tet that has the face cuts the plane in that circle.
bool Triangulation::is_destroyed_by(const Vec3& point, LocalIndex tet) const
{
  const LocalIndex place = place_of(kInfinity, tet);
  if (place == kNoIndex) return is_in_sphere(tet, point);
  const Corner infinity = 4 * tet + place;
  const int side = side_with(point, infinity);
  return side > 0 || (side == 0 && is_in_sphere(tet_of(across(infinity)), point));
}

// The corner that a vertex is of a tet; kNoIndex if of none.
LocalIndex Triangulation::place_of(LocalIndex vertex, LocalIndex tet) const
{
  const auto v = vertices(tet);
  for (LocalIndex place = 0; place < 4; ++place) {
    if (v[at(place)] == vertex) return place;
  }
  return kNoIndex;
}

void Triangulation::insert_all()
{
  const std::array<LocalIndex, 4> first{vertices(0)[0], vertices(0)[1], vertices(0)[2],
                                        vertices(0)[3]};
  for (LocalIndex v = 0; at(v) < points_.size(); ++v) {
    if (std::ranges::find(first, v) == first.end()) insert(v);
  }
}

void Triangulation::insert(LocalIndex vertex)
{
  find_cavity(find_destroyed(points_[at(vertex)]), vertex);
  fill_cavity(vertex);
}

// Walks towards the point, from tet to tet through faces that it lies beyond, to the tet that holds
// it or a ghost that sees it. Delaunay tets are never seen twice on such a walk.
// @cite edelsbrunner1990
LocalIndex Triangulation::find_destroyed(const Vec3& point) const
{
  LocalIndex tet = last_;
  Corner entry = kNoIndex;
  while (true) {
    Corner exit = 4 * tet;
    while (tet_of(exit) == tet && (exit == entry || side_with(point, exit) >= 0)) ++exit;
    if (tet_of(exit) != tet) return tet;
    entry = across(exit);
    tet = tet_of(entry);
    if (is_ghost(tet)) return tet;
  }
}

// The tets whose spheres hold the vertex; they hang together.
void Triangulation::find_cavity(LocalIndex first, LocalIndex vertex)
{
  cavity_.assign(1, first);
  cavity_boundary_.clear();
  tet_tested_[at(first)] = destroyed_by(vertex);
  const Vec3 point = points_[at(vertex)];
  for (std::size_t i = 0; i < cavity_.size(); ++i) {
    for (Corner corner = 4 * cavity_[i]; tet_of(corner) == cavity_[i]; ++corner) {
      const LocalIndex tet = tet_of(across(corner));
      LocalIndex& tested = tet_tested_[at(tet)];
      if (tested < kept_by(vertex)) {
        const bool is_destroyed = is_destroyed_by(point, tet);
        tested = is_destroyed ? destroyed_by(vertex) : kept_by(vertex);
        if (is_destroyed) cavity_.push_back(tet);
      }
      if (tested == kept_by(vertex)) cavity_boundary_.push_back(corner);
    }
  }
}

// Connects the vertex to the faces of the cavity. A new tet is the old one at the face with the
// vertex in the place of the corner that goes, so it looks the same way.
void Triangulation::fill_cavity(LocalIndex vertex)
{
  for (Corner& corner : cavity_boundary_) {
    const auto v = vertices(tet_of(corner));
    std::array<LocalIndex, 4> made{v[0], v[1], v[2], v[3]};
    made[at(corner & 3)] = vertex;
    const Corner outside = across(corner);
    const LocalIndex tet = add_tet(made);
    // The old tet still knows what lies across: that is how sides are found.
    link(4 * tet + (corner & 3), outside);
    across(corner) = outside;
  }
  for (const Corner face : cavity_boundary_) {
    const LocalIndex tet = tet_of(across(across(face)));
    for (LocalIndex side = 0; side < 4; ++side) {
      if (across(4 * tet + side) == kNoIndex) link(4 * tet + side, across_side(face, side));
    }
    if (!is_ghost(tet)) last_ = tet;
  }
  for (const LocalIndex tet : cavity_) tets_[at(tet)].vertices[0] = kNoTet;
  free_slots_.insert(free_slots_.end(), cavity_.begin(), cavity_.end());
}

// What lies across a side of the new tet at a face of the cavity: the new tet at the next face
// around their common edge, which is found by going through the old tets around it.
Corner Triangulation::across_side(Corner face, LocalIndex side) const
{
  LocalIndex tet = tet_of(face);
  LocalIndex behind =
      vertices(tet)[at(face & 3)];  // Of the face that is gone through, off the edge.
  Corner exit = 4 * tet + side;
  while (true) {
    const Corner entry = across(exit);
    if (across(entry) != exit) {
      // The face is of the cavity, and what is outside knows the new tet already.
      return (across(entry) & ~3) + place_of(behind, tet_of(exit));
    }
    tet = tet_of(entry);
    exit = 4 * tet + place_of(behind, tet);
    behind = vertices(tet)[at(entry & 3)];
  }
}

}  // namespace tessera::delaunay
