// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/comm/communicator.hpp"
#include "tessera/migrate/distributed_mesh.hpp"
#include "tessera/migrate/tet_neighbours.hpp"

#include "migrate/partition/part_graph.hpp"

namespace tessera::migrate {

inline constexpr LocalIndex kNoPart = -1;

/// @brief The parts of a rank's tets and of the tets beside them.
class PartView {
 public:
  /// @note Collective. @param[in] tet_part of this rank's tets; kNoPart for tets to be left out.
  PartView(const comm::Communicator& comm, const TetNeighbours& neighbours,
           std::vector<LocalIndex> tet_part);

  [[nodiscard]] LocalIndex num_tets() const { return static_cast<LocalIndex>(tet_part_.size()); }
  [[nodiscard]] LocalIndex part(LocalIndex tet) const { return tet_part_[at(tet)]; }

  /// @brief Tet of this rank behind a face, or kNoIndex.
  [[nodiscard]] LocalIndex tet_behind(LocalIndex tet, std::size_t corner) const
  {
    const LocalIndex behind = neighbours_.behind[4 * at(tet) + corner];
    return behind < num_tets() ? behind : kNoIndex;
  }

  /// @brief Part of the tet behind a face, on whatever rank; kNoPart if there is none.
  [[nodiscard]] LocalIndex part_behind(LocalIndex tet, std::size_t corner) const
  {
    const LocalIndex behind = neighbours_.behind[4 * at(tet) + corner];
    if (behind == kNoIndex) return kNoPart;
    return behind < num_tets() ? tet_part_[at(behind)]
                               : static_cast<LocalIndex>(remote_part_[at(behind - num_tets())]);
  }

 private:
  const TetNeighbours& neighbours_;
  std::vector<LocalIndex> tet_part_;
  std::vector<GlobalIndex> remote_part_;
};

/// @brief The components of the parts: each tet's lowest tet that can be reached inside its part.
/// Local. @pre each part is on one rank.
[[nodiscard]] std::vector<LocalIndex> components_of_parts(const PartView& view);

/// @brief Sizes of all parts and who is beside whom, on every rank.
/// @note Collective.
[[nodiscard]] PartGraph graph_of_parts(const comm::Communicator& comm, const PartView& view,
                                       LocalIndex num_parts);

/// @brief The tets that a part of this rank gives to a neighbour. They are taken from the triangles
/// between the two inwards, so that both parts stay connected if they are. Local.
/// @param[in] max_tets No more than so many; the wish is transfer.num_tets.
/// @return Nothing if it cannot be done.
[[nodiscard]] std::vector<LocalIndex> choose_tets(const PartView& view, const Transfer& transfer,
                                                  GlobalIndex max_tets);

}  // namespace tessera::migrate
