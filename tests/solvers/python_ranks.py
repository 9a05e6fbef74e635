# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the Python package share that run under mpirun.

A test script is both sides: unittest in the process that one starts, and, started anew under mpirun with the name
of one of its functions, the ranks.
"""
import json
import os
import pathlib
import sys
import tempfile
import unittest

import numpy as np
import solver_meshes

CASES = ("core", "bracket")
# An eighth of the tets: the same patches, materials and seams, and minutes less.
COARSER = {"refine.levels": 1}


def main(ranks_functions):
    """Runs unittest, or on a rank the function that the command line names."""
    if len(sys.argv) > 2 and sys.argv[1] == "--on-ranks":
        return on_ranks(ranks_functions[sys.argv[2]], *sys.argv[3:])
    options, _ = solver_meshes.arguments()
    package = f"{options.root}/src/python"
    os.environ["TESSERA"] = str(options.tessera)
    os.environ["PYTHONPATH"] = f"{package}:{os.environ.get('PYTHONPATH', '')}"
    sys.path.insert(0, package)
    RanksTest.root = options.root
    return solver_meshes.main()


def on_ranks(function, out, *arguments):
    """Calls the function on this rank; what it returns on rank 0 goes to the test."""
    from mpi4py import MPI

    result = function(MPI.COMM_WORLD, *arguments)
    if MPI.COMM_WORLD.rank == 0:
        pathlib.Path(out).write_text(json.dumps(result))
    return 0


class RanksTest(unittest.TestCase):
    """A test with a folder for all of its methods, in which the cases of CASES are meshed once."""

    root: pathlib.Path
    meshes = CASES

    @classmethod
    def setUpClass(cls):
        import tessera

        temporary = tempfile.TemporaryDirectory(prefix="tessera_solvers_")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        for name in cls.meshes:
            case = cls.root / f"configs/cases/{name}.toml"
            tessera.mesh(case, ranks=2, output=cls.folder / name, quiet=True, keys=COARSER)

    def on_ranks(self, ranks, function, *arguments):
        """What a function of this script returns on rank 0 of so many."""
        out = self.folder / "result.json"
        out.unlink(missing_ok=True)
        script = sys.modules[function.__module__].__file__
        self.run_script(ranks, script, "--on-ranks", function.__name__, out, *arguments)
        return json.loads(out.read_text())

    def run_example(self, ranks, name, *arguments):
        """What a script of tests/examples/python prints."""
        return self.run_script(ranks, self.root / "tests/examples/python" / name, *arguments)

    def run_script(self, ranks, *script):
        return solver_meshes.mpirun(ranks, [sys.executable, "-B", *script])


def volumes(mesh):
    """Of each own tet of a tessera.Mesh."""
    return solver_meshes.tet_volumes(mesh.points, mesh.cells[: mesh.num_own_cells])


def areas(mesh):
    """Of each triangle of a tessera.Mesh."""
    return solver_meshes.triangle_areas(mesh.points, mesh.triangles)


def outer_patches(mesh):
    """Tags (patch + 1) of the patches that no tet is behind on the other side: their triangles' points are on one
    tet only. For a whole mesh."""
    faces = np.sort(np.concatenate([np.delete(mesh.cells, i, axis=1) for i in range(4)]), axis=1)
    both = np.concatenate([faces, np.sort(mesh.triangles, axis=1)])
    _, kind, count = np.unique(both, axis=0, return_inverse=True, return_counts=True)
    outer = count[kind[len(faces) :]] == 2  # The triangle, and a face of one tet.
    return sorted({int(patch) + 1 for patch in mesh.patches[outer]})
