// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/error.hpp"
#include "tessera/formats/export_mesh.hpp"

#include "formats/elmer_writer.hpp"
#include "formats/mfem_writer.hpp"
#include "formats/openfoam_serial_writer.hpp"
#include "formats/openfoam_writer.hpp"
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
    case io::Format::elmer:
      return 60.0;
    case io::Format::mfem:
      return 45.0;
    case io::Format::openfoam:
      return 70.0;
    case io::Format::openfoam_serial:
      return 57.0;
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
    case io::Format::elmer:
      return make_elmer_writer(target);
    case io::Format::mfem:
      return make_mfem_writer(target);
    case io::Format::openfoam:
      return make_openfoam_writer(target);
    case io::Format::openfoam_serial:
      return make_openfoam_serial_writer(target);
  }
  throw ConfigError("the pieces are in pvtu already");
}

}  // namespace tessera::formats
