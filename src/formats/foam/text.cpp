// SPDX-License-Identifier: BSD-3-Clause
#include "formats/foam/text.hpp"

#include <bit>
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
    const bool is_between = patch.processor != kNoIndex;
    text += fmt::format("{}\n{{\n    type {};\n    nFaces {};\n    startFace {};\n", patch.name,
                        is_between ? "processor" : "patch", patch.num_faces, patch.first_face);
    if (is_between) {
      text += fmt::format("    matchTolerance 0.0001;\n    myProcNo {};\n    neighbProcNo {};\n",
                          patch.processor, patch.other_processor);
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
