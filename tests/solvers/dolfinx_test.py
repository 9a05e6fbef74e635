#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mesh.to_dolfinx(): a mesh of our partition, on which Poisson's equation and heat conduction are solved.

    tests/solvers/dolfinx_test.py --tessera build/release/bin/tessera
"""
import sys

import numpy as np
import python_ranks
from python_ranks import RanksTest, outer_patches

RANKS = (1, 3)
TIGHT = 1e-10  # Sums against the report's, and one rank against three.
SOLVED = 1e-8
CONDUCTIVITY = (1.0, 10.0, 100.0)  # By material.
# Temperatures of the two outer patches that are farthest from each other.
HOT, COLD = 400.0, 300.0
# Of the bracket's curved patches: two holes of radius 4 through 5, a quarter of a cylinder of radius 5 and length 20.
CURVED_AREAS = (40.0 * np.pi, 40.0 * np.pi, 50.0 * np.pi)
DIRECT = {"ksp_type": "preonly", "pc_type": "lu", "pc_factor_mat_solver_type": "mumps"}


def converted(comm, folder):
    import tessera

    share = tessera.read(folder, comm)
    return share, share.to_dolfinx(comm)


def assembled(comm, form):
    from dolfinx import fem

    return comm.allreduce(float(fem.assemble_scalar(fem.form(form))))


def geometry(comm, folder):
    """Each rank keeps its tets; sums over the tags, by DOLFINx."""
    import ufl

    share, (mesh, cell_tags, facet_tags) = converted(comm, folder)
    cells = mesh.topology.index_map(3)
    assert cells.size_local == len(share.cells), (cells.size_local, len(share.cells))
    assert cells.num_ghosts == 0 and cells.size_global == share.num_global_cells
    assert mesh.topology.index_map(0).size_global == share.num_global_points
    nodes = mesh.geometry.dofmap.array.reshape(cells.size_local, -1)
    first = comm.scan(len(share.cells)) - len(share.cells)
    row = np.array(mesh.topology.original_cell_index) - first
    assert np.array_equal(np.sort(row), np.arange(len(share.cells))), "a tet came from another rank"
    found, given = mesh.geometry.x[nodes], share.points[share.cells[row]]
    for corners in zip(found, given):
        assert sorted(map(tuple, corners[0])) == sorted(map(tuple, corners[1]))
    values = np.empty(len(share.cells), np.int32)
    values[cell_tags.indices] = cell_tags.values
    assert np.array_equal(values, share.materials[row])
    return {
        "materials": sums(comm, mesh, ufl.Measure("dx", mesh, subdomain_data=cell_tags), len(share.names.materials)),
        "patches": areas_of_patches(comm, share),
    }


def areas_of_patches(comm, share):
    """Outer ones, and with ghosts also those between materials."""
    import ufl

    mesh, cell_tags, facet_tags = share.to_dolfinx(comm, ghosts=True)
    assert_ghosts_have_tags(mesh, cell_tags)
    outer = ufl.Measure("ds", mesh, subdomain_data=facet_tags)
    inner = ufl.Measure("dS", mesh, subdomain_data=facet_tags)
    number = len(share.names.patches)
    of_outer, of_inner = sums(comm, mesh, outer, number), sums(comm, mesh, inner, number)
    return {tag: of_outer[tag] + of_inner[tag] for tag in of_outer}




def assert_ghosts_have_tags(mesh, cell_tags):
    """A function of the owners' tags, sent to the ghosts, has the tags there."""
    from dolfinx import fem

    tags = fem.Function(fem.FunctionSpace(mesh, ("DG", 0)))
    cells = mesh.topology.index_map(3)
    assert mesh.comm.size == 1 or mesh.comm.allreduce(cells.num_ghosts) > 0
    tags.x.array[: cells.size_local] = cell_tags.values[: cells.size_local]
    tags.x.scatter_forward()
    assert np.array_equal(cell_tags.indices, np.arange(cells.size_local + cells.num_ghosts))
    assert np.array_equal(tags.x.array, cell_tags.values)


def sums(comm, mesh, measure, number):
    from dolfinx import fem
    from petsc4py import PETSc

    one = fem.Constant(mesh, PETSc.ScalarType(1.0))
    one = one if measure.integral_type() != "interior_facet" else one("+")
    return {tag: assembled(comm, one * measure(tag)) for tag in range(1, number + 1)}


def poisson(comm, folder, degree, *tags):
    """The largest error where the exact solution is in the space: linear, or quadratic with a source."""
    import ufl
    from dolfinx import fem
    from dolfinx.fem.petsc import LinearProblem
    from petsc4py import PETSc

    degree = int(degree)
    share, (mesh, _, facet_tags) = converted(comm, folder)
    scale = max(comm.allgather(float(np.abs(share.points).max())))

    def exact(x):
        linear = 1.0 + 2.0 * x[0] - 3.0 * x[1] + 0.5 * x[2]
        return linear if degree == 1 else linear + (x[0] ** 2 - 2.0 * x[0] * x[1] + 3.0 * x[2] ** 2) / scale

    laplacian = 0.0 if degree == 1 else 8.0 / scale
    space = fem.FunctionSpace(mesh, ("Lagrange", degree))
    wanted = fem.Function(space)
    wanted.interpolate(exact)
    facets = np.concatenate([facet_tags.find(int(tag)) for tag in tags])
    fixed = fem.dirichletbc(wanted, fem.locate_dofs_topological(space, 2, facets))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    source = fem.Constant(mesh, PETSc.ScalarType(-laplacian))
    problem = LinearProblem(
        ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, source * v * ufl.dx, bcs=[fixed], petsc_options=DIRECT
    )
    error = problem.solve().vector - wanted.vector
    return {
        "error": error.norm(PETSc.NormType.INFINITY) / wanted.vector.norm(PETSc.NormType.INFINITY),
        "free": space.dofmap.index_map.size_global - comm.allreduce(fixed.dof_indices()[1]),
    }


def conduction(comm, folder, hot, cold):
    """Heat that flows through a body of several materials, and its mean temperature."""
    import ufl
    from dolfinx import fem
    from dolfinx.fem.petsc import LinearProblem
    from petsc4py import PETSc

    _, (mesh, cell_tags, facet_tags) = converted(comm, folder)
    space = fem.FunctionSpace(mesh, ("Lagrange", 1))
    conductivity = fem.Function(fem.FunctionSpace(mesh, ("DG", 0)))
    conductivity.x.array[cell_tags.indices] = np.array(CONDUCTIVITY)[cell_tags.values - 1]
    ends = [
        fem.dirichletbc(
            PETSc.ScalarType(value),
            fem.locate_dofs_topological(space, 2, facet_tags.find(int(tag))),
            space,
        )
        for tag, value in ((hot, HOT), (cold, COLD))
    ]
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    nothing = fem.Constant(mesh, PETSc.ScalarType(0.0))
    flow = conductivity * ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx
    solution = LinearProblem(flow, nothing * v * ufl.dx, bcs=ends, petsc_options=DIRECT).solve()
    energy = assembled(comm, conductivity * ufl.inner(ufl.grad(solution), ufl.grad(solution)) * ufl.dx)
    one = fem.Constant(mesh, PETSc.ScalarType(1.0))
    return {
        "heat": energy / (HOT - COLD),
        "mean": assembled(comm, solution * ufl.dx) / assembled(comm, one * ufl.dx),
    }


def curved(comm, folder):
    """Volume and areas of the patches of a mesh of second order."""
    import ufl
    from dolfinx import fem
    from petsc4py import PETSc

    share, (mesh, _, facet_tags) = converted(comm, folder)
    assert share.order == 2
    one = fem.Constant(mesh, PETSc.ScalarType(1.0))
    degree = {"quadrature_degree": 6}
    outer = ufl.Measure("ds", mesh, subdomain_data=facet_tags, metadata=degree)
    return {
        "volume": assembled(comm, one * ufl.dx(metadata=degree)),
        "areas": [assembled(comm, one * outer(tag)) for tag in range(1, len(share.names.patches) + 1)],
    }


def opposite_ends(mesh):
    """The two outer patches whose middles are farthest from each other."""
    tags = outer_patches(mesh)
    middle = np.array([mesh.points[mesh.triangles[mesh.patches + 1 == tag]].mean(axis=(0, 1)) for tag in tags])
    distance = np.linalg.norm(middle[:, None] - middle, axis=2)
    i, j = np.unravel_index(np.argmax(distance), distance.shape)
    return tags[i], tags[j]


class Dolfinx(RanksTest):
    def setUp(self):
        import tessera

        self.whole = {name: tessera.read(self.folder / name) for name in self.meshes}

    def test_ranks_keep_their_tets_and_tags_have_the_right_sums(self):
        for name, mesh in self.whole.items():
            for ranks in RANKS:
                with self.subTest(case=name, ranks=ranks):
                    self.assert_sums(mesh, self.on_ranks(ranks, geometry, self.folder / name))

    def assert_sums(self, mesh, found):
        outer = outer_patches(mesh)
        for tag, value in found["materials"].items():
            wanted = mesh.report["materials"][int(tag) - 1]["volume"]
            self.assertAlmostEqual(value / wanted, 1.0, delta=TIGHT)
        for tag, value in found["patches"].items():
            wanted = mesh.report["patches"][int(tag) - 1]["area"]
            self.assertAlmostEqual(value / wanted, 1.0, delta=TIGHT, msg=f"patch {tag}")
        outside = sum(found["patches"][str(tag)] for tag in outer)
        self.assertAlmostEqual(outside / mesh.report["boundary_area"], 1.0, delta=TIGHT)
        self.assertAlmostEqual(sum(found["materials"].values()) / mesh.report["volume"], 1.0, delta=TIGHT)

    def test_linear_and_quadratic_solutions_are_met(self):
        for name, mesh in self.whole.items():
            for ranks in RANKS:
                for degree in (1, 2):
                    with self.subTest(case=name, ranks=ranks, degree=degree):
                        found = self.on_ranks(ranks, poisson, self.folder / name, degree, *outer_patches(mesh))
                        self.assertGreater(found["free"], 100)
                        self.assertLess(found["error"], SOLVED)

    def test_heat_flows_alike_on_one_rank_and_three(self):
        for name, mesh in self.whole.items():
            with self.subTest(case=name):
                ends = opposite_ends(mesh)
                one, three = (self.on_ranks(ranks, conduction, self.folder / name, *ends) for ranks in RANKS)
                self.assertGreater(one["heat"], 0.0)
                self.assertTrue(COLD < one["mean"] < HOT)
                for key, value in one.items():
                    self.assertAlmostEqual(three[key] / value, 1.0, delta=SOLVED)

    def test_second_order_becomes_a_curved_mesh(self):
        import tessera

        folder = self.folder / "curved"
        mesh = tessera.mesh(
            self.root / "configs/cases/bracket.toml",
            keys={"refine.levels": 2, "output.order": 2},
            output=folder,
            quiet=True,
        )
        for ranks in RANKS:
            with self.subTest(ranks=ranks):
                found = self.on_ranks(ranks, curved, folder)
                self.assertAlmostEqual(found["volume"] / mesh.report["volume"], 1.0, delta=TIGHT)
                for area in CURVED_AREAS:  # Straight triangles are some 1e-3 off.
                    nearest = min(found["areas"], key=lambda one: abs(one - area))
                    self.assertAlmostEqual(nearest / area, 1.0, delta=1e-5)

    def test_the_example_of_the_page_runs(self):
        case = self.root / "configs/cases/core.toml"
        one, three = (self.run_example(ranks, "heat.py", case, 1, 2).split()[-1] for ranks in RANKS)
        self.assertGreater(float(one), 0.0)
        self.assertAlmostEqual(float(three) / float(one), 1.0, delta=SOLVED)


if __name__ == "__main__":
    sys.exit(python_ranks.main(globals()))
