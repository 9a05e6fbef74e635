// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/commands/model_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <string_view>

#include "tessera/base/vec3.hpp"

namespace tessera::pipeline {
namespace {

constexpr int kSide = 800;  // Of one view, pixels.
constexpr int kMargin = 30;

// Palette: white, black, then the shades of each hue.
constexpr std::uint8_t kWhite = 0;
constexpr std::uint8_t kBlack = 1;
constexpr int kNumHues = 24;
constexpr int kNumShades = 10;

constexpr LocalIndex kNothing = -1;

constexpr std::size_t kArea = static_cast<std::size_t>(kSide) * kSide;

std::size_t place(int x, int y)
{
  return static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
}

std::vector<std::array<std::uint8_t, 3>> make_palette()
{
  std::vector<std::array<std::uint8_t, 3>> palette{{255, 255, 255}, {0, 0, 0}};
  for (int hue = 0; hue < kNumHues; ++hue) {
    for (int shade = 0; shade < kNumShades; ++shade) {
      const double light = 0.45 + 0.55 * shade / (kNumShades - 1);
      std::array<std::uint8_t, 3>& colour = palette.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const double turn =
            2.0 * std::numbers::pi * (1.0 * hue / kNumHues + static_cast<double>(c) / 3.0);
        colour[c] =
            static_cast<std::uint8_t>(std::lround(255.0 * light * (0.72 + 0.27 * std::cos(turn))));
      }
    }
  }
  return palette;
}

// Hues of neighbours in number are far apart.
std::uint8_t colour_of(LocalIndex face, double brightness)
{
  constexpr int kStride = 7;
  const int hue = static_cast<int>(face % kNumHues) * kStride % kNumHues;
  const int shade = std::clamp(static_cast<int>(brightness * kNumShades), 0, kNumShades - 1);
  return static_cast<std::uint8_t>(2 + hue * kNumShades + shade);
}

struct View {
  Vec3 right{};
  Vec3 up{};
  Vec3 towards{};  // The eye.
};

View view_from(const Vec3& direction)
{
  const Vec3 towards = (1.0 / norm(direction)) * direction;
  Vec3 right = cross({0.0, 0.0, 1.0}, towards);
  right = (1.0 / norm(right)) * right;
  return {right, cross(towards, right), towards};
}

// One view: which face is seen at each pixel, and how bright.
class Canvas {
 public:
  Canvas(const model::ModelDescription& model, const View& view)
      : model_(model),
        view_(view),
        depth_(kArea, std::numeric_limits<double>::lowest()),
        face_(kArea, kNothing),
        shade_(kArea, 0.0)
  {
    fit();
    for (std::size_t t = 0; t < model.triangle_face.size(); ++t) draw(t);
  }

  [[nodiscard]] LocalIndex face(int x, int y) const { return face_[place(x, y)]; }
  [[nodiscard]] double shade(int x, int y) const { return shade_[place(x, y)]; }

 private:
  [[nodiscard]] Vec3 seen(const Vec3& p) const
  {
    return {dot(p, view_.right), -dot(p, view_.up), dot(p, view_.towards)};
  }

  void fit()
  {
    Vec3 low{};
    Vec3 high{};
    low.fill(std::numeric_limits<double>::max());
    high.fill(std::numeric_limits<double>::lowest());
    for (std::size_t v = 0; v < model_.vertex_xyz.size() / 3; ++v) {
      const Vec3 p = seen(point_at(std::span(model_.vertex_xyz), v));
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
    }
    middle_ = midpoint(low, high);
    const double extent = std::max({high[0] - low[0], high[1] - low[1], 1e-300});
    scale_ = (kSide - 2 * kMargin) / extent;
  }

  [[nodiscard]] Vec3 on_canvas(const Vec3& p) const
  {
    const Vec3 q = scale_ * (seen(p) - middle_);
    return {0.5 * kSide + q[0], 0.5 * kSide + q[1], q[2]};
  }

  void draw(std::size_t t)
  {
    std::array<Vec3, 3> p{};
    for (std::size_t c = 0; c < 3; ++c) {
      p[c] = on_canvas(point_at(std::span(model_.vertex_xyz), model_.triangle_vertices[3 * t + c]));
    }
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    if (std::abs(normal[2]) <= 0.0) return;  // Seen from the side.
    // Light comes from over the eye's left shoulder, and falls on both sides of a triangle.
    const Vec3 light = (1.0 / norm({-0.4, -0.6, 1.0})) * Vec3{-0.4, -0.6, 1.0};
    const double facing = normal[2] > 0.0 ? 1.0 : -1.0;
    const double shade = std::max(0.0, facing * dot(normal, light) / norm(normal));
    const auto [x_low, x_high] = std::minmax({p[0][0], p[1][0], p[2][0]});
    const auto [y_low, y_high] = std::minmax({p[0][1], p[1][1], p[2][1]});
    for (int y = first_pixel(y_low); y <= last_pixel(y_high); ++y) {
      for (int x = first_pixel(x_low); x <= last_pixel(x_high); ++x) {
        put(t, p, normal[2], shade, x, y);
      }
    }
  }

  static int first_pixel(double low) { return std::clamp(static_cast<int>(low), 0, kSide - 1); }
  static int last_pixel(double high)
  {
    return std::clamp(static_cast<int>(high) + 1, 0, kSide - 1);
  }

  void put(std::size_t t, const std::array<Vec3, 3>& p, double twice_area, double shade, int x,
           int y)
  {
    const Vec3 at_pixel{x + 0.5, y + 0.5, 0.0};
    double depth = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 a = p[(c + 1) % 3] - at_pixel;
      const Vec3 b = p[(c + 2) % 3] - at_pixel;
      const double weight = (a[0] * b[1] - a[1] * b[0]) / twice_area;
      if (weight < 0.0) return;
      depth += weight * p[c][2];
    }
    if (depth <= depth_[place(x, y)]) return;
    depth_[place(x, y)] = depth;
    face_[place(x, y)] = model_.triangle_face[t];
    shade_[place(x, y)] = shade;
  }

  const model::ModelDescription& model_;
  View view_;
  Vec3 middle_{};
  double scale_ = 1.0;
  std::vector<double> depth_;
  std::vector<LocalIndex> face_;
  std::vector<double> shade_;
};

// Digits of 5 by 7 dots, drawn larger.
constexpr int kDotSide = 2;
constexpr int kDigitWidth = 6 * kDotSide;
constexpr int kDigitHeight = 7 * kDotSide;
constexpr std::array<std::array<std::string_view, 7>, 10> kDigits{{
    {" ### ", "#   #", "#  ##", "# # #", "##  #", "#   #", " ### "},
    {"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "},
    {" ### ", "#   #", "    #", "   # ", "  #  ", " #   ", "#####"},
    {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "},
    {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "},
    {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "},
    {" ### ", "#    ", "#    ", "#### ", "#   #", "#   #", " ### "},
    {"#####", "    #", "   # ", "  #  ", "  #  ", "  #  ", "  #  "},
    {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "},
    {" ### ", "#   #", "#   #", " ####", "    #", "    #", " ### "},
}};

struct Place {
  int x = 0;
  int y = 0;
};

// The visible pixels of one face, and where its number goes: as far from its border as can be.
struct Visible {
  std::int64_t count = 0;
  Place label{};
  int label_distance = -1;
};

// Steps from each pixel to the nearest one of another face; a step may be diagonal.
class BorderDistance {
 public:
  explicit BorderDistance(const Canvas& canvas) : canvas_(canvas), distance_(kArea, kFar)
  {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) look_at(x, y, {{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}});
    }
    for (int y = kSide - 1; y >= 0; --y) {
      for (int x = kSide - 1; x >= 0; --x) look_at(x, y, {{{1, 0}, {1, 1}, {0, 1}, {-1, 1}}});
    }
  }

  [[nodiscard]] int at(int x, int y) const { return distance_[place(x, y)]; }

 private:
  static constexpr int kFar = kSide;

  void look_at(int x, int y, const std::array<Place, 4>& steps)
  {
    int& distance = distance_[place(x, y)];
    for (const Place& step : steps) {
      const Place other{x + step.x, y + step.y};
      const bool is_inside = other.x >= 0 && other.x < kSide && other.y >= 0 && other.y < kSide;
      const bool is_same = is_inside && canvas_.face(other.x, other.y) == canvas_.face(x, y);
      distance = std::min(distance, is_same ? 1 + distance_[place(other.x, other.y)] : 0);
    }
  }

  const Canvas& canvas_;
  std::vector<int> distance_;
};

std::vector<Visible> visible_faces(const Canvas& canvas, std::size_t num_faces)
{
  std::vector<Visible> faces(num_faces);
  const BorderDistance distance(canvas);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (canvas.face(x, y) == kNothing) continue;
      Visible& face = faces[static_cast<std::size_t>(canvas.face(x, y))];
      ++face.count;
      if (distance.at(x, y) <= face.label_distance) continue;
      face.label_distance = distance.at(x, y);
      face.label = {x, y};
    }
  }
  return faces;
}

void draw_digit(Picture& picture, int digit, Place corner)
{
  for (int y = -kDotSide; y < kDigitHeight + kDotSide; ++y) {
    for (int x = -kDotSide; x < kDigitWidth; ++x) {
      const bool is_around = x < 0 || y < 0 || x / kDotSide > 4 || y / kDotSide > 6;
      const bool is_dot =
          !is_around
          && kDigits[static_cast<std::size_t>(digit)][static_cast<std::size_t>(y / kDotSide)]
                    [static_cast<std::size_t>(x / kDotSide)]
                 == '#';
      picture.pixel(corner.x + x, corner.y + y) = is_dot ? kBlack : kWhite;
    }
  }
}

void draw_number(Picture& picture, LocalIndex number, Place middle, int left)
{
  const std::string digits = std::to_string(number);
  const int width = static_cast<int>(digits.size()) * kDigitWidth;
  Place corner{std::clamp(middle.x - width / 2, kDotSide, kSide - kDotSide - width),
               std::clamp(middle.y - kDigitHeight / 2, kDotSide, kSide - kDotSide - kDigitHeight)};
  corner.x += left;
  for (const char digit : digits) {
    draw_digit(picture, digit - '0', corner);
    corner.x += kDigitWidth;
  }
}

// Black where the pixel to the right or below shows another face.
void draw_faces(Picture& picture, const Canvas& canvas, int left)
{
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const LocalIndex face = canvas.face(x, y);
      const bool is_border = canvas.face(std::min(x + 1, kSide - 1), y) != face
                             || canvas.face(x, std::min(y + 1, kSide - 1)) != face;
      std::uint8_t colour = face == kNothing ? kWhite : colour_of(face, canvas.shade(x, y));
      if (is_border) colour = kBlack;
      picture.pixel(left + x, y) = colour;
    }
  }
}

void draw_view(Picture& picture, const model::ModelDescription& model, const View& view, int left)
{
  const Canvas canvas(model, view);
  draw_faces(picture, canvas, left);
  const std::vector<Visible> faces = visible_faces(canvas, model.faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    // Fewer pixels than a digit has: its number would hide other faces.
    if (faces[f].count < kDigitWidth * kDigitHeight) continue;
    draw_number(picture, model.faces[f].number, faces[f].label, left);
  }
}

}  // namespace

Picture draw_model(const model::ModelDescription& model)
{
  Picture picture{.width = 2 * kSide, .height = kSide, .palette = make_palette()};
  picture.pixels.assign(2 * static_cast<std::size_t>(kSide) * kSide, kWhite);
  const Vec3 eye{1.0, -1.7, 1.1};
  draw_view(picture, model, view_from(eye), 0);
  draw_view(picture, model, view_from(-1.0 * eye), kSide);
  return picture;
}

}  // namespace tessera::pipeline
