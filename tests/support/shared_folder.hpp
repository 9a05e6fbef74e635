// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "tessera/base/bytes.hpp"
#include "tessera/comm/all_or_none.hpp"
#include "tessera/comm/communicator.hpp"

namespace tessera::testing {

/// @brief A fresh folder that all ranks of this machine see; rank 0 makes and removes it.
/// @note Construction and destruction are collective; outlived by the communicator.
class SharedFolder {
 public:
  explicit SharedFolder(const comm::Communicator& comm) : comm_(comm)
  {
    path_ = comm::on_root(comm, [] { return made(); });
  }
  ~SharedFolder()
  {
    comm_.barrier();
    std::error_code ignored;
    if (comm_.rank() == 0) std::filesystem::remove_all(path_, ignored);
  }
  SharedFolder(const SharedFolder&) = delete;
  SharedFolder& operator=(const SharedFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const
  {
    return path_ / name;
  }

 private:
  static std::string made()
  {
    std::string name = (std::filesystem::temp_directory_path() / "tessera_test_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    return name;
  }

  const comm::Communicator& comm_;
  std::filesystem::path path_{};
};

}  // namespace tessera::testing
