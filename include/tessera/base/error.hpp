// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace tessera {

/// @brief Which class an error is of. With the text it is all of an error that goes from one
/// process to another, so that the other one can throw the same.
enum class ErrorKind : int {
  other,  ///< Error itself, and every exception that is not of this library.
  config,
  input,
  geometry,
  mesh,
  netgen,
  output,
  interrupted,
  usage,
};
[[nodiscard]] constexpr ErrorKind last_value(ErrorKind /*type*/) { return ErrorKind::usage; }

/// @brief Base of every error this library throws.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
  [[nodiscard]] virtual ErrorKind kind() const noexcept { return ErrorKind::other; }
};

/// @brief The command line or a case file is wrong; fix the input.
struct ConfigError : Error {
  using Error::Error;
  [[nodiscard]] ErrorKind kind() const noexcept override { return ErrorKind::config; }
};

/// @brief A function was called where it cannot work; fix the program that calls it.
struct UsageError : Error {
  using Error::Error;
  [[nodiscard]] ErrorKind kind() const noexcept override { return ErrorKind::usage; }
};

/// @brief An input file (CAD model, mesh) is missing, unreadable, or not what its name says.
struct InputError : Error {
  using Error::Error;
  [[nodiscard]] ErrorKind kind() const noexcept override { return ErrorKind::input; }
};

/// @brief The CAD model is readable but not a closed solid that can be meshed.
struct GeometryError : InputError {
  using InputError::InputError;
  [[nodiscard]] ErrorKind kind() const noexcept override { return ErrorKind::geometry; }
};

/// @brief A mesh breaks a documented invariant, or none could be made.
struct MeshError : Error {
  using Error::Error;
  [[nodiscard]] ErrorKind kind() const noexcept override { return ErrorKind::mesh; }
};

/// @brief NETGEN threw, died, ran out of time, or gave a result that fails its checks.
struct NetgenError : MeshError {
  using MeshError::MeshError;
  [[nodiscard]] ErrorKind kind() const noexcept override { return ErrorKind::netgen; }
};

/// @brief An output file cannot be written: permission, disk full, folder in use.
struct OutputError : Error {
  using Error::Error;
  [[nodiscard]] ErrorKind kind() const noexcept override { return ErrorKind::output; }
};

/// @brief A signal asked the run to stop; what was finished stays usable.
struct Interrupted : Error {
  using Error::Error;
  [[nodiscard]] ErrorKind kind() const noexcept override { return ErrorKind::interrupted; }
};

/// @brief The kind of any exception. std::filesystem::filesystem_error is `output`: it is thrown
/// where folders are made. Local.
[[nodiscard]] ErrorKind kind_of(const std::exception& error) noexcept;

/// @brief Calls `use` with std::type_identity of the class that `kind` stands for. A number that is
/// no kind stands for Error. Local.
template <class Use>
void with_error_class(ErrorKind kind, const Use& use)
{
  switch (kind) {
    case ErrorKind::config:
      return use(std::type_identity<ConfigError>{});
    case ErrorKind::input:
      return use(std::type_identity<InputError>{});
    case ErrorKind::geometry:
      return use(std::type_identity<GeometryError>{});
    case ErrorKind::mesh:
      return use(std::type_identity<MeshError>{});
    case ErrorKind::netgen:
      return use(std::type_identity<NetgenError>{});
    case ErrorKind::output:
      return use(std::type_identity<OutputError>{});
    case ErrorKind::interrupted:
      return use(std::type_identity<Interrupted>{});
    case ErrorKind::usage:
      return use(std::type_identity<UsageError>{});
    case ErrorKind::other:
      break;
  }
  use(std::type_identity<Error>{});
}

/// @brief Throws an error of the class that `kind` stands for. Local.
[[noreturn]] void throw_error(ErrorKind kind, const std::string& message);

}  // namespace tessera
