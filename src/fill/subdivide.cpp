// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/fill/subdivide.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/mesh/lattice_numbering.hpp"
#include "tessera/mesh/tet_face_map.hpp"
#include "tessera/mesh/tet_lattice.hpp"
#include "tessera/mesh/tet_points.hpp"

namespace tessera::fill {
namespace {

namespace lattice = mesh::lattice;

GlobalIndex num_tets_of(const mesh::TetComplex& complex, LocalIndex n)
{
  return static_cast<GlobalIndex>(complex.tets.size()) * n * n * n;
}

void require_local(const mesh::TetComplex& complex, LocalIndex n)
{
  const GlobalIndex num_corners = 4 * num_tets_of(complex, n);
  if (num_corners > std::numeric_limits<LocalIndex>::max()) {
    throw MeshError(
        fmt::format("{} tets in one subdomain are too many for 32-bit indices; use more subdomains",
                    num_corners / 4));
  }
}

// Subdivides one coarse tet after the other; the arrays by lattice point are reused.
class Subdivider {
 public:
  Subdivider(const mesh::TetComplex& complex, const mesh::RefinedLattice& lattice)
      : complex_(complex),
        lattice_(lattice),
        n_(lattice.n),
        numbering_(complex.faces, lattice.n),
        number_(at(lattice::num_tet_points(lattice.n))),
        next_inner_(numbering_.num_points())
  {
    const auto num_tets = static_cast<LocalIndex>(complex.tets.size());
    const LocalIndex num_points = next_inner_ + num_tets * lattice::num_inner_tet_points(n_);
    result_.vertex_xyz.resize(3 * at(num_points));
    result_.tet_vertices.reserve(4 * static_cast<std::size_t>(num_tets_of(complex, n_)));
  }

  FillOutput run()
  {
    for (LocalIndex t = 0; t < static_cast<LocalIndex>(complex_.tets.size()); ++t) {
      number_points(t);
      const mesh::TetPoints points(complex_, lattice_, t);
      place_points(points);
      append_children(points.diagonal());
    }
    return std::move(result_);
  }

 private:
  // Inner points get the next numbers, in the order of tet_index().
  void number_points(LocalIndex tet)
  {
    std::fill(number_.begin(), number_.end(), kNoIndex);
    const mesh::TetFaceMap map(complex_, tet);
    for (std::size_t c = 0; c < 4; ++c) {
      for (LocalIndex j = 0; j <= n_; ++j) {
        for (LocalIndex i = 0; i + j <= n_; ++i) {
          const LocalIndex place = lattice::tet_index(n_, map.tet_point(n_, c, {i, j}));
          number_[at(place)] = numbering_.triangle_point(map.triangle(c), {i, j});
        }
      }
    }
    for (LocalIndex& number : number_) {
      if (number == kNoIndex) number = next_inner_++;
    }
  }

  // Points on faces are written once for each tet that has them, with the same bits.
  void place_points(const mesh::TetPoints& points)
  {
    for (std::size_t place = 0; place < number_.size(); ++place) {
      const Vec3& point = points.all()[place];
      std::copy(point.begin(), point.end(), &result_.vertex_xyz[3 * at(number_[place])]);
    }
  }

  void append_children(std::size_t diagonal)
  {
    const std::size_t first = result_.tet_vertices.size();
    result_.tet_vertices.resize(first + 4 * at(n_) * at(n_) * at(n_));
    LocalIndex* to = &result_.tet_vertices[first];
    lattice::for_each_child_index(n_, diagonal,
                                  [&](LocalIndex a, LocalIndex b, LocalIndex c, LocalIndex d) {
                                    to[0] = number_[at(a)];
                                    to[1] = number_[at(b)];
                                    to[2] = number_[at(c)];
                                    to[3] = number_[at(d)];
                                    to += 4;
                                  });
  }

  const mesh::TetComplex& complex_;
  const mesh::RefinedLattice& lattice_;
  LocalIndex n_;
  mesh::LatticeNumbering numbering_;
  std::vector<LocalIndex> number_;  ///< By tet_index(): vertex of the piece.
  LocalIndex next_inner_;
  FillOutput result_{};
};

}  // namespace

FillOutput subdivide(const mesh::TetComplex& complex, const mesh::RefinedLattice& lattice)
{
  require_local(complex, lattice.n);
  return Subdivider(complex, lattice).run();
}

SubdivisionCounts count_subdivision(const mesh::TetComplex& complex, LocalIndex n)
{
  const mesh::Complex& faces = complex.faces;
  const auto num_inside = [](const std::vector<LocalIndex>& skeleton) {
    return static_cast<GlobalIndex>(std::count(skeleton.begin(), skeleton.end(), kNoIndex));
  };
  return {.tets = num_tets_of(complex, n),
          .interior_vertices =
              num_inside(faces.vertex_skeleton)
              + num_inside(faces.edge_skeleton) * lattice::num_inner_edge_points(n)
              + num_inside(faces.triangle_skeleton) * lattice::num_inner_triangle_points(n)
              + static_cast<GlobalIndex>(complex.tets.size()) * lattice::num_inner_tet_points(n)};
}

}  // namespace tessera::fill
