// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace tessera::pipeline {

/// @brief The page of a mesh to turn and to point at, from its files alone: from `boundary.pvtu`
/// beside its index. With `report.json` beside them it also knows areas and the worst tets. Local.
/// @param[in] before_each Called before each file is read.
/// @throws InputError naming the file if one cannot be read, or there is no boundary.
[[nodiscard]] std::string mesh_page(const std::filesystem::path& index,
                                    const std::function<void()>& before_each);

}  // namespace tessera::pipeline
