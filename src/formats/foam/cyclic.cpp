// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam/cyclic.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/find_partners.hpp"

#include "formats/foam/case.hpp"
#include "formats/foam/faces.hpp"

namespace tessera::formats {
namespace {

void require_one_partner_each(const Outline& outline)
{
  std::vector<std::int32_t> tags;
  for (const PeriodicPatch& pair : outline.periodic) {
    for (const std::int32_t tag : {pair.from, pair.to}) {
      if (std::ranges::find(tags, tag) != tags.end())
        throw ConfigError(fmt::format(
            "patch \"{}\" is in two pairs of periodic patches, but a cyclic patch of OpenFOAM has "
            "one partner; give its faces names of their own with [[geometry.name]]",
            outline.patch_names[at(tag - 1)]));
      tags.push_back(tag);
    }
  }
}

// Numbers of the originals of a pair. Triangles come first: so the corners before a face are known
// from its number.
struct Numbers {
  Places triangles;
  Places quads;

  Numbers(const Outline& outline, std::int32_t tag)
      : triangles(
          outline, 0,
          [&](LocalIndex piece) { return foam_patch_count(outline, piece, tag).num_triangles(); }),
        quads(outline, triangles.end(),
              [&](LocalIndex piece) { return foam_patch_count(outline, piece, tag).num_quads(); })
  {
  }

  [[nodiscard]] LocalIndex piece_with(GlobalIndex number) const
  {
    return (number < triangles.end() ? triangles : quads).piece_with(number);
  }
};

// Matches faces by the places of their first points within them, half way to the centre. An
// original has its place there for the point that it begins with; an image asks at all of its
// points, and begins with the one that finds something.
class FaceMatcher {
 public:
  explicit FaceMatcher(const Outline& outline) : outline_(outline)
  {
    for (const PeriodicPatch& pair : outline.periodic) numbers_.emplace_back(outline, pair.from);
  }

  // Pieces come in their order.
  void add(const Piece& piece)
  {
    for (std::size_t p = 0; p < outline_.periodic.size(); ++p) {
      add_faces(piece, p, false);
      add_faces(piece, p, true);
    }
  }

  // Collective. @return By this rank's pieces, of which `first` is the first one.
  [[nodiscard]] std::vector<std::vector<CyclicFace>> find(LocalIndex first, std::size_t num_pieces,
                                                          const comm::Communicator& comm) const
  {
    const std::vector<GlobalIndex> partners = comm::find_partners(places_, comm);
    std::vector<std::vector<CyclicFace>> found(num_pieces);
    all_or_none(comm, [&] {
      for (const Side& side : sides_)
        found[at(side.piece - first)].push_back(with_partner(side, partners));
    });
    for (auto& faces : found) {
      std::ranges::sort(faces, {},
                        [](const CyclicFace& face) { return std::pair(face.patch, face.number); });
    }
    return found;
  }

 private:
  struct Side {
    std::size_t pair = 0;
    bool is_image = false;
    LocalIndex piece = 0;
    LocalIndex row = 0;      // Among the faces of its patch.
    GlobalIndex number = 0;  // Of an original.
    FoamFace face{};
    Vec3 centre{};
    std::size_t asks_as = 0;  // First row of places_.

    [[nodiscard]] std::size_t num_places() const { return is_image ? face.corners().size() : 1; }
  };

  void add_faces(const Piece& piece, std::size_t p, bool is_image)
  {
    const PeriodicPatch& pair = outline_.periodic[p];
    const std::vector<FoamFace> faces = foam_patch_faces(piece, is_image ? pair.to : pair.from);
    GlobalIndex next_triangle = numbers_[p].triangles.of(piece.number);
    GlobalIndex next_quad = numbers_[p].quads.of(piece.number);
    for (std::size_t row = 0; row < faces.size(); ++row) {
      GlobalIndex& next = faces[row].num_points == 3 ? next_triangle : next_quad;
      add({.pair = p,
           .is_image = is_image,
           .piece = piece.number,
           .row = static_cast<LocalIndex>(row),
           .number = is_image ? 0 : next++,
           .face = faces[row],
           .asks_as = places_.size()},
          piece.point_xyz);
    }
  }

  void add(Side side, std::span<const double> xyz)
  {
    const PeriodicPatch& pair = outline_.periodic[side.pair];
    const auto corners = side.face.corners();
    for (const LocalIndex corner : corners) side.centre = side.centre + point_at(xyz, corner);
    side.centre = (1.0 / static_cast<double>(corners.size())) * side.centre;
    for (const LocalIndex corner : corners.first(side.num_places())) {
      const Vec3 place = midpoint(point_at(xyz, corner), side.centre);
      places_.push_back({.place = side.is_image ? place : pair.there(place),
                         .label = side.is_image ? side.piece : side.number,
                         .group = static_cast<std::int32_t>(side.pair),
                         .is_image = side.is_image});
    }
    sides_.push_back(side);
  }

  [[nodiscard]] CyclicFace with_partner(const Side& side,
                                        std::span<const GlobalIndex> partners) const
  {
    const auto asked = partners.subspan(side.asks_as, side.num_places());
    const auto answer = std::ranges::find_if(
        asked, [](GlobalIndex partner) { return partner != comm::kNoPartner; });
    if (answer == asked.end()) throw InputError(missing_text(side));
    if (!side.is_image) return original(side, *answer);
    return image(side, static_cast<std::size_t>(answer - asked.begin()), *answer);
  }

  [[nodiscard]] CyclicFace original(const Side& side, GlobalIndex piece_of_image) const
  {
    return {.patch = outline_.periodic[side.pair].from,
            .number = side.number,
            .row = side.row,
            .other_piece = static_cast<LocalIndex>(piece_of_image),
            .first_point = side.face.points[0]};
  }

  [[nodiscard]] CyclicFace image(const Side& side, std::size_t point, GlobalIndex number) const
  {
    return {.patch = outline_.periodic[side.pair].to,
            .number = number,
            .row = side.row,
            .other_piece = numbers_[side.pair].piece_with(number),
            .first_point = side.face.points[point]};
  }

  [[nodiscard]] std::string missing_text(const Side& side) const
  {
    const PeriodicPatch& pair = outline_.periodic[side.pair];
    const auto [own, other] =
        side.is_image ? std::pair(pair.to, pair.from) : std::pair(pair.from, pair.to);
    const auto& [x, y, z] = side.centre;
    return fmt::format(
        "the face at ({:.9g}, {:.9g}, {:.9g}) of patch \"{}\" has no partner on \"{}\", though "
        "the files call them periodic; `tessera check` lists their points",
        x, y, z, outline_.patch_names[at(own - 1)], outline_.patch_names[at(other - 1)]);
  }

  const Outline& outline_;
  std::vector<Numbers> numbers_{};         // By pair.
  std::vector<comm::SidePoint> places_{};  // Their groups are rows of Outline::periodic.
  std::vector<Side> sides_{};              // By piece.
};

}  // namespace

std::vector<std::vector<CyclicFace>> match_cyclic_faces(const PieceSource& source,
                                                        const LinkedMesh& mesh,
                                                        const comm::Communicator& comm,
                                                        const std::function<void()>& before_each)
{
  FaceMatcher matcher(mesh.outline);
  all_or_none(comm, [&] {
    require_one_partner_each(mesh.outline);
    for_each_piece(source, mesh, comm.rank(), before_each,
                   [&](const Piece& piece, std::size_t) { matcher.add(piece); });
  });
  return matcher.find(source.first_of(comm.rank()), mesh.links.size(), comm);
}

}  // namespace tessera::formats
