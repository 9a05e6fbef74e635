// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace tessera::pipeline {

/// @brief What pipeline/viewer/web holds, compiled in.
struct ViewerFiles {
  std::string_view style{};
  std::string_view markup{};
  std::string_view script{};  ///< All .js files, one behind the other.
};

[[nodiscard]] ViewerFiles viewer_files();

}  // namespace tessera::pipeline
