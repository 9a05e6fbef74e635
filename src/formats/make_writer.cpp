// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include <fmt/format.h>

#include "tessera/base/error.hpp"
#include "tessera/formats/export_mesh.hpp"

#include "formats/foam/serial_writer.hpp"
#include "formats/foam/writer.hpp"
#include "formats/writer.hpp"
#include "formats/writers/abaqus.hpp"
#include "formats/writers/elmer.hpp"
#include "formats/writers/exodus.hpp"
#include "formats/writers/medit.hpp"
#include "formats/writers/mfem.hpp"
#include "formats/writers/msh.hpp"
#include "formats/writers/msh2.hpp"
#include "formats/writers/msh_parts.hpp"
#include "formats/writers/pvtu_cells.hpp"
#include "formats/writers/xdmf.hpp"

namespace tessera::formats {

// Measured on core with 5.4e6 tets; of text (52 and 44) with the digits that 1e8 tets need more.
double bytes_per_tet(io::Format format)
{
  switch (format) {
    case io::Format::pvtu:
      return 0.0;
    case io::Format::abaqus:
      return 63.0;
    case io::Format::elmer:
      return 60.0;
    case io::Format::exodus:
      return 37.0;
    case io::Format::medit:
      return 52.0;
    case io::Format::mfem:
    case io::Format::mfem_sets:
      return 45.0;
    case io::Format::msh2:
      return 63.0;
    case io::Format::msh:
      return 48.0;
    case io::Format::msh_parts:
      return 54.0;
    case io::Format::openfoam:
      return 70.0;
    case io::Format::openfoam_serial:
      return 57.0;
    case io::Format::pvtu_cells:
      return 44.0;
    case io::Format::xdmf:
      return 46.0;
  }
  return 0.0;
}

namespace {

// Of the formats that hold tets of second order.
std::string words_of_second_order()
{
  std::string words;
  for (const auto& [format, word] : enum_words(io::Format{}))
    if (io::holds_second_order(format)) words.append(words.empty() ? "" : ", ").append(word);
  return words;
}

}  // namespace

void require_order_possible(io::Format format, bool is_second_order)
{
  if (!is_second_order || io::holds_second_order(format)) return;
  throw ConfigError(fmt::format(
      "{} is not written of tets of second order; take one of {}, or make the mesh with "
      "output.order = 1",
      word_of(format), words_of_second_order()));
}

std::unique_ptr<Writer> make_writer(io::Format format, const WriterTarget& target)
{
  require_order_possible(format, target.outline.is_of_second_order());
  switch (format) {
    case io::Format::pvtu:
      break;
    case io::Format::abaqus:
      return make_abaqus_writer(target);
    case io::Format::elmer:
      return make_elmer_writer(target);
    case io::Format::exodus:
      return make_exodus_writer(target);
    case io::Format::medit:
      return make_medit_writer(target);
    case io::Format::mfem:
      return make_mfem_writer(target, MfemNames::comments);
    case io::Format::mfem_sets:
      return make_mfem_writer(target, MfemNames::sets);
    case io::Format::msh2:
      return make_msh2_writer(target);
    case io::Format::msh:
      return make_msh_writer(target);
    case io::Format::msh_parts:
      return make_msh_parts_writer(target);
    case io::Format::openfoam:
      return make_openfoam_writer(target);
    case io::Format::openfoam_serial:
      return make_openfoam_serial_writer(target);
    case io::Format::pvtu_cells:
      return make_pvtu_cells_writer(target);
    case io::Format::xdmf:
      return make_xdmf_writer(target);
  }
  throw ConfigError("the pieces are in pvtu already");
}

}  // namespace tessera::formats
