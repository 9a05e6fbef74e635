// SPDX-License-Identifier: BSD-3-Clause
#include "model/criteria.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tessera/base/error.hpp"
#include "tessera/base/name_patterns.hpp"
#include "tessera/base/sort_unique.hpp"
#include "tessera/model/part_names.hpp"

namespace tessera::model {
namespace {

// A box may be what `tessera info` prints, with six digits.
constexpr double kDigits = 1e-5;

std::string point_text(const Vec3& p)
{
  return fmt::format("[{:g}, {:g}, {:g}]", p[0], p[1], p[2]);
}

std::string upper(std::string text)
{
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

template <class Parts>
std::vector<std::string> names_of(const Parts& parts)
{
  std::vector<std::string> names;
  for (const auto& part : parts) {
    if (!part.name.empty()) names.push_back(part.name);
  }
  return names;
}

// What has no name in the file has none that could fit.
template <class Parts>
Criterion of_pattern(const std::string& pattern, const Parts& parts)
{
  const std::vector<std::string> names = names_of(parts);
  Criterion criterion{.text = fmt::format("pattern = \"{}\"", pattern),
                      .what_there_is = names.empty() ? "the file has no names of them"
                                                     : "the names in the file are "
                                                           + nearest_first(pattern, names)};
  for (const auto& part : parts) {
    criterion.fits.push_back(!part.name.empty() && matches_pattern(pattern, part.name));
  }
  return criterion;
}

Criterion of_colour(const std::string& colour, const std::vector<FaceDescription>& faces)
{
  Criterion criterion{.text = fmt::format("colour = \"{}\"", colour)};
  std::vector<std::string> colours;
  for (const FaceDescription& face : faces) {
    criterion.fits.push_back(upper(face.colour) == upper(colour));
    if (!face.colour.empty()) colours.push_back(face.colour);
  }
  criterion.what_there_is =
      colours.empty() ? "the file has no colours of them"
                      : "the colours in the file are " + nearest_first(upper(colour), colours);
  return criterion;
}

}  // namespace

std::string ranges_text(std::span<const LocalIndex> numbers)
{
  std::string text;
  for (std::size_t first = 0; first < numbers.size();) {
    std::size_t last = first;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", numbers[first]);
    if (last > first) text += fmt::format("-{}", numbers[last]);
    first = last + 1;
  }
  return text;
}

CriteriaTest::CriteriaTest(const ModelDescription& model, double scale)
    : model_(&model), face_boxes_(model.faces.size()), solid_boxes_(model.solids.size())
{
  for (std::size_t t = 0; t < model.triangle_face.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 p =
          scale * point_at(std::span(model.vertex_xyz), model.triangle_vertices[3 * t + c]);
      face_boxes_[at(model.triangle_face[t])].include(p);
    }
  }
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    box_.include(face_boxes_[f]);
    for (const LocalIndex solid : model.faces[f].solids) {
      solid_boxes_[at(solid - 1)].include(face_boxes_[f]);
    }
  }
}

PartKind CriteriaTest::faces() const
{
  PartKind kind{.word = "face"};
  for (const FaceDescription& face : model_->faces) kind.numbers.push_back(face.number);
  return kind;
}

PartKind CriteriaTest::solids() const
{
  PartKind kind{.word = "solid", .numbers = std::vector<LocalIndex>(model_->solids.size())};
  std::iota(kind.numbers.begin(), kind.numbers.end(), 1);
  return kind;
}

std::vector<Criterion> CriteriaTest::criteria(const FaceCriteria& of) const
{
  std::vector<Criterion> given;
  if (!of.faces.empty()) {
    PartKind kind = faces();
    for (std::size_t f = 0; f < model_->faces.size(); ++f) {
      kind.numbers[f] = model_->faces[f].given_number();
    }
    given.push_back(of_numbers("faces", of.faces, kind));
  }
  if (!of.pattern.empty()) given.push_back(of_pattern(of.pattern, model_->faces));
  if (!of.colour.empty()) given.push_back(of_colour(of.colour, model_->faces));
  if (of.normal != kNoPoint) given.push_back(of_normal(of));
  if (of.box_min != kNoPoint) given.push_back(of_box(of.box_min, of.box_max, face_boxes_));
  return given;
}

std::vector<Criterion> CriteriaTest::criteria(const SolidCriteria& of) const
{
  std::vector<Criterion> given;
  if (!of.solids.empty()) given.push_back(of_numbers("solids", of.solids, solids()));
  if (!of.pattern.empty()) given.push_back(of_pattern(of.pattern, model_->solids));
  if (of.box_min != kNoPoint) given.push_back(of_box(of.box_min, of.box_max, solid_boxes_));
  return given;
}

Criterion CriteriaTest::of_numbers(std::string_view key, const std::vector<LocalIndex>& wanted,
                                   const PartKind& kind) const
{
  for (const LocalIndex number : wanted) {
    if (std::ranges::find(kind.numbers, number) != kind.numbers.end()) continue;
    std::vector<LocalIndex> known = kind.numbers;
    sort_unique(known);
    std::erase(known, 0);  // Put in by the case.
    throw ConfigError(fmt::format("{} holds {}, but the model's {} are {}", key, number, key,
                                  ranges_text(known)));
  }
  Criterion criterion{.text = fmt::format("{} = [{}]", key, fmt::join(wanted, ", "))};
  for (const LocalIndex number : kind.numbers) {
    criterion.fits.push_back(std::ranges::find(wanted, number) != wanted.end());
  }
  return criterion;
}

Criterion CriteriaTest::of_normal(const FaceCriteria& of) const
{
  const double tolerance_deg = of.tolerance_deg > 0.0 ? of.tolerance_deg : kNormalTolerance_deg;
  const double least = std::cos(tolerance_deg * std::numbers::pi / 180.0);
  const Vec3 wanted = (1.0 / norm(of.normal)) * of.normal;
  Criterion criterion{
      .text = fmt::format("normal = {} within {:g} degrees", point_text(of.normal), tolerance_deg),
      .what_there_is = "tessera info lists the normals of flat faces"};
  for (const std::vector<Vec3>& normals : face_normals(*model_)) {
    const auto fits = [&](const Vec3& normal) { return dot(normal, wanted) >= least; };
    criterion.fits.push_back(!normals.empty() && std::ranges::all_of(normals, fits));
  }
  return criterion;
}

Criterion CriteriaTest::of_box(const Vec3& min, const Vec3& max,
                               const std::vector<Box>& boxes) const
{
  Criterion criterion{.text = fmt::format("box = {{ min = {}, max = {} }} around it",
                                          point_text(min), point_text(max)),
                      .what_there_is = fmt::format(
                          "the model lies in {} to {} (output units: geometry.scale counts)",
                          point_text(box_.low), point_text(box_.high))};
  double largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, std::abs(box_.low[axis]), std::abs(box_.high[axis])});
  }
  const double slack = kDigits * largest;
  const Box around = Box{min, max}.widened(slack);
  for (const Box& box : boxes) criterion.fits.push_back(!box.is_empty() && around.holds(box));
  return criterion;
}

}  // namespace tessera::model
