// SPDX-License-Identifier: BSD-3-Clause
#include "netgen/model_file.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/model/options.hpp"
#include "tessera/netgen/factory.hpp"

namespace tessera::netgen {
namespace {

namespace fs = std::filesystem;

struct FileKind {
  std::string_view extension;  // Lower case.
  model::Format format;
};

constexpr FileKind kFileKinds[] = {
    {".geo", model::Format::csg},  {".stl", model::Format::stl},  {".step", model::Format::occ},
    {".stp", model::Format::occ},  {".iges", model::Format::occ}, {".igs", model::Format::occ},
    {".brep", model::Format::occ}, {".msh", model::Format::own},  {".vol", model::Format::own},
    {".vtu", model::Format::own},
};

[[noreturn]] void throw_unknown_kind(const fs::path& file)
{
  std::string allowed;
  for (const FileKind& kind : kFileKinds) {
    if (!allowed.empty()) allowed += ' ';
    allowed += kind.extension;
  }
  throw InputError(
      fmt::format("{}: not a kind of CAD file that is known by its extension; known are {}",
                  file.string(), allowed));
}

const FileKind* find_kind(const fs::path& file)
{
  const auto* const kind =
      std::ranges::find(kFileKinds, model::lower_case_extension(file), &FileKind::extension);
  return kind == std::ranges::end(kFileKinds) ? nullptr : kind;
}

// Says what is wrong before a reader of NETGEN or OpenCASCADE, whose words help less, sees the
// file.
void require_readable(const fs::path& file)
{
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) {
    throw InputError(file.string() + ": no such file; check geometry.file, which is relative to the "
                     "case file's folder");
  }
  if (status.type() == fs::file_type::directory) {
    throw InputError(file.string() + ": is a folder; name a CAD file in it");
  }
  if (fs::is_other(status) && status.type() != fs::file_type::unknown) {
    throw InputError(file.string() + ": is a pipe or a device; name a CAD file");
  }
  if (!std::ifstream(file, std::ios::binary)) {
    throw InputError(file.string() + ": cannot be read; check its permissions");
  }
  if (fs::file_size(file, error) == 0 && !error) {
    throw InputError(file.string() + ": is empty; export the model again");
  }
}

}  // namespace

model::Format format_of(const fs::path& file)
{
  const FileKind* const kind = find_kind(file);
  if (kind == nullptr) throw_unknown_kind(file);
  return kind->format;
}

void require_model_file(const fs::path& file)
{
  require_reader(format_of(file));
  require_readable(file);
}

bool is_model_name(const fs::path& file) { return find_kind(file) != nullptr; }

}  // namespace tessera::netgen
