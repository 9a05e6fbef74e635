// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/coarse/divide_domains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <unordered_map>
#include <utility>

#include "tessera/base/vec3.hpp"
#include "tessera/cut/choose_planes.hpp"
#include "tessera/model/description.hpp"

namespace tessera::coarse {
namespace {

constexpr double kMostPieces = 256.0;

// Of the mean edge, by which a plane is moved if no membrane can be made along it.
constexpr std::array kShifts{0.0, 0.4, -0.4};

double volume_of(const DomainSkin& skin)
{
  const auto corner = [&](std::size_t c) {
    return point_at(std::span(skin.vertex_xyz), skin.triangle_vertices[c]);
  };
  double volume = 0.0;
  for (std::size_t c = 0; c < skin.triangle_vertices.size(); c += 3) {
    volume += tet_volume(Vec3{}, corner(c), corner(c + 1), corner(c + 2));
  }
  return volume;
}

LocalIndex pieces_wanted(const DomainSkin& skin, double tets_per_piece)
{
  return static_cast<LocalIndex>(std::min(predicted_tets(skin) / tets_per_piece, kMostPieces));
}

double mean_edge(const DomainSkin& skin)
{
  double sum = 0.0;
  for (std::size_t c = 0; c < skin.triangle_vertices.size(); ++c) {
    const std::size_t next = c % 3 == 2 ? c - 2 : c + 1;
    sum += norm(point_at(std::span(skin.vertex_xyz), skin.triangle_vertices[next])
                - point_at(std::span(skin.vertex_xyz), skin.triangle_vertices[c]));
  }
  return sum / static_cast<double>(skin.triangle_vertices.size());
}

// What planes are chosen by: a solid whose faces are the patches.
model::ModelDescription description_of(const DomainSkin& skin)
{
  model::ModelDescription model;
  model.solids.push_back({.volume = volume_of(skin)});
  const LocalIndex num_patches = 1 + *std::ranges::max_element(skin.triangle_patch);
  for (LocalIndex p = 0; p < num_patches; ++p) {
    model.faces.push_back({.number = p + 1, .solids = {1}});
  }
  model.vertex_xyz = skin.vertex_xyz;
  model.triangle_vertices = skin.triangle_vertices;
  model.triangle_face = skin.triangle_patch;
  return model;
}

class Divider {
 public:
  Divider(const CoarseSurface& surface, const MembraneMesher& mesher, double tets_per_piece)
      : mesher_(mesher), surface_(surface), num_domains_(surface.num_domains())
  {
    for (LocalIndex d = 1; d <= num_domains_; ++d) {
      pieces_.emplace_back(1, d);
      const DomainSkin skin = skin_of(surface, d);
      const LocalIndex wanted = pieces_wanted(skin, tets_per_piece);
      if (wanted > 1) divide(skin, wanted);
    }
  }

  DividedSurface take()
  {
    DividedSurface divided{.surface = std::move(surface_)};
    std::vector<LocalIndex> order{0};
    for (const std::vector<LocalIndex>& pieces : pieces_) {
      divided.num_pieces.push_back(static_cast<LocalIndex>(pieces.size()));
      order.insert(order.end(), pieces.begin(), pieces.end());
    }
    number_by(order, divided.surface);
    return divided;
  }

 private:
  void divide(const DomainSkin& skin, LocalIndex num_pieces)
  {
    const cut::CutOptions options{.parts = num_pieces, .coarse_size = mean_edge(skin)};
    const cut::CutTree tree = cut::choose_planes(description_of(skin), options).tree;
    divide_by(tree, tree.solid_root.front(), pieces_.back().front());
  }

  void divide_by(const cut::CutTree& tree, LocalIndex row, LocalIndex piece)
  {
    const cut::CutNode& node = tree.nodes[at(row)];
    if (node.is_leaf()) return;
    const LocalIndex above = split(piece, node.plane);
    if (above == kNoIndex) return;
    divide_by(tree, node.below, piece);
    divide_by(tree, node.above, above);
  }

  // The new piece, above the plane; kNoIndex if there is no sound membrane.
  LocalIndex split(LocalIndex piece, const cut::Plane& plane)
  {
    const DomainSkin skin = skin_of(surface_, piece);
    const double size = mean_edge(skin);
    for (const double shift : kShifts) {
      const auto border = membrane_border(skin, {plane.normal, plane.offset + shift * size});
      if (!border) continue;
      const Membrane membrane = mesher_(skin, *border);
      if (is_sound(membrane, skin, *border)) return split_along(piece, skin, *border, membrane);
    }
    return kNoIndex;
  }

  LocalIndex split_along(LocalIndex piece, const DomainSkin& skin, const MembraneBorder& border,
                         const Membrane& membrane)
  {
    const LocalIndex above = add_piece_like(piece);
    const std::vector<LocalIndex> faces = faces_of(surface_, piece);
    for (std::size_t t = 0; t < faces.size(); ++t) {
      if (border.is_above[t] == 0) continue;
      for (LocalIndex& domain : surface_.face_domains[at(faces[t])]) {
        if (domain == piece) domain = above;
      }
    }
    add_faces(membrane, skin, {piece, above});
    return above;
  }

  LocalIndex add_piece_like(LocalIndex piece)
  {
    const auto repeat = [&](auto& of_domain) {
      if (of_domain.empty()) return;
      const auto same = of_domain[at(piece - 1)];
      of_domain.push_back(same);
    };
    repeat(surface_.domain_material);
    repeat(surface_.domain_part);
    repeat(surface_.domain_max_size);
    pieces_.back().push_back(surface_.num_domains());
    return surface_.num_domains();
  }

  void add_faces(const Membrane& membrane, const DomainSkin& skin,
                 const std::array<LocalIndex, 2>& domains)
  {
    mesh::CoarseMesh& mesh = surface_.mesh;
    const auto num_skin = static_cast<LocalIndex>(skin.vertex.size());
    const LocalIndex first_new = mesh.num_vertices() - num_skin;
    for (const LocalIndex v : membrane.triangle_vertices) {
      mesh.face_vertices.push_back(v < num_skin ? skin.vertex[at(v)] : first_new + v);
    }
    mesh.vertex_xyz.insert(mesh.vertex_xyz.end(), membrane.vertex_xyz.begin(),
                           membrane.vertex_xyz.end());
    const std::size_t num_faces = mesh.face_vertices.size() / 3;
    mesh.face_patch.resize(num_faces, kNoIndex);
    surface_.face_domains.resize(num_faces, domains);
    if (!mesh.face_uv.empty()) mesh.face_uv.resize(6 * num_faces, 0.0);
  }

  // Makes piece order[i] number i.
  static void number_by(const std::vector<LocalIndex>& order, CoarseSurface& surface)
  {
    std::vector<LocalIndex> number(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      number[at(order[i])] = static_cast<LocalIndex>(i);
    for (auto& domains : surface.face_domains) {
      for (LocalIndex& domain : domains) domain = number[at(domain)];
    }
    const auto reorder = [&](auto& of_domain) {
      const auto old = of_domain;
      for (std::size_t i = 0; i < old.size(); ++i) of_domain[i] = old[at(order[i + 1] - 1)];
    };
    reorder(surface.domain_material);
    reorder(surface.domain_part);
    reorder(surface.domain_max_size);
  }

  const MembraneMesher& mesher_;
  CoarseSurface surface_;
  LocalIndex num_domains_;
  std::vector<std::vector<LocalIndex>> pieces_{};  // Of each domain so far.
};

}  // namespace

double predicted_tets(const DomainSkin& skin)
{
  if (skin.vertex.empty()) return 0.0;
  constexpr double kTetsPerTriangle = 4.0;  // Of bodies with many features, at least.
  constexpr double kTetsPerCube = 8.5;      // Regular tets in the cube of their edge.
  const double by_size = kTetsPerCube * volume_of(skin) / std::pow(skin.max_size, 3);
  return std::max(by_size, kTetsPerTriangle * static_cast<double>(skin.triangle_patch.size()));
}

bool has_large_domain(const CoarseSurface& surface, double tets_per_piece)
{
  for (LocalIndex d = 1; d <= surface.num_domains(); ++d) {
    if (pieces_wanted(skin_of(surface, d), tets_per_piece) > 1) return true;
  }
  return false;
}

DomainSkin skin_of_piece(const DividedSurface& divided, LocalIndex piece)
{
  DomainSkin skin = skin_of(divided.surface, piece);
  LocalIndex last = 0;  // Piece of a domain.
  const auto domain = std::ranges::find_if(
      divided.num_pieces, [&](LocalIndex num_pieces) { return piece <= (last += num_pieces); });
  skin.is_piece = *domain > 1;
  return skin;
}

DividedSurface undivided(CoarseSurface surface)
{
  std::vector<LocalIndex> num_pieces(at(surface.num_domains()), 1);
  return {std::move(surface), std::move(num_pieces)};
}

DividedSurface divide_domains(const CoarseSurface& surface, const MembraneMesher& mesher,
                              double tets_per_piece)
{
  return Divider(surface, mesher, tets_per_piece).take();
}

DomainTets join_pieces(const DomainSkin& whole, const std::vector<DomainSkin>& skins,
                       std::span<const DomainTets> pieces)
{
  DomainTets joined{.vertex_xyz = whole.vertex_xyz};
  std::unordered_map<LocalIndex, LocalIndex> place;  // Of a row of the mesh; only looked up.
  for (const LocalIndex row : whole.vertex) {
    place.emplace(row, static_cast<LocalIndex>(place.size()));
  }
  const auto add_vertex = [&](const DomainTets& from, std::size_t v) {
    const auto* xyz = &from.vertex_xyz[3 * v];
    joined.vertex_xyz.insert(joined.vertex_xyz.end(), xyz, xyz + 3);
    return static_cast<LocalIndex>(joined.vertex_xyz.size() / 3) - 1;
  };
  for (std::size_t p = 0; p < skins.size(); ++p) {
    const DomainTets& piece = pieces[p];
    std::vector<LocalIndex> number;
    for (std::size_t v = 0; v < piece.vertex_xyz.size() / 3; ++v) {
      if (v >= skins[p].vertex.size()) {
        number.push_back(add_vertex(piece, v));
        continue;
      }
      const auto found = place.find(skins[p].vertex[v]);
      number.push_back(found != place.end() ? found->second : add_vertex(piece, v));
      if (found == place.end()) place.emplace(skins[p].vertex[v], number.back());
    }
    for (const LocalIndex v : piece.tet_vertices) joined.tet_vertices.push_back(number[at(v)]);
  }
  return joined;
}

}  // namespace tessera::coarse
