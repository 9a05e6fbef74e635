// SPDX-License-Identifier: BSD-3-Clause
#include "surface/wrap/corners.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "tessera/base/box_tree.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/mesh/half_edges.hpp"
#include "tessera/surface/overlap.hpp"

namespace tessera::surface {
namespace {

using Square = LatticeBoundary::Square;
using Matrix = std::array<Vec3, 3>;

// Of the cell, around its middle: an edge of the file may pass just beside the cell that it belongs
// to.
constexpr double kReach = 0.75;

// Twice the area of a triangle that is one, of the spacing squared. An edge of the file between two
// faces with 10 degrees between them may be so sharp as neighbours may be to each other.
constexpr double kLeastArea = 1e-3;
constexpr double kLeastCosine = -0.985;

// Between a corner and a triangle, of the spacing: one that has a corner beside it, and one of
// another sheet. Bodies that meet along an edge are held together by what is as thick as that.
constexpr double kLeastGap = 0.02;
constexpr double kLeastGapOfSheets = 0.3;

// A plane that a corner should lie on; without a normal, a place.
struct Sample {
  Vec3 place{};
  Vec3 normal{};
  Vec3 on_edge{};  // Of the lattice.
};

// Where the edge of a square goes through the file: along the planes of the nearest triangles.
Sample sample_of(const Square& square, double spacing, const FileTriangles& file)
{
  constexpr int kSteps = 3;
  const Vec3 along = square.outside - square.inside;
  double t = 0.5;
  model::NearestPoint nearest;
  Vec3 normal{};
  for (int step = 0; step < kSteps; ++step) {
    nearest = file.search.nearest(square.inside + t * along);
    normal = unit_normal_of(file.triangles[at(nearest.simplex)]);
    const double slope = dot(normal, along);
    if (std::abs(slope) < 0.1 * spacing) break;
    t = std::clamp(dot(normal, nearest.xyz - square.inside) / slope, 0.0, 1.0);
  }
  const Vec3 place = square.inside + t * along;
  nearest = file.search.nearest(place);
  if (nearest.simplex != kNoIndex && norm(nearest.xyz - place) <= 0.5 * spacing)
    return {nearest.xyz, unit_normal_of(file.triangles[at(nearest.simplex)]), place};
  const Vec3 between = square.inside + square.share * along;
  return {between, {}, between};
}

Vec3 times(const Matrix& m, const Vec3& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

// Of a symmetric positive definite one.
Matrix inverse(const Matrix& m)
{
  const Matrix columns{cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
  const double factor = 1.0 / dot(m[0], columns[0]);
  return {factor * columns[0], factor * columns[1], factor * columns[2]};
}

Vec3 mean_of(const std::vector<Sample>& samples)
{
  Vec3 sum{};
  for (const Sample& sample : samples) sum = sum + sample.on_edge;
  return (1.0 / static_cast<double>(samples.size())) * sum;
}

// The point that is nearest to all planes; of such points one near `point`.
Vec3 meeting_point(const std::vector<Sample>& samples, Vec3 point)
{
  constexpr double kHold = 0.05;  // Draws to the point before; small beside the planes' 1.
  constexpr int kRounds = 10;
  Matrix sum{Vec3{kHold, 0.0, 0.0}, Vec3{0.0, kHold, 0.0}, Vec3{0.0, 0.0, kHold}};
  for (const Sample& sample : samples) {
    for (std::size_t row = 0; row < 3; ++row)
      sum[row] = sum[row] + sample.normal[row] * sample.normal;
  }
  const Matrix inverted = inverse(sum);
  for (int round = 0; round < kRounds; ++round) {
    Vec3 pull{};
    for (const Sample& sample : samples)
      pull = pull + dot(sample.normal, sample.place - point) * sample.normal;
    point = point + times(inverted, pull);
  }
  return point;
}

// Where planes are nearly one, noise of the file says where they meet.
bool is_bent(const std::vector<Sample>& samples)
{
  constexpr double kFlat = 0.94;  // Cosine of 20 degrees.
  for (const Sample& a : samples) {
    for (const Sample& b : samples) {
      if (norm(a.normal) > 0.0 && norm(b.normal) > 0.0 && dot(a.normal, b.normal) < kFlat)
        return true;
    }
  }
  return false;
}

Vec3 within(Vec3 point, const Vec3& middle, double reach)
{
  for (std::size_t a = 0; a < 3; ++a)
    point[a] = std::clamp(point[a], middle[a] - reach, middle[a] + reach);
  return point;
}

// The nearest point of the file if it is as near as that.
Vec3 near_file(const Vec3& point, double most, const FileTriangles& file)
{
  const Vec3 nearest = file.search.nearest(point).xyz;
  return norm(nearest - point) <= most ? nearest : point;
}

// Draws corners back until nothing is wrong.
class SoundTriangles {
 public:
  SoundTriangles(const LatticeBoundary& boundary, double spacing,
                 const std::vector<CornerPlaces>& places, const FileTriangles& file)
      : boundary_(boundary),
        spacing_(spacing),
        places_(places),
        file_(file),
        step_(places.size()),
        has_moved_(places.size(), 1),
        first_(boundary.squares.size())
  {
    for (const CornerPlaces& place : places) surface_.vertex_xyz.push_back(place.sharp);
  }

  PatchSurface make()
  {
    do {
      is_bad_.assign(places_.size(), 0);
      split_squares();
      find_touches();
      find_folds();
      find_cuts();
    } while (draw_back());
    surface_.triangle_patch.assign(surface_.triangles.size(), 0);
    surface_.vertex_is_fixed.assign(surface_.vertex_xyz.size(), 0);
    surface_.patch_materials = {{1, 0}};
    return std::move(surface_);
  }

 private:
  [[nodiscard]] const Vec3& place(LocalIndex cell) const { return surface_.vertex_xyz[at(cell)]; }

  [[nodiscard]] Vec3 normal_of(const PatchSurface::Triangle& v) const
  {
    return tessera::normal_of({place(v[0]), place(v[1]), place(v[2])});
  }

  [[nodiscard]] bool is_flat(const PatchSurface::Triangle& v) const
  {
    return norm(normal_of(v)) <= kLeastArea * spacing_ * spacing_;
  }

  [[nodiscard]] bool are_folded(const PatchSurface::Triangle& a,
                                const PatchSurface::Triangle& b) const
  {
    return dot(unit(normal_of(a)), unit(normal_of(b))) < kLeastCosine;
  }

  static std::array<PatchSurface::Triangle, 2> halves_of(const Square& square, std::size_t first)
  {
    const auto& v = square.cells;
    return {PatchSurface::Triangle{v[first], v[first + 1], v[first + 2]},
            PatchSurface::Triangle{v[first], v[first + 2], v[(first + 3) % 4]}};
  }

  [[nodiscard]] bool is_sound(const std::array<PatchSurface::Triangle, 2>& halves) const
  {
    return !is_flat(halves[0]) && !is_flat(halves[1]) && !are_folded(halves[0], halves[1]);
  }

  // Of the diagonal from that corner on: how far it is off the file. Along an edge of the file it
  // is on it.
  [[nodiscard]] double miss(const Square& square, std::size_t first) const
  {
    const Vec3& a = place(square.cells[first]);
    const Vec3& c = place(square.cells[first + 2]);
    return file_.distance(midpoint(a, c)) + 1e-3 * norm(c - a);
  }

  void split_squares()
  {
    surface_.triangles.clear();
    for (std::size_t s = 0; s < boundary_.squares.size(); ++s) {
      const Square& square = boundary_.squares[s];
      const bool has_moved = std::ranges::any_of(
          square.cells, [this](LocalIndex cell) { return has_moved_[at(cell)] != 0; });
      if (has_moved) first_[s] = better_diagonal(square);
      const auto halves = halves_of(square, first_[s]);
      if (!is_sound(halves)) blame(square.cells);
      surface_.triangles.insert(surface_.triangles.end(), halves.begin(), halves.end());
    }
  }

  // The corner that it begins at.
  [[nodiscard]] std::size_t better_diagonal(const Square& square) const
  {
    const std::array is_right{is_sound(halves_of(square, 0)), is_sound(halves_of(square, 1))};
    if (is_right[0] != is_right[1]) return is_right[0] ? 0 : 1;
    return miss(square, 1) < miss(square, 0) ? 1 : 0;
  }

  // Corners that nearly lie on a triangle that is not theirs: two sheets would touch there, or
  // triangles be needles.
  void find_touches()
  {
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < surface_.triangles.size(); ++t)
      boxes.push_back(box_of(surface_.corners(t)));
    const BoxTree tree(std::move(boxes));
    const std::vector<std::vector<LocalIndex>> neighbours = neighbours_of_corners();
    const double gap = kLeastGapOfSheets * spacing_;
    for (std::size_t cell = 0; cell < places_.size(); ++cell) {
      const Vec3& corner = surface_.vertex_xyz[cell];
      const Box around = Box{corner, corner}.widened(gap);
      tree.visit(
          [&](const Box& box) { return box.touches(around); },
          [&](LocalIndex t) { look_at_touch(static_cast<LocalIndex>(cell), t, neighbours[cell]); });
    }
  }

  [[nodiscard]] std::vector<std::vector<LocalIndex>> neighbours_of_corners() const
  {
    std::vector<std::vector<LocalIndex>> neighbours(places_.size());
    for (const auto& v : surface_.triangles) {
      for (std::size_t c = 0; c < 3; ++c) neighbours[at(v[c])].push_back(v[(c + 1) % 3]);
    }
    return neighbours;
  }

  void look_at_touch(LocalIndex cell, LocalIndex t, const std::vector<LocalIndex>& neighbours)
  {
    const PatchSurface::Triangle& v = surface_.triangles[at(t)];
    if (std::ranges::find(v, cell) != v.end()) return;
    const bool is_beside = std::ranges::find_first_of(v, neighbours) != v.end();
    const double gap = (is_beside ? kLeastGap : kLeastGapOfSheets) * spacing_;
    const Vec3 nearest = model::nearest_point_of(surface_.corners(at(t)), place(cell));
    if (norm(nearest - place(cell)) < gap) blame(std::array{cell, v[0], v[1], v[2]});
  }

  // Neighbours that lie on each other, whose edges do not cut.
  void find_folds()
  {
    std::vector<LocalIndex> vertices;
    for (const auto& v : surface_.triangles) vertices.insert(vertices.end(), v.begin(), v.end());
    const std::vector<LocalIndex> opposite =
        mesh::opposite_half_edges(mesh::half_edges_of_edges(vertices));
    for (std::size_t h = 0; h < opposite.size(); ++h) {
      const auto& a = surface_.triangles[h / 3];
      const auto& b = surface_.triangles[at(opposite[h] / 3)];
      if (h < at(opposite[h]) && are_folded(a, b)) blame_both(a, b);
    }
  }

  void find_cuts()
  {
    for (const Overlap& overlap : find_overlaps(surface_)) {
      blame_both(surface_.triangles[overlap.first], surface_.triangles[overlap.second]);
    }
  }

  void blame_both(const PatchSurface::Triangle& a, const PatchSurface::Triangle& b)
  {
    blame(std::array{a[0], a[1], a[2], b[0], b[1], b[2]});
  }

  // Marks the corners of what is wrong: those that are not in their own cells, if there are any.
  void blame(std::span<const LocalIndex> cells)
  {
    const auto is_outside = [&](LocalIndex cell) {
      const Vec3 off = place(cell) - places_[at(cell)].middle;
      return std::max({std::abs(off[0]), std::abs(off[1]), std::abs(off[2])}) > 0.5 * spacing_;
    };
    const bool has_outside = std::ranges::any_of(cells, is_outside);
    for (const LocalIndex cell : cells) {
      if (!has_outside || is_outside(cell)) is_bad_[at(cell)] = 1;
    }
  }

  // Whether any corner was moved.
  bool draw_back()
  {
    bool has_moved = false;
    has_moved_.assign(places_.size(), 0);
    for (std::size_t cell = 0; cell < step_.size(); ++cell) {
      const CornerPlaces& to = places_[cell];
      const std::array steps{to.sharp, to.smooth, to.mean, midpoint(to.mean, to.middle), to.middle};
      if (is_bad_[cell] == 0 || step_[cell] + 1 == steps.size()) continue;
      surface_.vertex_xyz[cell] = steps[++step_[cell]];
      has_moved = true;
      has_moved_[cell] = 1;
    }
    return has_moved;
  }

  const LatticeBoundary& boundary_;
  double spacing_;
  const std::vector<CornerPlaces>& places_;
  const FileTriangles& file_;
  std::vector<std::size_t> step_;  // Of each corner.
  std::vector<char> is_bad_{};
  std::vector<char> has_moved_;     // Since the squares were split last.
  std::vector<std::size_t> first_;  // Of each square: the corner that its diagonal begins at.
  PatchSurface surface_{};
};

}  // namespace

std::vector<CornerPlaces> corner_places(const LatticeBoundary& boundary, double spacing,
                                        const FileTriangles& file)
{
  std::vector<std::vector<Sample>> samples(boundary.cell_middles.size());
  for (const Square& square : boundary.squares) {
    const Sample sample = sample_of(square, spacing, file);
    for (const LocalIndex cell : square.cells) samples[at(cell)].push_back(sample);
  }
  std::vector<CornerPlaces> places;
  for (std::size_t cell = 0; cell < samples.size(); ++cell) {
    const Vec3& middle = boundary.cell_middles[cell];
    const Vec3 mean = mean_of(samples[cell]);
    CornerPlaces place{mean, mean, mean, middle};
    const bool is_on_file = std::ranges::any_of(
        samples[cell], [](const Sample& sample) { return norm(sample.normal) > 0.0; });
    if (is_on_file) place.sharp = place.smooth = near_file(mean, 0.5 * spacing, file);
    if (is_bent(samples[cell])) {
      place.sharp = near_file(within(meeting_point(samples[cell], mean), middle, kReach * spacing),
                              0.5 * spacing, file);
    }
    places.push_back(place);
  }
  return places;
}

PatchSurface sound_triangles(const LatticeBoundary& boundary, double spacing,
                             const std::vector<CornerPlaces>& places, const FileTriangles& file)
{
  return SoundTriangles(boundary, spacing, places, file).make();
}

}  // namespace tessera::surface
