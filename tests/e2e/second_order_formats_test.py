# SPDX-License-Identifier: BSD-3-Clause
"""Tets of second order in other formats than PVTU: the same nodes on the same edges, the same bits for any number of
ranks, and a refusal where a format has no such tets."""
import re
import unittest
import xml.etree.ElementTree

import convert_test
import kill
import numpy
import parts_test
import program
from convert_test import grid_of, hashes
from msh_file import Msh
from program import OK, WRONG_INPUT, sets
from repartition_test import INDEX
from vtkmodules.util.numpy_support import vtk_to_numpy

# Corners of the edges that nodes stand on, from the first after the corners.
VTK_EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
MSH_EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]
TRIANGLE_EDGES = [(0, 1), (1, 2), (2, 0)]
MSH_TRIANGLE, MSH_TET = 9, 11

FORMATS = ("abaqus", "exodus", "msh", "msh2", "xdmf")
REFUSED = ("elmer", "medit", "mfem", "mfem-sets", "msh-parts", "openfoam", "openfoam-serial", "pvtu-cells")


def described(xyz, cells, names, edges):
    """Each cell by the positions of its corners: its name, and which node stands between which of them."""
    num_corners = 3 if len(edges) == 3 else 4
    found = {}
    for row, name in zip((xyz[cells].round(9) + 0.0).tolist(), names):
        points = list(map(tuple, row))
        nodes = {frozenset((points[a], points[b])): points[num_corners + e] for e, (a, b) in enumerate(edges)}
        found[frozenset(points[:num_corners])] = name, nodes
    return found


def triangles_of_sides(tets, sides, opposite):
    """Points of sides of tets, numbered from 1."""
    triangles = []
    for tet, side in sides:
        a, b, c = (corner for corner in range(4) if corner != opposite[side - 1])
        node = {frozenset(edge): tets[tet][4 + e] for e, edge in enumerate(VTK_EDGES)}
        between = [node[frozenset(edge)] for edge in ((a, b), (b, c), (c, a))]
        triangles.append([*(tets[tet][corner] for corner in (a, b, c)), *between])
    return numpy.array(triangles)


class Found:
    """What files hold: tets and triangles as described(), the arrays, points of each patch."""

    def __init__(self, xyz, tets, triangles, nodes=None, edges=None):
        """`tets`, `triangles`: an array, and a name for each row."""
        self.xyz, self.cells, self.nodes = xyz, tets[0], nodes
        self.tets = described(xyz, *tets, edges or VTK_EDGES)
        self.triangles = described(xyz, *triangles, TRIANGLE_EDGES)


def read_abaqus(folder):
    xyz, tets, names, sides, patches, nodes = [], [], [], [], [], {}
    keyword, label = None, None
    for line in (folder / "mesh.inp").read_text().splitlines():
        if line.startswith("*"):
            keyword = line
            label = re.search(r"(?:NSET|ELSET|NAME)=([^,]+)", line)
            label = label and label[1].lower()
        elif keyword.startswith("*NODE"):
            number, *position = map(float, line.split(","))
            xyz.append(position)
            assert number == len(xyz)
        elif keyword.startswith("*ELEMENT, TYPE=C3D10,"):
            element, *points = map(int, line.split(","))
            tets.append((element, points, label))
        elif keyword.startswith("*SURFACE"):
            element, side = line.split(",S")
            sides.append((int(element) - 1, int(side)))
            patches.append(label)
        elif keyword.startswith("*NSET"):
            nodes.setdefault(label.removeprefix("n_"), []).append(int(line) - 1)
    tets.sort()
    assert [tet[0] for tet in tets] == list(range(1, len(tets) + 1))
    points, names = numpy.array([tet[1] for tet in tets]) - 1, [tet[2] for tet in tets]
    triangles = triangles_of_sides(points, sides, convert_test.OPPOSITE_OF_SIDE["abaqus"])
    return Found(numpy.array(xyz), (points, names), (triangles, patches), nodes)


def read_exodus(folder):
    file = convert_test.Netcdf(folder / "mesh.exo")
    assert b"TETRA10" in file.bytes
    xyz = numpy.stack([file["coord" + axis] for axis in "xyz"], axis=1).astype(float)
    blocks = [file[f"connect{i}"] - 1 for i in range(1, len(file["eb_prop1"]) + 1)]
    tets = numpy.concatenate(blocks)
    names = [name for name, block in zip(file.names("eb_names"), blocks) for _ in block]
    sides, patches, nodes = [], [], {}
    for i, patch in enumerate(file.names("ss_names"), 1):
        found = list(zip((file[f"elem_ss{i}"] - 1).tolist(), file[f"side_ss{i}"].tolist()))
        sides += found
        patches += [patch] * len(found)
        nodes[patch] = (file[f"node_ns{i}"] - 1).tolist()
    triangles = triangles_of_sides(tets, sides, convert_test.OPPOSITE_OF_SIDE["exodus"])
    return Found(xyz, (tets, names), (triangles, patches), nodes)


def read_msh_file(file):
    msh = Msh(file)
    assert (msh.nodes == numpy.arange(1, len(msh.nodes) + 1)).all()
    tets, triangles = msh.elements(MSH_TET), msh.elements(MSH_TRIANGLE)
    return Found(msh.xyz, (tets[0][:, 1:] - 1, tets[1]), (triangles[0][:, 1:] - 1, triangles[1]), edges=MSH_EDGES)


READERS = {
    "abaqus": read_abaqus,
    "exodus": read_exodus,
    "msh": lambda folder: read_msh_file(folder / "mesh.msh"),
    "msh2": lambda folder: read_msh_file(folder / "mesh_v2.msh"),
}


def read_pieces(folder):
    """As VTK reads them."""
    found = []
    for name, tags, names, first, width in (("mesh", "attribute", "material_names", 1, 10),
                                            ("boundary", "patch", "patch_names", 0, 6)):
        grid = grid_of(folder / f"{name}.pvtu")
        cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, width)
        texts = grid.GetFieldData().GetAbstractArray(names)
        values = vtk_to_numpy(grid.GetCellData().GetArray(tags))
        points = vtk_to_numpy(grid.GetPoints().GetData())
        found.append((points, cells, [texts.GetValue(int(v) - first) for v in values]))
    (xyz, tets, materials), (outer_xyz, triangles, patches) = found
    return Found(numpy.concatenate([xyz, outer_xyz]), (tets, materials), (triangles + len(xyz), patches))


class SecondOrderFormatsTest(program.ProgramTest):
    """Two materials in four pieces."""

    @classmethod
    def setUpClass(cls):
        cls.maker = cls.make_maker()
        cls.maker.write("two.geo", program.TWO_MATERIALS.replace("(0, 0, 0; 1)", "(0, 0, 0; 1) -bcname=inner")
                        .replace("(0, 0, 0; 2)", "(0, 0, 0; 2) -bcname=outer"))  # fmt: skip
        cls.case = cls.maker.write_case(geometry="two.geo", max_size=1.2, levels=1)
        cls.mesh_folder = cls.maker.mesh(cls.case, "mesh", *cls.keys(2))
        cls.num_points = program.figures(cls.mesh_folder)["num_vertices"]

    @staticmethod
    def keys(order, *more):
        return sets(f"output.order={order}", "fill.kernel='subdivide'", *more)

    def convert(self, mesh, output, formats, ranks=None):
        words = [word for name in formats for word in ("--format", name)]
        return self.run_program("convert", mesh, "--output", output, *words, ranks=ranks)

    def converted(self, mesh, output, formats, ranks=None):
        outcome = self.convert(mesh / "mesh.pvtu", output, formats, ranks)
        self.assertEqual(outcome.code, OK, outcome.err)
        return self.folder / output


class Files(SecondOrderFormatsTest):
    def test_hold_the_mesh_with_its_nodes(self):
        folder = self.converted(self.mesh_folder, "out", FORMATS)
        reference = read_pieces(self.mesh_folder)
        self.assertEqual({name for name, _ in reference.triangles.values()}, {"inner", "outer"})
        for name, read in READERS.items():
            with self.subTest(name):
                found = read(folder)
                self.assertEqual(len(found.xyz), self.num_points)
                self.assertEqual(found.tets, reference.tets)
                self.assertEqual(found.triangles, reference.triangles)
                a, b, c, d = (found.xyz[found.cells[:, i]] for i in range(4))
                self.assertGreater(numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a).min(), 0.0)
                for patch, nodes in (found.nodes or {}).items():
                    self.assertEqual(len(nodes), len(set(nodes)))
                    triangles = [(cell, on) for cell, (name, on) in reference.triangles.items() if name == patch]
                    expected = {point for cell, on in triangles for point in (*cell, *on.values())}
                    self.assertEqual({tuple(x) for x in (found.xyz[nodes].round(9) + 0.0).tolist()}, expected)

    def test_number_vertices_as_of_first_order_and_nodes_after_them(self):
        first = self.mesh(self.case, "first", *self.keys(1))
        straight = convert_test.read_exodus(self.converted(first, "straight", ["exodus"]))
        curved = read_exodus(self.converted(self.mesh_folder, "curved", ["exodus"]))
        num_vertices = len(straight.xyz)
        self.assertLess(num_vertices, self.num_points)
        self.assertTrue((curved.xyz[:num_vertices] == straight.xyz).all())
        self.assertEqual(set(curved.cells[:, :4].ravel()), set(range(num_vertices)))
        self.assertEqual(set(curved.cells[:, 4:].ravel()), set(range(num_vertices, self.num_points)))

    def test_xdmf_names_arrays_of_mesh_h5(self):
        folder = self.converted(self.mesh_folder, "out", ["xdmf"])
        root = xml.etree.ElementTree.parse(folder / "mesh.xdmf").getroot()
        kinds = [topology.get("TopologyType") for topology in root.iter("Topology")]
        self.assertEqual(kinds, ["Tetrahedron_10", "Triangle_6"])
        shapes = {item.text.partition(":")[2]: item.get("Dimensions") for item in root.iter("DataItem")}
        reference = read_pieces(self.mesh_folder)
        self.assertEqual(shapes["/geometry/vertices"], f"{self.num_points} 3")
        self.assertEqual(shapes["/viz/topology/cells"], f"{len(reference.tets)} 10")
        self.assertEqual(shapes["/boundary/triangles"], f"{len(reference.triangles)} 6")

    def test_a_mesh_without_boundary_files(self):
        """All of its surface is one patch, whose set of nodes has those on edges too."""
        outcome = self.convert(self.mesh_folder / "mesh/piece_000000.vtu", "out", READERS)
        self.assertEqual(outcome.code, OK, outcome.err)
        for name, read in READERS.items():
            with self.subTest(name):
                found = read(self.folder / "out")
                (patch,) = {name for name, _ in found.triangles.values()}
                points = {point for cell, (_, on) in found.triangles.items() for point in (*cell, *on.values())}
                if found.nodes is not None:
                    self.assertEqual(len(found.nodes[patch]), len(points))


class SameBits(SecondOrderFormatsTest):
    def test_for_any_number_of_ranks(self):
        one = hashes(self.converted(self.mesh_folder, "one", FORMATS))
        self.assertEqual(set(one), {"mesh.inp", "mesh.exo", "mesh.msh", "mesh_v2.msh", "mesh.h5", "mesh.xdmf",
                                    "tets.xdmf", "boundary.xdmf"})  # fmt: skip
        for ranks in (2, 3):
            self.assertEqual(hashes(self.converted(self.mesh_folder, f"ranks_{ranks}", FORMATS, ranks=ranks)), one)

    def test_as_output_formats_gives(self):
        words = ",".join(f"'{name}'" for name in ("pvtu", *FORMATS))
        together = self.mesh(self.case, "together", *self.keys(2, f"output.formats=[{words}]"), ranks=3)
        afterwards = hashes(self.converted(self.mesh_folder, "afterwards", FORMATS))
        together = hashes(together)
        self.assertEqual({name: together.get(name) for name in afterwards}, afterwards)

    def test_graded_levels_and_corners_that_are_split(self):
        """Edges of pieces with other levels beside them have nodes as well."""
        keys = ("refine.levels=3", "size.target=0.4", "fill.split_corners=true")
        mesh = self.mesh(self.case, "graded", *self.keys(2, *keys))
        reference = read_pieces(mesh)
        found = read_exodus(self.converted(mesh, "out", ["exodus"], ranks=3))
        self.assertEqual(len(found.xyz), program.figures(mesh)["num_vertices"])
        self.assertEqual(found.tets, reference.tets)
        self.assertEqual(found.triangles, reference.triangles)


class Parts(SecondOrderFormatsTest):
    def test_know_their_neighbours(self):
        mesh = self.mesh(self.case, "parts", *self.keys(2, "output.parts=2"))
        pairs = parts_test.shared_points(mesh)
        self.assertEqual([pair[:2] for pair in pairs], [[0, 1]])
        self.assertEqual(program.figures(mesh)["file_neighbours"], pairs)
        self.assertEqual(parts_test.neighbours(mesh / "mesh.pvtu"), pairs)


class Killed(kill.RestartTest):
    """While other formats are made of the pieces."""

    FILES = ("mesh.exo", "mesh.inp")

    @staticmethod
    def make_arguments(maker):
        case = maker.write_case(levels=3)
        return [case, *SecondOrderFormatsTest.keys(2, "output.formats=['pvtu', 'exodus', 'abaqus']")]

    def kill_while_exporting(self):
        for _ in range(kill.TRIES):
            watch = self.start_run(ranks=2)
            program.wait_until(lambda: watch.log.exists() or watch.has_ended(), "the log")
            victims = watch.victims("all")
            has_begun = watch.wait_for(lambda: any("mesh.inp.tmp-" in name for name in kill.names_in(self.out)))
            if has_begun and watch.kill(victims) != OK and not (self.out / "mesh.inp").exists():
                return
        self.fail("no run could be killed while it exported")

    def test_a_run_goes_on(self):
        expected = {name: hashes(self.reference)[name] for name in self.FILES}
        self.kill_while_exporting()
        out = self.resume(ranks=3)
        self.assertNotRegex(out, r"(?m)^(coarse|decompose|plan) ")
        found = hashes(self.out)
        self.assertEqual({name: found[name] for name in self.FILES}, expected)
        self.assertEqual(list(self.out.glob("*.tmp-*")), [])


class Refusals(SecondOrderFormatsTest):
    def test_name_the_formats_that_hold_them(self):
        words = ("second order", *FORMATS, "output.order = 1")
        for name in REFUSED:
            with self.subTest(name):
                outcome = self.convert(self.mesh_folder / "mesh.pvtu", name, [name])
                self.assert_refused(outcome, WRONG_INPUT, name, *words)
                outcome = self.run_program("mesh", self.case, "--output", f"{name}_made",
                                           *self.keys(2, f"output.formats=['{name}']"))  # fmt: skip
                self.assert_refused(outcome, WRONG_INPUT, name, *words)

    def test_of_pieces_of_both_orders(self):
        first = self.mesh(self.case, "first", *self.keys(1))
        for name, folder in (("straight.vtu", first), ("curved.vtu", self.mesh_folder)):
            self.write(name, (folder / "mesh/piece_000000.vtu").read_bytes())
        index = self.write("both.pvtu", INDEX.format('<Piece Source="straight.vtu"/><Piece Source="curved.vtu"/>'))
        for ranks in (None, 2):
            outcome = self.convert(index, f"out_{ranks}", ["exodus"], ranks=ranks)
            self.assert_refused(outcome, WRONG_INPUT, "first order", "second order")


if __name__ == "__main__":
    unittest.main()
