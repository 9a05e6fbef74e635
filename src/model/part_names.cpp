// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/part_names.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/base/tet.hpp"

#include "model/criteria.hpp"

namespace tessera::model {
namespace {

// Below this part of the square on its longest side a triangle's normal is rounding.
constexpr double kLeastArea = 1e-8;

// Of several rows with one number, all have to fit: a name is that of a number.
std::vector<LocalIndex> numbers_that_fit_all(const std::vector<Criterion>& criteria,
                                             const PartKind& kind)
{
  std::map<LocalIndex, bool> fits_all;
  for (std::size_t row = 0; row < kind.numbers.size(); ++row) {
    const auto fits = [&](const Criterion& criterion) { return criterion.fits[row]; };
    bool& all = fits_all.try_emplace(kind.numbers[row], true).first->second;
    all = all && std::ranges::all_of(criteria, fits);
  }
  std::vector<LocalIndex> numbers;
  for (const auto& [number, all] : fits_all) {
    if (all) numbers.push_back(number);
  }
  return numbers;
}

// Of a criterion that nothing fits what there is; else what fits each of them.
[[noreturn]] void fail_without_fit(const std::vector<Criterion>& criteria, const PartKind& kind)
{
  std::string each;
  for (const Criterion& criterion : criteria) {
    const std::vector<LocalIndex> numbers = numbers_that_fit_all({criterion}, kind);
    if (numbers.empty()) {
      throw ConfigError(
          fmt::format("no {} has {}; {}", kind.word, criterion.text, criterion.what_there_is));
    }
    each += fmt::format("{}{} has {} {}", each.empty() ? "" : ", ", criterion.text, kind.word,
                        ranges_text(numbers));
  }
  throw ConfigError(fmt::format("no {} has all that is asked for: {}", kind.word, each));
}

// Names of one kind of part.
class Naming {
 public:
  explicit Naming(PartKind kind) : kind_(std::move(kind)) {}

  void add(const std::string& name, const std::vector<Criterion>& criteria)
  {
    const std::vector<LocalIndex> numbers = numbers_that_fit_all(criteria, kind_);
    if (numbers.empty()) fail_without_fit(criteria, kind_);
    for (const LocalIndex number : numbers) {
      const auto [given, is_new] = names_.emplace(number, name);
      if (is_new) continue;
      throw ConfigError(
          fmt::format("{} {} has been named \"{}\" by an entry before; it can be "
                      "chosen by one entry only",
                      kind_.word, number, given->second));
    }
  }

  [[nodiscard]] std::vector<NumberedName> result() const
  {
    std::vector<NumberedName> named;
    for (const auto& [number, name] : names_) named.push_back({number, name});
    return named;
  }

 private:
  PartKind kind_;
  std::map<LocalIndex, std::string> names_{};  // By number.
};

// Patches that have a name from the case become one row, at the place of the first of them. Others
// stay in the row that they have.
std::vector<LocalIndex> joined_rows(const NamedParts& parts, const mesh::CoarseMesh& coarse)
{
  std::map<std::string, LocalIndex> rows;
  for (const NumberedName& face : parts.faces) rows[face.name] = kNoIndex;
  std::vector<LocalIndex> patch_row;
  std::map<LocalIndex, LocalIndex> row_before;
  LocalIndex next = 0;
  for (LocalIndex p = 0; p < coarse.num_patches(); ++p) {
    const auto found = rows.find(coarse.patch_names[at(p)]);
    const LocalIndex before = coarse.patch_row.empty() ? p : coarse.patch_row[at(p)];
    LocalIndex& row = found != rows.end() ? found->second
                                          : row_before.try_emplace(before, kNoIndex).first->second;
    if (row == kNoIndex) row = next++;
    patch_row.push_back(row);
  }
  return patch_row;
}

}  // namespace

std::vector<std::vector<Vec3>> face_normals(const ModelDescription& model)
{
  std::vector<std::vector<Vec3>> normals(model.faces.size());
  for (std::size_t t = 0; t < model.triangle_face.size(); ++t) {
    const auto corners = corners_at<3>(model.vertex_xyz, model.triangle_vertices, t);
    const Vec3 a = corners[1] - corners[0];
    const Vec3 b = corners[2] - corners[0];
    const Vec3 normal = cross(a, b);
    const double longest = std::max({dot(a, a), dot(b, b), dot(b - a, b - a)});
    if (!(norm(normal) > kLeastArea * longest)) continue;
    normals[at(model.triangle_face[t])].push_back((1.0 / norm(normal)) * normal);
  }
  return normals;
}

NamedParts find_named_parts(const ModelDescription& model, std::span<const PartName> names,
                            double scale)
{
  const CriteriaTest test(model, scale);
  Naming faces(test.faces());
  Naming solids(test.solids());
  for (const PartName& entry : names) {
    try {
      if (const auto* of = std::get_if<FaceCriteria>(&entry.of)) {
        faces.add(entry.name, test.criteria(*of));
      } else {
        solids.add(entry.name, test.criteria(std::get<SolidCriteria>(entry.of)));
      }
    } catch (const ConfigError& error) {
      throw ConfigError(fmt::format("[[geometry.name]] \"{}\": {}", entry.name, error.what()));
    }
  }
  return {faces.result(), solids.result()};
}

void apply_names(const NamedParts& parts, mesh::CoarseMesh& coarse)
{
  std::map<LocalIndex, std::string> of_face;
  for (const NumberedName& face : parts.faces) of_face[face.number] = face.name;
  for (LocalIndex p = 0; p < coarse.num_patches(); ++p) {
    const auto found = of_face.find(coarse.patch_surface[at(p)] + 1);
    if (found != of_face.end()) coarse.patch_names[at(p)] = found->second;
  }
  for (const NumberedName& solid : parts.solids) {
    for (LocalIndex m = 1; m <= coarse.num_materials(); ++m) {
      if (coarse.body(m) == solid.number) coarse.material_names[at(m - 1)] = solid.name;
    }
  }
  if (!parts.faces.empty()) coarse.patch_row = joined_rows(parts, coarse);
}

}  // namespace tessera::model
