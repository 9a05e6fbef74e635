// SPDX-License-Identifier: BSD-3-Clause
#include "subject.hpp"

#include "tessera/base/error.hpp"
#include "tessera/coarse/coarse_mesher.hpp"
#include "tessera/netgen/factory.hpp"

#include "support/decompositions.hpp"

namespace tessera::testing {

Subject::Subject(const std::string& argument)
{
  const std::size_t equals = argument.rfind('=');
  if (equals == std::string::npos) throw ConfigError(argument + ": expected MODEL=MAX_SIZE");
  file = argument.substr(0, equals);
  model = netgen::load_model(netgen::import_model(file, {}));
  coarse = netgen::make_coarse_mesher(*model)->generate(
      {.max_size = std::stod(argument.substr(equals + 1))});
  decomposition = one_subdomain_a_material(coarse);
  skeleton = mesh::build_skeleton(coarse, decomposition);
}

}  // namespace tessera::testing
