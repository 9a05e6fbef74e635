// SPDX-License-Identifier: BSD-3-Clause
#include "topology/split_faces.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/name_patterns.hpp"
#include "tessera/base/union_find.hpp"
#include "tessera/base/vec3.hpp"
#include "tessera/mesh/face_tets.hpp"

namespace tessera::topology {
namespace {

using MaterialPairs = std::set<std::array<LocalIndex, 2>>;  // Ascending, each from 1.

// Tells an error of an entry which table it is in.
template <class Find>
auto within(const char* table, const Find& find)
{
  try {
    return find();
  } catch (const ConfigError& error) {
    throw ConfigError(fmt::format("{}: {}", table, error.what()));
  }
}

std::vector<bool> chosen_patches(const std::vector<SplitPatch>& splits,
                                 const std::vector<std::string>& names)
{
  std::vector<bool> chosen(names.size(), false);
  for (const SplitPatch& one : splits) {
    const std::vector<bool> fits =
        within("[[split]]", [&] { return matching_names("patch", one.patch, names); });
    for (std::size_t p = 0; p < fits.size(); ++p) chosen[p] = chosen[p] || fits[p];
  }
  return chosen;
}

MaterialPairs chosen_materials(const std::vector<Contact>& contacts,
                               const std::vector<std::string>& names)
{
  const auto solids = [&](const std::string& pattern) {
    return within("[[geometry.contact]]", [&] { return matching_solids(pattern, names); });
  };
  MaterialPairs pairs;
  for (const Contact& contact : contacts) {
    const std::vector<LocalIndex> others = solids(contact.other);
    for (const LocalIndex a : solids(contact.body)) {
      for (const LocalIndex b : others) pairs.insert({std::min(a, b), std::max(a, b)});
    }
  }
  return pairs;
}

// Which joint there is on the side of a body, if a patch has it.
class JointSides {
 public:
  JointSides(const mesh::CoarseMesh& mesh, const std::vector<JointSide>& joints)
  {
    const std::vector<std::string> bodies = mesh::body_names(mesh);
    for (const JointSide& joint : joints) {
      fits_.push_back(within("[[layer]]", [&] {
        return Fits{patches_that_fit(joint.patch, mesh.patch_names),
                    matching_solids(joint.solid, bodies)};
      }));
    }
  }

  [[nodiscard]] LocalIndex find(LocalIndex patch, LocalIndex body) const
  {
    const auto found = std::ranges::find_if(fits_, [&](const Fits& fits) {
      return fits.patches[at(patch)] && std::ranges::binary_search(fits.solids, body);
    });
    return found == fits_.end() ? kNoIndex : static_cast<LocalIndex>(found - fits_.begin());
  }

 private:
  struct Fits {
    std::vector<bool> patches{};
    std::vector<LocalIndex> solids{};  // Ascending.
  };

  // It is no error if there is none: the name may be that of a side of a split.
  static std::vector<bool> patches_that_fit(const std::string& pattern,
                                            const std::vector<std::string>& names)
  {
    std::vector<bool> fits;
    for (const std::string& name : names) fits.push_back(matches_pattern(pattern, name));
    return fits;
  }

  std::vector<Fits> fits_{};
};

}  // namespace

SplitFaces::SplitFaces(const mesh::CoarseMesh& mesh, const SplitOptions& options) : mesh_(mesh)
{
  const std::vector<mesh::TriangleTets> triangles = mesh::triangles_of_tets(mesh.tet_vertices);
  find_faces(options, triangles);
  find_sides(triangles);
  drop_closed_joints();
}

SplitFaces::SplitFaces(const mesh::CoarseMesh& mesh) : mesh_(mesh)
{
  const std::vector<mesh::TriangleTets> triangles = mesh::triangles_of_tets(mesh.tet_vertices);
  for (const mesh::TriangleTets& triangle : mesh::tets_of_faces(mesh, triangles)) {
    const auto face = static_cast<LocalIndex>(tets_.size());
    const bool is_wake = mesh.is_wake(mesh.face_patch[at(face)]);
    tets_.push_back(triangle.tets);
    openings_.push_back({.is_open = is_wake, .is_wake = is_wake});
    if (is_wake) faces_.push_back(face);
  }
  find_sides(triangles);
}

std::size_t SplitFaces::corner(LocalIndex tet, LocalIndex vertex) const
{
  const auto corners = mesh_.tet(tet);
  return 4 * at(tet)
         + static_cast<std::size_t>(std::ranges::find(corners, vertex) - corners.begin());
}

void SplitFaces::find_faces(const SplitOptions& options,
                            std::span<const mesh::TriangleTets> triangles)
{
  const std::vector<bool> patch_is_split = chosen_patches(options.patches, mesh_.patch_names);
  const MaterialPairs contacts = chosen_materials(options.contacts, mesh::body_names(mesh_));
  const JointSides joints(mesh_, options.joints);
  LocalIndex face = 0;
  for (const mesh::TriangleTets& triangle : mesh::tets_of_faces(mesh_, triangles)) {
    std::array<LocalIndex, 2>& tets = tets_.emplace_back(triangle.tets);
    const auto body = [&](std::size_t side) {
      return mesh_.body(mesh_.tet_material[at(tets[side])]);
    };
    const bool is_inner = tets[1] != kNoIndex;
    if (is_inner && is_minus_first(face, tets)) std::swap(tets[0], tets[1]);
    const LocalIndex patch = mesh_.face_patch[at(face)];
    if (patch_is_split[at(patch)] && !is_inner) {
      throw ConfigError(fmt::format(
          "[[split]]: patch \"{}\" is on the outside of the model; only patches inside of it can "
          "be split",
          mesh_.patch_names[at(patch)]));
    }
    const bool is_between = is_inner && body(0) != body(1);
    const bool is_contact = is_between && contacts.contains({body(0), body(1)});
    Opening& opening = openings_.emplace_back();
    opening.is_open = patch_is_split[at(patch)] || is_contact;
    if (is_between && !opening.is_open) {
      opening.joints = {joints.find(patch, body(0)), joints.find(patch, body(1))};
      if (opening.joints[1] < opening.joints[0]) {
        std::swap(opening.joints[0], opening.joints[1]);
        std::swap(tets[0], tets[1]);
      }
      opening.is_open = opening.is_joint();
    }
    if (opening.is_open) faces_.push_back(face);
    ++face;
  }
}

// On the plus side is the body with the lower number; inside of a body, what the face looks at.
bool SplitFaces::is_minus_first(LocalIndex face, const std::array<LocalIndex, 2>& tets) const
{
  const auto body = [&](std::size_t side) {
    return mesh_.body(mesh_.tet_material[at(tets[side])]);
  };
  if (body(0) != body(1)) return body(1) < body(0);
  const LocalIndex* v = &mesh_.face_vertices[3 * at(face)];
  const auto corners = mesh_.tet(tets[0]);
  const auto opposite = std::ranges::find_if(
      corners, [&](LocalIndex corner) { return std::find(v, v + 3, corner) == v + 3; });
  return tet_volume(mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2]),
                    mesh_.position(*opposite))
         < 0.0;
}

void SplitFaces::find_sides(std::span<const mesh::TriangleTets> triangles)
{
  std::vector<bool> is_on_split(at(mesh_.num_vertices()), false);
  std::vector<std::array<LocalIndex, 3>> split;
  for (const LocalIndex f : faces_) {
    const LocalIndex* v = &mesh_.face_vertices[3 * at(f)];
    split.push_back(mesh::sorted_triangle(v[0], v[1], v[2]));
    for (const LocalIndex corner : split.back()) is_on_split[at(corner)] = true;
  }
  std::ranges::sort(split);
  UnionFind fans(4 * mesh_.num_tets());
  for (const mesh::TriangleTets& triangle : triangles) {
    if (triangle.tets[1] == kNoIndex) continue;
    if (std::ranges::binary_search(split, triangle.vertices)) continue;
    for (const LocalIndex v : triangle.vertices) {
      if (!is_on_split[at(v)]) continue;
      fans.join(static_cast<LocalIndex>(corner(triangle.tets[0], v)),
                static_cast<LocalIndex>(corner(triangle.tets[1], v)));
    }
  }
  num_sides_.assign(at(mesh_.num_vertices()), 0);
  side_.assign(mesh_.tet_vertices.size(), 0);
  for (std::size_t c = 0; c < side_.size(); ++c) {
    const LocalIndex v = mesh_.tet_vertices[c];
    const auto first = static_cast<std::size_t>(fans.find(static_cast<LocalIndex>(c)));
    if (is_on_split[at(v)]) side_[c] = first == c ? num_sides_[at(v)]++ : side_[first];
  }
  for (LocalIndex& number : num_sides_) number = std::max(number, 1);
}

// Where both sides of a joint would have the same vertices, there is nothing to open.
void SplitFaces::drop_closed_joints()
{
  std::erase_if(faces_, [&](LocalIndex face) {
    const LocalIndex* v = &mesh_.face_vertices[3 * at(face)];
    const bool is_closed =
        std::none_of(v, v + 3, [&](LocalIndex corner) { return is_parted(face, corner); });
    if (!opening(face).is_joint() || !is_closed) return false;
    openings_[at(face)] = {};
    return true;
  });
}

}  // namespace tessera::topology
