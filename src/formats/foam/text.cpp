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
    word.insert(0, "_");
  return word;
}

std::string text_of(const Vec3& v)
{
  return fmt::format("({:.17g} {:.17g} {:.17g})", v[0], v[1], v[2]);
}

// The axis of a rotation of less than half a turn, as long as the sine of its angle.
Vec3 axis_by_sine(const Affine& there)
{
  const auto& r = there.rows;
  return 0.5 * Vec3{r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]};
}

// A shift, or a rotation about an axis. Of all else, as half a turn, OpenFOAM finds the transform
// from the faces, whose order needs none.
std::string transform_text(const Affine& there)
{
  if (there.rows == Affine{}.rows) {
    return fmt::format("    transform translational;\n    separationVector {};\n",
                       text_of(there.shift));
  }
  const Vec3 axis = axis_by_sine(there);
  const double sine = norm(axis);
  const double cosine = 0.5 * (there.rows[0][0] + there.rows[1][1] + there.rows[2][2] - 1.0);
  const bool has_pitch = std::abs(dot(there.shift, axis)) > 1e-9 * norm(there.shift) * sine;
  if (sine < 1e-6 || has_pitch) return "    transform unknown;\n";
  // The point that stays: half the shift, and as much across as its triangle with the centre needs.
  const Vec3 centre =
      0.5 * (there.shift + (1.0 + cosine) / (sine * sine) * cross(axis, there.shift));
  return fmt::format("    transform rotational;\n    rotationAxis {};\n    rotationCentre {};\n",
                     text_of(1.0 / sine * axis), text_of(centre));
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
