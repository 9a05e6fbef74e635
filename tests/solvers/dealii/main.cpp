// SPDX-License-Identifier: BSD-3-Clause
// deal.II on the shares that tessera::read_mesh() gives: mpirun -n 3 laplace DIR
//
// Every rank keeps its tets. Solves Laplace's equation with FE_SimplexP(1) and the values of a
// linear function on the whole boundary, which the solution must then be. Prints what deal.II says
// of the mesh, as JSON.
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/tria_description.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/numerics/vector_tools.h>
#include <tessera/tessera.hpp>

namespace {

using Description = dealii::TriangulationDescription::Description<3, 3>;
using Face = std::array<tessera::LocalIndex, 3>;

std::size_t at(tessera::LocalIndex i) { return static_cast<std::size_t>(i); }

// Faces of a tet as deal.II numbers them.
constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{
    {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};

Face sorted(Face face)
{
  std::sort(face.begin(), face.end());
  return face;
}

Face face_of(const tessera::MeshShare& mesh, std::size_t tet, std::size_t face)
{
  const auto point = [&](std::size_t i) { return mesh.tet_points[4 * tet + kFaces[face][i]]; };
  return sorted({point(0), point(1), point(2)});
}

// Boundary id of each face that has a patch and one tet only; inner ones may have none in deal.II.
std::map<Face, unsigned> boundary_ids(const tessera::MeshShare& mesh)
{
  std::map<Face, unsigned> ids;
  for (std::size_t t = 0; t < mesh.triangle_ids.size(); ++t) {
    const auto* const point = mesh.triangle_points.data() + 3 * t;
    ids[sorted({point[0], point[1], point[2]})] = static_cast<unsigned>(mesh.triangle_patch[t]);
  }
  std::map<Face, int> num_tets;
  for (std::size_t t = 0; t < mesh.tet_ids.size(); ++t)
    for (std::size_t f = 0; f < 4; ++f)
      if (ids.count(face_of(mesh, t, f)) > 0) ++num_tets[face_of(mesh, t, f)];
  for (const auto& [face, count] : num_tets)
    if (count > 1) ids.erase(face);
  return ids;
}

Description description_of(const tessera::MeshShare& mesh, MPI_Comm comm)
{
  Description description;
  description.comm = comm;
  for (std::size_t p = 0; p < mesh.point_ids.size(); ++p)
    description.coarse_cell_vertices.emplace_back(mesh.point_xyz[3 * p], mesh.point_xyz[3 * p + 1],
                                                  mesh.point_xyz[3 * p + 2]);
  description.cell_infos.resize(1);
  const auto ids = boundary_ids(mesh);
  for (std::size_t t = 0; t < mesh.tet_ids.size(); ++t) {
    dealii::CellData<3> cell(4);
    for (std::size_t c = 0; c < 4; ++c)
      cell.vertices[c] = static_cast<unsigned>(mesh.tet_points[4 * t + c]);
    cell.material_id = static_cast<dealii::types::material_id>(mesh.tet_material[t]);
    description.coarse_cells.push_back(cell);
    const auto number = static_cast<dealii::types::coarse_cell_id>(mesh.tet_ids[t]);
    description.coarse_cell_index_to_coarse_cell_id.push_back(number);
    dealii::TriangulationDescription::CellData<3> info;
    info.id = dealii::CellId(number, std::vector<std::uint8_t>()).to_binary<3>();
    info.subdomain_id = static_cast<unsigned>(mesh.tet_rank[t]);
    info.level_subdomain_id = info.subdomain_id;
    info.manifold_id = dealii::numbers::flat_manifold_id;
    info.manifold_line_ids.fill(dealii::numbers::flat_manifold_id);
    info.manifold_quad_ids.fill(dealii::numbers::flat_manifold_id);
    for (unsigned f = 0; f < 4; ++f) {
      const auto id = ids.find(face_of(mesh, t, f));
      if (id != ids.end()) info.boundary_ids.emplace_back(f, id->second);
    }
    description.cell_infos[0].push_back(info);
  }
  return description;
}

double exact(const dealii::Point<3>& x) { return 1.0 + 2.0 * x[0] - 3.0 * x[1] + 0.5 * x[2]; }

class Laplace {
 public:
  explicit Laplace(const tessera::MeshShare& mesh)
      : num_patches_(mesh.patch_names.size()),
        triangulation_(MPI_COMM_WORLD),
        handler_(triangulation_)
  {
    triangulation_.create_triangulation(description_of(mesh, MPI_COMM_WORLD));
    handler_.distribute_dofs(element_);
  }

  [[nodiscard]] auto num_own_cells() const { return triangulation_.n_locally_owned_active_cells(); }
  [[nodiscard]] auto num_cells() const { return triangulation_.n_global_active_cells(); }
  [[nodiscard]] auto num_points() const { return handler_.n_dofs(); }

  // Largest distance of a value from the exact one.
  double solve()
  {
    const dealii::IndexSet own = handler_.locally_owned_dofs();
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(handler_, relevant);
    dealii::AffineConstraints<double> constraints(relevant);
    const dealii::ScalarFunctionFromFunctionObject<3> values(&exact);
    for (unsigned id = 0; id < num_patches_; ++id)
      dealii::VectorTools::interpolate_boundary_values(mapping_, handler_, id, values, constraints);
    constraints.close();
    assemble(own, relevant, constraints);

    dealii::TrilinosWrappers::MPI::Vector solution(own, MPI_COMM_WORLD);
    dealii::SolverControl control(10000, 1e-13 * right_side_.l2_norm());
    dealii::TrilinosWrappers::PreconditionJacobi jacobi;
    jacobi.initialize(matrix_);
    dealii::SolverCG<dealii::TrilinosWrappers::MPI::Vector>(control).solve(matrix_, solution,
                                                                           right_side_, jacobi);
    constraints.distribute(solution);
    dealii::TrilinosWrappers::MPI::Vector difference(own, MPI_COMM_WORLD);
    dealii::VectorTools::interpolate(mapping_, handler_, values, difference);
    difference -= solution;
    return difference.linfty_norm();
  }

  [[nodiscard]] std::map<unsigned, double> volumes() const
  {
    std::map<unsigned, double> sums;
    dealii::FEValues<3> values(mapping_, element_, quadrature_, dealii::update_JxW_values);
    for (const auto& cell : handler_.active_cell_iterators()) {
      if (!cell->is_locally_owned()) continue;
      values.reinit(cell);
      for (const unsigned q : values.quadrature_point_indices())
        sums[cell->material_id()] += values.JxW(q);
    }
    return sums;
  }

  [[nodiscard]] std::map<unsigned, double> areas() const
  {
    std::map<unsigned, double> sums;
    const dealii::QGaussSimplex<2> on_faces(1);
    dealii::FEFaceValues<3> values(mapping_, element_, on_faces, dealii::update_JxW_values);
    for (const auto& cell : handler_.active_cell_iterators()) {
      if (!cell->is_locally_owned()) continue;
      for (const unsigned f : cell->face_indices()) {
        if (!cell->face(f)->at_boundary()) continue;
        values.reinit(cell, f);
        sums[cell->face(f)->boundary_id()] += values.JxW(0);
      }
    }
    return sums;
  }

 private:
  void assemble(const dealii::IndexSet& own, const dealii::IndexSet& relevant,
                const dealii::AffineConstraints<double>& constraints)
  {
    dealii::DynamicSparsityPattern pattern(relevant);
    dealii::DoFTools::make_sparsity_pattern(handler_, pattern, constraints, false);
    dealii::SparsityTools::distribute_sparsity_pattern(pattern, own, MPI_COMM_WORLD, relevant);
    matrix_.reinit(own, own, pattern, MPI_COMM_WORLD);
    right_side_.reinit(own, MPI_COMM_WORLD);
    dealii::FEValues<3> values(mapping_, element_, quadrature_,
                               dealii::update_gradients | dealii::update_JxW_values);
    dealii::FullMatrix<double> local(4, 4);
    const dealii::Vector<double> nothing(4);
    std::vector<dealii::types::global_dof_index> rows(4);
    for (const auto& cell : handler_.active_cell_iterators()) {
      if (!cell->is_locally_owned()) continue;
      values.reinit(cell);
      local = 0.0;
      for (const unsigned q : values.quadrature_point_indices())
        for (unsigned i = 0; i < 4; ++i)
          for (unsigned j = 0; j < 4; ++j)
            local(i, j) += values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
      cell->get_dof_indices(rows);
      constraints.distribute_local_to_global(local, nothing, rows, matrix_, right_side_);
    }
    matrix_.compress(dealii::VectorOperation::add);
    right_side_.compress(dealii::VectorOperation::add);
  }

  std::size_t num_patches_;
  dealii::parallel::fullydistributed::Triangulation<3> triangulation_;
  dealii::FE_SimplexP<3> element_{1};
  dealii::MappingFE<3> mapping_{element_};
  dealii::QGaussSimplex<3> quadrature_{1};
  dealii::DoFHandler<3> handler_;
  dealii::TrilinosWrappers::SparseMatrix matrix_{};
  dealii::TrilinosWrappers::MPI::Vector right_side_{};
};

// Sums over ranks of the values of keys 0…num_keys-1, as a JSON list.
std::string summed(const std::map<unsigned, double>& own, std::size_t num_keys)
{
  std::vector<double> sums(num_keys, 0.0);
  for (const auto& [key, value] : own) sums.at(key) += value;
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(num_keys), MPI_DOUBLE, MPI_SUM,
                MPI_COMM_WORLD);
  std::string text;
  for (const double sum : sums) {
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%.17g", sum);
    text += (text.empty() ? "[" : ", ") + std::string(number.data());
  }
  return text + "]";
}

}  // namespace

int main(int argc, char** argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 2) return 64;
  const tessera::comm::Communicator world(MPI_COMM_WORLD);
  const tessera::MeshShare mesh = tessera::read_mesh(argv[1], world, {.num_ghost_layers = 1});
  Laplace laplace(mesh);
  const bool keeps_tets = laplace.num_own_cells() == at(mesh.num_tets() - mesh.num_ghost_tets);
  const auto num_keeping = world.sum(keeps_tets ? 1 : 0);
  const double error = laplace.solve();
  const std::string volumes = summed(laplace.volumes(), mesh.material_names.size() + 1);
  const std::string areas = summed(laplace.areas(), mesh.patch_names.size());
  if (world.rank() == 0)
    std::printf(
        "{\"ranks_that_keep_their_tets\": %lld, \"cells\": %llu, \"points\": %llu, "
        "\"error\": %g, \"volumes\": %s, \"areas\": %s}\n",
        static_cast<long long>(num_keeping), static_cast<unsigned long long>(laplace.num_cells()),
        static_cast<unsigned long long>(laplace.num_points()), error, volumes.c_str(),
        areas.c_str());
  return 0;
}
