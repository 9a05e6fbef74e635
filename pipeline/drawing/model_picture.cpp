// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/drawing/model_picture.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "tessera/base/tet.hpp"
#include "tessera/base/vec3.hpp"

#include "pipeline/drawing/canvas.hpp"

namespace tessera::pipeline {
namespace {

constexpr int kSide = 800;  // Of one view, pixels.
constexpr int kMargin = 30;

// As in every painted picture.
constexpr std::uint8_t kWhite = 0;
constexpr std::uint8_t kBlack = 1;

constexpr std::size_t kArea = static_cast<std::size_t>(kSide) * kSide;

std::size_t place(int x, int y)
{
  return static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
}

Canvas draw_faces(const model::ModelDescription& model, const View& view)
{
  Camera camera = fit_camera(view, model.vertex_xyz, {kSide, kSide, kMargin});
  camera.height = kSide;
  Canvas canvas(camera);
  for (std::size_t t = 0; t < model.triangle_face.size(); ++t) {
    canvas.draw(corners_at<3>(model.vertex_xyz, model.triangle_vertices, t),
                model.triangle_face[t]);
  }
  return canvas;
}

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
      const bool is_same = is_inside && canvas_.row(other.x, other.y) == canvas_.row(x, y);
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
      if (canvas.row(x, y) == kNoIndex) continue;
      Visible& face = faces[static_cast<std::size_t>(canvas.row(x, y))];
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

void put(Picture& picture, const Picture& part, int left)
{
  for (int y = 0; y < kSide; ++y) {
    const auto row = part.pixels.begin() + static_cast<std::ptrdiff_t>(place(0, y));
    std::copy_n(row, kSide, &picture.pixel(left, y));
  }
}

void draw_view(Picture& picture, const model::ModelDescription& model, const View& view, int left)
{
  const Canvas canvas = draw_faces(model, view);
  const Picture painted = paint(canvas, {.colours = distinct_colours()});
  picture.palette = painted.palette;
  put(picture, painted, left);
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
  Picture picture{.width = 2 * kSide, .height = kSide};
  picture.pixels.assign(2 * static_cast<std::size_t>(kSide) * kSide, kWhite);
  const Vec3 eye{1.0, -1.7, 1.1};
  draw_view(picture, model, view_from(eye), 0);
  draw_view(picture, model, view_from(-1.0 * eye), kSide);
  return picture;
}

}  // namespace tessera::pipeline
