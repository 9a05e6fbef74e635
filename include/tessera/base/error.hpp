// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace tessera {

/// @brief Base of every error this library throws.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @brief The command line or a case file is wrong; fix the input.
struct ConfigError : Error {
  using Error::Error;
};

/// @brief A function was called where it cannot work; fix the program that calls it.
struct UsageError : Error {
  using Error::Error;
};

/// @brief An input file (CAD model, mesh) is missing, unreadable, or not what its name says.
struct InputError : Error {
  using Error::Error;
};

/// @brief The CAD model is readable but not a closed solid that can be meshed.
struct GeometryError : InputError {
  using InputError::InputError;
};

/// @brief A mesh breaks a documented invariant, or none could be made.
struct MeshError : Error {
  using Error::Error;
};

/// @brief NETGEN threw, died, ran out of time, or gave a result that fails its checks.
struct NetgenError : MeshError {
  using MeshError::MeshError;
};

/// @brief An output file cannot be written: permission, disk full, folder in use.
struct OutputError : Error {
  using Error::Error;
};

/// @brief A signal asked the run to stop; what was finished stays usable.
struct Interrupted : Error {
  using Error::Error;
};

}  // namespace tessera
