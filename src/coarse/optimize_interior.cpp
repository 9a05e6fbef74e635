// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/optimize_interior.hpp"

#include <algorithm>
#include <array>

#include "tessera/base/index_lists.hpp"
#include "tessera/base/tet.hpp"

#include "coarse/child_energy.hpp"
#include "coarse/flip_tets.hpp"

namespace tessera::coarse {
namespace {

constexpr int kRounds = 6;
constexpr int kSweepsOfARound = 4;

// Of a step, in mean distances to the corners around.
constexpr double kLongestStep = 0.1;
constexpr double kShortestStep = 0.003;
constexpr double kDifference = 1e-4;  // For the gradient.
constexpr double kLeastGain = 1e-6;   // Relative; less is rounding.

class Smoother {
 public:
  Smoother(mesh::CoarseMesh& mesh, const Geometry& geometry)
      : mesh_(mesh),
        geometry_(geometry),
        stars_(rows_by_key(mesh.tet_vertices, mesh.num_vertices(), 4))
  {
  }

  LocalIndex sweep()
  {
    LocalIndex moves = 0;
    for (LocalIndex v = 0; v < mesh_.num_vertices(); ++v) {
      if (geometry_.has_vertex(v) || stars_[v].empty()) continue;
      moves += move(v) ? 1 : 0;
    }
    return moves;
  }

 private:
  [[nodiscard]] double energy_around(LocalIndex v) const
  {
    double sum = 0.0;
    for (const LocalIndex t : stars_[v]) sum += child_energy(corners_of(t));
    return sum;
  }

  [[nodiscard]] std::array<Vec3, 4> corners_of(LocalIndex t) const
  {
    return corners_at<4>(mesh_.vertex_xyz, mesh_.tet_vertices, t);
  }

  [[nodiscard]] double mean_distance(LocalIndex v) const
  {
    double sum = 0.0;
    for (const LocalIndex t : stars_[v]) {
      for (const Vec3& corner : corners_of(t)) sum += norm(corner - mesh_.position(v));
    }
    return sum / (3.0 * static_cast<double>(stars_[v].size()));
  }

  void place(LocalIndex v, const Vec3& point)
  {
    std::ranges::copy(point, &mesh_.vertex_xyz[3 * at(v)]);
  }

  // Downhill; of some length only.
  [[nodiscard]] Vec3 descent(LocalIndex v, double difference)
  {
    const Vec3 here = mesh_.position(v);
    Vec3 direction{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Vec3 point = here;
      point[axis] = here[axis] - difference;
      place(v, point);
      direction[axis] = energy_around(v);
      point[axis] = here[axis] + difference;
      place(v, point);
      direction[axis] -= energy_around(v);
    }
    place(v, here);
    return direction;
  }

  bool move(LocalIndex v)
  {
    const Vec3 here = mesh_.position(v);
    const double before = energy_around(v);
    const double distance = mean_distance(v);
    const Vec3 direction = descent(v, kDifference * distance);
    const double length = norm(direction);
    if (!(length > 0.0) || length == kNoTet) return false;
    for (double step = kLongestStep; step >= kShortestStep; step *= 0.5) {
      place(v, here + (step * distance / length) * direction);
      if (energy_around(v) < (1.0 - kLeastGain) * before) return true;
    }
    place(v, here);
    return false;
  }

  mesh::CoarseMesh& mesh_;
  const Geometry& geometry_;
  IndexLists stars_;
};

}  // namespace

InteriorStatistics optimize_interior(mesh::CoarseMesh& mesh)
{
  const Geometry geometry(mesh);
  InteriorStatistics done;
  for (int round = 0; round < kRounds; ++round) {
    done.num_flips += flip_tets(mesh, geometry);
    Smoother smoother(mesh, geometry);
    for (int sweep = 0; sweep < kSweepsOfARound; ++sweep) done.num_moves += smoother.sweep();
  }
  return done;
}

}  // namespace tessera::coarse
