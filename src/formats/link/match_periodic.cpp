// SPDX-License-Identifier: BSD-3-Clause
#include "formats/link/match_periodic.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/find_partners.hpp"
#include "tessera/mesh/periodic_pairs.hpp"
#include "tessera/mesh/side_places.hpp"

namespace tessera::formats {
namespace {

// Of a name; 0 if there is none.
std::int32_t tag_of(const std::string& name, const Outline& outline)
{
  const auto found = std::ranges::find(outline.patch_names, name);
  if (found == outline.patch_names.end()) return 0;
  return static_cast<std::int32_t>(found - outline.patch_names.begin()) + 1;
}

bool has_points(std::int32_t patch, const Outline& outline)
{
  return std::ranges::any_of(outline.pieces, [&](const PieceCounts& piece) {
    return std::ranges::find(piece.points_of_patch, patch, &TagCount::tag)
           != piece.points_of_patch.end();
  });
}

// A point that is the image of none.
struct Missing {
  LocalIndex piece = 0;
  LocalIndex point = 0;
  std::string text{};

  static auto fields(auto& self) { return std::tie(self.piece, self.point, self.text); }
};

// Matches points by mesh::for_each_side_place().
class PatchMatcher {
 public:
  PatchMatcher(const Outline& outline, const std::vector<PeriodicPatch>& patches)
      : outline_(outline), patches_(patches)
  {
  }

  // Pieces come in their order.
  void add(const Piece& piece)
  {
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      add_originals(piece, p);
      add_images(piece, p);
    }
  }

  // Collective. @return By this rank's pieces, of which `first` is the first one.
  [[nodiscard]] std::vector<std::vector<PeriodicPoint>> find(LocalIndex first,
                                                             std::size_t num_pieces,
                                                             const comm::Communicator& comm) const
  {
    const std::vector<GlobalIndex> partners = comm::find_partners(places_, comm);
    std::vector<std::vector<PeriodicPoint>> found(num_pieces);
    // Of two pairs with one patch of images a point may be in either.
    std::map<std::tuple<LocalIndex, LocalIndex, std::int32_t>, const Image*> missing;
    const auto key_of = [&](const Image& image) {
      return std::tuple(image.piece, image.point, patches_[at(image.patch)].to);
    };
    for (const Image& image : images_) {
      const GlobalIndex partner = partners[image.asks_as];
      if (partner == comm::kNoPartner)
        missing.emplace(key_of(image), &image);
      else
        found[at(image.piece - first)].push_back({image.patch, image.point, partner});
    }
    for (const Image& image : images_)
      if (partners[image.asks_as] != comm::kNoPartner) missing.erase(key_of(image));
    std::vector<Missing> first_missing;
    if (!missing.empty()) first_missing.push_back(to_missing(*missing.begin()->second));
    require_none(comm.all_gather_rows(first_missing));
    return found;
  }

 private:
  struct Image {
    LocalIndex piece = 0;
    std::int32_t patch = 0;  // A row of patches_.
    LocalIndex point = 0;
    std::size_t asks_as = 0;  // A row of places_.
    Vec3 position{};
  };

  // Calls `visit(row, place)` for each point of each triangle of a patch.
  template <class Visit>
  void for_each_place(const Piece& piece, std::int32_t tag, const Visit& visit) const
  {
    const std::size_t width = outline_.points_per_triangle();
    const std::span<const double> xyz(piece.point_xyz);
    for (std::size_t t = 0; t < piece.triangle_patch.size(); ++t) {
      if (piece.triangle_patch[t] != tag) continue;
      mesh::for_each_side_place(xyz, std::span(piece.triangle_points).subspan(width * t, width),
                                visit);
    }
  }

  void add_originals(const Piece& piece, std::size_t p)
  {
    for_each_place(piece, patches_[p].from, [&](LocalIndex row, const Vec3& place) {
      places_.push_back({.place = patches_[p].there(place),
                         .label = piece.point_numbers[at(row)],
                         .group = static_cast<std::int32_t>(p)});
    });
  }

  // Of the triangles with a point, one asks for it.
  void add_images(const Piece& piece, std::size_t p)
  {
    std::vector<bool> is_to_ask(at(piece.num_points()), false);
    for (const PatchPoint& point : piece.patch_points)
      if (point.patch == patches_[p].to) is_to_ask[at(point.point)] = true;
    const std::size_t first = images_.size();
    for_each_place(piece, patches_[p].to, [&](LocalIndex row, const Vec3& place) {
      if (!is_to_ask[at(row)]) return;
      is_to_ask[at(row)] = false;
      const auto group = static_cast<std::int32_t>(p);
      images_.push_back(
          {piece.number, group, row, places_.size(), point_at(std::span(piece.point_xyz), row)});
      places_.push_back({.place = place, .group = group, .is_image = true});
    });
    std::sort(images_.begin() + static_cast<std::ptrdiff_t>(first), images_.end(),
              [](const Image& a, const Image& b) { return a.point < b.point; });
  }

  static void require_none(const std::vector<Missing>& missing)
  {
    const auto place = [](const Missing& one) { return std::tuple(one.piece, one.point); };
    if (!missing.empty())
      throw comm::Collective<InputError>(std::ranges::min_element(missing, {}, place)->text);
  }

  [[nodiscard]] Missing to_missing(const Image& image) const
  {
    const auto& [x, y, z] = image.position;
    const auto name = [&](std::int32_t tag) { return outline_.patch_names[at(tag - 1)]; };
    const PeriodicPatch& patch = patches_[at(image.patch)];
    return {
        image.piece, image.point,
        fmt::format("the point at ({:.9g}, {:.9g}, {:.9g}) of patch \"{}\" is the image of none of "
                    "\"{}\", though the files call them periodic; `tessera check` lists such "
                    "points",
                    x, y, z, name(patch.to), name(patch.from))};
  }

  const Outline& outline_;
  const std::vector<PeriodicPatch>& patches_;
  std::vector<comm::SidePoint> places_{};  // Their groups are rows of patches_.
  std::vector<Image> images_{};            // By piece, by patch, by point.
};

}  // namespace

std::vector<PeriodicPatch> periodic_patches(const FileNames& names, const Outline& outline)
{
  std::vector<PeriodicPatch> patches;
  for (const mesh::PeriodicPair& pair : mesh::periodic_pairs(names.periodic)) {
    const std::int32_t from = tag_of(pair.from, outline);
    const std::int32_t to = tag_of(pair.to, outline);
    if (has_points(from, outline) && has_points(to, outline))
      patches.push_back({.from = from, .to = to, .there = pair.there});
  }
  return patches;
}

std::vector<std::vector<PeriodicPoint>> match_periodic_points(
    const PieceSource& source, LinkedMesh& mesh, const comm::Communicator& comm,
    const std::function<void()>& before_each)
{
  std::vector<PeriodicPatch>& patches = mesh.outline.periodic;
  PatchMatcher matcher(mesh.outline, patches);
  all_or_none(comm, [&] {
    for_each_piece(source, mesh, comm.rank(), before_each,
                   [&](const Piece& piece, std::size_t) { matcher.add(piece); });
  });
  auto points = matcher.find(source.first_of(comm.rank()), mesh.links.size(), comm);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    std::vector<GlobalIndex> counts;
    for (const auto& of_piece : points)
      counts.push_back(
          std::ranges::count(of_piece, static_cast<std::int32_t>(p), &PeriodicPoint::patch));
    for (const GlobalIndex count : comm.all_gather_rows(counts))
      patches[p].first_point.push_back(patches[p].first_point.back() + count);
  }
  return points;
}

}  // namespace tessera::formats
