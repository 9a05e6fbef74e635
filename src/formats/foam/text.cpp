// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam/text.hpp"

#include <bit>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "formats/plain_name.hpp"

namespace tessera::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they are");

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

bool is_of_word(char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; }

std::string word_of_name(const std::string& name)
{
  std::string word;
  for (const char c : name) word += is_of_word(c) ? c : '_';
  // Patches between processors have names of this beginning.
  if (word.empty() || !is_letter(word.front()) || word.starts_with("procBoundary"))
    word.insert(0, 1, '_');
  return word;
}

constexpr double kRounding = 1e-9;  // Of a shift, along an axis that it should be across.

std::string text_of(const Vec3& v)
{
  return fmt::format("({:.17g} {:.17g} {:.17g})", v[0], v[1], v[2]);
}

// A rotation. Its axis is a column of axis * axis^T, which holds for half a turn as well; the
// longest one is the most exact.
struct Turn {
  double cosine = 0.0;
  Vec3 axis{};       // Of length 1.
  Vec3 axis_sine{};  // The axis, times the sine of the angle about it.
};

Turn turn_of(const Affine& there)
{
  const auto& r = there.rows;
  Turn turn{.cosine = 0.5 * (r[0][0] + r[1][1] + r[2][2] - 1.0),
            .axis_sine = 0.5 * Vec3{r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]}};
  Vec3 longest{};
  for (std::size_t j = 0; j < 3; ++j) {
    Vec3 column{};
    for (std::size_t i = 0; i < 3; ++i)
      column[i] = 0.5 * (r[i][j] + r[j][i]) - (i == j ? turn.cosine : 0.0);
    if (norm(column) > norm(longest)) longest = column;
  }
  turn.axis = (dot(longest, turn.axis_sine) < 0.0 ? -1.0 : 1.0) / norm(longest) * longest;
  return turn;
}

// A shift, or a rotation about an axis. A screw, which no case makes, is left to OpenFOAM.
std::string transform_text(const Affine& there)
{
  if (there.rows == Affine{}.rows) {
    return fmt::format("    transform translational;\n    separationVector {};\n",
                       text_of(there.shift));
  }
  const Turn turn = turn_of(there);
  if (std::abs(dot(there.shift, turn.axis)) > kRounding * norm(there.shift))
    return "    transform unknown;\n";
  // The point that stays: half the shift, and as much across as its triangle with the centre needs.
  const Vec3 centre =
      0.5 * (there.shift + 1.0 / (1.0 - turn.cosine) * cross(turn.axis_sine, there.shift));
  return fmt::format("    transform rotational;\n    rotationAxis {};\n    rotationCentre {};\n",
                     text_of(turn.axis), text_of(centre));
}

std::string kind_of(const FoamBoundary& patch)
{
  if (patch.processor != kNoIndex) return patch.through.empty() ? "processor" : "processorCyclic";
  return patch.cyclic ? "cyclic" : "patch";
}

}  // namespace

std::string foam_header(const FoamKind& kind, std::string_view name)
{
  std::string text = fmt::format("FoamFile\n{{\n    version 2.0;\n    format {};\n    class {};\n",
                                 kind.format, kind.kind);
  if (kind.format == "binary") text += "    arch \"LSB;label=32;scalar=64\";\n";
  if (!kind.note.empty()) text += fmt::format("    note \"{}\";\n", kind.note);
  return text + fmt::format("    location \"{}\";\n    object {};\n}}\n", kind.location, name);
}

std::string foam_list_head(GlobalIndex length)
{
  return length == 0 ? "0" : fmt::format("{}\n(", length);
}

std::string_view foam_list_tail(GlobalIndex length) { return length == 0 ? "" : ")"; }

std::string foam_labels(std::span<const std::int32_t> labels)
{
  return foam_list(labels, static_cast<GlobalIndex>(labels.size()));
}

std::string foam_boundary(const std::vector<FoamBoundary>& patches)
{
  std::string text = foam_header({.kind = "polyBoundaryMesh"}, "boundary");
  text += fmt::format("{}\n(\n", patches.size());
  for (const FoamBoundary& patch : patches) {
    text += fmt::format("{}\n{{\n    type {};\n    nFaces {};\n    startFace {};\n", patch.name,
                        kind_of(patch), patch.num_faces, patch.first_face);
    const bool is_between = patch.processor != kNoIndex;
    if (is_between || patch.cyclic) text += "    matchTolerance 0.0001;\n";
    if (is_between) {
      text += fmt::format("    myProcNo {};\n    neighbProcNo {};\n", patch.processor,
                          patch.other_processor);
    }
    if (!patch.through.empty()) text += fmt::format("    referPatch {};\n", patch.through);
    if (patch.cyclic) {
      text += fmt::format("    neighbourPatch {};\n", patch.cyclic->neighbour);
      text += transform_text(patch.cyclic->there);
    }
    text += "}\n";
  }
  return text + ")\n";
}

std::string foam_zone_head(const std::string& name)
{
  return fmt::format("{}\n{{\n    type cellZone;\ncellLabels List<label> ", name);
}

std::vector<std::string> foam_words(const std::vector<std::string>& names)
{
  std::vector<std::string> words;
  std::set<std::string> taken;
  for (const std::string& name : names)
    words.push_back(unique_name(word_of_name(name), std::identity{}, taken));
  return words;
}

}  // namespace tessera::formats
