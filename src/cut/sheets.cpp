// SPDX-License-Identifier: BSD-3-Clause
#include "cut/sheets.hpp"

#include <cmath>
#include <iterator>

#include "tessera/base/sort_unique.hpp"
#include "tessera/base/union_find.hpp"

namespace tessera::cut {
namespace {

// Connected triangles with the same solids on their two sides.
struct Sheet {
  std::vector<LocalIndex> solids{};  // It may bound these, from 0.
  TriangleSolids bounds{kNoIndex, kNoIndex};
  Vec3 area{};          // Sum of area times normal.
  double size = 0.0;    // Sum of areas.
  double volume = 0.0;  // Of the cone from the reference point.
};

class Sheets {
 public:
  Sheets(const WeldedModel& welded, const model::ModelDescription& model)
      : welded_(welded), model_(model), sheet_of_(welded.triangles.size(), kNoIndex)
  {
  }

  std::vector<TriangleSolids> run()
  {
    connect();
    measure();
    for (Sheet& sheet : sheets_) {
      if (!sheet.solids.empty()) sheet.bounds = choices(sheet).front();
    }
    improve();
    std::vector<TriangleSolids> result;
    for (const LocalIndex sheet : sheet_of_) result.push_back(sheets_[at(sheet)].bounds);
    return result;
  }

 private:
  void connect()
  {
    UnionFind connected(static_cast<LocalIndex>(welded_.triangles.size()));
    for_each_edge_group(sorted_edges(welded_.triangles), [&](std::span<const TriangleEdge> edge) {
      if (edge.size() == 2) connected.join(edge[0].triangle, edge[1].triangle);
    });
    for (LocalIndex t = 0; t < static_cast<LocalIndex>(sheet_of_.size()); ++t) {
      const LocalIndex first = connected.find(t);
      if (first == t) {
        sheet_of_[at(t)] = static_cast<LocalIndex>(sheets_.size());
        sheets_.push_back({.solids = solids_of_face(t)});
      } else {
        sheet_of_[at(t)] = sheet_of_[at(first)];
      }
    }
  }

  [[nodiscard]] std::vector<LocalIndex> solids_of_face(LocalIndex triangle) const
  {
    std::vector<LocalIndex> solids = model_.faces[at(welded_.triangles[at(triangle)].face)].solids;
    for (LocalIndex& solid : solids) --solid;
    sort_unique(solids);
    return solids;
  }

  void measure()
  {
    const Vec3 reference = welded_.points.front();
    for (LocalIndex t = 0; t < static_cast<LocalIndex>(sheet_of_.size()); ++t) {
      Sheet& sheet = sheets_[at(sheet_of_[at(t)])];
      std::vector<LocalIndex> both;
      std::ranges::set_intersection(sheet.solids, solids_of_face(t), std::back_inserter(both));
      sheet.solids = both;
      const auto& [a, b, c] = welded_.triangles[at(t)].vertices;
      const Vec3 p = welded_.points[at(a)];
      const Vec3 area = 0.5 * cross(welded_.points[at(b)] - p, welded_.points[at(c)] - p);
      sheet.area = sheet.area + area;
      sheet.size += norm(area);
      sheet.volume += dot(area, p - reference) / 3.0;
    }
  }

  // The pairs first: it is rare that a face bounds two solids, and never at the same place.
  static std::vector<TriangleSolids> choices(const Sheet& sheet)
  {
    std::vector<TriangleSolids> result;
    for (std::size_t i = 0; i < sheet.solids.size(); ++i) {
      for (std::size_t j = i + 1; j < sheet.solids.size(); ++j) {
        result.push_back({sheet.solids[i], sheet.solids[j]});
      }
    }
    for (const LocalIndex solid : sheet.solids) result.push_back({solid, kNoIndex});
    return result;
  }

  // How far the surfaces are from closed ones of the described volumes.
  [[nodiscard]] double error() const
  {
    struct Sum {
      Vec3 area{};
      double size = 0.0;
      double volume = 0.0;
    };
    std::vector<Sum> sums(model_.solids.size());
    for (const Sheet& sheet : sheets_) {
      for (std::size_t side = 0; side < 2; ++side) {
        if (sheet.bounds[side] == kNoIndex) continue;
        Sum& sum = sums[at(sheet.bounds[side])];
        const double sign = side == 0 ? 1.0 : -1.0;
        sum.area = sum.area + sign * sheet.area;
        sum.size += sheet.size;
        sum.volume += sign * sheet.volume;
      }
    }
    double total = 0.0;
    for (std::size_t s = 0; s < sums.size(); ++s) {
      const double wanted = model_.solids[s].volume;
      total += sums[s].size > 0.0 ? norm(sums[s].area) / sums[s].size : 1.0;
      total += wanted > 0.0 ? std::abs(sums[s].volume / wanted - 1.0) : 0.0;
    }
    return total;
  }

  // Takes the best choice for each sheet, one after the other, until none becomes better.
  void improve()
  {
    constexpr int kMaxRounds = 20;
    double best = error();
    bool is_better = true;
    for (int round = 0; is_better && round < kMaxRounds; ++round) {
      is_better = false;
      for (Sheet& sheet : sheets_) {
        if (sheet.solids.size() > 1) is_better |= improve(sheet, best);
      }
    }
  }

  bool improve(Sheet& sheet, double& best)
  {
    TriangleSolids taken = sheet.bounds;
    bool is_better = false;
    for (const TriangleSolids& choice : choices(sheet)) {
      sheet.bounds = choice;
      const double now = error();
      if (now >= best - 1e-9) continue;
      best = now;
      taken = choice;
      is_better = true;
    }
    sheet.bounds = taken;
    return is_better;
  }

  const WeldedModel& welded_;
  const model::ModelDescription& model_;
  std::vector<LocalIndex> sheet_of_;
  std::vector<Sheet> sheets_{};
};

}  // namespace

std::vector<TriangleSolids> solids_of_triangles(const WeldedModel& welded,
                                                const model::ModelDescription& model)
{
  return Sheets(welded, model).run();
}

}  // namespace tessera::cut
