// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

namespace tessera::pipeline {

/// @brief PREFIX, where this program is PREFIX/bin/NAME. Local.
[[nodiscard]] std::filesystem::path install_prefix();

/// @brief The folder of the Open MPI that was packed with this program (`cpack -G TGZ -D
/// TESSERA_MPI_INSIDE=ON`), if one was. Local.
[[nodiscard]] std::optional<std::filesystem::path> mpi_inside();

/// @brief Lets Open MPI find its parts in that folder, and nowhere else. Before MPI_Init, and
/// before mpirun begins. Local.
void use_mpi_inside(const std::filesystem::path& folder);

/// @brief Whether an mpirun has started this process that is not the one of that folder: such ranks
/// would not find each other. Before use_mpi_inside(). Local.
[[nodiscard]] bool is_rank_of_other_mpi(const std::filesystem::path& folder);

}  // namespace tessera::pipeline
