# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of solvers share: meshes of two cases, what report.json and VTK say of them, and how other
programs are started. Those of the Python package add python_ranks.py to it."""
import argparse
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy

if os.geteuid() == 0:  # In a container; Open MPI wants it to be said.
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tessera", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).parents[2])
    options, rest = parser.parse_known_args()
    options.tessera, options.root = options.tessera.resolve(), options.root.resolve()
    return options, rest


def main():
    """Runs the tests of the calling script; arguments that are not ours go to unittest."""
    unittest.main(argv=[sys.argv[0], *arguments()[1]])


def run(command, folder=None, timeout_s=300, **more):
    """Its standard output; an AssertionError with all that it said if it fails."""
    done = subprocess.run(
        [str(word) for word in command], cwd=folder, timeout=timeout_s, text=True, check=False,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **more,
    )  # fmt: skip
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout[-4000:]}")
    return done.stdout


def mpirun(ranks, command, **more):
    return run(["mpirun", "--quiet", "--oversubscribe", "--bind-to", "none", "-n", ranks, *command], **more)


def tet_volumes(points, tets):
    """Of each tet."""
    a, b, c, d = (points[tets[:, i]] for i in range(4))
    return numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) / 6.0


def triangle_areas(points, triangles):
    """Of each triangle."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 2.0


def read_pvtu(file):
    """Points, cells and arrays by name of a mesh of one kind of cells."""
    from vtkmodules.util.numpy_support import vtk_to_numpy  # Not beside the VTK of a solver.
    from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

    reader = vtkXMLPUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    num_cells = grid.GetNumberOfCells()
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(num_cells, -1)
    arrays = {}
    for data in (grid.GetPointData(), grid.GetCellData()):
        for i in range(data.GetNumberOfArrays()):
            arrays[data.GetArrayName(i)] = vtk_to_numpy(data.GetArray(i))
    texts = {}
    for i in range(grid.GetFieldData().GetNumberOfArrays()):
        lines = grid.GetFieldData().GetAbstractArray(i)
        if not lines.IsA("vtkStringArray"):
            continue
        texts[lines.GetName()] = [lines.GetValue(j) for j in range(lines.GetNumberOfValues())]
    return vtk_to_numpy(grid.GetPoints().GetData()), cells, arrays, texts


def made_of(model, case, parts):
    """A mesh of a case file and its model.geo, both given as texts."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "case.toml"
        file.write_text(case, encoding="utf-8")
        file.with_name("model.geo").write_text(model, encoding="utf-8")
        return Mesh(file, parts)


class Mesh:
    """A mesh of one of the cases in configs/cases, or of a case file, in a folder of its own."""

    def __init__(self, case, parts, *settings):
        options = arguments()[0]
        self.program, self.root = options.tessera, options.root
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tessera_solver_"))
        self.mesh = self.folder / "mesh"
        file = case if isinstance(case, pathlib.Path) else self.root / f"configs/cases/{case}.toml"
        keys = ["fill.kernel='optimize'", f"output.parts={parts}", "output.report_html=false", *settings]
        command = ["mesh", file, *[word for key in keys for word in ("--set", key)]]
        if isinstance(case, pathlib.Path) or "TESSERA_SHARED_MESHES" not in os.environ:
            run([self.program, *command, "--output", self.mesh])
            return
        # A folder of `run` for what several tests look at.
        made = pathlib.Path(os.environ["TESSERA_SHARED_MESHES"]) / hashlib.sha256(str(command).encode()).hexdigest()
        if not (made / "report.json").exists():
            run([self.program, *command, "--output", made])
        shutil.copytree(made, self.mesh)

    def remove(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def convert(self, name, *more):
        """Folder with the mesh in another format. `more`: options of `tessera convert`."""
        folder = self.folder / name
        run([self.program, "convert", self.mesh / "mesh.pvtu", "--format", name, "--output", folder, *more])
        return folder

    def report(self):
        return json.loads((self.mesh / "report.json").read_text(encoding="utf-8"))

    def num_tets(self):
        return self.report()["num_tets"]

    def volumes(self):
        """By name of the material."""
        return self._sums("materials", "volume")

    def areas(self):
        """By name of the patch; those of one name together, inner ones once."""
        return self._sums("patches", "area")

    def triangles(self):
        """How many, by name as areas()."""
        return self._sums("patches", "triangles")

    def _sums(self, kind, figure):
        sums = {}
        for one in self.report()[kind]:
            sums[one["name"]] = sums.get(one["name"], 0) + one[figure]
        return sums

    def outer_areas(self):
        """As areas(), of faces with one tet only."""
        tets = read_pvtu(self.mesh / "mesh.pvtu")
        ids = tets[2]["GlobalPointIds"][tets[1]]
        faces = numpy.sort(numpy.concatenate([numpy.delete(ids, i, axis=1) for i in range(4)]))
        faces, count = numpy.unique(numpy.sort(faces, axis=1), axis=0, return_counts=True)
        inner = {tuple(face) for face in faces[count == 2]}
        points, triangles, arrays, texts = read_pvtu(self.mesh / "boundary.pvtu")
        corners = numpy.sort(arrays["GlobalPointIds"][triangles], axis=1)
        sums = {}
        for corner, patch, area in zip(corners, arrays["patch"], triangle_areas(points, triangles)):
            if tuple(corner) not in inner:
                name = texts["patch_names"][patch]
                sums[name] = sums.get(name, 0.0) + float(area)
        return sums
