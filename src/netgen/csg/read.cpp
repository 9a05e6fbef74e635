// SPDX-License-Identifier: BSD-3-Clause
// How NETGEN 6.2.2501 reads a CSG file: its library hides the parser.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tessera/base/error.hpp"

#include "netgen/versions.hpp"

namespace tessera::netgen {
namespace {

namespace fs = std::filesystem;

// A folder in memory, while this lives.
class MemoryFolder {
 public:
  MemoryFolder()
  {
    if (mkdtemp(name_.data()) == nullptr)
      throw OutputError("/dev/shm: no folder can be made there");
  }
  ~MemoryFolder()
  {
    std::error_code error;
    fs::remove_all(name_, error);
  }
  MemoryFolder(const MemoryFolder&) = delete;
  MemoryFolder& operator=(const MemoryFolder&) = delete;

  [[nodiscard]] fs::path path() const { return name_; }

 private:
  std::string name_ = "/dev/shm/tessera_XXXXXX";
};

}  // namespace

std::unique_ptr<::netgen::CSGeometry> read_csg(const std::string& text)
{
  // NETGEN throws where it is none.
  if (text.find("algebraic3d") == std::string::npos) return nullptr;
  const MemoryFolder folder;
  const fs::path file = folder.path() / "model.geo";
  std::ofstream(file) << text;
  for (const auto& reader : ::netgen::geometryregister) {
    if (auto* const geometry = reader->Load(file)) {
      return std::unique_ptr<::netgen::CSGeometry>(static_cast<::netgen::CSGeometry*>(geometry));
    }
  }
  return nullptr;
}

}  // namespace tessera::netgen
