// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/drawing/canvas.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "tessera/base/box.hpp"
#include "tessera/base/triangle.hpp"

namespace tessera::pipeline {
namespace {

constexpr std::uint8_t kWhite = 0;
constexpr std::uint8_t kBlack = 1;
constexpr std::uint8_t kFirstColour = 2;
constexpr int kTones = Canvas::kNumShades + 1;  // Of a colour in the palette: its sides come first.

constexpr std::uint64_t kSideBit = 0x80;
constexpr std::uint64_t kRowMask = 0xffffff;

// Of two floats the larger one has the larger number.
std::uint64_t ordered_bits(float value)
{
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits >> 31U) != 0U ? ~bits : bits | 0x80000000U;
}

Vec3 seen(const View& view, const Vec3& p)
{
  return {dot(p, view.right), -dot(p, view.up), dot(p, view.towards)};
}

double twice_area(const Vec3& a, const Vec3& b) { return a[0] * b[1] - a[1] * b[0]; }

// A triangle on the picture, ready to be asked pixel by pixel.
class Raster {
 public:
  Raster(const std::array<Vec3, 3>& p, Sides sides) : p_(p)
  {
    const Vec3 normal = normal_of(p);
    twice_area_ = normal[2];
    if (!is_seen()) return;
    // Light comes from over the eye's left shoulder, and falls on both sides of a triangle.
    const Vec3 light = (1.0 / norm({-0.4, -0.6, 1.0})) * Vec3{-0.4, -0.6, 1.0};
    const double facing = twice_area_ > 0.0 ? 1.0 : -1.0;
    const double brightness = std::max(0.0, facing * dot(normal, light) / norm(normal));
    shade_ =
        std::clamp(static_cast<int>(brightness * Canvas::kNumShades), 0, Canvas::kNumShades - 1);
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 side = p[(c + 2) % 3] - p[(c + 1) % 3];
      heights_[c] = std::abs(twice_area_) / std::hypot(side[0], side[1]);
    }
    // Lines of small triangles are thin, or there would be nothing but lines.
    const double height = *std::ranges::min_element(heights_);
    if (sides == Sides::drawn && height >= kLeastHeight) {
      side_width_ = std::min(kSideWidth, kSideShare * height);
    }
  }

  [[nodiscard]] bool is_seen() const { return std::abs(twice_area_) > 0.0; }

  struct Sample {
    bool is_inside = false;
    double depth = 0.0;
    std::uint64_t shade = 0;
  };

  [[nodiscard]] Sample at(int x, int y) const
  {
    const Vec3 at_pixel{x + 0.5, y + 0.5, 0.0};
    Sample sample{.is_inside = true, .shade = static_cast<std::uint64_t>(shade_)};
    for (std::size_t c = 0; c < 3; ++c) {
      const double weight =
          twice_area(p_[(c + 1) % 3] - at_pixel, p_[(c + 2) % 3] - at_pixel) / twice_area_;
      if (weight < 0.0) return {};
      sample.depth += weight * p_[c][2];
      if (weight * heights_[c] < side_width_) sample.shade |= kSideBit;
    }
    return sample;
  }

 private:
  static constexpr double kLeastHeight = 1.5;  // Pixels.
  static constexpr double kSideWidth = 0.6;    // On either side of the line, pixels.
  static constexpr double kSideShare = 0.12;   // Of the height.

  std::array<Vec3, 3> p_;
  std::array<double, 3> heights_{};
  double twice_area_ = 0.0;
  double side_width_ = 0.0;
  int shade_ = 0;
};

int pixel_in(double place, int size) { return std::clamp(static_cast<int>(place), 0, size - 1); }

Colour toned(const Colour& colour, double light)
{
  Colour toned{};
  for (std::size_t c = 0; c < 3; ++c) {
    toned[c] = static_cast<std::uint8_t>(std::lround(light * colour[c]));
  }
  return toned;
}

std::vector<Colour> palette_of(const std::vector<Colour>& colours)
{
  constexpr double kSideLight = 0.3;
  std::vector<Colour> palette{{255, 255, 255}, {0, 0, 0}};
  for (const Colour& colour : colours) {
    palette.push_back(toned(colour, kSideLight));
    for (int shade = 0; shade < Canvas::kNumShades; ++shade) {
      palette.push_back(toned(colour, 0.6 + 0.4 * shade / (Canvas::kNumShades - 1)));
    }
  }
  return palette;
}

}  // namespace

View view_from(const Vec3& direction)
{
  const Vec3 towards = (1.0 / norm(direction)) * direction;
  Vec3 right = cross({0.0, 0.0, 1.0}, towards);
  right = (1.0 / norm(right)) * right;
  return {right, cross(towards, right), towards};
}

Vec3 Camera::on_picture(const Vec3& p) const
{
  const Vec3 q = scale * (seen(view, p) - middle);
  return {0.5 * width + q[0], 0.5 * height + q[1], q[2]};
}

Camera fit_camera(const View& view, std::span<const double> xyz, const Room& room)
{
  Box box;
  for (std::size_t v = 0; v < xyz.size() / 3; ++v) box.include(seen(view, point_at(xyz, v)));
  if (box.is_empty()) box.include(Vec3{});
  const Vec3 sides = box.extent();
  const Vec3 extent{std::max(sides[0], 1e-300), std::max(sides[1], 1e-300), 0.0};
  Camera camera{.view = view, .width = room.width, .middle = midpoint(box.low, box.high)};
  camera.scale = std::min((room.width - 2 * room.margin) / extent[0],
                          (room.most_height - 2 * room.margin) / extent[1]);
  camera.height = std::clamp(static_cast<int>(camera.scale * extent[1]) + 2 * room.margin,
                             room.width / 4, room.most_height);
  return camera;
}

Canvas::Canvas(const Camera& camera) : camera_(camera) {}

std::size_t Canvas::num_pixels() const
{
  return static_cast<std::size_t>(camera_.width) * static_cast<std::size_t>(camera_.height);
}

std::uint64_t Canvas::pixel(int x, int y) const
{
  if (pixels_.empty()) return 0;
  return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width)
                 + static_cast<std::size_t>(x)];
}

void Canvas::draw(const std::array<Vec3, 3>& corners, LocalIndex row, Sides sides)
{
  std::array<Vec3, 3> p{};
  std::ranges::transform(corners, p.begin(),
                         [&](const Vec3& corner) { return camera_.on_picture(corner); });
  const Raster raster(p, sides);
  if (!raster.is_seen()) return;
  if (pixels_.empty()) pixels_.resize(num_pixels());
  const auto [x_low, x_high] = std::minmax({p[0][0], p[1][0], p[2][0]});
  const auto [y_low, y_high] = std::minmax({p[0][1], p[1][1], p[2][1]});
  const std::uint64_t low_row_first = (kRowMask - static_cast<std::uint64_t>(row)) << 8U;
  for (int y = pixel_in(y_low, camera_.height); y <= pixel_in(y_high, camera_.height); ++y) {
    for (int x = pixel_in(x_low, camera_.width); x <= pixel_in(x_high, camera_.width); ++x) {
      const Raster::Sample sample = raster.at(x, y);
      if (!sample.is_inside) continue;
      const std::uint64_t depth = ordered_bits(static_cast<float>(sample.depth)) << 32U;
      std::uint64_t& there = pixels_[static_cast<std::size_t>(y * camera_.width + x)];
      there = std::max(there, depth | low_row_first | sample.shade);
    }
  }
}

LocalIndex Canvas::row(int x, int y) const
{
  const std::uint64_t there = pixel(x, y);
  if (there == 0) return kNoIndex;
  return static_cast<LocalIndex>(kRowMask - ((there >> 8U) & kRowMask));
}

int Canvas::shade(int x, int y) const { return static_cast<int>(pixel(x, y) & 0x7fU); }

bool Canvas::is_side(int x, int y) const { return (pixel(x, y) & kSideBit) != 0; }

const std::vector<Colour>& distinct_colours()
{
  static const std::vector<Colour> kColours = [] {
    constexpr int kNumHues = 24;
    constexpr int kStride = 7;  // Hues of neighbours in number are far apart.
    std::vector<Colour> colours;
    for (int row = 0; row < kNumHues; ++row) {
      Colour& colour = colours.emplace_back();
      const double hue = 1.0 * (row * kStride % kNumHues) / kNumHues;
      for (std::size_t c = 0; c < 3; ++c) {
        const double turn = 2.0 * std::numbers::pi * (hue + static_cast<double>(c) / 3.0);
        colour[c] = static_cast<std::uint8_t>(std::lround(255.0 * (0.72 + 0.27 * std::cos(turn))));
      }
    }
    return colours;
  }();
  return kColours;
}

Picture paint(const Canvas& canvas, const Paint& paint)
{
  const auto [width, height] = std::pair(canvas.camera().width, canvas.camera().height);
  Picture picture{.width = width, .height = height, .palette = palette_of(paint.colours)};
  picture.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kWhite);
  const auto num_colours = static_cast<LocalIndex>(paint.colours.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const LocalIndex row = canvas.row(x, y);
      const bool is_border = canvas.row(std::min(x + 1, width - 1), y) != row
                             || canvas.row(x, std::min(y + 1, height - 1)) != row;
      std::uint8_t& colour = picture.pixel(x, y);
      if (row != kNoIndex) {
        const int tone = canvas.is_side(x, y) ? 0 : 1 + canvas.shade(x, y);
        colour = static_cast<std::uint8_t>(kFirstColour + (row % num_colours) * kTones + tone);
      }
      if (is_border && paint.has_borders) colour = kBlack;
    }
  }
  return picture;
}

}  // namespace tessera::pipeline
