// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tessera/cut/options.hpp"
#include "tessera/decompose/options.hpp"
#include "tessera/fill/options.hpp"
#include "tessera/improve/options.hpp"
#include "tessera/io/options.hpp"
#include "tessera/layers/options.hpp"
#include "tessera/model/options.hpp"
#include "tessera/quality/options.hpp"
#include "tessera/refine/options.hpp"
#include "tessera/sizing/options.hpp"
#include "tessera/surface/options.hpp"
#include "tessera/topology/options.hpp"

namespace tessera::config {

/// @brief What to mesh; table `[geometry]` of a case file.
struct GeometryOptions {
  std::filesystem::path file{};  ///< CAD model or coarse mesh; absolute in a loaded case.
  std::filesystem::path cad{};   ///< CAD model of a coarse mesh, absolute; empty: none is given.
  bool smooth = false;           ///< Whether the surface of a coarse mesh is made smooth.
  double scale = 1.0;            ///< Output length units per file length unit, > 0.
  std::vector<model::PartName> names{};  ///< Of patches and materials.
  model::AssemblyOptions assembly{};     ///< Lengths in output length units.
  model::StlOptions stl{};               ///< The same.

  friend bool operator==(const GeometryOptions&, const GeometryOptions&) = default;
};

/// @brief Everything a run is told: the options of every stage. What a value may be, its unit and
/// the reason for its default stand in configs/reference.toml.
///
/// A loaded case has a model file, and either size.target or coarse.max_size (the other one is 0);
/// if that file is a mesh, no coarse.max_size.
/// Its model and size field, if it has one, have absolute paths.
struct Case {
  GeometryOptions geometry{};
  sizing::SizeOptions size{};
  surface::CoarseOptions coarse{};
  decompose::DecomposeOptions decompose{};
  cut::PlaneSettings planes{};                     ///< Of decompose.method "geometry".
  std::vector<layers::LayerOptions> layers{};      ///< On walls; empty: none.
  topology::SplitOptions splits{};                 ///< Cracks and baffles; empty: none.
  std::vector<topology::PeriodicSide> periodic{};  ///< Sides that are images; empty: none.
  refine::RefineOptions refine{};
  fill::FillOptions fill{};
  improve::ImproveOptions improve{};
  quality::QualityTargets quality{};
  io::OutputOptions output{};

  friend bool operator==(const Case&, const Case&) = default;
};

/// @brief Read a case file. Local.
///
/// An override has the form `table.key=value` and acts as if it stood in the file instead of the
/// key there. Its value is read as TOML; text needs no quotes (`geometry.file=a b.geo`).
/// @throws ConfigError naming file and line (or the override), the key, the value given, what is
/// allowed, and for an unknown key the nearest known one.
[[nodiscard]] Case load_case(const std::filesystem::path& file,
                             std::span<const std::string> overrides = {});

/// @brief load_case() on the text of a case file. Local.
/// @param[in] file Where the text would stand as a file. It names the input in messages and the
/// output folder; `geometry.file` and `size.field` are relative to its folder.
[[nodiscard]] Case parse_case(std::string_view text, const std::filesystem::path& file,
                              std::span<const std::string> overrides = {});

/// @brief The options of the fill, with what other tables want in place of "auto": formats for
/// OpenFOAM that no tet has several faces on the geometry, tets of second order and layers that
/// subdomains are filled on all levels. Local.
/// @param[in] is_partial Only some subdomains are made: then no tets are divided.
[[nodiscard]] fill::FillOptions resolved_fill(const Case& given, bool is_partial);

/// @brief Throws ConfigError if a number is out of its range in a case that a program has made. The
/// default of a key that has none in case files says that it is not given. `where`: names the case.
/// Lists of tables are not looked at. Local.
void require_in_range(const Case& given, const std::string& where);

/// @brief The case as a case file with every key written out; parse_case() of it gives the same
/// case. Numbers out of range are left out: require_in_range(). Local.
/// @throws ConfigError if a path is not valid UTF-8, which no TOML file can hold.
[[nodiscard]] std::string to_toml(const Case& resolved);

/// @brief The text of configs/reference.toml: every key with its meaning, unit, range, default and
/// the reason for the default. Local.
[[nodiscard]] std::string reference_toml();

/// @brief A key of a case file that may stand behind `--set`.
struct KnownKey {
  std::string_view name{};                ///< "table.key".
  std::vector<std::string_view> words{};  ///< Its values, if they are words of a list, or a flag's.
  bool is_path = false;                   ///< Its value names a file or a folder.
};

/// @brief Every key outside of lists of tables, in the order of configs/reference.toml. Local.
[[nodiscard]] std::vector<KnownKey> known_keys();

}  // namespace tessera::config
