// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include <Standard_Failure.hxx>
#include <fmt/format.h>

#include "tessera/base/error.hpp"

namespace tessera::cad {

/// @brief An exception of OpenCASCADE as one that can be told. Local.
[[nodiscard]] inline GeometryError error_of(const Standard_Failure& failure)
{
  const char* words = failure.GetMessageString();
  const std::string reason = words != nullptr && *words != '\0' ? words : "no reason given";
  return GeometryError(
      fmt::format("OpenCASCADE says {} ({})", failure.DynamicType()->Name(), reason));
}

/// @brief Runs `work()`; an exception of OpenCASCADE, which is no std::exception, becomes a
/// GeometryError that starts with `what`.
template <class Work>
auto with_occ_errors(const std::string& what, Work&& work)
{
  try {
    return work();
  } catch (const Standard_Failure& failure) {
    throw GeometryError(fmt::format("{}: {}", what, error_of(failure).what()));
  }
}

}  // namespace tessera::cad
