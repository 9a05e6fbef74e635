#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Mesh.to_petsc(): a DMPlex of our partition, on which a Laplace equation is solved.

    tests/solvers/petsc_test.py --tessera build/release/bin/tessera
"""
import sys

import numpy as np
import python_ranks
from python_ranks import RanksTest, outer_patches

RANKS = (1, 3)
TIGHT = 1e-10  # Sums against the report's.
SOLVED = 1e-8  # The solver's own tolerance is 1e-13.


def exact(x):
    return 1.0 + x @ [2.0, -3.0, 0.5]


def vertices_of(plex, cell):
    """In the order of the closure, which is that of the reference cell."""
    points, _ = plex.getTransitiveClosure(cell)
    first, end = plex.getDepthStratum(0)
    return [int(p) for p in points if first <= p < end]


def stratum(plex, name, value):
    """Points with this value on this rank."""
    if plex.getStratumSize(name, value) == 0:  # Then there is no index set to ask.
        return np.empty(0, np.int32)
    return plex.getStratumIS(name, value).getIndices()


def owned(plex, points):
    if plex.getComm().size == 1:
        return points
    _, leaves, _ = plex.getPointSF().getGraph()
    return points[~np.isin(points, leaves)]


def geometry(comm, folder):
    """Each rank keeps its tets; sums over the labels."""
    import tessera
    from petsc4py import PETSc

    mesh = tessera.read(folder, comm)
    plex = mesh.to_petsc(comm)
    first, end = plex.getHeightStratum(0)
    assert (first, end) == (0, len(mesh.cells)), (first, end, len(mesh.cells))
    first_vertex = plex.getDepthStratum(0)[0]
    xyz = plex.getCoordinatesLocal().array.reshape(-1, 3)
    for cell in range(end):
        vertices = np.array(vertices_of(plex, cell)) - first_vertex
        corners = xyz[vertices]
        assert sorted(map(tuple, corners)) == sorted(map(tuple, mesh.points[mesh.cells[cell]])), cell
        edges = corners[1:] - corners[0]
        # As DMPlexComputeCellGeometryFEM: columns of the Jacobian are corners 2, 1, 3.
        assert np.linalg.det(edges[[1, 0, 2]]) > 0.0, "turned inside out"
        assert plex.getLabelValue("material", cell) == mesh.materials[cell]
        assert plex.getLabelValue("Cell Sets", cell) == mesh.materials[cell]
    faces = plex.getHeightStratum(1)
    patches = {}
    for tag in range(1, len(mesh.names.patches) + 1):
        points = stratum(plex, "patch", tag)
        assert np.array_equal(points, stratum(plex, "Face Sets", tag))
        assert np.all((points >= faces[0]) & (points < faces[1]))
        area = sum(plex.computeCellGeometryFVM(int(p))[0] for p in owned(plex, points))
        patches[tag] = comm.allreduce(float(area))
    materials = {}
    for tag in range(1, len(mesh.names.materials) + 1):
        points = stratum(plex, "material", tag)
        volume = sum(plex.computeCellGeometryFVM(int(p))[0] for p in points)
        materials[tag] = comm.allreduce(float(volume))
    assert isinstance(plex, PETSc.DMPlex)
    return {"materials": materials, "patches": patches}


def stiffness(corners):
    """Of a linear tet, shape (4, 4)."""
    gradients = np.linalg.inv(np.column_stack([np.ones(4), corners]))[1:]
    volume = abs(np.linalg.det(corners[1:] - corners[0])) / 6.0
    return volume * gradients.T @ gradients


def laplace(comm, folder, *tags):
    """The largest error of linear elements where the solution is linear, and the number of unknowns."""
    import tessera
    from petsc4py import PETSc

    plex = tessera.read(folder, comm).to_petsc(comm)
    plex.setNumFields(1)
    plex.setSection(plex.createSection([1], [1, 0, 0, 0]))
    first_vertex = plex.getDepthStratum(0)[0]
    xyz = plex.getCoordinatesLocal().array.reshape(-1, 3)
    matrix, right = plex.createMat(), plex.createGlobalVec()
    for cell in range(plex.getHeightStratum(0)[1]):
        rows = np.array(vertices_of(plex, cell), PETSc.IntType) - first_vertex
        matrix.setValuesLocal(rows, rows, stiffness(xyz[rows]), addv=True)
    matrix.assemble()
    fixed = fixed_rows(plex, [int(tag) for tag in tags])
    solution, wanted = right.duplicate(), plex.createLocalVec()
    wanted.array = exact(xyz)
    given = right.duplicate()
    plex.localToGlobal(wanted, given)
    matrix.zeroRowsColumns(plex.getLGMap().apply(fixed), 1.0, given, right)
    solver = PETSc.KSP().create(comm)
    solver.setOperators(matrix)
    solver.setType("cg")
    solver.getPC().setType("jacobi")
    solver.setTolerances(rtol=1e-13, max_it=5000)
    solver.solve(right, solution)
    assert solver.getConvergedReason() > 0
    solution.axpy(-1.0, given)
    return {"error": solution.norm(PETSc.NormType.INFINITY), "unknowns": right.getSize()}


def fixed_rows(plex, tags):
    """Local rows of the vertices on these patches; of a patch's vertices a rank may have no face."""
    plex.createLabel("fixed")
    for tag in tags:
        for face in stratum(plex, "patch", tag):
            plex.setLabelValue("fixed", int(face), 1)
    plex.labelComplete(plex.getLabel("fixed"))
    first, end = plex.getDepthStratum(0)
    points = stratum(plex, "fixed", 1)
    return (points[(points >= first) & (points < end)] - first).astype(np.int32)


class Petsc(RanksTest):
    def test_ranks_keep_their_tets_and_labels_have_the_right_sums(self):
        import tessera

        for name in self.meshes:
            mesh = tessera.read(self.folder / name)
            for ranks in RANKS:
                with self.subTest(case=name, ranks=ranks):
                    found = self.on_ranks(ranks, geometry, self.folder / name)
                    for tag, value in found["materials"].items():
                        wanted = mesh.report["materials"][int(tag) - 1]["volume"]
                        self.assertAlmostEqual(value / wanted, 1.0, delta=TIGHT)
                    for tag, value in found["patches"].items():
                        wanted = mesh.report["patches"][int(tag) - 1]["area"]
                        self.assertAlmostEqual(value / wanted, 1.0, delta=TIGHT)
                    outside = sum(found["patches"][str(tag)] for tag in outer_patches(mesh))
                    self.assertAlmostEqual(outside / mesh.report["boundary_area"], 1.0, delta=TIGHT)
                    self.assertAlmostEqual(
                        sum(found["materials"].values()) / mesh.report["volume"], 1.0, delta=TIGHT
                    )

    def test_a_linear_solution_is_met(self):
        import tessera

        for name in self.meshes:
            mesh = tessera.read(self.folder / name)
            for ranks in RANKS:
                with self.subTest(case=name, ranks=ranks):
                    found = self.on_ranks(ranks, laplace, self.folder / name, *outer_patches(mesh))
                    self.assertEqual(found["unknowns"], mesh.report["num_vertices"])
                    self.assertLess(found["error"], SOLVED * np.abs(exact(mesh.points)).max())


if __name__ == "__main__":
    sys.exit(python_ranks.main(globals()))
