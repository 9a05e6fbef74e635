# SPDX-License-Identifier: BSD-3-Clause
# Heat conduction with DOLFINx in our partition: mpirun -n 3 python3 heat.py case.toml HOT COLD
import sys

import tessera
import ufl
from dolfinx import fem
from dolfinx.fem.petsc import LinearProblem
from mpi4py import MPI
from petsc4py.PETSc import ScalarType

comm = MPI.COMM_WORLD
share = tessera.mesh(sys.argv[1], comm=comm)  # Rank 0 runs the program, each rank reads its share.
mesh, cell_tags, facet_tags = share.to_dolfinx()

conductivity = fem.Function(fem.FunctionSpace(mesh, ("DG", 0)))
conductivity.x.array[cell_tags.indices] = 1.0
for tag in share.material_tags(share.names.materials[0]):
    conductivity.x.array[cell_tags.find(tag)] = 100.0

space = fem.FunctionSpace(mesh, ("Lagrange", 1))
ends = []
for patch, temperature in ((int(sys.argv[2]), 400.0), (int(sys.argv[3]), 300.0)):
    points = fem.locate_dofs_topological(space, 2, facet_tags.find(patch))
    ends.append(fem.dirichletbc(ScalarType(temperature), points, space))

u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
nothing = fem.Constant(mesh, ScalarType(0.0))
flow = conductivity * ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx
options = {"ksp_type": "cg", "pc_type": "jacobi", "ksp_rtol": 1e-12}
temperature = LinearProblem(flow, nothing * v * ufl.dx, bcs=ends, petsc_options=options).solve()

energy = conductivity * ufl.inner(ufl.grad(temperature), ufl.grad(temperature)) * ufl.dx
heat = comm.allreduce(fem.assemble_scalar(fem.form(energy))) / 100.0
if comm.rank == 0:
    print(f"heat flow {heat:.10g}")
