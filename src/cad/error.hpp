// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Standard_Failure.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::cad {

/// @brief Runs `work()`; an exception of OpenCASCADE, which is no std::exception, becomes a
/// GeometryError that starts with `what`.
template <class Work>
auto with_occ_errors(const std::string& what, Work&& work)
{
  try {
    return work();
  } catch (const Standard_Failure& failure) {
    const char* words = failure.GetMessageString();
    const std::string reason = words != nullptr && *words != '\0' ? words : "no reason given";
    throw GeometryError(
        fmt::format("{}: OpenCASCADE says {} ({})", what, failure.DynamicType()->Name(), reason));
  }
}

}  // namespace tessera::cad
