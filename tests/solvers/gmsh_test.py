# SPDX-License-Identifier: BSD-3-Clause
"""Gmsh opens all three forms of MSH files, and meshio, PETSc and gmshToFoam those that they read:
elements, groups, partitions and ghosts, volumes and areas by name."""
import json
import multiprocessing
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

import gmsh
import meshio
import numpy as np
import solver_meshes
from solver_meshes import Mesh, read_pvtu, run, tet_volumes, triangle_areas
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from periodic_models import PACKING, PAIRS, SECTOR, packing_case, sector_case  # noqa: E402

NUM_PARTS = 3

# What PETSc counts in a file, as JSON.
PETSC_LABELS = """
import json, sys
import petsc4py
petsc4py.init()
from petsc4py import PETSc
plex = PETSc.DMPlex().createFromFile(sys.argv[1])
first, last = plex.getHeightStratum(0)
found = {"cells": last - first}
for name in ("Cell Sets", "Face Sets"):
    values = plex.getLabelIdIS(name).getIndices()
    found[name] = {str(v): plex.getStratumSize(name, int(v)) for v in sorted(values)}
print(json.dumps(found))
"""


class Model:
    """What Gmsh holds of one or several files."""

    def __init__(self, *files):
        gmsh.clear()
        gmsh.logger.start()
        gmsh.open(str(files[0]))
        for file in files[1:]:
            gmsh.merge(str(file))
        self.said = [line for line in gmsh.logger.get() if line.startswith(("Error", "Warning"))]
        gmsh.logger.stop()
        nodes, xyz, _ = gmsh.model.mesh.getNodes()
        self.xyz = np.full((int(nodes.max()) + 1, 3), np.nan)
        self.xyz[nodes.astype(int)] = xyz.reshape(-1, 3)
        self.num_nodes = len(set(nodes.tolist()))

    def cells(self, dimension, with_ghosts=False):
        """Rows of tag and nodes of the triangles or tets, by the name of their group."""
        found = {}
        for _, entity in gmsh.model.getEntities(dimension):
            is_ghost = gmsh.model.getType(dimension, entity) == "Ghost volume"
            if is_ghost and not with_ghosts:
                continue
            groups = gmsh.model.getPhysicalGroupsForEntity(dimension, entity)
            names = [gmsh.model.getPhysicalName(dimension, group) for group in groups]
            kinds, tags, nodes = gmsh.model.mesh.getElements(dimension, entity)
            for kind, tag, rows in zip(kinds, tags, nodes):
                assert kind == {2: 2, 3: 4}[dimension]
                found.setdefault("ghost" if is_ghost else names[0], []).append(
                    np.column_stack([tag.astype(int), rows.astype(int).reshape(len(tag), -1)])
                )
        return {name: np.concatenate(rows) for name, rows in found.items()}

    def sizes(self, dimension):
        measure = tet_volumes if dimension == 3 else triangle_areas
        return {
            name: float(measure(self.xyz, rows[:, 1:]).sum())
            for name, rows in self.cells(dimension).items()
        }


    def figures(self):
        rows = self.cells(3).values()
        parts = [gmsh.model.getPartitions(*entity).tolist() for entity in gmsh.model.getEntities(3)]
        return {
            "errors": [line for line in self.said if line.startswith("Error")],
            "num_nodes": self.num_nodes,
            "tets": sorted(np.concatenate(list(rows))[:, 0].tolist()),
            "volumes": self.sizes(3),
            "areas": self.sizes(2),
            "parts": sorted({part for several in parts for part in several}),
        }


def figures_of(*files):
    """Figures of a model of several files. For a process of its own: Gmsh 4.8 crashes when it forgets
    such a model, also one of files that it has written itself."""
    return Model(*files).figures()


class PeriodicSides(unittest.TestCase):
    """What Gmsh says of them has all nodes of a side, each where its partner's image is. Of version 2.2 it says nothing,
    also of its own files: it writes that form of what it has read, which must be what is in ours."""

    @classmethod
    def setUpClass(cls):
        gmsh.initialize(["", "-nopopup"], readConfigFiles=False)
        cls.addClassCleanup(gmsh.finalize)
        gmsh.option.setNumber("General.Terminal", 0)

    def files(self, model, case, *settings):
        folder = pathlib.Path(tempfile.mkdtemp(prefix="tessera_periodic_"))
        self.addCleanup(shutil.rmtree, folder)
        (folder / "model.geo").write_text(model, encoding="utf-8")
        (folder / "case.toml").write_text(case, encoding="utf-8")
        mesh = Mesh(folder / "case.toml", NUM_PARTS, "fill.kernel='subdivide'", *settings)
        self.addCleanup(mesh.remove)
        return mesh.convert("msh") / "mesh.msh", mesh.convert("msh2") / "mesh_v2.msh"

    def assert_alike(self, file, pairs):
        model = Model(file)
        self.assertEqual([line for line in model.said if "compiled with ANN" not in line], [])
        sides = {}
        for _, entity in gmsh.model.getEntities(2):
            group = gmsh.model.getPhysicalGroupsForEntity(2, entity)[0]
            sides[gmsh.model.getPhysicalName(2, group)] = entity
        for start, end in pairs:
            master, nodes, of_nodes, matrix = gmsh.model.mesh.getPeriodicNodes(2, sides[end], True)
            self.assertEqual(master, sides[start])
            for side, listed in ((start, of_nodes), (end, nodes)):
                of_side = np.concatenate(gmsh.model.mesh.getElements(2, sides[side])[2])
                self.assertEqual(sorted(listed.tolist()), np.unique(of_side).tolist())
            matrix = np.reshape(matrix, (4, 4))
            images = model.xyz[of_nodes.astype(int)] @ matrix[:3, :3].T + matrix[:3, 3]
            self.assertLess(abs(model.xyz[nodes.astype(int)] - images).max(), 1e-12)

    def assert_written_alike(self, file):
        written = file.with_name("written.msh")
        gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
        gmsh.write(str(written))
        expected = periodic_of(written)
        self.assertGreater(len(expected), 0)
        self.assertEqual(periodic_of(file), expected)
        self.assertEqual(Model(file).said, [])

    def test_of_a_cell_of_a_packing(self):
        file, old = self.files(PACKING, packing_case())
        self.assert_alike(file, PAIRS)
        self.assert_written_alike(old)

    def test_of_a_sector_of_second_order(self):
        file, old = self.files(SECTOR, sector_case("refine.levels = 1\n"), "output.order=2")
        self.assert_alike(file, [("start", "end")])
        self.assert_written_alike(old)


class Gmsh(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.meshes = {case: Mesh(case, NUM_PARTS) for case in ("core", "bracket")}
        for mesh in cls.meshes.values():
            cls.addClassCleanup(mesh.remove)
        cls.files = {
            case: {name: mesh.convert(name) for name in ("msh", "msh2", "msh-parts")}
            for case, mesh in cls.meshes.items()
        }
        gmsh.initialize(["", "-nopopup"], readConfigFiles=False)
        cls.addClassCleanup(gmsh.finalize)
        gmsh.option.setNumber("General.Terminal", 0)

    def parts(self, case):
        return [self.files[case]["msh-parts"] / f"mesh_{k + 1}.msh" for k in range(NUM_PARTS)]

    def whole_files(self):
        for case, files in self.files.items():
            for file in (files["msh"] / "mesh.msh", files["msh2"] / "mesh_v2.msh"):
                with self.subTest(file=file.name, case=case):
                    yield self.meshes[case], file

    def assert_sizes(self, found, expected):
        self.assertEqual(sorted(found), sorted(expected))
        self.assertGreater(len(found), 0)
        for name, size in found.items():
            self.assertAlmostEqual(size / expected[name], 1.0, delta=1e-10)

    def assert_whole(self, found, mesh):
        self.assertEqual(found["errors"], [])
        self.assertEqual(found["num_nodes"], mesh.report()["num_vertices"])
        self.assertEqual(found["tets"], list(range(1, mesh.num_tets() + 1)))
        self.assert_sizes(found["volumes"], mesh.volumes())
        self.assert_sizes(found["areas"], mesh.areas())
        volume = sum(found["volumes"].values())
        self.assertAlmostEqual(volume / mesh.report()["volume"], 1.0, delta=1e-10)

    def test_one_file(self):
        for mesh, file in self.whole_files():
            model = Model(file)
            self.assertEqual(model.said, [])
            self.assert_whole(model.figures(), mesh)
            for rows in model.cells(3).values():
                self.assertGreater(tet_volumes(model.xyz, rows[:, 1:]).min(), 0.0)

    def test_boxes_hold_their_entities(self):
        for case, files in self.files.items():
            model = Model(files["msh"] / "mesh.msh")
            self.assertEqual(
                len(gmsh.model.getEntities(3)), len(self.meshes[case].volumes()), case
            )
            for _, entity in gmsh.model.getEntities(3):
                box = np.array(gmsh.model.getBoundingBox(3, entity)).reshape(2, 3)
                nodes = gmsh.model.mesh.getElements(3, entity)[2][0].astype(int)
                self.assertTrue((box[0] <= model.xyz[nodes].min(axis=0) + 1e-6).all())
                self.assertTrue((box[1] >= model.xyz[nodes].max(axis=0) - 1e-6).all())

    def test_all_parts_together_are_the_mesh(self):
        for case, mesh in self.meshes.items():
            with self.subTest(case=case):
                with multiprocessing.get_context("fork").Pool(1) as pool:
                    found = pool.apply(figures_of, self.parts(case))
                self.assertEqual(found["parts"], list(range(1, NUM_PARTS + 1)))
                self.assert_whole(found, mesh)

    def test_each_part_has_its_tets_and_the_ghosts_around_them(self):
        for case, mesh in self.meshes.items():
            with self.subTest(case=case):
                self.check_parts(self.parts(case), mesh)

    def check_parts(self, files, mesh):
        _, tets, arrays, _ = read_pvtu(mesh.mesh / "mesh.pvtu")
        ids = arrays["GlobalPointIds"][tets]
        ends = np.cumsum([num_tets_of(file) for file in sorted((mesh.mesh / "mesh").iterdir())])
        owner = np.searchsorted(ends, np.arange(len(tets)), side="right")
        owners, ghosts = {}, []
        for number, file in enumerate(files, 1):
            model = Model(file)
            own = np.concatenate(list(model.cells(3).values()))
            self.assertEqual(len(own), np.count_nonzero(owner == number - 1))
            owners |= dict.fromkeys(own[:, 0].tolist(), number)
            touched = np.isin(ids, np.unique(ids[owner == number - 1])).any(axis=1)
            self.check_partitions(number)
            ghosts += self.check_ghosts(model, number, int(touched.sum()) - len(own))
        for element, part in ghosts:
            self.assertEqual(owners[element], part)

    def check_partitions(self, number):
        """Every partitioned volume is of this part alone, and has a parent."""
        kinds = {}
        for _, entity in gmsh.model.getEntities(3):
            kind = gmsh.model.getType(3, entity)
            kinds.setdefault(kind, []).append(gmsh.model.getPartitions(3, entity).tolist())
            if kind == "Partition volume":
                self.assertEqual(gmsh.model.getParent(3, entity)[0], 3)
        self.assertEqual(kinds["Ghost volume"], [[number]])
        self.assertEqual({tuple(parts) for parts in kinds["Partition volume"]}, {(number,)})

    def check_ghosts(self, model, number, expected):
        """Tags and owners of the ghosts of a part."""
        self.assertGreater(expected, 0)
        ghosts = []
        for _, entity in gmsh.model.getEntities(3):
            tags, parts = gmsh.model.mesh.getGhostElements(3, entity)
            ghosts += zip(tags.tolist(), parts.tolist())
        self.assertEqual(len(ghosts), expected)
        self.assertNotIn(number, {part for _, part in ghosts})
        rows = model.cells(3, with_ghosts=True)["ghost"]
        self.assertEqual(sorted(rows[:, 0].tolist()), sorted(tag for tag, _ in ghosts))
        self.assertGreater(tet_volumes(model.xyz, rows[:, 1:]).min(), 0.0)
        return ghosts

    def test_meshio(self):
        for mesh, file in self.whole_files():
            found = meshio.read(file)
            self.assertEqual(len(found.points), mesh.report()["num_vertices"])
            self.assertEqual(len(found.get_cells_type("tetra")), mesh.num_tets())
            for kind, dimension, measure, expected in (
                ("tetra", 3, tet_volumes, mesh.volumes()),
                ("triangle", 2, triangle_areas, mesh.areas()),
            ):
                tags = found.get_cell_data("gmsh:physical", kind)
                sums = np.bincount(tags, measure(found.points, found.get_cells_type(kind)))
                groups = found.field_data.items()
                by_name = {name: sums[tag] for name, (tag, dim) in groups if dim == dimension}
                self.assert_sizes(by_name, expected)

    def test_gmsh_to_foam(self):
        """Patches on the outside become patches, those within zones of faces, materials zones of cells."""
        for case, mesh in self.meshes.items():
            with self.subTest(case=case):
                self.check_foam(mesh, mesh.folder / "foam", self.files[case]["msh2"] / "mesh_v2.msh")

    def check_foam(self, mesh, folder, file):
        (folder / "system").mkdir(parents=True)
        for name, text in FOAM_FILES.items():
            (folder / "system" / name).write_text(FOAM_HEAD.format(name) + text, encoding="utf-8")
        environment = os.environ | {"WM_PROJECT_DIR": "/usr/share/openfoam"}
        run(["gmshToFoam", "-case", folder, file], env=environment)
        said = run(["checkMesh", "-case", folder], env=environment)
        self.assertRegex(said, rf"cells: +{mesh.num_tets()}\n")
        self.assertIn("Mesh OK.", said)
        boundary = (folder / "constant/polyMesh/boundary").read_text(encoding="utf-8")
        counts = dict(re.findall(r"(\S+)\s*{[^}]*nFaces\s+(\d+);", boundary))
        outer = mesh.outer_areas()
        expected = {name: count if name in outer else 0 for name, count in mesh.triangles().items()}
        self.assertEqual({name: int(count) for name, count in counts.items()}, expected)
        zones = (folder / "constant/polyMesh/cellZones").read_text(encoding="utf-8")
        for name in mesh.volumes():
            self.assertRegex(zones, rf"\n{name}\n{{")

    def test_petsc(self):
        for case, mesh in self.meshes.items():
            with self.subTest(case=case):
                self.check_petsc(mesh, self.files[case]["msh"] / "mesh.msh")

    def check_petsc(self, mesh, file):
        said = run(["/usr/bin/python3", "-c", PETSC_LABELS, file], folder=mesh.folder)
        _, tets, arrays, texts = read_pvtu(mesh.mesh / "mesh.pvtu")
        cells = np.bincount(arrays["attribute"])
        first_patch = len(texts["material_names"]) + 1
        _, _, arrays, texts = read_pvtu(mesh.mesh / "boundary.pvtu")
        names = list(dict.fromkeys(texts["patch_names"]))
        tags = np.array([first_patch + names.index(name) for name in texts["patch_names"]])
        faces = np.bincount(tags[arrays["patch"]])
        expected = {
            "cells": len(tets),
            "Cell Sets": {str(i): int(cells[i]) for i in np.flatnonzero(cells)},
            "Face Sets": {str(i): int(faces[i]) for i in np.flatnonzero(faces)},
        }
        self.assertEqual(json.loads(said.splitlines()[-1]), expected)


# What OpenFOAM's tools must find beside a mesh.
FOAM_HEAD = "FoamFile {{ version 2.0; format ascii; class dictionary; object {}; }}\n"
FOAM_FILES = {
    "controlDict": "application none; startFrom startTime; startTime 0; stopAt endTime; endTime 1;\n"
    "deltaT 1; writeControl timeStep; writeInterval 1;\n",
    "fvSchemes": "divSchemes {} gradSchemes {} laplacianSchemes {}\n",
    "fvSolution": "",
}


def periodic_of(file):
    """By dimension and entities of a pair in a file of version 2.2: the transform, and pairs of nodes in their order."""
    lines = iter(file.read_text(encoding="utf-8").split("$Periodic\n")[1].split("$EndPeriodic")[0].splitlines())
    found = {}
    for _ in range(int(next(lines))):
        entities = tuple(next(lines).split())
        word, *matrix = next(lines).split()
        nodes = sorted(tuple(map(int, next(lines).split())) for _ in range(int(next(lines))))
        found[entities] = word, [round(float(number), 12) for number in matrix], nodes
    assert next(lines, None) is None
    return found


def num_tets_of(file):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput().GetNumberOfCells()


if __name__ == "__main__":
    solver_meshes.main()
