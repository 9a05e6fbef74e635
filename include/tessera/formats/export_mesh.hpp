// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "tessera/comm/communicator.hpp"
#include "tessera/formats/piece.hpp"
#include "tessera/io/options.hpp"
#include "tessera/io/vtu.hpp"

namespace tessera::formats {

/// @brief What is to be written of a mesh, and where.
struct ExportRequest {
  std::filesystem::path mesh{};       ///< A .pvtu or .vtu file of tets.
  std::vector<io::Format> formats{};  ///< Of io::Format::pvtu there is nothing to do.
  std::filesystem::path folder{};     ///< Exists.
  io::LayerCells layers = io::LayerCells::prisms;
};

/// @brief Writes a mesh in other formats. Every piece is read twice, once to find what it shares
/// with others and once to write it; a rank holds one piece, and what its pieces share with others.
/// The files are the same for any number of ranks. Each appears under its name when it is complete.
/// @note Collective.
/// @param[in] before_each Called before each piece is read; what it throws, all ranks throw.
/// @return What all ranks know of the mesh.
/// @throws on all ranks InputError naming the file if a piece is damaged or does not fit the
/// others; ConfigError if a format cannot hold the mesh; OutputError naming the file.
Outline export_mesh(const ExportRequest& request, const comm::Communicator& comm,
                    const std::function<void()>& before_each);

/// @brief What pieces have and share, from their files alone: the first of the two readings.
/// @note Collective. @throws as export_mesh().
[[nodiscard]] Outline outline_of(const std::filesystem::path& mesh, const comm::Communicator& comm,
                                 const std::function<void()>& before_each);

/// @brief The pairs of pieces that share points, ascending. Local.
[[nodiscard]] std::vector<io::SharedPoints> shared_points(const std::vector<PieceCounts>& pieces);

/// @brief Refuses tets of second order in a format that does not hold them. Local.
/// @throws ConfigError naming those that do.
void require_order_possible(io::Format format, bool is_second_order);

/// @brief Bytes on disk for each tet of a large mesh, beside the piece files. Local.
[[nodiscard]] double bytes_per_tet(io::Format format);

}  // namespace tessera::formats
