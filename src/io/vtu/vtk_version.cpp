// SPDX-License-Identifier: BSD-3-Clause
#include <vtkVersion.h>

#include "tessera/io/vtu.hpp"

namespace tessera::io {

std::string vtk_version() { return vtkVersion::GetVTKVersion(); }

}  // namespace tessera::io
