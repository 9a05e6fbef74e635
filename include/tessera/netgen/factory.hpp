// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "tessera/coarse/coarse_mesher.hpp"
#include "tessera/coarse/model_figures.hpp"
#include "tessera/fill/kernel.hpp"
#include "tessera/model/description.hpp"
#include "tessera/model/model.hpp"
#include "tessera/model/options.hpp"

/// The only door to NETGEN and OpenCASCADE; free of their types. Everything behind it may crash,
/// exit or hang, so the program calls it in jobs only, unless it says otherwise. It stands in a
/// library of its own, which the first call loads: MPI's ranks never do. In a build without NETGEN
/// meshes of the user's and STL files can be read, and nothing can be meshed: ConfigError.
namespace tessera::netgen {

/// @brief Loads that library now, so that processes that are forked from this one need not. Local.
/// @throws ConfigError if it cannot be loaded; as does every call that needs it.
void load_library();

/// @brief Looks at a CAD file's name and kind, reads nothing and calls no library: for any process.
/// @note Local. @throws InputError if the file is missing, unreadable, empty or of an unknown kind.
void require_model_file(const std::filesystem::path& file);

/// @brief Whether a file's name is that of a CAD model, by its extension; the file need not exist.
/// Calls no library: for any process. In a build without NETGEN no name is. Local.
[[nodiscard]] bool is_model_name(const std::filesystem::path& file);

/// @brief Reads a CAD file by its extension (.geo .stl .step .stp .iges .igs .brep) and checks it.
/// @note Local.
/// @param[in] reader  Of a STEP or STL file; others have one reader. What the plain one loses is
/// said in ModelSource::repairs.
/// @throws InputError as require_model_file().
/// @throws GeometryError if it holds no closed solid (names the open edges, the missing solid, …).
[[nodiscard]] model::ModelSource import_model(
    const std::filesystem::path& file, const model::ImportOptions& options,
    model::StepReader reader = model::StepReader::with_names);

/// @brief Loads what import_model() read. @throws GeometryError if NETGEN refuses it.
[[nodiscard]] std::unique_ptr<model::Model> load_model(const model::ModelSource& source);

/// @brief What a model of load_model() holds.
/// @note Local. @throws NetgenError if its faces cannot be triangulated.
/// @param[in] mesher Whose triangles a CSG model is described by, with the same numbers and names.
[[nodiscard]] model::ModelDescription describe_model(
    const model::Model& model, surface::SurfaceMesher mesher = surface::SurfaceMesher::netgen);

/// @brief How much there is to mesh, within a second or so. Length unit of the file.
/// @note Local. @throws NetgenError
[[nodiscard]] coarse::ModelFigures measure_model(const model::Model& model);

/// @brief Fills in CoarseMesh::curves of a mesh of a model of load_model(). Local.
void name_curves(const model::Model& model, mesh::CoarseMesh& mesh);

/// @brief A coarse mesher for a model of load_model(). The model must outlive it.
[[nodiscard]] std::unique_ptr<coarse::CoarseMesher> make_coarse_mesher(const model::Model& model);

/// @brief NETGEN's volume mesher as a fill kernel.
[[nodiscard]] std::unique_ptr<fill::Kernel> make_fill_kernel();

/// @brief Whether triangles of a skin that share no edge cut each other: NETGEN cannot fill it
/// then.
/// @note Local.
[[nodiscard]] bool skin_overlaps(const fill::FillInput& skin);

/// @brief The version of NETGEN that this build was linked with, e.g. "6.2.1905"; "none" without
/// NETGEN. Calls no library: for any process.
[[nodiscard]] std::string netgen_version();

}  // namespace tessera::netgen
