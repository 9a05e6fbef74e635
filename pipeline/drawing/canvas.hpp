// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tessera/base/types.hpp"
#include "tessera/base/vec3.hpp"

#include "pipeline/drawing/png.hpp"

namespace tessera::pipeline {

/// @brief From where something is looked at; unit vectors.
struct View {
  Vec3 right{};
  Vec3 up{};
  Vec3 towards{};  ///< The eye.
};

/// @brief The view of an eye that is far away in that direction; z is up. Local.
/// @pre the direction is not along z.
[[nodiscard]] View view_from(const Vec3& direction);

/// @brief Where points of space are on a picture.
struct Camera {
  View view{};
  int width = 0;  ///< Pixels.
  int height = 0;
  Vec3 middle{};       ///< Of what is seen, in the axes of the view.
  double scale = 1.0;  ///< Pixels a unit of length.

  /// @brief Pixels from the left and from the top, and pixels towards the eye.
  [[nodiscard]] Vec3 on_picture(const Vec3& p) const;
};

/// @brief Room on a picture, pixels.
struct Room {
  int width = 0;
  int most_height = 0;
  int margin = 0;
};

/// @brief A camera that has all points on its picture, which is no higher than it needs to be; at
/// least a quarter of its width. Local.
/// @param[in] xyz Shape (num_points, 3).
[[nodiscard]] Camera fit_camera(const View& view, std::span<const double> xyz, const Room& room);

/// @brief Which sides of a triangle are drawn as lines.
enum class Sides { hidden, drawn };

/// @brief A picture in the making: for each pixel the triangle next to the eye.
///
/// A pixel is one number, larger for what is in front. Canvases are put together by the larger
/// number. So the order in which triangles are drawn, and who draws them, changes nothing. Of
/// triangles at one depth that of the lowest row wins.
class Canvas {
 public:
  static constexpr int kNumShades = 9;  ///< Of a colour, from dark.
  static constexpr LocalIndex kMostRows = (1 << 24) - 2;

  explicit Canvas(const Camera& camera);

  /// @brief Draws a triangle of space. `row` says what it is part of, such as a subdomain.
  /// @param[in] sides Drawn where the triangle is large enough that lines leave something of it.
  /// @pre 0 <= row < kMostRows
  void draw(const std::array<Vec3, 3>& corners, LocalIndex row, Sides sides = Sides::hidden);

  [[nodiscard]] const Camera& camera() const { return camera_; }

  /// @brief What is seen at a pixel; kNoIndex: nothing.
  [[nodiscard]] LocalIndex row(int x, int y) const;
  [[nodiscard]] int shade(int x, int y) const;     ///< 0…kNumShades-1.
  [[nodiscard]] bool is_side(int x, int y) const;  ///< The line of a side.

  /// @brief Shape (height, width), or empty as long as nothing is drawn: to be put together by the
  /// larger number. Zeros are as good as nothing.
  [[nodiscard]] std::vector<std::uint64_t>& pixels() { return pixels_; }

  [[nodiscard]] std::size_t num_pixels() const;

 private:
  [[nodiscard]] std::uint64_t pixel(int x, int y) const;

  Camera camera_;
  std::vector<std::uint64_t> pixels_;
};

using Colour = std::array<std::uint8_t, 3>;  ///< Red, green, blue.

/// @brief Colours for rows that only need to be told apart: row r has entry r modulo their number.
/// Those of neighbouring rows differ much.
[[nodiscard]] const std::vector<Colour>& distinct_colours();

/// @brief How a canvas becomes a picture.
struct Paint {
  std::vector<Colour> colours{};  ///< At most 25; row r has entry r modulo their number.
  bool has_borders = true;        ///< Black lines where one row ends.
};

/// @brief The picture: white where nothing is seen. Palette: white, black, then colours. Local.
[[nodiscard]] Picture paint(const Canvas& canvas, const Paint& paint);

}  // namespace tessera::pipeline
