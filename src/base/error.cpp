// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/base/error.hpp"

#include <filesystem>

namespace tessera {

ErrorKind kind_of(const std::exception& error) noexcept
{
  if (const auto* ours = dynamic_cast<const Error*>(&error)) return ours->kind();
  const bool is_of_files =
      dynamic_cast<const std::filesystem::filesystem_error*>(&error) != nullptr;
  return is_of_files ? ErrorKind::output : ErrorKind::other;
}

void throw_error(ErrorKind kind, const std::string& message)
{
  with_error_class(kind, [&]<class E>(std::type_identity<E>) { throw E(message); });
  throw Error(message);  // Not reached: tells the compiler that this does not return.
}

}  // namespace tessera
