// SPDX-License-Identifier: BSD-3-Clause
#include "surface/remesh/side_shift.hpp"

#include <cmath>
#include <vector>

#include "surface/model_curve.hpp"

namespace tessera::surface {
namespace {

// Each step of Newton's doubles the digits; the first has three from triangles.
constexpr int kSteps = 5;

// Below this part of what three directions give together, one of them is open: that is rounding, as
// a circle has 0.25 of it, and a rectangle of ten to one 0.08.
constexpr double kLeastDeterminant = 1e-9;

// A point of the one side, the curve that its image lies on, and the direction of that.
struct Sample {
  Vec3 point{};
  LocalIndex image_curve = kNoIndex;
  Vec3 direction{};
};

std::vector<Sample> samples_of(const SurfaceReference& reference, const model::Model& model,
                               std::span<const std::array<LocalIndex, 2>> curves)
{
  const PatchSurface& surface = reference.surface();
  std::vector<Sample> samples;
  for (const auto& [curve, image] : curves) {
    for (std::size_t e = 0; e < surface.edges.size(); ++e) {
      if (surface.edge_curve[e] != curve) continue;
      const Vec3& a = surface.vertex_xyz[at(surface.edges[e][0])];
      const Vec3& b = surface.vertex_xyz[at(surface.edges[e][1])];
      samples.push_back(
          {on_model_curve(reference, model, curve, midpoint(a, b)), image, unit(b - a)});
    }
  }
  return samples;
}

// What is asked of a step: that images lie on their curves, wherever along them.
struct Equations {
  std::array<Vec3, 3> rows{};
  Vec3 right{};
  double num_samples = 0.0;

  void add(const Vec3& direction, const Vec3& off)
  {
    for (std::size_t i = 0; i < 3; ++i) {
      rows[i] = rows[i] - direction[i] * direction;
      rows[i][i] += 1.0;
    }
    right = right + off;
    num_samples += 1.0;
  }

  [[nodiscard]] double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }

  [[nodiscard]] bool is_open() const
  {
    return determinant() <= kLeastDeterminant * std::pow(num_samples, 3);
  }

  [[nodiscard]] Vec3 solution() const
  {
    const Vec3 sum = right[0] * cross(rows[1], rows[2]) + right[1] * cross(rows[2], rows[0])
                     + right[2] * cross(rows[0], rows[1]);
    return (1.0 / determinant()) * sum;
  }
};

}  // namespace

Vec3 shift_by_curves(const SurfaceReference& reference, const model::Model& model,
                     std::span<const std::array<LocalIndex, 2>> curves, Vec3 shift)
{
  const std::vector<Sample> samples = samples_of(reference, model, curves);
  for (int step = 0; step < kSteps; ++step) {
    Equations equations;
    for (const Sample& sample : samples) {
      const Vec3 image = sample.point + shift;
      equations.add(sample.direction,
                    on_model_curve(reference, model, sample.image_curve, image) - image);
    }
    if (samples.empty() || equations.is_open()) break;
    shift = shift + equations.solution();
  }
  return shift;
}

}  // namespace tessera::surface
