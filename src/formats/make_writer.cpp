// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/error.hpp"
#include "tessera/formats/export_mesh.hpp"

#include "formats/msh2_writer.hpp"
#include "formats/msh_parts_writer.hpp"
#include "formats/msh_writer.hpp"
#include "formats/writer.hpp"
#include "formats/xdmf_writer.hpp"

namespace tessera::formats {

double bytes_per_tet(io::Format format)
{
  switch (format) {
    case io::Format::pvtu:
      return 0.0;
    case io::Format::xdmf:
      return 46.0;
    case io::Format::msh:
      return 48.0;
    case io::Format::msh2:
      return 63.0;
    case io::Format::msh_parts:
      return 54.0;
  }
  return 0.0;
}

std::unique_ptr<Writer> make_writer(io::Format format, const WriterTarget& target)
{
  switch (format) {
    case io::Format::pvtu:
      break;
    case io::Format::xdmf:
      return make_xdmf_writer(target);
    case io::Format::msh:
      return make_msh_writer(target);
    case io::Format::msh2:
      return make_msh2_writer(target);
    case io::Format::msh_parts:
      return make_msh_parts_writer(target);
  }
  throw ConfigError("the pieces are in pvtu already");
}

}  // namespace tessera::formats
