// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stages/coarse/coarse_budget.hpp"

#include <algorithm>

#include "tessera/surface/coarse_surface.hpp"

namespace tessera::pipeline {
namespace {

// With these, a model of up to a thousand faces and no fine size has its verdict within three
// minutes on two ranks, even if every try hangs: they are made side by side.
constexpr double kFirst_s = 60.0;
constexpr double kLater_s = 40.0;
constexpr double kWholeOrDomain_s = 60.0;

constexpr double kMargin = 10.0;

// Seconds of CPU time. Measured: NETGEN takes 16 ms a face and 50 us a triangle of frame.step (375
// faces), 18 ms a face of Bottom.brep.
constexpr double kSecondsPerFace = 0.012;
constexpr double kSecondsPerFaceOfOthers = 0.002;
constexpr double kSecondsPerTriangle = 0.0005;
constexpr double kSecondsPerFileTriangle = 0.0002;
constexpr double kTetsPerSecond = 5000.0;

constexpr double kStall_s = 120.0;
constexpr double kMemory_gib = 16.0;
constexpr double kLeastIdle_s = 20.0;

double budget_s(const surface::CoarseOptions& options, double least_s, double expected_s)
{
  return options.timeout_s > 0.0 ? options.timeout_s : std::max(least_s, kMargin * expected_s);
}

// Triangles with edges of the largest size, half as many more where they must be smaller.
double expected_triangles(double area, double size)
{
  constexpr double kTrianglesPerSquare = 2.31;
  return 1.5 * kTrianglesPerSquare * area / (size * size);
}

}  // namespace

jobs::JobLimits surface_limits(const surface::CoarseOptions& options,
                               const coarse::ModelFigures& model, bool is_first)
{
  const bool is_netgen = options.mesher == surface::Mesher::netgen
                         && options.surface_mesher == surface::SurfaceMesher::netgen;
  const double expected_s =
      (is_netgen ? kSecondsPerFace : kSecondsPerFaceOfOthers) * model.num_faces
      + kSecondsPerTriangle * expected_triangles(model.area, options.max_size)
      + kSecondsPerFileTriangle * model.num_triangles;
  const double cpu_s = budget_s(options, is_first ? kFirst_s : kLater_s, expected_s);
  return {.cpu_s = cpu_s,
          .stall_s = kStall_s,
          .memory_gib = kMemory_gib,
          .idle_cpu_s = is_netgen ? std::max(kLeastIdle_s, cpu_s / 3.0) : 0.0};
}

jobs::JobLimits domain_limits(const surface::CoarseOptions& options,
                              const surface::DomainSkin& skin)
{
  const double expected_s = surface::predicted_tets(skin) / kTetsPerSecond;
  return {.cpu_s = budget_s(options, kWholeOrDomain_s, expected_s),
          .stall_s = kStall_s,
          .memory_gib = kMemory_gib};
}

jobs::JobLimits whole_limits(const surface::CoarseOptions& options, double num_tets)
{
  const double expected_s = num_tets / kTetsPerSecond;
  return {.cpu_s = budget_s(options, kWholeOrDomain_s, expected_s),
          .stall_s = kStall_s,
          .memory_gib = kMemory_gib};
}

}  // namespace tessera::pipeline
