// SPDX-License-Identifier: BSD-3-Clause
#include "formats/link/number_faces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>

#include "tessera/comm/record_exchange.hpp"

namespace tessera::formats {
namespace {

// A seam, known by its tets.
struct Seam {
  std::array<std::uint64_t, 2> tets{};  // Numbers, the lower one first.
  LocalIndex piece = 0;
  GlobalIndex face_number = kNoNumber;

  static auto fields(auto& self) { return std::tie(self.tets, self.piece, self.face_number); }
};

std::vector<GlobalIndex> first_owned_faces(const Outline& outline)
{
  std::vector<GlobalIndex> first{0};
  for (LocalIndex piece = 0; piece < outline.num_pieces(); ++piece)
    first.push_back(first.back() + num_owned_faces(outline, piece));
  return first;
}

// Of a tet's faces those within the piece come first, as all later pieces have higher tets.
void add_seams(const PieceLinks& links, LocalIndex piece, GlobalIndex first_tet,
               GlobalIndex first_face, std::vector<Seam>& seams)
{
  const std::size_t begin = seams.size();
  for (const SeamFace& seam : links.seams) {
    const auto own = static_cast<std::uint64_t>(first_tet + seam.side / 4);
    const auto other = static_cast<std::uint64_t>(seam.other_tet);
    seams.push_back({{std::min(own, other), std::max(own, other)}, piece, kNoNumber});
  }
  std::vector<std::size_t> owned;
  for (std::size_t s = 0; s < links.seams.size(); ++s)
    if (links.seams[s].other_piece > piece) owned.push_back(s);
  std::ranges::sort(owned, {}, [&](std::size_t s) { return seams[begin + s].tets; });
  for (std::size_t i = 0; i < owned.size(); ++i) {
    seams[begin + owned[i]].face_number =
        first_face + links.inner_faces_up_to[owned[i]] + static_cast<GlobalIndex>(i);
  }
}

}  // namespace

GlobalIndex num_inner_faces(const PieceCounts& piece)
{
  GlobalIndex with_two = 4 * piece.num_tets - piece.num_open_faces;
  for (const PieceNeighbour& neighbour : piece.neighbours) with_two -= neighbour.num_shared_faces;
  return with_two / 2;
}

GlobalIndex num_owned_faces(const Outline& outline, LocalIndex piece)
{
  GlobalIndex count = num_inner_faces(outline.pieces[at(piece)]);
  for (const PieceNeighbour& neighbour : outline.pieces[at(piece)].neighbours)
    if (neighbour.piece > piece) count += neighbour.num_shared_faces;
  return count;
}

void number_seam_faces(const Outline& outline, LocalIndex first_piece,
                       const comm::Communicator& comm, std::vector<PieceLinks>& links)
{
  const std::vector<GlobalIndex> first_face = first_owned_faces(outline);
  std::vector<Seam> seams;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const LocalIndex piece = first_piece + static_cast<LocalIndex>(i);
    add_seams(links[i], piece, outline.first_tet[at(piece)], first_face[at(piece)], seams);
  }
  const comm::RecordExchange<Seam> exchange(
      seams, [](const Seam& seam) { return hash_of(seam.tets); }, comm);
  const std::span<const Seam> received = exchange.received();
  std::vector<GlobalIndex> numbers(received.size(), kNoNumber);
  comm::for_each_group(
      received, [](const Seam& seam) { return seam.tets; },
      [](const Seam& seam) { return seam.piece; },
      [&](std::span<const std::size_t> rows) {
        for (const std::size_t row : rows) numbers[row] = received[rows[0]].face_number;
      });
  const auto answers = exchange.answer<GlobalIndex>(numbers, comm);
  auto answer = answers.begin();
  for (PieceLinks& own : links)
    for (SeamFace& seam : own.seams) seam.face_number = *answer++;
}

}  // namespace tessera::formats
