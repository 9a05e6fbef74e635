// SPDX-License-Identifier: BSD-3-Clause
// An STL file: all that is ours, up to where NETGEN is called in a job.
#include <array>
#include <vector>

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"
#include "tessera/model/nearest_point.hpp"
#include "tessera/model/stl_file.hpp"
#include "tessera/model/surface_features.hpp"
#include "tessera/model/triangle_surface.hpp"

#include "support/temporary_file.hpp"

#include "fuzz_target.hpp"

namespace tessera {
namespace {

void import(const std::filesystem::path& file)
{
  const auto surface = model::check_surface(model::read_stl(file), file.string()).surface;
  fuzz::promise(to_bytes(from_bytes<model::TriangleSurface>(to_bytes(surface)))
                == to_bytes(surface));
  const model::SurfaceFeatures features = model::find_features(surface, 30.0);
  fuzz::promise(features.triangle_patch.size() == surface.triangle_solid.size());

  std::vector<std::array<Vec3, 3>> triangles;
  for (LocalIndex t = 0; t < surface.num_triangles(); ++t) {
    triangles.push_back(surface.corners(t));
  }
  static_cast<void>(model::TriangleSearch(triangles).nearest(surface.position(0)));
}

}  // namespace
}  // namespace tessera

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const tessera::testing::TemporaryFile file("model.stl", tessera::fuzz::text_of(data, size));
  try {
    tessera::import(file.path());
  } catch (const tessera::InputError&) {
  }
  return 0;
}
