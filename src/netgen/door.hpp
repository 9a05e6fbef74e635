// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>

#include "tessera/netgen/factory.hpp"

namespace tessera::netgen {

/// @brief What libtessera asks of the library that is linked with NETGEN and OpenCASCADE. The
/// contracts are those of the functions in factory.hpp.
class Door {
 public:
  virtual ~Door() = default;

  [[nodiscard]] virtual model::ModelSource import_model(const std::filesystem::path& file,
                                                        const model::ImportOptions& options,
                                                        model::StepReader reader) const = 0;
  [[nodiscard]] virtual std::unique_ptr<model::Model> load_model(
      const model::ModelSource& source) const = 0;
  [[nodiscard]] virtual model::ModelDescription describe_model(
      const model::Model& model, surface::SurfaceMesher mesher) const = 0;
  [[nodiscard]] virtual coarse::ModelFigures measure_model(const model::Model& model) const = 0;
  virtual void name_curves(const model::Model& model, mesh::CoarseMesh& mesh) const = 0;
  [[nodiscard]] virtual std::unique_ptr<coarse::CoarseMesher> make_coarse_mesher(
      const model::Model& model) const = 0;
  [[nodiscard]] virtual std::unique_ptr<fill::Kernel> make_fill_kernel() const = 0;
  [[nodiscard]] virtual bool skin_overlaps(const fill::FillInput& skin) const = 0;
};

}  // namespace tessera::netgen

/// @brief The one door of that library; it lives as long as the process.
extern "C" const tessera::netgen::Door* tessera_netgen_door();
