// SPDX-License-Identifier: BSD-3-Clause
#include "formats/link/link_pieces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/record_exchange.hpp"
#include "tessera/mesh/tet_topology.hpp"

#include "formats/count_elements.hpp"
#include "formats/link/link_edges.hpp"
#include "formats/link/match_nodes.hpp"
#include "formats/link/number_faces.hpp"
#include "formats/link/tets_behind.hpp"
#include "formats/name_tags.hpp"
#include "formats/patch_points.hpp"

namespace tessera::formats {
namespace {

// A face that one tet of a piece has.
struct OpenFace {
  TriangleKey key{};
  LocalIndex piece = 0;
  LocalIndex side = 0;
  LocalIndex cell = 0;  // Of the tet.

  static auto fields(auto& self) { return std::tie(self.key, self.piece, self.side, self.cell); }
};

// A point on such a face.
struct SkinPoint {
  VertexKey key{};
  LocalIndex piece = 0;
  LocalIndex row = 0;  // In its file, and later among the own points of its owner.

  static auto fields(auto& self) { return std::tie(self.key, self.piece, self.row); }
};

struct OtherSide {
  LocalIndex piece = kNoIndex;
  LocalIndex tet = 0;
  LocalIndex cell = 0;

  static auto fields(auto& self) { return std::tie(self.piece, self.tet, self.cell); }
};

// Those of a piece, as in its file.
struct Triangles {
  std::vector<LocalIndex> side{};
  std::vector<std::int32_t> patch{};
};

// What is found while a piece is there.
struct Skin {
  std::vector<OpenFace> faces{};
  IndexLists face_points{};                     // Rows of the faces' points, corners first.
  std::vector<LocalIndex> inner_faces_up_to{};  // Of each, see PieceLinks.
  std::vector<SkinPoint> points{};
};

// Of corners alone: match_nodes() sees to it that pieces have the same nodes between them.
TriangleKey key_of_points(const LoadedPiece& piece, const std::vector<LocalIndex>& points)
{
  std::array<VertexKey, 3> keys{piece.point_keys[at(points[0])], piece.point_keys[at(points[1])],
                                piece.point_keys[at(points[2])]};
  std::ranges::sort(keys);
  return key_of_vertices(keys);
}

void add_skin(const LoadedPiece& piece, LocalIndex number, const std::vector<LocalIndex>& behind,
              Skin& skin)
{
  std::vector<bool> is_on_skin(piece.point_keys.size(), false);
  LocalIndex num_inner = 0;
  for (std::size_t side = 0; side < behind.size(); ++side) {
    if (side % 4 == 0) {
      num_inner += static_cast<LocalIndex>(std::ranges::count_if(
          std::span(behind).subspan(side, 4),
          [&](LocalIndex other) { return other > static_cast<LocalIndex>(side / 4); }));
    }
    if (behind[side] != kNoIndex) continue;
    const auto face = static_cast<LocalIndex>(side);
    const std::vector<LocalIndex> points = piece.points_of_side(face);
    skin.faces.push_back(
        {key_of_points(piece, points), number, face, piece.tet_cell[at(face / 4)]});
    skin.face_points.add(points);
    skin.inner_faces_up_to.push_back(num_inner);
    for (const LocalIndex point : points) is_on_skin[at(point)] = true;
  }
  for (LocalIndex row = 0; row < piece.num_points(); ++row) {
    if (is_on_skin[at(row)]) skin.points.push_back({piece.point_keys[at(row)], number, row});
  }
}

GlobalIndex number_of_own(const Outline& outline, const SkinPoint& point)
{
  GlobalIndex number = 0;
  for (const PointRun& run : outline.own_points(point.piece))
    if (point.row >= run.first_row) number = run.first_number + point.row - run.first_row;
  return number;
}

// Pieces of a rank under way to being linked.
class Linker {
 public:
  Linker(const PieceSource& source, const comm::Communicator& comm, const LinkOptions& options)
      : source_(source), comm_(comm), options_(options), first_(source.first_of(comm.rank()))
  {
    const auto num_own = at(source.first_of(comm.rank() + 1) - first_);
    links_.resize(num_own);
    counts_.resize(num_own);
  }

  void look_at_pieces(const std::function<void()>& before_each)
  {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      before_each();
      const LocalIndex number = first_ + static_cast<LocalIndex>(i);
      const LoadedPiece piece = source_.load(number);
      const std::vector<LocalIndex> behind = tets_behind(piece.num_points(), piece.tet_points);
      add_skin(piece, number, behind, skin_);
      add_skin_nodes(piece, number, behind, skin_nodes_);
      if (options_.shared_edges) skin_edges_.push_back(skin_edges(piece, behind));
      add_triangles(piece, behind, links_[i]);
      counts_[i] = {.num_own_nodes = piece.num_nodes,  // Of foreign ones it is not known yet.
                    .num_points = piece.num_points(),
                    .num_tets = piece.num_tets(),
                    .num_cells = piece.tet_cell.empty() ? 0 : piece.tet_cell.back() + 1,
                    .points_per_tet = piece.points_per_tet(),
                    .elements = counted_elements(piece),
                    .box = bounding_box(piece.point_xyz)};
      triangles_.push_back({piece.triangle_side, piece.patch});
      halves_.push_back(source_.has_boundary() ? std::vector<SideHalves>{}
                                               : skin_halves(piece, behind));
    }
  }

  void match_nodes() { require_same_nodes(std::exchange(skin_nodes_, {}), source_, comm_); }

  void link_faces()
  {
    const comm::RecordExchange<OpenFace> exchange(
        skin_.faces, [](const OpenFace& face) { return hash_of(face.key); }, comm_);
    const std::span<const OpenFace> received = exchange.received();
    std::vector<OtherSide> others(received.size());
    bool has_third = false;
    comm::for_each_group(
        received, [](const OpenFace& face) { return face.key; },
        [](const OpenFace& face) { return std::tuple(face.piece, face.side); },
        [&](std::span<const std::size_t> rows) {
          if (rows.size() > 2) has_third = true;
          if (rows.size() < 2) return;
          const auto other_side = [&](const OpenFace& face) {
            return OtherSide{face.piece, face.side / 4, face.cell};
          };
          others[rows[0]] = other_side(received[rows[1]]);
          others[rows[1]] = other_side(received[rows[0]]);
        });
    if (comm_.sum(has_third ? 1 : 0) > 0)
      throw comm::Collective<InputError>(
          "the mesh has a triangle on more than two tets; `tessera check` says where");
    const auto answers = exchange.answer<OtherSide>(others, comm_);
    for (std::size_t f = 0; f < skin_.faces.size(); ++f) {
      const OpenFace& face = skin_.faces[f];
      PieceLinks& links = links_of(face.piece);
      if (answers[f].piece == kNoIndex) {
        links.open_sides.push_back(face.side);
        if (options_.patch_points && !source_.has_boundary())
          add_patch_points(skin_.face_points[static_cast<LocalIndex>(f)], 0, links.patch_points);
      } else {
        links.seams.push_back({face.side, answers[f].piece, answers[f].tet, answers[f].cell});
        links.inner_faces_up_to.push_back(skin_.inner_faces_up_to[f]);
      }
    }
    skin_.faces = {};
    skin_.face_points = {};
    skin_.inner_faces_up_to = {};
  }

  void mark_inner_triangles()
  {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      PieceLinks& links = links_[i];
      const auto num_open = static_cast<GlobalIndex>(links.open_sides.size());
      counts_[i].num_open_faces = num_open;
      std::vector<std::int32_t> outer_patches;
      for (std::size_t t = 0; t < triangles_[i].side.size(); ++t) {
        if (std::ranges::binary_search(links.seams, triangles_[i].side[t], {}, &SeamFace::side))
          links.is_inner_triangle[t] = 1;
        if (links.is_inner_triangle[t] == 0) outer_patches.push_back(triangles_[i].patch[t]);
      }
      counts_[i].outer_triangles_of_patch = counted(outer_patches);
      if (source_.has_boundary()) continue;
      links.is_inner_triangle.assign(links.open_sides.size(), 0);
      count_open_faces(links.open_sides, halves_[i], counts_[i]);
    }
    triangles_ = {};
    halves_ = {};
  }

  void link_points()
  {
    const comm::RecordExchange<SkinPoint> exchange(
        skin_.points, [](const SkinPoint& point) { return hash_of(point.key); }, comm_);
    std::vector<OtherPieces> others(exchange.received().size());
    for_each_shared(exchange.received(), [&](std::span<const std::size_t> rows) {
      for (const std::size_t row : rows)
        for (const std::size_t other : rows)
          if (other != row) others[row].pieces.push_back(exchange.received()[other].piece);
    });
    const auto answers = exchange.answer<OtherPieces>(others, comm_);
    std::vector<SkinPoint> shared;
    for (std::size_t p = 0; p < skin_.points.size(); ++p) {
      if (answers[p].pieces.empty()) continue;
      shared.push_back(skin_.points[p]);
      PieceLinks& links = links_of(skin_.points[p].piece);
      links.shared_points.push_back(skin_.points[p].row);
      links.sharers.add(answers[p].pieces);
    }
    skin_.points = std::move(shared);
    count_shared();
    if (options_.shared_edges) link_edges(std::exchange(skin_edges_, {}), first_, comm_, links_);
  }

  // Needs to know where the numbers of each piece begin.
  void number_shared_points(const Outline& outline)
  {
    for (SkinPoint& point : skin_.points) point.row = own_row(point);
    const comm::RecordExchange<SkinPoint> exchange(
        skin_.points, [](const SkinPoint& point) { return hash_of(point.key); }, comm_);
    const std::span<const SkinPoint> received = exchange.received();
    std::vector<GlobalIndex> numbers(received.size(), kNoNumber);
    for_each_shared(received, [&](std::span<const std::size_t> rows) {
      const SkinPoint& owner = received[rows[0]];
      for (const std::size_t row : rows.subspan(1)) numbers[row] = number_of_own(outline, owner);
    });
    const auto answers = exchange.answer<GlobalIndex>(numbers, comm_);
    for (std::size_t p = 0; p < skin_.points.size(); ++p)
      links_of(skin_.points[p].piece).shared_numbers.push_back(answers[p]);
    for (PieceLinks& links : links_)
      for (SeamFace& seam : links.seams) {
        seam.other_tet += outline.first_tet[at(seam.other_piece)];
        seam.other_cell += outline.first_cell[at(seam.other_piece)];
      }
    if (options_.face_numbers && !outline.has_prisms())
      number_seam_faces(outline, first_, comm_, links_);
  }

  /// @return How many points of each patch each piece has.
  std::vector<std::vector<TagCount>> link_patch_points(const Tags& tags)
  {
    std::vector<VertexKey> keys;
    keys.reserve(skin_.points.size());
    for (const SkinPoint& point : skin_.points) keys.push_back(point.key);
    share_out_patch_points(links_, keys, tags, first_, comm_);
    std::vector<std::vector<TagCount>> counts;
    for (const PieceLinks& links : links_) {
      std::vector<std::int32_t> patches;
      for (const PatchPoint& point : links.patch_points) patches.push_back(point.patch);
      counts.push_back(counted(patches));
    }
    return counts;
  }

  [[nodiscard]] const std::vector<PieceCounts>& counts() const { return counts_; }
  [[nodiscard]] std::vector<PieceLinks> take_links() { return std::move(links_); }

 private:
  PieceLinks& links_of(LocalIndex piece) { return links_[at(piece - first_)]; }

  void add_triangles(const LoadedPiece& piece, const std::vector<LocalIndex>& behind,
                     PieceLinks& links) const
  {
    for (std::size_t t = 0; t < piece.triangle_side.size(); ++t) {
      const LocalIndex side = piece.triangle_side[t];
      links.is_inner_triangle.push_back(behind[at(side)] == kNoIndex ? 0 : 1);
      if (options_.patch_points)
        add_patch_points(piece.points_of_side(side), piece.patch[t], links.patch_points);
    }
  }

  template <class Visit>
  static void for_each_shared(std::span<const SkinPoint> points, const Visit& visit)
  {
    comm::for_each_group(
        points, [](const SkinPoint& point) { return point.key; },
        [](const SkinPoint& point) { return std::tuple(point.piece, point.row); }, visit);
  }

  void count_shared()
  {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const LocalIndex number = first_ + static_cast<LocalIndex>(i);
      const GlobalIndex first_node = counts_[i].num_points - counts_[i].num_own_nodes;
      GlobalIndex num_foreign = 0;
      GlobalIndex num_foreign_nodes = 0;
      std::map<LocalIndex, GlobalIndex> shared_with;
      for (LocalIndex p = 0; p < links_[i].sharers.num_lists(); ++p) {
        const auto others = links_[i].sharers[p];
        if (others.front() < number) {
          ++num_foreign;
          if (links_[i].shared_points[at(p)] >= first_node) ++num_foreign_nodes;
        }
        for (const LocalIndex other : others) ++shared_with[other];
      }
      counts_[i].num_own_points = counts_[i].num_points - num_foreign;
      counts_[i].num_own_nodes -= num_foreign_nodes;
      std::map<LocalIndex, GlobalIndex> num_faces;
      for (const SeamFace& seam : links_[i].seams) ++num_faces[seam.other_piece];
      for (const auto& [other, num_points] : shared_with)
        counts_[i].neighbours.push_back({other, num_points, num_faces[other]});
    }
  }

  // Its row once the points of lower pieces are left out. @pre points come in order of their rows.
  LocalIndex own_row(const SkinPoint& point)
  {
    if (point.piece != counted_piece_) {
      counted_piece_ = point.piece;
      next_shared_ = 0;
      num_left_out_ = 0;
    }
    const bool is_own = links_of(point.piece).sharers[next_shared_++].front() > point.piece;
    const LocalIndex row = point.row - num_left_out_;
    if (!is_own) ++num_left_out_;
    return row;
  }

  const PieceSource& source_;
  const comm::Communicator& comm_;
  LinkOptions options_;
  LocalIndex first_;
  std::vector<PieceLinks> links_{};
  std::vector<PieceCounts> counts_{};
  std::vector<Triangles> triangles_{};
  std::vector<std::vector<SideHalves>> halves_{};
  Skin skin_{};
  std::vector<SkinEdges> skin_edges_{};
  std::vector<SkinNode> skin_nodes_{};
  LocalIndex counted_piece_ = kNoIndex;
  LocalIndex next_shared_ = 0;
  LocalIndex num_left_out_ = 0;
};

// @throws InputError, on all ranks if all have the same pieces, if tets are of several orders.
bool are_of_second_order(const std::vector<PieceCounts>& pieces)
{
  const auto has = [&](int points_per_tet) {
    return std::ranges::find(pieces, points_per_tet, &PieceCounts::points_per_tet) != pieces.end();
  };
  if (has(4) && has(10)) {
    throw comm::Collective<InputError>(
        "some pieces have tets of first order, and others of second order");
  }
  return has(10);
}

Outline outline_of(std::vector<PieceCounts> pieces)
{
  Outline outline;
  outline.pieces = std::move(pieces);
  for (const PieceCounts& piece : outline.pieces) {
    outline.first_point.push_back(outline.first_point.back() + piece.num_own_points
                                  - piece.num_own_nodes);
    outline.first_tet.push_back(outline.first_tet.back() + piece.num_tets);
    outline.first_cell.push_back(outline.first_cell.back() + piece.num_cells);
    for (const Shape shape : kAllShapes) {
      GlobalIndex first = outline.first_of[shape].back();
      for (const TagCount& count : piece.elements[shape]) first += count.count;
      outline.first_of[shape].push_back(first);
    }
  }
  if (!are_of_second_order(outline.pieces)) return outline;
  outline.first_node = {outline.first_point.back()};
  for (const PieceCounts& piece : outline.pieces)
    outline.first_node.push_back(outline.first_node.back() + piece.num_own_nodes);
  return outline;
}

}  // namespace

LinkedMesh link_pieces(const PieceSource& source, const comm::Communicator& comm,
                       const std::function<void()>& before_each, const LinkOptions& options)
{
  Linker linker(source, comm, options);
  all_or_none(comm, [&] { linker.look_at_pieces(before_each); });
  linker.match_nodes();
  linker.link_faces();
  linker.mark_inner_triangles();
  linker.link_points();
  LinkedMesh mesh;
  mesh.outline = outline_of(comm.all_gather_rows(linker.counts()));
  mesh.tags = name_tags(source.names(), mesh.outline);
  if (options.patch_points) {
    const auto points_of_patch = comm.all_gather_rows(linker.link_patch_points(mesh.tags));
    for (std::size_t p = 0; p < points_of_patch.size(); ++p)
      mesh.outline.pieces[p].points_of_patch = points_of_patch[p];
  }
  linker.number_shared_points(mesh.outline);
  mesh.links = linker.take_links();
  return mesh;
}

}  // namespace tessera::formats
