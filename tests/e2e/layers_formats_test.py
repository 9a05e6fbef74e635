# SPDX-License-Identifier: BSD-3-Clause
"""Layers in formats of solvers: prisms, pyramids and quads, which conform, fill what the tets fill, and are the same bits
for any number of ranks. Each format is read by a few lines of its own, or by VTK."""
import collections
import pathlib
import re
import sys
import unittest

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import program  # noqa: E402
from capsule import CAPSULE  # noqa: E402
from convert_test import Netcdf, grid_of, hashes, medit_sections  # noqa: E402
from msh_file import Msh  # noqa: E402
from poly_mesh import PolyMesh  # noqa: E402
from program import OK, sets  # noqa: E402

FORMATS = ("abaqus", "elmer", "exodus", "medit", "mfem", "mfem-sets", "msh", "msh2", "msh-parts", "openfoam",
           "openfoam-serial", "pvtu-cells", "xdmf")  # fmt: skip

# Of 11 degrees, across a channel.
WEDGE = (
    "algebraic3d\nsolid channel = orthobrick (-1, -1, 0; 2, 1, 1);\n"
    "solid wedge = plane (0, 0, 0; -1, 0, 0) and plane (1, 0, 0; 0.1, 1, 0) and plane (1, 0, 0; 0.1, -1, 0);\n"
    "solid flow = channel and not wedge;\ntlo flow;\n"
)

# Sides seen from outside. The first triangle of a prism and the base of a pyramid are seen from the other corners.
SIDES = {
    "tet": [(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)],
    "pyramid": [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
    "prism": [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
}
NUM_CORNERS = {"tet": 4, "pyramid": 5, "prism": 6, "triangle": 3, "quad": 4}
KIND_OF_VTK = {10: "tet", 14: "pyramid", 13: "prism", 5: "triangle", 9: "quad"}


def cycle(points):
    """The same for all corners that one may begin with."""
    first = points.index(min(points))
    return (*points[first:], *points[:first])


def fluxes(xyz, faces):
    """Of the position through each face, by three. A quad is the mean of its two cuts."""
    a, b, c = (xyz[faces[:, i]] for i in range(3))

    def through(a, b, c):
        return numpy.einsum("ij,ij->i", a, numpy.cross(b, c)) / 6.0

    if faces.shape[1] == 3:
        return through(a, b, c)
    d = xyz[faces[:, 3]]
    return (through(a, b, c) + through(a, c, d) + through(a, b, d) + through(b, c, d)) / 2.0


class Mesh:
    """`cells`, `faces` {kind: rows of points}, `patches` {kind: names}."""

    def __init__(self, xyz):
        self.xyz, self.cells, self.faces, self.patches = xyz, {}, {}, {}
        self.materials = collections.Counter()

    def add(self, kind, rows, names):
        rows, names = numpy.array(rows, dtype=int).reshape(-1, NUM_CORNERS[kind]), list(names)
        assert len(rows) == len(names)
        if kind in SIDES:
            self.cells[kind] = numpy.concatenate([self.cells.get(kind, rows[:0]), rows])
            self.materials.update(names)
        else:
            self.faces[kind] = numpy.concatenate([self.faces.get(kind, rows[:0]), rows])
            self.patches.setdefault(kind, []).extend(names)

    def counts(self):
        return {kind: len(rows) for kind, rows in (*self.cells.items(), *self.faces.items()) if len(rows) > 0}

    def volumes(self):
        """Of all cells, by kind."""
        return {kind: sum(fluxes(self.xyz, rows[:, side]) for side in SIDES[kind]) for kind, rows in self.cells.items()}

    def sides(self):
        """All sides of cells."""
        return [cycle(tuple(row[c] for c in side)) for kind, rows in self.cells.items() for row in rows.tolist()
                for side in SIDES[kind]]  # fmt: skip

    def named_faces(self):
        return {cycle(tuple(row)): name for kind, rows in self.faces.items()
                for row, name in zip(rows.tolist(), self.patches[kind])}  # fmt: skip

    def add_sides(self, cells, sides):
        """Faces that are given as a cell, a set of its corners, and a name. `cells`: kind and corners of each."""
        for cell, corners, name in sides:
            kind, row = cells[cell]
            (side,) = (side for side in SIDES[kind] if {row[c] for c in side} == corners)
            self.add("triangle" if len(side) == 3 else "quad", [[row[c] for c in side]], [name])


def merged(xyz, mesh):
    """With one number for each position: pieces have their own."""
    _, first, inverse = numpy.unique(xyz.round(12) + 0.0, axis=0, return_index=True, return_inverse=True)
    result = Mesh(xyz[first])
    inverse = inverse.ravel()
    for kind, rows in mesh.cells.items():
        result.add(kind, inverse[rows], ["material"] * len(rows))
    for kind, rows in mesh.faces.items():
        result.add(kind, inverse[rows], mesh.patches[kind])
    return result


def read_msh(file):
    msh = Msh(file)
    assert (msh.nodes == numpy.arange(1, len(msh.nodes) + 1)).all()
    mesh = Mesh(msh.xyz)
    numbers = []
    for number, kind in ((4, "tet"), (7, "pyramid"), (6, "prism"), (2, "triangle"), (3, "quad")):
        rows, names = msh.elements(number)
        numbers += rows[:, 0].tolist()
        mesh.add(kind, rows[:, 1:] - 1, names)
    assert sorted(numbers) == list(range(1, len(numbers) + 1))
    return mesh


def read_msh_parts(folder):
    xyz, cells = {}, Mesh(None)
    files = sorted(folder.glob("mesh_[0-9]*.msh"))
    assert len(files) > 1
    owned, ghosts = {}, {}
    for file in files:
        msh = Msh(file)
        xyz.update(zip(msh.nodes.tolist(), msh.xyz))
        for number, kind in ((4, "tet"), (7, "pyramid"), (6, "prism"), (2, "triangle"), (3, "quad")):
            rows, names = msh.elements(number)
            cells.add(kind, rows[:, 1:] - 1, names)
            if kind not in SIDES:
                continue
            owned.update((row[0], (kind, *row[1:])) for row in rows.tolist())
            both, _ = msh.elements(number, with_ghosts=True)
            ghosts.update((row[0], (kind, *row[1:])) for row in both.tolist())
    assert owned == ghosts, "ghosts are the cells that others have"
    cells.xyz = numpy.array([xyz[node] for node in range(1, len(xyz) + 1)])
    return cells


def read_medit(folder):
    section, name_of = medit_sections(folder)
    mesh = Mesh(section("Vertices", 4)[:, :3])
    for keyword, kind in (("Tetrahedra", "tet"), ("Pyramids", "pyramid"), ("Prisms", "prism"),
                          ("Triangles", "triangle"), ("Quadrilaterals", "quad")):  # fmt: skip
        rows = section(keyword, NUM_CORNERS[kind] + 1).astype(int)
        names = [name_of["material" if kind in SIDES else "patch", tag] for tag in rows[:, -1]]
        mesh.add(kind, rows[:, :-1] - 1, names)
    return mesh


def read_abaqus(folder):
    """A pyramid is a prism with one point twice."""
    xyz, cells, sides, label = [], {}, [], None
    corners_of_side = {
        4: [(0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)],
        6: [(0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    }
    elements = {}
    for line in (folder / "mesh.inp").read_text().splitlines():
        if line.startswith("*"):
            keyword = line
            label = re.search(r"(?:NSET|ELSET|NAME)=([^,]+)", line)
            label = label and label[1].lower()
        elif keyword.startswith("*NODE"):
            xyz.append([float(word) for word in line.split(",")[1:]])
        elif keyword.startswith("*ELEMENT"):
            element, *nodes = (int(word) - 1 for word in line.split(","))
            elements[element] = nodes, label
        elif keyword.startswith("*SURFACE"):
            element, side = line.split(",S")
            nodes, _ = elements[int(element) - 1]
            corners = corners_of_side[len(nodes)][int(side) - 1]
            sides.append((int(element) - 1, {nodes[c] for c in corners}, label))
    assert sorted(elements) == list(range(len(elements)))
    mesh = Mesh(numpy.array(xyz))
    for element, (nodes, name) in elements.items():
        kind = "tet" if len(nodes) == 4 else "prism"
        if len(set(nodes)) == 5:
            a, b, top, d, c, same = nodes
            assert top == same
            kind, nodes = "pyramid", [a, d, c, b, top]
        cells[element] = kind, nodes
        mesh.add(kind, [nodes], [name])
    mesh.add_sides(cells, sides)
    return mesh


def read_exodus(folder):
    file = Netcdf(folder / "mesh.exo")
    mesh = Mesh(numpy.stack([file["coord" + axis] for axis in "xyz"], axis=1).astype(float))
    corners_of_side = {
        4: [(0, 1, 3), (1, 2, 3), (0, 3, 2), (0, 2, 1)],
        5: [(0, 1, 4), (1, 2, 4), (2, 3, 4), (0, 4, 3), (0, 3, 2, 1)],
        6: [(0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2), (0, 2, 1), (3, 4, 5)],
    }
    cells, ids = [], file["eb_prop1"].tolist()
    names = file.names("eb_names")
    assert len(set(names)) == len(set(ids)) == len(ids)
    for i, name in enumerate(names, 1):
        rows = file[f"connect{i}"] - 1
        kind = {4: "tet", 5: "pyramid", 6: "prism"}[rows.shape[1]]
        assert name.endswith({4: "", 5: "_pyramids", 6: "_prisms"}[rows.shape[1]])
        mesh.add(kind, rows, [name] * len(rows))
        cells += [(kind, row) for row in rows.tolist()]
    sides = []
    for i, name in enumerate(file.names("ss_names"), 1):
        for element, side in zip((file[f"elem_ss{i}"] - 1).tolist(), file[f"side_ss{i}"].tolist()):
            row = cells[element][1]
            sides.append((element, {row[c] for c in corners_of_side[len(row)][side - 1]}, name))
    mesh.add_sides(cells, sides)
    return mesh


def read_mfem(folder, stem):
    """Pieces by MFEM's numbers of shapes; what two pieces share must be the same in both."""
    pieces = Mesh(None)
    kinds = {4: "tet", 7: "pyramid", 6: "prism", 2: "triangle", 3: "quad"}
    xyz, shared = numpy.empty((0, 3)), collections.Counter()
    for file in sorted(folder.glob(stem + ".[0-9]*")):
        text = file.read_text()
        vertices = re.search(r"\nvertices\n\d+\n3\n(.*?)\n\n", text, re.S)[1]
        points = numpy.array(vertices.split(), dtype=float).reshape(-1, 3)
        for section in ("elements", "boundary"):
            for line in re.search(rf"\n{section}\n\d+\n(.*?)\n\n", text, re.S)[1].splitlines():
                tag, kind, *rows = map(int, line.split())
                pieces.add(kinds[kind], [numpy.array(rows) + len(xyz)], [str(tag)])
        lines = text.splitlines()
        for begin, line in enumerate(lines):
            word, _, count = line.partition(" ")
            if word not in ("shared_edges", "shared_faces"):
                continue
            for row in lines[begin + 1 : begin + 1 + int(count)]:
                kind, *rows = [0, *map(int, row.split())] if word == "shared_edges" else map(int, row.split())
                shared[kinds.get(kind, "edge"), *map(tuple, points[rows].tolist())] += 1
        xyz = numpy.concatenate([xyz, points])
    assert {count for entity, count in shared.items() if entity[0] != "edge"} == {2}
    assert min(shared.values()) >= 2
    assert {entity[0] for entity in shared} == {"edge", "triangle", "quad"}
    mesh = merged(xyz, pieces)
    numbers = {tuple(point): number for number, point in enumerate(mesh.xyz.round(12) + 0.0)}
    edges = {frozenset(pair) for side in mesh.sides() for pair in zip(side, (*side[1:], side[0]))}
    for kind, *points in shared:
        if kind == "edge":
            assert frozenset(numbers[tuple(p)] for p in numpy.array(points).round(12) + 0.0) in edges, "a diagonal"
    return mesh


def read_elmer(folder):
    mesh, xyz, numbers = Mesh(None), {}, {"elements": set(), "boundary": set()}
    kinds = {504: "tet", 605: "pyramid", 706: "prism", 303: "triangle", 404: "quad"}
    (parts,) = folder.glob("partitioning.*")
    for nodes in parts.glob("*.nodes"):
        xyz.update((int(w[0]), list(map(float, w[2:]))) for w in map(str.split, nodes.read_text().splitlines()))
        cells = {}
        for line in nodes.with_suffix(".elements").read_text().splitlines():
            number, body, kind, *rows = map(int, line.split())
            numbers["elements"].add(number)
            cells[number] = set(rows)
            mesh.add(kinds[kind], [numpy.array(rows) - 1], [str(body)])
        for line in nodes.with_suffix(".boundary").read_text().splitlines():
            number, patch, parent, _, kind, *rows = map(int, line.split())
            numbers["boundary"].add(number)
            assert set(rows) <= cells[parent]
            mesh.add(kinds[kind], [numpy.array(rows) - 1], [str(patch)])
        counts, _, *types, shared = nodes.with_suffix(".header").read_text().splitlines()
        assert int(shared.split()[0]) > 0
        assert sum(int(t.split()[1]) for t in types) == sum(map(int, counts.split()[1:]))
    assert numbers["elements"] == set(range(1, len(numbers["elements"]) + 1))
    assert numbers["boundary"] == set(range(1, len(numbers["boundary"]) + 1))
    mesh.xyz = numpy.array([xyz[node] for node in range(1, len(xyz) + 1)])
    return mesh


def add_grid(grid, numbers, tags, mesh):
    """Cells of VTK, whose prisms begin with a triangle that is seen from outside."""
    begins = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    points = numbers[vtk_to_numpy(grid.GetCells().GetConnectivityArray())]
    types = vtk_to_numpy(grid.GetCellTypesArray())
    names = vtk_to_numpy(grid.GetCellData().GetArray(tags)).astype(str)
    for number, kind in KIND_OF_VTK.items():
        cells = numpy.flatnonzero(types == number)
        order = [0, 2, 1, 3, 5, 4] if kind == "prism" else range(NUM_CORNERS[kind])
        mesh.add(kind, points[begins[cells][:, None] + numpy.array(order)], names[cells])


def read_pvtu_cells(folder):
    grid = grid_of(folder / "cells.pvtu")
    ids = vtk_to_numpy(grid.GetPointData().GetGlobalIds())
    _, first = numpy.unique(ids, return_index=True)
    cell_ids = vtk_to_numpy(grid.GetCellData().GetGlobalIds())
    assert sorted(cell_ids) == list(range(len(cell_ids)))
    mesh = Mesh(vtk_to_numpy(grid.GetPoints().GetData())[first])
    add_grid(grid, ids, "attribute", mesh)
    return mesh


READERS = {
    "abaqus": read_abaqus,
    "elmer": read_elmer,
    "exodus": read_exodus,
    "medit": read_medit,
    "mfem": lambda folder: read_mfem(folder, "mesh"),
    "mfem-sets": lambda folder: read_mfem(folder, "mesh_sets"),
    "msh": lambda folder: read_msh(folder / "mesh.msh"),
    "msh2": lambda folder: read_msh(folder / "mesh_v2.msh"),
    "msh-parts": read_msh_parts,
    "pvtu-cells": read_pvtu_cells,
}


class LayersFormatsTest(program.ProgramTest):
    MODEL, WALLS = CAPSULE, "wall"

    @classmethod
    def setUpClass(cls):
        maker = cls.make_maker()
        maker.write("model.geo", cls.MODEL)
        cls.case = maker.write(
            "case.toml",
            "geometry.file = 'model.geo'\ncoarse.max_size = 0.4\ndecompose.subdomains = 3\nfill.kernel = 'subdivide'\n"
            f"refine.levels = 1\n[[layer]]\npatch = '{cls.WALLS}'\nfirst = 0.02\ncount = 2\n",
        )
        cls.mesh_folder = maker.mesh(cls.case, "mesh")
        cls.report = program.figures(cls.mesh_folder)

    def converted(self, output, *more, formats=FORMATS, ranks=None):
        words = [word for name in formats for word in ("--format", name)]
        outcome = self.run_program("convert", self.mesh_folder / "mesh.pvtu", "--output", output, *words, *more, ranks=ranks)
        self.assertEqual(outcome.code, OK, outcome.err)
        return self.folder / output


class Files(LayersFormatsTest):
    def expected_counts(self):
        """Of cells, by the piece files."""
        of_prism = vtk_to_numpy(grid_of(self.mesh_folder / "mesh.pvtu").GetCellData().GetArray("tet_of_prism"))
        sizes = numpy.diff(numpy.append(numpy.flatnonzero(of_prism == 0), len(of_prism)))
        return {kind: int((sizes == size).sum()) for kind, size in (("tet", 1), ("pyramid", 2), ("prism", 3))}

    def test_hold_cells_that_conform_and_fill_the_mesh(self):
        folder = self.converted("out")
        expected = self.expected_counts()
        self.assertGreater(min(expected.values()), 10, expected)
        faces = set()
        for name, read in READERS.items():
            with self.subTest(name):
                mesh = read(folder)
                self.assertEqual(len(mesh.xyz), self.report["num_vertices"])
                counts = mesh.counts()
                self.assertEqual({kind: counts[kind] for kind in expected}, expected)
                volumes = mesh.volumes()
                self.assertGreater(min(volume.min() for volume in volumes.values()), 0.0)
                total = sum(volume.sum() for volume in volumes.values())
                self.assertAlmostEqual(total / self.report["volume"], 1.0, delta=1e-12)
                self.assert_conforming(mesh)
                patches = [sorted(collections.Counter(names).values()) for names in mesh.patches.values()]
                faces.add((counts["triangle"], counts["quad"], str(patches)))
        self.assertEqual(len(faces), 1, faces)

    def assert_conforming(self, mesh):
        """Each side is that of another cell, seen from there, or a face of a patch."""
        sides = mesh.sides()
        found = set(sides)
        self.assertEqual(len(found), len(sides))
        outside = {side for side in sides if cycle(side[::-1]) not in found}
        self.assertEqual(outside, set(mesh.named_faces()))

    def test_openfoam_has_the_same_cells(self):
        folder = self.converted("out", formats=("openfoam-serial", "msh"))
        counts = read_msh(folder / "mesh.msh").counts()
        mesh = PolyMesh(folder)
        self.assertEqual(mesh.num_cells(), sum(self.expected_counts().values()))
        begin = len(mesh.neighbour)
        self.assertEqual(int((mesh.num_corners[begin:] == 4).sum()), counts["quad"])


class OfASharpEdge(Files):
    """Layers go on into the flow behind a wedge, and close there."""

    MODEL, WALLS = WEDGE, "patch_[789]"


class SameBits(LayersFormatsTest):
    def test_for_any_number_of_ranks(self):
        one = hashes(self.converted("one"))
        self.assertEqual(hashes(self.converted("ranks_3", ranks=3)), one)


class Tets(LayersFormatsTest):
    def test_are_written_where_they_are_asked_for(self):
        formats = tuple(name for name in FORMATS if name not in ("mfem-sets", "openfoam"))
        folder = self.converted("out", "--layers", "tets", formats=formats)
        for name in ("msh", "exodus", "elmer", "abaqus"):
            with self.subTest(name):
                counts = READERS[name](folder).counts()
                self.assertEqual(set(counts), {"tet", "triangle"})
                self.assertEqual(counts["tet"], self.report["num_tets"])
        self.assertEqual(PolyMesh(folder).num_cells(), self.report["num_tets"])
        made = self.mesh(self.case, "made", *sets("output.layers=tets", "output.formats=['pvtu', 'msh', 'exodus']"))
        found = hashes(made)
        expected = hashes(folder)
        for file in ("mesh.msh", "mesh.exo"):
            self.assertEqual(found[file], expected[file])


if __name__ == "__main__":
    unittest.main()
