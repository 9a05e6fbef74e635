# SPDX-License-Identifier: BSD-3-Clause
"""Run by xdmf_test.py on some ranks: DOLFINx reads mesh.xdmf, solves on it, and says as JSON what it
found."""
import json
import sys

import dolfinx
import numpy
import ufl
from dolfinx import fem
from dolfinx.io import XDMFFile
from mpi4py import MPI
from petsc4py import PETSc

COMM = MPI.COMM_WORLD
CG = {"ksp_type": "cg", "pc_type": "bjacobi", "ksp_rtol": 1e-13, "ksp_max_it": 10000}


def read(file):
    with XDMFFile(COMM, file, "r") as xdmf:
        mesh = xdmf.read_mesh(name="mesh")
        mesh.topology.create_connectivity(2, 3)
        return mesh, xdmf.read_meshtags(mesh, name="mesh"), xdmf.read_meshtags(mesh, name="boundary")


def total(expression):
    own = fem.assemble_scalar(fem.form(expression))
    return float(COMM.allreduce(own, MPI.SUM).real)


def poisson(mesh, degree, exact_degree):
    """Largest error, relative, of a solution that the elements hold exactly."""
    x = ufl.SpatialCoordinate(mesh)
    exact = 1 + 2 * x[0] - 3 * x[1] + x[2]
    if exact_degree == 2:
        exact = exact + x[0] ** 2 - 2 * x[1] ** 2 + x[0] * x[2]
    space = fem.FunctionSpace(mesh, ("Lagrange", degree))
    values = fem.Function(space)
    values.interpolate(fem.Expression(exact, space.element.interpolation_points()))
    facets = dolfinx.mesh.exterior_facet_indices(mesh.topology)
    dofs = fem.locate_dofs_topological(space, 2, facets)
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    load = fem.Constant(mesh, PETSc.ScalarType(0 if exact_degree == 1 else 2.0))  # -(2 - 4)
    problem = fem.petsc.LinearProblem(
        ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, load * v * ufl.dx,
        bcs=[fem.dirichletbc(values, dofs)], petsc_options=CG,
    )  # fmt: skip
    found = problem.solve()
    scale = COMM.allreduce(float(abs(values.x.array).max()), MPI.MAX)
    error = COMM.allreduce(float(abs(found.x.array - values.x.array).max()), MPI.MAX)
    return error / scale


def conduction(mesh, materials):
    """Mean temperature of a body that is heated by 1 and cold outside, each material with a
    conductivity of its own."""
    space = fem.FunctionSpace(mesh, ("Lagrange", 1))
    conductivity = fem.Function(fem.FunctionSpace(mesh, ("DG", 0)))
    conductivity.x.array[materials.indices] = 10.0 ** materials.values
    facets = dolfinx.mesh.exterior_facet_indices(mesh.topology)
    cold = fem.dirichletbc(
        PETSc.ScalarType(0), fem.locate_dofs_topological(space, 2, facets), space
    )
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    problem = fem.petsc.LinearProblem(
        conductivity * ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx,
        fem.Constant(mesh, PETSc.ScalarType(1)) * v * ufl.dx,
        bcs=[cold], petsc_options=CG,
    )  # fmt: skip
    return total(problem.solve() * ufl.dx)


def main():
    mesh, materials, patches = read(sys.argv[1])
    num_materials, num_patches = map(int, sys.argv[2:])
    order = mesh.geometry.cmap.degree
    # On curved tets only straight solutions are among those of the elements, which have their order.
    degrees = ((1, 1), (2, 2)) if order == 1 else ((2, 1),)
    one = fem.Constant(mesh, PETSc.ScalarType(1))
    dx = ufl.Measure("dx", domain=mesh, subdomain_data=materials)
    ds = ufl.Measure("ds", domain=mesh, subdomain_data=patches)
    found = {
        "cells": mesh.topology.index_map(3).size_global,
        "points": mesh.topology.index_map(0).size_global,
        "volumes": [total(one * dx(i + 1)) for i in range(num_materials)],
        "areas": [total(one * ds(i + 1)) for i in range(num_patches)],
        "facets": COMM.allreduce(int(numpy.sum(patches.indices
                                               < mesh.topology.index_map(2).size_local)), MPI.SUM),
        "errors": [poisson(mesh, *degree) for degree in degrees],
        "order": order,
        "heat": conduction(mesh, materials),
    }  # fmt: skip
    if COMM.rank == 0:
        print(json.dumps(found))


main()
