// SPDX-License-Identifier: BSD-3-Clause
#include "sample_models.hpp"

#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace tessera::testing {
namespace {

constexpr std::size_t kSteps = 8;  // Of each side of a cell.

Vec3 at_height(const Point2& p, double z) { return {p[0], p[1], z}; }

// The border of a cell and that of its hole, with as many points, counter-clockwise.
struct Ring {
  std::vector<Point2> outer{};
  std::vector<Point2> inner{};
};

Ring ring_of(const Cell& cell, double x, double y)
{
  const std::array<Point2, 5> corners{
      {{0.0, 0.0}, {cell.side_x, 0.0}, {cell.side_x, cell.side_y}, {0.0, cell.side_y}, {0.0, 0.0}}};
  Ring ring;
  for (std::size_t i = 0; i < 4 * kSteps; ++i) {
    const Point2& a = corners[i / kSteps];
    const Point2& b = corners[i / kSteps + 1];
    const double share = static_cast<double>(i % kSteps) / kSteps;
    ring.outer.push_back({x + a[0] + share * (b[0] - a[0]), y + a[1] + share * (b[1] - a[1])});
    const double angle = (static_cast<double>(i) / (2.0 * kSteps) - 0.75) * std::numbers::pi;
    ring.inner.push_back({x + cell.hole[0] + cell.radius * std::cos(angle),
                          y + cell.hole[1] + cell.radius * std::sin(angle)});
  }
  return ring;
}

}  // namespace

LocalIndex ModelBuilder::add_face(std::vector<LocalIndex> solids)
{
  const auto row = static_cast<LocalIndex>(model_.faces.size());
  model_.faces.push_back({.number = row + 1, .solids = std::move(solids)});
  return row;
}

void ModelBuilder::add_triangle(LocalIndex face, const Vec3& a, const Vec3& b, const Vec3& c)
{
  for (const Vec3& p : {a, b, c}) {
    const auto [place, is_new] =
        points_.try_emplace({face, p}, static_cast<LocalIndex>(model_.vertex_xyz.size() / 3));
    if (is_new) model_.vertex_xyz.insert(model_.vertex_xyz.end(), p.begin(), p.end());
    model_.triangle_vertices.push_back(place->second);
  }
  model_.triangle_face.push_back(face);
}

void ModelBuilder::add_quad(LocalIndex face, const Vec3& a, const Vec3& b, const Vec3& c,
                            const Vec3& d)
{
  add_triangle(face, a, b, c);
  add_triangle(face, a, c, d);
}

model::ModelDescription ModelBuilder::finish() { return finish({enclosed_volume(model_)}); }

model::ModelDescription ModelBuilder::finish(const std::vector<double>& volumes)
{
  for (const double volume : volumes) model_.solids.push_back({.name = {}, .volume = volume});
  return std::move(model_);
}

double enclosed_volume(const model::ModelDescription& model)
{
  const std::span<const double> xyz(model.vertex_xyz);
  double volume = 0.0;
  for (std::size_t t = 0; t < model.triangle_face.size(); ++t) {
    const auto corner = [&](std::size_t c) {
      return point_at(xyz, model.triangle_vertices[3 * t + c]);
    };
    volume += tet_volume({}, corner(0), corner(1), corner(2));
  }
  return volume;
}

model::ModelDescription prism(const std::vector<Point2>& corners,
                              const std::vector<std::array<std::size_t, 3>>& triangles,
                              double height)
{
  ModelBuilder builder;
  const LocalIndex low = builder.add_face();
  const LocalIndex high = builder.add_face();
  for (const auto& [a, b, c] : triangles) {
    builder.add_triangle(low, at_height(corners[a], 0.0), at_height(corners[c], 0.0),
                         at_height(corners[b], 0.0));
    builder.add_triangle(high, at_height(corners[a], height), at_height(corners[b], height),
                         at_height(corners[c], height));
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2& p = corners[i];
    const Point2& q = corners[(i + 1) % corners.size()];
    builder.add_quad(builder.add_face(), at_height(p, 0.0), at_height(q, 0.0), at_height(q, height),
                     at_height(p, height));
  }
  return builder.finish();
}

model::ModelDescription box(double x, double y, double z)
{
  return prism({{0, 0}, {x, 0}, {x, y}, {0, y}}, {{0, 1, 2}, {0, 2, 3}}, z);
}

model::ModelDescription l_shape()
{
  return prism({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
               {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}, 1.0);
}

model::ModelDescription cylinder(double radius, double height, int n)
{
  ModelBuilder builder;
  const LocalIndex low = builder.add_face();
  const LocalIndex high = builder.add_face();
  const LocalIndex round = builder.add_face();
  const auto on_circle = [&](int i) {
    const double angle = 2.0 * std::numbers::pi * (i % n) / n;
    return Point2{radius * std::cos(angle), radius * std::sin(angle)};
  };
  for (int i = 0; i < n; ++i) {
    const Point2 p = on_circle(i);
    const Point2 q = on_circle(i + 1);
    builder.add_triangle(low, {0, 0, 0}, at_height(q, 0.0), at_height(p, 0.0));
    builder.add_triangle(high, {0, 0, height}, at_height(p, height), at_height(q, height));
    builder.add_quad(round, at_height(p, 0.0), at_height(q, 0.0), at_height(q, height),
                     at_height(p, height));
  }
  return builder.finish();
}

model::ModelDescription torus(double major, double minor, int n)
{
  ModelBuilder builder;
  const LocalIndex face = builder.add_face();
  const auto point = [&](int i, int j) {
    const double around = std::numbers::pi * (i % (2 * n)) / n;
    const double across = 2.0 * std::numbers::pi * (j % n) / n;
    const double radius = major + minor * std::cos(across);
    return Vec3{radius * std::cos(around), radius * std::sin(around), minor * std::sin(across)};
  };
  for (int i = 0; i < 2 * n; ++i) {
    for (int j = 0; j < n; ++j) {
      builder.add_quad(face, point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
    }
  }
  return builder.finish();
}

model::ModelDescription plate(int num_x, int num_y, const Cell& cell, double height)
{
  ModelBuilder builder;
  const LocalIndex low = builder.add_face();
  const LocalIndex high = builder.add_face();
  std::array<LocalIndex, 4> sides{};
  for (LocalIndex& side : sides) side = builder.add_face();
  for (int ix = 0; ix < num_x; ++ix) {
    for (int iy = 0; iy < num_y; ++iy) {
      const Ring ring = ring_of(cell, ix * cell.side_x, iy * cell.side_y);
      const LocalIndex hole = builder.add_face();
      const std::array is_at_side{iy == 0, ix == num_x - 1, iy == num_y - 1, ix == 0};
      for (std::size_t i = 0; i < ring.outer.size(); ++i) {
        const std::size_t next = (i + 1) % ring.outer.size();
        const auto& [a, b] = std::tie(ring.outer[i], ring.outer[next]);
        const auto& [p, q] = std::tie(ring.inner[i], ring.inner[next]);
        builder.add_quad(low, at_height(a, 0), at_height(p, 0), at_height(q, 0), at_height(b, 0));
        builder.add_quad(high, at_height(a, height), at_height(b, height), at_height(q, height),
                         at_height(p, height));
        builder.add_quad(hole, at_height(q, 0), at_height(p, 0), at_height(p, height),
                         at_height(q, height));
        if (!is_at_side[i / kSteps]) continue;
        builder.add_quad(sides[i / kSteps], at_height(a, 0), at_height(b, 0), at_height(b, height),
                         at_height(a, height));
      }
    }
  }
  return builder.finish();
}

model::ModelDescription two_cubes()
{
  ModelBuilder builder;
  const LocalIndex between = builder.add_face({1, 2});
  builder.add_quad(between, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1});
  const LocalIndex left = builder.add_face({1});
  builder.add_quad(left, {0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0});
  const LocalIndex right = builder.add_face({2});
  builder.add_quad(right, {2, 0, 0}, {2, 1, 0}, {2, 1, 1}, {2, 0, 1});
  const std::array<LocalIndex, 4> sides{builder.add_face({1, 2}), builder.add_face({1, 2}),
                                        builder.add_face({1, 2}), builder.add_face({1, 2})};
  for (const double x : {0.0, 1.0}) {
    const double y = x + 1.0;
    builder.add_quad(sides[0], {x, 0, 0}, {x, 1, 0}, {y, 1, 0}, {y, 0, 0});
    builder.add_quad(sides[1], {x, 0, 1}, {y, 0, 1}, {y, 1, 1}, {x, 1, 1});
    builder.add_quad(sides[2], {x, 0, 0}, {y, 0, 0}, {y, 0, 1}, {x, 0, 1});
    builder.add_quad(sides[3], {x, 1, 0}, {x, 1, 1}, {y, 1, 1}, {y, 1, 0});
  }
  return builder.finish({1.0, 1.0});
}

}  // namespace tessera::testing
