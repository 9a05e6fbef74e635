// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace tessera::netgen {

/// @brief Understands what NETGEN's surface meshers say: whether they get on, and whether it is
/// already clear that no surface will come. It counts NETGEN's own steps and no seconds, so what it
/// finds is the same on every machine.
class SurfaceMessages {
 public:
  /// @brief Takes the next line.
  /// @return Whether it shows progress.
  bool read(const std::string& line);

  /// @brief Why no surface will come; empty: nothing is known.
  [[nodiscard]] const std::string& verdict() const noexcept { return verdict_; }

 private:
  bool read_open_segments(long count);
  void read_refinement();

  long last_elements_ = -1;
  long fewest_open_ = std::numeric_limits<long>::max();
  bool is_repairing_ = false;  ///< NETGEN goes over its own surface: only fewer gaps are progress.
  int refinements_without_ = 0;
  std::string face_{};
  std::string verdict_{};
};

}  // namespace tessera::netgen
