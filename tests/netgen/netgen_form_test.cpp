// SPDX-License-Identifier: BSD-3-Clause
// A coarse mesh in NETGEN's own form: the one that Tessera gets, and one that NETGEN can refine.
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <meshing.hpp>

#include "tessera/base/error.hpp"
#include "tessera/base/vec3.hpp"

#include "netgen/cad/occ_fixture.hpp"
#include "netgen/mesh_conversion.hpp"
#include "netgen/model_mesher.hpp"

namespace tessera {
namespace {

class NetgenForm : public ::testing::TestWithParam<std::pair<const char*, double>> {
 protected:
  [[nodiscard]] mesh::CoarseMesh generate(const netgen::NetgenMeshUser& use) const
  {
    const auto& loaded = dynamic_cast<const geometry::LoadedModel&>(*model_);
    return netgen::ModelMesher(loaded).generate({.max_size = GetParam().second}, use);
  }

  std::unique_ptr<model::Model> model_ = testing::load_own(GetParam().first);
};

// Corner by corner, tet after tet.
std::vector<Vec3> corners_of(const ::netgen::Mesh& mesh)
{
  std::vector<Vec3> corners;
  for (const auto& element : mesh.VolumeElements()) {
    for (const int c : netgen::kNetgenTetOrder) {
      const auto& point = mesh[element[c]];
      corners.push_back({point(0), point(1), point(2)});
    }
  }
  return corners;
}

std::vector<Vec3> corners_of(const mesh::CoarseMesh& mesh)
{
  std::vector<Vec3> corners;
  for (const LocalIndex v : mesh.tet_vertices) corners.push_back(mesh.position(v));
  return corners;
}

TEST_P(NetgenForm, HasTheBitsOfTheCoarseMesh)
{
  std::vector<Vec3> theirs;
  const mesh::CoarseMesh coarse =
      generate([&](const auto&, const ::netgen::Mesh& mesh) { theirs = corners_of(mesh); });
  const std::vector<Vec3> ours = corners_of(coarse);
  ASSERT_EQ(theirs.size(), ours.size());
  // STL goes through NETGEN scaled by a power of two.
  const double scale =
      std::exp2(std::round(std::log2(norm(theirs[1] - theirs[0]) / norm(ours[1] - ours[0]))));
  for (std::size_t c = 0; c < ours.size(); ++c) EXPECT_EQ(theirs[c], scale * ours[c]);
}

TEST_P(NetgenForm, CanBeRefinedByNetgen)
{
  double volume = 0.0;
  std::size_t num_tets = 0;
  const auto refine = [&](const ::netgen::NetgenGeometry& geometry, ::netgen::Mesh& mesh) {
    geometry.GetRefinement().Refine(mesh);
    num_tets = static_cast<std::size_t>(mesh.GetNE());
    const std::vector<Vec3> p = corners_of(mesh);
    for (std::size_t t = 0; t < p.size(); t += 4) {
      volume += tet_volume(p[t], p[t + 1], p[t + 2], p[t + 3]);
    }
  };
  const mesh::CoarseMesh coarse = generate(refine);
  EXPECT_EQ(num_tets, 8U * static_cast<std::size_t>(coarse.num_tets()));
  EXPECT_GT(volume, 0.0);
}

TEST_P(NetgenForm, PassesOnWhatItsUserThrows)
{
  const auto fail = [](const auto&, auto&) { throw MeshError("enough seen"); };
  EXPECT_THROW(static_cast<void>(generate(fail)), MeshError);
}

INSTANTIATE_TEST_SUITE_P(Formats, NetgenForm,
                         ::testing::Values(std::pair{"cylinder.geo", 1000.0},
                                           std::pair{"cylinder.step", 1000.0},
                                           std::pair{"plate_with_hole.stl", 1000.0}));

}  // namespace
}  // namespace tessera
