// SPDX-License-Identifier: BSD-3-Clause
#include "support/piece_sets.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "tessera/base/error.hpp"
#include "tessera/mesh/subdomain_tets.hpp"
#include "tessera/mesh/surface_match.hpp"
#include "tessera/mesh/tet_topology.hpp"
#include "tessera/quality/statistics.hpp"

namespace tessera::testing {
namespace {

// Name of a vertex in a set of pieces; below zero are hosts of interior ones.
mesh::HostPoint name_of(const mesh::Piece& piece, LocalIndex v)
{
  if (v < piece.num_skin_vertices()) return piece.skin_point(v);
  return {-1 - piece.subdomain, v};
}

using TriangleKey = std::array<mesh::HostPoint, 3>;

struct Sides {
  int even = 0;
  int odd = 0;
  int on_geometry = 0;
};

// Every triangle's number of tets on either side, and of entries on the geometry.
class TriangleCount {
 public:
  void add_tets(const mesh::Piece& piece)
  {
    for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
      const LocalIndex* v = &piece.tet_vertices[4 * at(t)];
      for (const auto& [a, b, c] : mesh::kTetFaceCorners) {
        const auto [key, is_even] = key_of_triangle(piece, v[a], v[b], v[c]);
        ++(is_even ? sides_[key].even : sides_[key].odd);
      }
    }
  }

  void add_boundary(const mesh::Piece& piece)
  {
    for (LocalIndex i = 0; i < piece.num_boundary(); ++i) {
      const LocalIndex* v = &piece.boundary_vertices[3 * at(i)];
      ++sides_[key_of_triangle(piece, v[0], v[1], v[2]).first].on_geometry;
    }
  }

  // Inside: one tet on each side. On the outside: one tet, and one entry. Triangles between
  // materials have both.
  [[nodiscard]] std::string first_flaw() const
  {
    for (const auto& [key, sides] : sides_) {
      if (sides.even > 1 || sides.odd > 1 || sides.on_geometry > 1)
        return "a triangle stands twice";
      if (sides.even + sides.odd + sides.on_geometry < 2) return "a triangle has no mirror";
      if (sides.even + sides.odd == 0) return "a triangle on the geometry has no tet";
    }
    return {};
  }

 private:
  static std::pair<TriangleKey, bool> key_of_triangle(const mesh::Piece& piece, LocalIndex a,
                                                      LocalIndex b, LocalIndex c)
  {
    TriangleKey key{name_of(piece, a), name_of(piece, b), name_of(piece, c)};
    const bool is_even = (key[0] < key[1]) + (key[1] < key[2]) + (key[2] < key[0]) == 2;
    std::sort(key.begin(), key.end());
    return {key, is_even};
  }

  std::map<TriangleKey, Sides> sides_{};
};

std::string flaw_of_piece(const mesh::Piece& piece)
{
  std::vector<char> is_used(at(piece.num_vertices()), 0);
  for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
    const auto [a, b, c, d] = piece.corners(t);
    if (!(tet_volume(a, b, c, d) > 0.0)) return "a tet is not positive";
    for (std::size_t i = 0; i < 4; ++i) is_used[at(piece.tet_vertices[4 * at(t) + i])] = 1;
  }
  if (std::count(is_used.begin(), is_used.end(), 0) != 0) return "a vertex is not used";
  for (LocalIndex i = 0; i < piece.num_boundary(); ++i) {
    const LocalIndex* tet = &piece.tet_vertices[4 * at(piece.boundary_tet[at(i)])];
    const LocalIndex* v = &piece.boundary_vertices[3 * at(i)];
    const bool is_behind = std::any_of(
        mesh::kTetFaceCorners.begin(), mesh::kTetFaceCorners.end(), [&](const auto& face) {
          return mesh::sorted_triangle(tet[face[0]], tet[face[1]], tet[face[2]])
                 == mesh::sorted_triangle(v[0], v[1], v[2]);
        });
    if (!is_behind) return "a triangle on the geometry names a tet that is not behind it";
  }
  return {};
}

std::string flaw_of_shared_vertices(const std::vector<mesh::Piece>& pieces)
{
  std::map<mesh::HostPoint, std::array<std::uint64_t, 3>> positions;
  for (const mesh::Piece& piece : pieces) {
    std::map<mesh::HostPoint, int> times;
    for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
      if (++times[name_of(piece, v)] > 1) return "a piece has a shared vertex twice";
      const auto here = bits(point_at(std::span(piece.vertex_xyz), v));
      if (positions.emplace(name_of(piece, v), here).first->second != here) {
        return "a shared vertex is in two places";
      }
    }
  }
  return {};
}

std::string flaw_of_triangles(const std::vector<mesh::Piece>& pieces)
{
  TriangleCount count;
  for (const mesh::Piece& piece : pieces) {
    count.add_tets(piece);
    count.add_boundary(piece);
  }
  return count.first_flaw();
}

// A piece as the regions of a phase see it.
struct PieceInPhase {
  improve::PiecePart part{};
  std::vector<improve::Band> bands{};
  IndexLists tets{};
  std::vector<improve::RegionExchange> exchanges{};
};

PieceInPhase piece_in_phase(const mesh::Piece& piece, const improve::SeamRegions& regions,
                            int phase, int layers)
{
  PieceInPhase here{.part = improve::whole_piece(piece)};
  const auto labels = improve::label_tets(piece, regions, phase, layers);
  here.bands = improve::make_bands(here.part, labels, regions, phase);
  here.tets = improve::tets_of_bands(here.part, labels, regions, phase);
  return here;
}

improve::RegionOutcome improve_one(const improve::SeamRegions& regions, LocalIndex region,
                                   const ImproveSetup& setup,
                                   const std::vector<PieceInPhase>& pieces)
{
  std::vector<improve::Band> bands;
  for (const LocalIndex s : regions.subdomains_of(region)) {
    bands.push_back(
        pieces[at(s)].bands[row_in(region, regions.regions_of(s, regions.phase_of(region)))]);
  }
  return improve::improve_region(improve::extract_region(bands, regions, region), setup.optimizer,
                                 setup.rounds, setup.measure);
}

// Gives the vertices of some coarse tets to a piece, those on the skeleton first; returns their
// numbers in it by coarse vertex.
std::map<LocalIndex, LocalIndex> add_vertices(const Body& body, std::span<const LocalIndex> tets,
                                              mesh::Piece& piece)
{
  const auto& on_skeleton = body.skeleton.vertex_coarse;
  std::map<LocalIndex, LocalIndex> number;
  const mesh::HostLayout hosts(body.skeleton);
  for (const bool wants_skin : {true, false}) {
    for (const LocalIndex t : tets) {
      for (const LocalIndex v : body.coarse.tet(t)) {
        const auto place = std::lower_bound(on_skeleton.begin(), on_skeleton.end(), v);
        const bool is_skin = place != on_skeleton.end() && *place == v;
        if (is_skin != wants_skin || !number.emplace(v, piece.num_vertices()).second) continue;
        const Vec3 p = body.coarse.position(v);
        piece.vertex_xyz.insert(piece.vertex_xyz.end(), p.begin(), p.end());
        if (!is_skin) continue;
        piece.skin_host.push_back(
            hosts.vertex(static_cast<LocalIndex>(place - on_skeleton.begin())));
        piece.skin_index.push_back(0);
      }
    }
  }
  return number;
}

// The triangles on the geometry that the piece owns, turned outwards.
void add_boundary(const Body& body, const std::map<LocalIndex, LocalIndex>& number,
                  mesh::Piece& piece)
{
  const mesh::Skeleton& skeleton = body.skeleton;
  for (const LocalIndex t : skeleton.triangles_of(piece.subdomain)) {
    if (skeleton.triangle_patch[at(t)] == kNoIndex) continue;
    if (skeleton.triangle_owner(t) != piece.subdomain) continue;
    std::array<LocalIndex, 3> v;
    for (std::size_t c = 0; c < 3; ++c) {
      v[c] = number.at(skeleton.vertex_coarse[at(skeleton.triangle_vertices[3 * at(t) + c])]);
    }
    if (skeleton.triangle_subdomains[2 * at(t)] != piece.subdomain) std::swap(v[1], v[2]);
    piece.boundary_vertices.insert(piece.boundary_vertices.end(), v.begin(), v.end());
    piece.boundary_patch.push_back(skeleton.triangle_patch[at(t)]);
  }
  piece.boundary_tet =
      mesh::match_surface(piece.boundary_vertices, piece.num_skin_vertices(), piece.tet_vertices)
          .triangle_tet;
}

}  // namespace

std::vector<mesh::Piece> coarse_pieces(const Body& body)
{
  const IndexLists tets = mesh::subdomain_tets(body.decomposition);
  std::vector<mesh::Piece> pieces;
  for (LocalIndex s = 0; s < body.num_subdomains(); ++s) {
    mesh::Piece& piece = pieces.emplace_back();
    piece.subdomain = s;
    piece.material = body.decomposition.subdomain_material[at(s)];
    const auto number = add_vertices(body, tets[s], piece);
    for (const LocalIndex t : tets[s]) {
      for (const LocalIndex v : body.coarse.tet(t)) piece.tet_vertices.push_back(number.at(v));
    }
    add_boundary(body, number, piece);
  }
  return pieces;
}

std::size_t row_in(LocalIndex value, std::span<const LocalIndex> ascending)
{
  return static_cast<std::size_t>(std::ranges::lower_bound(ascending, value) - ascending.begin());
}

std::vector<improve::Band> bands_of_region(const std::vector<mesh::Piece>& pieces,
                                           const improve::SeamRegions& regions, LocalIndex region,
                                           int layers)
{
  const int phase = regions.phase_of(region);
  std::vector<improve::Band> bands;
  for (const LocalIndex s : regions.subdomains_of(region)) {
    bands.push_back(piece_in_phase(pieces[at(s)], regions, phase, layers)
                        .bands[row_in(region, regions.regions_of(s, phase))]);
  }
  return bands;
}

PhaseCount improve_phase(const improve::SeamRegions& regions, int phase, const ImproveSetup& setup,
                         std::vector<mesh::Piece>& pieces)
{
  std::vector<PieceInPhase> states;
  for (const mesh::Piece& piece : pieces) {
    states.push_back(piece_in_phase(piece, regions, phase, setup.layers));
  }
  PhaseCount count;
  for (LocalIndex r = regions.first_of_phase(phase); r < regions.first_of_phase(phase + 1); ++r) {
    try {
      const improve::RegionOutcome outcome = improve_one(regions, r, setup, states);
      if (!outcome.is_accepted) {
        count.refusals.push_back(outcome.reason);
        continue;
      }
      ++count.num_accepted;
      count.num_splits += outcome.num_splits;
      const auto subdomains = regions.subdomains_of(r);
      for (std::size_t i = 0; i < subdomains.size(); ++i) {
        PieceInPhase& state = states[at(subdomains[i])];
        const auto row = row_in(r, regions.regions_of(subdomains[i], phase));
        const auto old_tets = state.tets[static_cast<LocalIndex>(row)];
        state.exchanges.push_back({{old_tets.begin(), old_tets.end()}, outcome.updates[i]});
      }
    } catch (const MeshError& error) {
      count.refusals.emplace_back(error.what());
    }
  }
  for (std::size_t s = 0; s < pieces.size(); ++s) {
    pieces[s] = improve::apply_updates(states[s].part, states[s].exchanges).piece;
  }
  return count;
}

improve::ShapeSummary measure_shapes(const improve::TetMesh& tets)
{
  quality::Histogram unused(0.0, 1.0, 1);
  quality::ShapeSum sum(unused);
  const std::span<const double> xyz(tets.vertex_xyz);
  for (std::size_t t = 0; t < tets.tet_vertices.size(); t += 4) {
    const LocalIndex* v = &tets.tet_vertices[t];
    sum.add(quality::shape_of(
        {point_at(xyz, v[0]), point_at(xyz, v[1]), point_at(xyz, v[2]), point_at(xyz, v[3])}));
  }
  const quality::TetStatistics shapes = sum.statistics();
  return {shapes.min_dihedral_deg, shapes.min_mean_ratio, shapes.mean_mean_ratio()};
}

std::string first_flaw(const std::vector<mesh::Piece>& pieces)
{
  for (const mesh::Piece& piece : pieces) {
    if (std::string flaw = flaw_of_piece(piece); !flaw.empty()) return flaw;
  }
  std::string flaw = flaw_of_shared_vertices(pieces);
  return flaw.empty() ? flaw_of_triangles(pieces) : flaw;
}

double volume_of(const std::vector<mesh::Piece>& pieces)
{
  double volume = 0.0;
  for (const mesh::Piece& piece : pieces) {
    for (LocalIndex t = 0; t < piece.num_tets(); ++t) {
      const auto [a, b, c, d] = piece.corners(t);
      volume += tet_volume(a, b, c, d);
    }
  }
  return volume;
}

std::vector<std::vector<char>> vertices_on_seams(const std::vector<mesh::Piece>& pieces)
{
  std::map<std::pair<LocalIndex, mesh::HostPoint>, int> num_holders;
  const auto key = [](const mesh::Piece& piece, LocalIndex v) {
    return std::pair{piece.material, piece.skin_point(v)};
  };
  for (const mesh::Piece& piece : pieces) {
    for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) ++num_holders[key(piece, v)];
  }
  std::vector<std::vector<char>> on_seam;
  for (const mesh::Piece& piece : pieces) {
    auto& here = on_seam.emplace_back(at(piece.num_vertices()), 0);
    for (LocalIndex v = 0; v < piece.num_skin_vertices(); ++v) {
      here[at(v)] = num_holders[key(piece, v)] > 1;
    }
  }
  return on_seam;
}

}  // namespace tessera::testing
