// SPDX-License-Identifier: BSD-3-Clause
#include "formats/writers/msh_periodic.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tessera/mesh/periodic_pairs.hpp"

#include "formats/writers/msh_sections.hpp"

namespace tessera::formats {

std::array<double, 16> msh_matrix(const Affine& there)
{
  std::array<double, 16> matrix{};
  std::ranges::copy(mesh::matrix_of(there), matrix.begin());
  matrix[15] = 1.0;
  return matrix;
}

std::string msh4_periodic_head(const Outline& outline, std::size_t row)
{
  const PeriodicPatch& patch = outline.periodic[row];
  const std::array<double, 16> matrix = msh_matrix(patch.there);
  MshBytes bytes;
  if (row == 0) bytes.add("$Periodic\n").add(static_cast<GlobalIndex>(outline.periodic.size()));
  bytes.add(kMshSurface);
  bytes.add(msh_tag(outline, Shape::triangle, patch.to));
  bytes.add(msh_tag(outline, Shape::triangle, patch.from));
  bytes.add(static_cast<GlobalIndex>(matrix.size())).add(bytes_of(matrix));
  return bytes.add(patch.first_point.back()).text();
}

std::string msh2_periodic_head(const Outline& outline, std::size_t row)
{
  const PeriodicPatch& patch = outline.periodic[row];
  const std::string head = fmt::format("$Periodic\n{}\n", outline.periodic.size());
  return fmt::format("{}{} {} {}\nAffine {}\n{}\n", row == 0 ? head : "", kMshSurface,
                     msh_tag(outline, Shape::triangle, patch.to),
                     msh_tag(outline, Shape::triangle, patch.from),
                     fmt::join(msh_matrix(patch.there), " "), patch.first_point.back());
}

}  // namespace tessera::formats
