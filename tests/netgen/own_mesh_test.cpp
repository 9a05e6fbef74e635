// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <meshing.hpp>

#include "tessera/base/error.hpp"
#include "tessera/coarse/snap_vertices.hpp"
#include "tessera/netgen/factory.hpp"

#include "support/temporary_file.hpp"

#include "netgen/loaders.hpp"
#include "netgen/model_mesher.hpp"

namespace tessera::netgen {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFile;

// Corners of a face to a part of the box's diagonal: vertex numbers differ, and files have 16
// digits.
using Corners = std::array<std::array<long long, 3>, 3>;

std::map<Corners, LocalIndex> surface_by_place(const mesh::CoarseMesh& mesh, double box_diagonal)
{
  constexpr double kUnit = 1e-6;
  constexpr double kOffset = 0.1234;  // So that no round number lies between two cells.
  std::map<Corners, LocalIndex> surfaces;
  for (LocalIndex f = 0; f < mesh.num_faces(); ++f) {
    Corners corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 p = mesh.position(mesh.face_vertices[3 * at(f) + c]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        corners[c][axis] = std::llround(p[axis] / (kUnit * box_diagonal) + kOffset);
      }
    }
    std::ranges::sort(corners);
    surfaces[corners] = mesh.patch_surface[at(mesh.face_patch[at(f)])];
  }
  return surfaces;
}

struct Sample {
  const char* name;
  double size;
};

// NETGEN's own mesh, saved as NETGEN saves it, read again.
class OwnMeshOf : public ::testing::TestWithParam<Sample> {
 protected:
  void SetUp() override
  {
    cad_ = fs::path(TESSERA_GEOMETRY_DIR) / GetParam().name;
    model_ = load_any_model(import_model(cad_, {}));
    surface::CoarseOptions options;
    options.max_size = GetParam().size;
    made_ = ModelMesher(*model_).generate(
        options, [&](const auto&, ::netgen::Mesh& mesh) { mesh.Save(file_.path().string()); });
  }

  [[nodiscard]] mesh::CoarseMesh read_with(const model::ImportOptions& options) const
  {
    const auto model = load_any_model(import_model(file_.path(), options));
    return ModelMesher(*model).generate({});
  }

  fs::path cad_{};
  TemporaryFile file_{"mesh.vol", ""};
  std::unique_ptr<geometry::LoadedModel> model_{};
  mesh::CoarseMesh made_{};
};

TEST_P(OwnMeshOf, ACadModelGoesToTheFacesThatNetgenMeshed)
{
  mesh::CoarseMesh fitted = read_with({.cad = cad_});
  ASSERT_EQ(fitted.num_tets(), made_.num_tets());
  ASSERT_EQ(fitted.num_faces(), made_.num_faces());
  EXPECT_EQ(fitted.num_materials(), made_.num_materials());
  const double box = model_->box_diagonal();
  EXPECT_EQ(surface_by_place(fitted, box), surface_by_place(made_, box));
  const coarse::VertexDistance off = coarse::snap_vertices(fitted, *model_);
  EXPECT_EQ(off.num_off, 0);
}

TEST_P(OwnMeshOf, IsTakenWithoutTheModel)
{
  const mesh::CoarseMesh flat = read_with({});
  EXPECT_EQ(flat.num_tets(), made_.num_tets());
  EXPECT_EQ(flat.num_faces(), made_.num_faces());
  EXPECT_TRUE(flat.segment_curve.empty());
}

INSTANTIATE_TEST_SUITE_P(Models, OwnMeshOf,
                         ::testing::Values(Sample{"cylinder.step", 5.0}, Sample{"torus.step", 4.0},
                                           Sample{"two_blocks.step", 5.0},
                                           Sample{"bracket.step", 8.0}, Sample{"cone.brep", 4.0},
                                           Sample{"core.geo", 4.0}, Sample{"cylinder.geo", 4.0},
                                           Sample{"shaft.geo", 16.0}),
                         [](const auto& of) {
                           std::string name = of.param.name;
                           std::ranges::replace(name, '.', '_');
                           return name;
                         });

TEST(OwnMesh, OfAnotherSizeIsRefusedWithTheDistance)
{
  const fs::path folder(TESSERA_GEOMETRY_DIR);
  const auto model =
      load_any_model(import_model(folder / "cylinder.msh", {.cad = folder / "torus.step"}));
  try {
    (void)ModelMesher(*model).generate({});
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("the largest distance"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace tessera::netgen
