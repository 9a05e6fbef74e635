// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/topology/periodic_sides.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tessera/base/box.hpp"
#include "tessera/base/error.hpp"
#include "tessera/base/name_patterns.hpp"
#include "tessera/base/tet.hpp"
#include "tessera/base/triangle.hpp"
#include "tessera/mesh/face_tets.hpp"
#include "tessera/mesh/orbit_walk.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/model/point_search.hpp"

namespace tessera::topology {
namespace {

using Faces = std::vector<LocalIndex>;

std::string words_of(const PeriodicSide& side)
{
  return fmt::format("[[periodic]] from \"{}\" to \"{}\"", side.from, side.to);
}

std::array<Vec3, 3> corners_of(const mesh::CoarseMesh& mesh, LocalIndex face)
{
  return corners_at<3>(mesh.vertex_xyz, mesh.face_vertices, face);
}

Vec3 centroid_of(const mesh::CoarseMesh& mesh, const Faces& faces)
{
  std::vector<std::array<Vec3, 3>> triangles;
  for (const LocalIndex f : faces) triangles.push_back(corners_of(mesh, f));
  return tessera::centroid_of(triangles);
}

std::vector<LocalIndex> vertices_of(const mesh::CoarseMesh& mesh, const Faces& faces)
{
  std::vector<LocalIndex> vertices;
  for (const LocalIndex f : faces) {
    const LocalIndex* v = &mesh.face_vertices[3 * at(f)];
    vertices.insert(vertices.end(), v, v + 3);
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

// Which patches the entries choose; each of one entry, and outside.
class ChosenPatches {
 public:
  explicit ChosenPatches(const mesh::CoarseMesh& mesh) : mesh_(mesh), user_(at(mesh.num_patches()))
  {
    const auto tets = mesh::tets_of_faces(mesh);
    is_inside_.resize(user_.size());
    for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
      if (tets[at(f)].tets[1] != kNoIndex) is_inside_[at(mesh.face_patch[at(f)])] = true;
    }
  }

  Faces faces(const std::string& pattern, const PeriodicSide& side)
  {
    std::vector<bool> fits;
    try {
      fits = matching_names("patch", pattern, mesh_.patch_names);
    } catch (const ConfigError& error) {
      throw ConfigError(fmt::format("{}: {}", words_of(side), error.what()));
    }
    for (std::size_t p = 0; p < fits.size(); ++p) {
      if (fits[p]) choose(p, side);
    }
    Faces faces;
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      if (fits[at(mesh_.face_patch[at(f)])]) faces.push_back(f);
    }
    if (!faces.empty()) return faces;
    throw ConfigError(fmt::format("{}: \"{}\" has no triangles", words_of(side), pattern));
  }

 private:
  void choose(std::size_t patch, const PeriodicSide& side)
  {
    const std::string& name = mesh_.patch_names[patch];
    if (is_inside_[patch]) {
      throw ConfigError(fmt::format("{}: patch \"{}\" lies inside of the model; a side is outside",
                                    words_of(side), name));
    }
    if (!user_[patch].empty()) {
      throw ConfigError(
          fmt::format("{}: patch \"{}\" is one of {} as well; it can have one partner",
                      words_of(side), name, user_[patch]));
    }
    user_[patch] = words_of(side);
  }

  const mesh::CoarseMesh& mesh_;
  std::vector<std::string> user_;  // Of each patch: the entry that has it.
  std::vector<bool> is_inside_{};
};

// Joins the sides of all entries; lives for one call.
class Joiner {
 public:
  explicit Joiner(mesh::CoarseMesh& mesh)
      : mesh_(mesh), tolerance_(kMostOffImage * box_diagonal(mesh.vertex_xyz))
  {
    images_.begin(mesh.num_patches(), mesh.num_faces());
  }

  void add(const PeriodicSide& side, const Faces& from, const Faces& to)
  {
    const Affine there = transform_of(side, centroid_of(mesh_, to) - centroid_of(mesh_, from));
    images_.transforms.push_back(there);
    const std::map<LocalIndex, LocalIndex> partner = partners(side, there, from, to);
    for (const auto& [vertex, image] : partner) links_.push_back({vertex, image, newest()});
    std::map<std::array<LocalIndex, 3>, LocalIndex> face_with;
    for (const LocalIndex f : to) face_with[vertices_of_face(f)] = f;
    for (const LocalIndex f : from) {
      auto vertices = vertices_of_face(f);
      for (LocalIndex& v : vertices) v = partner.at(v);
      std::ranges::sort(vertices);
      const auto image = face_with.find(vertices);
      if (image == face_with.end()) throw MeshError(no_image(side, corners_of(mesh_, f)));
      link(side, f, image->second);
    }
    for (const LocalIndex f : to) {
      if (images_.face_origin[at(f)] == kNoIndex)
        throw MeshError(no_image(side, corners_of(mesh_, f)));
    }
  }

  void move_and_number()
  {
    std::vector<Affine> products{Affine{}};
    const mesh::OrbitTable orbits =
        mesh::find_orbits(mesh_.num_vertices(), links_, images_.transforms, products);
    for (LocalIndex v = 0; v < mesh_.num_vertices(); ++v) {
      if (orbits.image_of(v) == 0) continue;
      const Vec3 place = products[at(orbits.image_of(v))](mesh_.position(orbits.base_of(v)));
      std::ranges::copy(place, &mesh_.vertex_xyz[3 * at(v)]);
    }
    number_by(orbits);
    mesh_.images = std::move(images_);
  }

 private:
  [[nodiscard]] LocalIndex newest() const
  {
    return static_cast<LocalIndex>(images_.transforms.size()) - 1;
  }

  [[nodiscard]] std::array<LocalIndex, 3> vertices_of_face(LocalIndex f) const
  {
    const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
    return mesh::sorted_triangle(v[0], v[1], v[2]);
  }

  // Of each vertex of the one side that of the other one.
  [[nodiscard]] std::map<LocalIndex, LocalIndex> partners(const PeriodicSide& side,
                                                          const Affine& there, const Faces& from,
                                                          const Faces& to) const
  {
    const std::vector<LocalIndex> candidates = vertices_of(mesh_, to);
    std::vector<Vec3> places;
    for (const LocalIndex v : candidates) places.push_back(mesh_.position(v));
    const model::SegmentSearch search = model::search_of_points(places);
    std::map<LocalIndex, LocalIndex> partner;
    for (const LocalIndex v : vertices_of(mesh_, from)) {
      const Vec3 image = there(mesh_.position(v));
      const model::NearestPoint nearest = search.nearest(image);
      const double off = norm(nearest.xyz - image);
      if (off > tolerance_) throw MeshError(too_far(side, mesh_.position(v), image, off));
      partner[v] = candidates[at(nearest.simplex)];
    }
    return partner;
  }

  [[nodiscard]] std::string too_far(const PeriodicSide& side, const Vec3& point, const Vec3& image,
                                    double off) const
  {
    return fmt::format(
        "{}: the sides do not match: the image of the point ({:g}) is ({:g}), and the nearest "
        "point of the other side is {:.3g} away, more than {:.3g}; {}",
        words_of(side), fmt::join(point, ", "), fmt::join(image, ", "), off, tolerance_,
        side.has_translation() || side.has_rotation()
            ? "correct the translation or rotation, or the model"
            : "give the translation, or a rotation, or correct the model");
  }

  [[nodiscard]] static std::string no_image(const PeriodicSide& side,
                                            const std::array<Vec3, 3>& triangle)
  {
    const Vec3 middle = middle_of(triangle);
    return fmt::format(
        "{}: the sides do not match: the triangle at ({:g}) has no partner with the same corners",
        words_of(side), fmt::join(middle, ", "));
  }

  void link(const PeriodicSide& side, LocalIndex from, LocalIndex to)
  {
    const LocalIndex patch = mesh_.face_patch[at(to)];
    const LocalIndex origin = mesh_.face_patch[at(from)];
    LocalIndex& of_patch = images_.patch_origin[at(patch)];
    if (of_patch != kNoIndex && of_patch != origin) {
      throw ConfigError(fmt::format(
          "{}: patch \"{}\" is the image of \"{}\" and of \"{}\"; give both sides the same patches",
          words_of(side), mesh_.patch_names[at(patch)], mesh_.patch_names[at(of_patch)],
          mesh_.patch_names[at(origin)]));
    }
    of_patch = origin;
    images_.patch_transform[at(patch)] = newest();
    images_.face_origin[at(to)] = from;
  }

  // How often each transform leads from the base of its orbit to a vertex, back counting less.
  // Empty for a vertex without images.
  [[nodiscard]] std::vector<std::vector<int>> steps_from_bases() const
  {
    std::vector<std::vector<int>> steps(at(mesh_.num_vertices()));
    const auto count = [&](LocalIndex here, LocalIndex there, const mesh::ImageLink& link) {
      steps[at(here)].resize(images_.transforms.size());
      steps[at(there)] = steps[at(here)];
      steps[at(there)][at(link.transform)] += link.from == here ? 1 : -1;
    };
    mesh::walk_orbits(mesh_.num_vertices(), links_, count);
    return steps;
  }

  // Vertices of an orbit behind each other, where its lowest is; by the steps that lead to them. So
  // also a face with a corner and the image of that has the order of its own image.
  void number_by(const mesh::OrbitTable& orbits)
  {
    const std::vector<std::vector<int>> steps = steps_from_bases();
    std::vector<LocalIndex> rows(at(mesh_.num_vertices()));
    std::iota(rows.begin(), rows.end(), 0);
    std::ranges::stable_sort(rows, [&](LocalIndex a, LocalIndex b) {
      const LocalIndex base = orbits.base_of(a);
      return base == orbits.base_of(b) ? steps[at(a)] < steps[at(b)] : base < orbits.base_of(b);
    });
    std::vector<LocalIndex> number(rows.size());
    FlatArray<double> xyz;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      number[at(rows[i])] = static_cast<LocalIndex>(i);
      const double* place = &mesh_.vertex_xyz[3 * at(rows[i])];
      xyz.insert(xyz.end(), place, place + 3);
    }
    require_same_order(number);
    mesh_.vertex_xyz = std::move(xyz);
    for (auto* const vertices :
         {&mesh_.tet_vertices, &mesh_.face_vertices, &mesh_.segment_vertices}) {
      for (LocalIndex& v : *vertices) v = number[at(v)];
    }
  }

  void require_same_order(const std::vector<LocalIndex>& number) const
  {
    std::map<std::pair<LocalIndex, LocalIndex>, LocalIndex> image;  // Of a vertex by a transform.
    for (const mesh::ImageLink& link : links_) image[{link.from, link.transform}] = link.to;
    for (LocalIndex f = 0; f < mesh_.num_faces(); ++f) {
      if (images_.face_origin[at(f)] == kNoIndex) continue;
      const LocalIndex patch = mesh_.face_patch[at(f)];
      const LocalIndex transform = images_.patch_transform[at(patch)];
      auto corners = vertices_of_face(images_.face_origin[at(f)]);
      std::ranges::sort(corners, {}, [&](LocalIndex v) { return number[at(v)]; });
      const auto number_of_image = [&](LocalIndex v) {
        return number[at(image.at({v, transform}))];
      };
      if (std::ranges::is_sorted(corners, {}, number_of_image)) continue;
      throw MeshError(fmt::format(
          "[[periodic]]: the triangle at ({:g}) of patch \"{}\" has a corner and the image of that "
          "corner; make the coarse mesh finer, so that there are two edges from side to side",
          fmt::join(mesh_.position(mesh_.face_vertices[3 * at(f)]), ", "),
          mesh_.patch_names[at(patch)]));
    }
  }

  mesh::CoarseMesh& mesh_;
  double tolerance_;
  mesh::SideImages images_{};
  std::vector<mesh::ImageLink> links_{};  // Between vertices.
};

}  // namespace

void join_periodic_sides(mesh::CoarseMesh& mesh, std::span<const PeriodicSide> sides)
{
  ChosenPatches patches(mesh);
  Joiner joiner(mesh);
  for (const PeriodicSide& side : sides) {
    const Faces from = patches.faces(side.from, side);
    joiner.add(side, from, patches.faces(side.to, side));
  }
  joiner.move_and_number();
  mesh::validate(mesh);
}

}  // namespace tessera::topology
