// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace tessera::pipeline {

/// @brief Arrays of whole numbers as text for a page, small, read by web/arrays.js.
///
/// Of each array the differences between neighbours are kept, the first one from 0, modulo
/// 2^(8 width). A difference d, from -2^(8 width - 1) on, is 2 d, or -2 d - 1 if it is negative.
/// First stand the lowest bytes of all values, then the next ones. The arrays stand one behind the
/// other. All of it is deflated (zlib), and in base64.
class PackedArrays {
 public:
  /// @param[in] width Bytes of a value: 1, 2 or 4. @pre Each value fits.
  void add(const std::string& name, std::size_t width, std::span<const std::uint32_t> values);

  /// @brief Name, width and size of each array, in their order.
  [[nodiscard]] const nlohmann::ordered_json& layout() const { return layout_; }

  [[nodiscard]] std::string text() const;

 private:
  nlohmann::ordered_json layout_ = nlohmann::ordered_json::array();
  std::vector<std::uint8_t> bytes_{};
};

}  // namespace tessera::pipeline
