// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/surface/surface_messages.hpp"

#include <cstdio>

#include <fmt/format.h>

namespace tessera::netgen {
namespace {

// NETGEN makes up to 19 of them. Triangulations that it could mesh needed none.
constexpr int kMostRefinements = 2;

bool has(const std::string& line, std::string_view words)
{
  return line.find(words) != std::string::npos;
}

}  // namespace

// "Face 3 / 79 (…)" begins a face of a CAD file. If it fails twice NETGEN says "Problem in Surface
// mesh generation", goes on with all other faces, and gives up after the last one.
// "faces = F trials = T elements = E" comes after every thousand trials on one face.
// "N open segments found" is said of triangulations (STL): sides where a triangle is missing.
// NETGEN then takes triangles away around them, and at last refines there, again and again.
bool SurfaceMessages::read(const std::string& line)
{
  int number = 0;
  int count = 0;
  long trials = 0;
  long elements = 0;
  if (std::sscanf(line.c_str(), " Face %d / %d", &number, &count) == 2) {
    face_ = fmt::format("face {} of {}", number, count);
    return true;
  }
  if (std::sscanf(line.c_str(), " faces = %d trials = %ld elements = %ld", &number, &trials,
                  &elements)
      == 3) {
    const bool is_new = elements != last_elements_ && !is_repairing_;
    last_elements_ = elements;
    return is_new;
  }
  if (std::sscanf(line.c_str(), " %d open segments", &number) == 1 && has(line, "found")) {
    return read_open_segments(number);
  }
  if (has(line, "trying to refine")) read_refinement();
  if (has(line, "Problem in Surface mesh generation") && !face_.empty() && verdict_.empty()) {
    verdict_ = "NETGEN cannot mesh " + face_;
  }
  return !is_repairing_ && !has(line, "WARNING") && !has(line, "ERROR");
}

bool SurfaceMessages::read_open_segments(long count)
{
  // The first count is of a surface without triangles.
  const bool is_first = last_elements_ < 0 && fewest_open_ == std::numeric_limits<long>::max();
  if (count >= fewest_open_) return false;
  fewest_open_ = count;
  refinements_without_ = 0;
  is_repairing_ = !is_first && count > 0;
  return true;
}

void SurfaceMessages::read_refinement()
{
  is_repairing_ = true;
  if (++refinements_without_ != kMostRefinements) return;
  verdict_ =
      fmt::format("NETGEN's surface keeps gaps, at least {} sides of triangles, in {} rounds",
                  fewest_open_, refinements_without_);
}

}  // namespace tessera::netgen
