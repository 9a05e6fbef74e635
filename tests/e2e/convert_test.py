# SPDX-License-Identifier: BSD-3-Clause
"""`tessera convert` and `output.formats`: what the files hold, the same bits for any number of ranks, errors.

Each format is read by a few lines of its own here. tests/solvers has the solvers that read them."""
import hashlib
import os
import re
import resource
import signal
import struct
import tempfile
import unittest
import xml.etree.ElementTree

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE

import program
from program import CANNOT_WRITE, OK, WRONG_INPUT
from vtk_grids import grid_of

FILES = {
    "xdmf": ["mesh.h5", "mesh.xdmf", "tets.xdmf", "boundary.xdmf"],
    "abaqus": ["mesh.inp"],
    "medit": ["mesh.mesh"],
    "exodus": ["mesh.exo"],
    "pvtu-cells": ["cells.pvtu", "cells"],
}
FORMATS = [word for name in FILES for word in ("--format", name)]
OPPOSITE_OF_SIDE = {"abaqus": [3, 2, 0, 1], "exodus": [2, 0, 1, 3]}  # Corner opposite to side 1, 2, 3, 4.


def hashes(folder):
    """By name, of all files but the lock."""
    return {
        file.relative_to(folder).as_posix(): hashlib.sha256(file.read_bytes()).hexdigest()
        for file in folder.glob("**/*")
        if file.is_file() and file.name != ".tessera.lock"
    }


def cells_of(grid, kind, size):
    """Rows of points of the cells of one kind, and which cells they are."""
    cells = grid.GetCells()
    begins = vtk_to_numpy(cells.GetOffsetsArray())
    rows = numpy.flatnonzero(vtk_to_numpy(grid.GetCellTypesArray()) == kind)
    points = vtk_to_numpy(cells.GetConnectivityArray())
    return points[begins[rows][:, None] + numpy.arange(size)], rows


def places(xyz, cells):
    """Each cell as the sorted positions of its corners, so that numbers of points do not matter."""
    corners = xyz[cells].round(9) + 0.0  # No -0.0
    return [tuple(sorted(map(tuple, corner))) for corner in corners.tolist()]


class Reference:
    """What the pieces hold: a tag by name for each tet and triangle."""

    def __init__(self, folder):
        grid = grid_of(folder / "mesh.pvtu")
        self.xyz = vtk_to_numpy(grid.GetPoints().GetData())
        self.num_points = len(set(vtk_to_numpy(grid.GetPointData().GetGlobalIds()).tolist()))
        self.tets = self.by_name(grid, VTK_TETRA, 4, "attribute", "material_names", 1)
        boundary = grid_of(folder / "boundary.pvtu")
        self.triangles = self.by_name(boundary, VTK_TRIANGLE, 3, "patch", "patch_names", 0)

    @staticmethod
    def by_name(grid, kind, size, array, names, first):
        cells, _ = cells_of(grid, kind, size)
        texts = grid.GetFieldData().GetAbstractArray(names)
        tags = vtk_to_numpy(grid.GetCellData().GetArray(array))
        xyz = vtk_to_numpy(grid.GetPoints().GetData())
        return {place: texts.GetValue(int(tag) - first) for place, tag in zip(places(xyz, cells), tags)}


class Found:
    """What a file holds, in the same form. Tets of each material are positive."""

    def __init__(self, xyz, tets, tet_names, triangles, triangle_names, nodes=None):
        self.xyz, self.nodes = xyz, nodes
        a, b, c, d = (xyz[tets[:, i]] for i in range(4))
        self.volumes = numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a)
        self.tets = dict(zip(places(xyz, tets), tet_names))
        self.triangles = dict(zip(places(xyz, triangles), triangle_names))


def sides_to_triangles(tets, sides, opposite):
    """Corners of sides of tets, numbered from 1."""
    return numpy.array([numpy.delete(tets[tet], opposite[side - 1]) for tet, side in sides])


def read_abaqus(folder):
    numbers, tets, names, sides, patches, nodes = [], {}, {}, [], [], {}
    label, keyword = None, None
    for line in (folder / "mesh.inp").read_text().splitlines():
        if line.startswith("*"):
            keyword = line.split(",")[0]
            label = re.search(r"(?:NSET|ELSET|NAME)=([^,]+)", line)
            label = label and label[1].lower()
        elif keyword == "*NODE":
            numbers.append([float(word) for word in line.split(",")])
            assert all(len(word) <= 20 for word in line.split(","))
        elif keyword == "*ELEMENT":
            element, *corners = map(int, line.split(","))
            tets[element], names[element] = corners, label
        elif keyword == "*SURFACE":
            element, side = line.split(",S")
            sides.append((int(element) - 1, int(side)))
            patches.append(label)
        elif keyword == "*NSET":
            nodes.setdefault(label.removeprefix("n_"), []).append(int(line) - 1)
    numbers = numpy.array(numbers)
    assert sorted(tets) == list(range(1, len(tets) + 1))
    assert (numbers[:, 0] == numpy.arange(1, len(numbers) + 1)).all()
    tets = numpy.array([tets[element] for element in sorted(tets)]) - 1
    triangles = sides_to_triangles(tets, sides, OPPOSITE_OF_SIDE["abaqus"])
    return Found(numbers[:, 1:], tets, [names[e] for e in sorted(names)], triangles, patches, nodes)


def medit_sections(folder):
    """A function that gives the rows of a section, and {(kind, tag): name}."""
    text, _, comments = (folder / "mesh.mesh").read_text().partition("\nEnd\n")
    name_of = {(kind, int(tag)): name for kind, tag, name in re.findall(r"^# (\w+) (\d+) (.*)$", comments, re.M)}
    words = text.split()

    def section(keyword, width):
        at = words.index(keyword)
        count = int(words[at + 1])
        return numpy.array(words[at + 2 : at + 2 + count * width], dtype=float).reshape(count, width)

    return section, name_of


def read_medit(folder):
    section, name_of = medit_sections(folder)
    xyz = section("Vertices", 4)[:, :3]
    tets, triangles = section("Tetrahedra", 5).astype(int), section("Triangles", 4).astype(int)
    return Found(xyz, tets[:, :4] - 1, [name_of["material", tag] for tag in tets[:, 4]],
                 triangles[:, :3] - 1, [name_of["patch", tag] for tag in triangles[:, 3]])  # fmt: skip


class Netcdf:
    """The variables of a file in netCDF's classic form of 64-bit sizes, and nothing else."""

    TYPES = {1: "b", 2: "S1", 4: ">i4", 5: ">f4", 6: ">f8", 10: ">i8"}

    def __init__(self, file):
        self.bytes, self.at = file.read_bytes(), 4
        assert self.bytes[:4] == b"CDF\x05"
        assert self.take(">q") == 0  # Records.
        dimensions = [(self.text(), self.take(">q")) for _ in range(self.length())]
        self.attributes()
        self.variables = {}
        for _ in range(self.length()):
            name = self.text()
            shape = [dimensions[self.take(">q")][1] for _ in range(self.take(">q"))]
            self.attributes()
            kind = numpy.dtype(self.TYPES[self.take(">i")])
            self.take(">q")
            begin = self.take(">q")
            count = int(numpy.prod(shape))
            self.variables[name] = numpy.frombuffer(self.bytes, kind, count, begin).reshape(shape) if count else None

    def take(self, form):
        (value,) = struct.unpack_from(form, self.bytes, self.at)
        self.at += struct.calcsize(form)
        return value

    def length(self):
        self.take(">i")
        return self.take(">q")

    def text(self):
        size = self.take(">q")
        self.at += -(-size // 4) * 4
        return self.bytes[self.at - -(-size // 4) * 4 :][:size].decode()

    def attributes(self):
        for _ in range(self.length()):
            self.text()
            size = numpy.dtype(self.TYPES[self.take(">i")]).itemsize * self.take(">q")
            self.at += -(-size // 4) * 4

    def __getitem__(self, name):
        return self.variables[name]

    def names(self, name):
        return [row.tobytes().rstrip(b"\0").decode() for row in self[name]]


def read_exodus(folder):
    file = Netcdf(folder / "mesh.exo")
    xyz = numpy.stack([file["coord" + axis] for axis in "xyz"], axis=1).astype(float)
    blocks = [file[f"connect{i}"] - 1 for i in range(1, len(file["eb_prop1"]) + 1)]
    tets = numpy.concatenate(blocks)
    names = [name for name, block in zip(file.names("eb_names"), blocks) for _ in block]
    sides, patches, nodes = [], [], {}
    for i, patch in enumerate(file.names("ss_names"), 1):
        found = list(zip((file[f"elem_ss{i}"] - 1).tolist(), file[f"side_ss{i}"].tolist()))
        sides += found
        patches += [patch] * len(found)
    for i, patch in enumerate(file.names("ns_names"), 1):
        nodes[patch] = (file[f"node_ns{i}"] - 1).tolist()
    triangles = sides_to_triangles(tets, sides, OPPOSITE_OF_SIDE["exodus"])
    return Found(xyz, tets, names, triangles, patches, nodes)


def read_pvtu_cells(folder):
    grid = grid_of(folder / "cells.pvtu")
    xyz = vtk_to_numpy(grid.GetPoints().GetData())
    names = grid.GetFieldData().GetAbstractArray("attribute_names")
    tags = vtk_to_numpy(grid.GetCellData().GetArray("attribute"))
    ids = vtk_to_numpy(grid.GetCellData().GetGlobalIds())
    assert sorted(ids) == list(range(len(ids)))
    (tets, tet_rows), (triangles, rows) = cells_of(grid, VTK_TETRA, 4), cells_of(grid, VTK_TRIANGLE, 3)
    assert max(ids[tet_rows]) < min(ids[rows])
    point_ids = vtk_to_numpy(grid.GetPointData().GetGlobalIds())
    _, first = numpy.unique(point_ids, return_index=True)
    found = Found(xyz, tets, [names.GetValue(int(tag) - 1) for tag in tags[tet_rows]],
                  triangles, [names.GetValue(int(tag) - 1) for tag in tags[rows]])  # fmt: skip
    found.xyz = xyz[first]
    return found


READERS = {"abaqus": read_abaqus, "medit": read_medit, "exodus": read_exodus, "pvtu-cells": read_pvtu_cells}


class ConvertTest(program.ProgramTest):
    """Two materials in four pieces, of which some share points."""

    @classmethod
    def setUpClass(cls):
        maker = cls.make_maker()
        maker.write("two.geo", program.TWO_MATERIALS.replace("(0, 0, 0; 1)", "(0, 0, 0; 1) -bcname=inner")
                    .replace("(0, 0, 0; 2)", "(0, 0, 0; 2) -bcname=outer"))  # fmt: skip
        cls.case = maker.write_case(geometry="two.geo", max_size=1.2, levels=0)
        cls.mesh_folder = maker.mesh(cls.case, "mesh", *program.sets("fill.kernel='subdivide'"))
        cls.source = cls.mesh_folder / "mesh.pvtu"

    def convert(self, output, *arguments, ranks=None, **options):
        return self.run_program("convert", self.source, "--output", output, *arguments, ranks=ranks, **options)

    def converted(self, output, *arguments, ranks=None):
        outcome = self.convert(output, *arguments, ranks=ranks)
        self.assertEqual(outcome.code, OK, outcome.err)
        return self.folder / output


class Files(ConvertTest):
    def test_each_holds_the_mesh(self):
        folder = self.converted("out", *FORMATS)
        reference = Reference(self.mesh_folder)
        self.assertEqual(set(reference.triangles.values()), {"inner", "outer"})
        self.assertEqual(len(set(reference.tets.values())), 2)
        for name, read in READERS.items():
            with self.subTest(name):
                found = read(folder)
                self.assertEqual(len(found.xyz), reference.num_points)
                self.assertTrue((found.volumes > 0).all())
                self.assertEqual(found.tets, reference.tets)
                self.assertEqual(found.triangles, reference.triangles)
                if found.nodes is not None:
                    self.check_nodes(found, reference)

    def check_nodes(self, found, reference):
        """The points of each patch, each of them once."""
        self.assertEqual(set(found.nodes), set(reference.triangles.values()))
        for patch, nodes in found.nodes.items():
            self.assertEqual(len(nodes), len(set(nodes)))
            expected = {xyz for place, name in reference.triangles.items() if name == patch for xyz in place}
            self.assertEqual({tuple(xyz) for xyz in (found.xyz[nodes].round(9) + 0.0).tolist()}, expected)

    def test_coordinates_are_the_same_bits(self):
        folder = self.converted("out", *FORMATS)
        expected = set(map(tuple, Reference(self.mesh_folder).xyz.tolist()))
        for name in ("medit", "exodus", "pvtu-cells"):
            with self.subTest(name):
                self.assertEqual(set(map(tuple, READERS[name](folder).xyz.tolist())), expected)

    def test_xdmf_names_arrays_of_mesh_h5(self):
        folder = self.converted("out", "--format", "xdmf")
        size = (folder / "mesh.h5").stat().st_size
        reference = Reference(self.mesh_folder)
        root = xml.etree.ElementTree.parse(folder / "mesh.xdmf").getroot()
        shapes = {item.text.partition(":")[2]: item.get("Dimensions") for item in root.iter("DataItem")}
        self.assertEqual(shapes["/geometry/vertices"], f"{reference.num_points} 3")
        self.assertEqual(shapes["/viz/topology/cells"], f"{len(reference.tets)} 4")
        self.assertGreater(size, 24 * reference.num_points + 32 * len(reference.tets))

    def test_check_reads_pieces_with_triangles(self):
        folder = self.converted("out", "--format", "pvtu-cells")
        outcome = self.run_program("check", folder / "cells.pvtu")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)

    def test_a_mesh_without_boundary_files(self):
        """All of its surface is one patch."""
        outcome = self.run_program("convert", self.mesh_folder / "mesh/piece_000000.vtu", *FORMATS, "--output", "out")
        self.assertEqual(outcome.code, OK, outcome.err)
        for name, read in READERS.items():
            with self.subTest(name):
                found = read(self.folder / "out")
                (patch,) = set(found.triangles.values())
                if found.nodes is not None:
                    corners = {xyz for place in found.triangles for xyz in place}
                    self.assertEqual(len(found.nodes[patch]), len(corners))


class SameBits(ConvertTest):
    def test_for_any_number_of_ranks(self):
        one = hashes(self.converted("one", *FORMATS))
        for files in FILES.values():
            for file in files:
                self.assertTrue(any(name == file or name.startswith(file + "/") for name in one), file)
        for ranks in (2, 3):
            self.assertEqual(hashes(self.converted(f"ranks_{ranks}", *FORMATS, ranks=ranks)), one)

    def test_as_output_formats_gives(self):
        words = ",".join(f"'{name}'" for name in ("pvtu", *FILES))
        formats = program.sets("fill.kernel='subdivide'", f"output.formats=[{words}]")
        together = hashes(self.mesh(self.case, "together", *formats, ranks=2))
        afterwards = hashes(self.converted("afterwards", *FORMATS))
        self.assertEqual({name: together.get(name) for name in afterwards}, afterwards)


class Errors(ConvertTest):
    def test_wrong_input(self):
        outcome = self.run_program("convert", "none.pvtu", "--format", "medit", "--output", "out")
        self.assert_refused(outcome, WRONG_INPUT, "none.pvtu: no such file")
        self.assert_refused(self.convert("out", "--format", "stl"), WRONG_INPUT, "stl", "exodus")
        second = self.mesh(self.case, "second", *program.sets("fill.kernel='subdivide'", "output.order=2"))
        outcome = self.run_program("convert", second / "mesh.pvtu", "--format", "medit", "--output", "out_2")
        self.assert_refused(outcome, WRONG_INPUT, "second order", "output.order = 1")

    def test_folder_is_not_empty(self):
        folder = self.converted("out", "--format", "medit")
        before = hashes(folder)
        self.assert_refused(self.convert("out", "--format", "abaqus"), CANNOT_WRITE, "out", "--overwrite")
        self.assertEqual(hashes(folder), before)

    def test_overwriting_leaves_nothing_of_before(self):
        folder = self.converted("out", *FORMATS)
        self.assertEqual({file.name for file in folder.iterdir()},
                         {".tessera.lock", *(name for names in FILES.values() for name in names)})  # fmt: skip
        (folder / "mine.txt").write_text("kept")
        self.converted("out", "--format", "medit", "--overwrite")
        self.assertEqual({file.name for file in folder.iterdir()}, {".tessera.lock", "mesh.mesh", "mine.txt"})

    def test_full_disk(self):
        whole = self.converted("whole", *FORMATS)
        environment = os.environ | {
            "OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_btl": "self", "PMIX_MCA_gds": "hash",
            **program.mpi_files_in(tempfile.mkdtemp(prefix="mpi_", dir=self.folder)),
        }  # fmt: skip
        for name, files in FILES.items():
            sizes = [file.stat().st_size for file in whole.glob("**/*") if file.relative_to(whole).parts[0] in files]
            for limit in (1, max(sizes) // 2, max(sizes) - 1):
                with self.subTest(name=name, limit=limit):
                    output = f"{name}_{limit}"
                    outcome = self.convert(
                        output, "--format", name, env=environment,
                        preexec_fn=lambda size=limit: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)),
                    )  # fmt: skip
                    self.assert_refused(outcome, CANNOT_WRITE, f"cannot write {output}/")
                    left = {file.name for file in (self.folder / output).iterdir()}
                    self.assertLessEqual(left, {".tessera.lock", "cells"})
                    self.assertEqual(list((self.folder / output).glob("**/*.tmp-*")), [])

    def test_killed(self):
        """Nothing has its final name, and the next one begins anew."""
        settings = program.sets("fill.kernel='subdivide'", "refine.levels=3", "improve.seams=false")
        source = self.mesh(self.case, "large", *settings) / "mesh.pvtu"
        command = ("convert", source, "--format", "medit", "--format", "exodus", "--output")
        self.assertEqual(self.run_program(*command, "whole").code, OK)
        folder = self.folder / "killed"
        process = self.start(*command, "killed")
        program.wait_until(lambda: len(list(folder.glob("*.tmp-*"))) == 2, "files that are being written")
        process.send_signal(signal.SIGKILL)
        process.communicate()
        self.assertEqual(process.returncode, -signal.SIGKILL)
        self.assertEqual(set(hashes(folder)), {"mesh.mesh.tmp-0", "mesh.exo.tmp-0"})
        outcome = self.run_program(*command, "killed", "--overwrite")
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual(hashes(folder), hashes(self.folder / "whole"))


if __name__ == "__main__":
    unittest.main()
