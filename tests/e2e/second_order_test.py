# SPDX-License-Identifier: BSD-3-Clause
"""output.order = 2: tets of ten nodes, curved along the geometry, certainly valid, the same for any number of ranks."""
import json
import math
import re
import unittest

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

import program
from program import DEGRADED, FAILED, OK, WRONG_INPUT, sets

# Corners of the edges that VTK's nodes 4 to 9 stand on.
EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
QUADRATIC_TRIANGLE, QUADRATIC_TETRA = 22, 24


def read(file):
    """The grid of a .pvtu, by VTK's own reader, and what it said."""
    reader = vtkXMLPUnstructuredGridReader()
    window = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    reader.SetFileName(str(file))
    reader.Update()
    vtkOutputWindow.SetInstance(None)
    return reader.GetOutput(), window.GetOutput()


def cells_of(grid):
    """Rows of points, one a cell."""
    for c in range(grid.GetNumberOfCells()):
        ids = grid.GetCell(c).GetPointIds()
        yield [ids.GetId(i) for i in range(ids.GetNumberOfIds())]


def ids_of(grid):
    ids = grid.GetPointData().GetGlobalIds()
    return [ids.GetValue(i) for i in range(ids.GetNumberOfValues())]


def middle(a, b):
    return tuple(0.5 * (x + y) for x, y in zip(a, b))


class SecondOrderTest(program.ProgramTest):
    def made(self, case, folder, *values, ranks=None):
        return self.mesh(case, folder, *sets("output.order=2", "output.report_html=false", *values), ranks=ranks)

    def checked(self, folder):
        """Its figures; `check` finds the same in the files, and nothing wrong."""
        figures, found = self.assert_checked(folder, volume_tolerance=1e-12)
        least = found["second_order"]["scaled_jacobian"]["min"]
        self.assertEqual(least, figures["second_order"]["scaled_jacobian"]["min"])
        self.assertGreater(least, 0.0)
        self.assertLess(least, 1.0)
        return figures


class AnyNumberOfRanks(SecondOrderTest):
    def test_has_the_same_bits(self):
        self.write("core.geo", program.TWO_MATERIALS)
        case = self.write_case(geometry="core.geo", max_size=0.8, subdomains=6, levels=1)
        for kernel, others in (("subdivide", (2, 3, 5)), ("optimize", (3,)), ("netgen", (2,))):
            with self.subTest(kernel=kernel):
                alone = self.made(case, kernel, f"fill.kernel={kernel}", ranks=None)
                figures = self.checked(alone)
                self.assertEqual(figures["second_order"]["num_straightened"], 0)
                for ranks in others:
                    other = self.made(case, f"{kernel}_{ranks}", f"fill.kernel={kernel}", ranks=ranks)
                    self.assertEqual(program.figures(other), figures)
                    self.assertEqual(program.mesh_files(other), program.mesh_files(alone))

    def test_and_any_number_of_files_and_graded_levels(self):
        case = self.write_case(levels=3)
        graded = ("fill.kernel=optimize", "size.target=0.15", "size.curvature=10")
        many = self.checked(self.made(case, "many", *graded))
        few = self.checked(self.made(case, "few", *graded, "output.files=2", ranks=2))
        self.assertEqual(few["digest"], many["digest"])


class Nodes(program.ResultTest):
    """Of a ball of radius 1."""

    @classmethod
    def make_result(cls, maker):
        return maker.mesh(maker.write_case(), "out", *sets("output.order=2"), ranks=2)

    def setUp(self):
        super().setUp()
        self.grid, said = read(self.out / "mesh.pvtu")
        self.assertEqual(said, "")
        self.boundary, said = read(self.out / "boundary.pvtu")
        self.assertEqual(said, "")

    def test_stand_in_the_middle_of_edges_or_on_the_geometry(self):
        num_curved = 0
        for nodes in cells_of(self.grid):
            self.assertEqual(len(nodes), 10)
            points = [self.grid.GetPoint(p) for p in nodes]
            for e, (a, b) in enumerate(EDGES):
                node = points[4 + e]
                if node == middle(points[a], points[b]):
                    continue
                num_curved += 1
                self.assertAlmostEqual(math.hypot(*node), 1.0, places=12)
                self.assertLess(math.dist(node, middle(points[a], points[b])), 0.3 * math.dist(points[a], points[b]))
        self.assertGreater(num_curved, 100)

    def test_have_dense_ids_and_one_place_an_id(self):
        places = {}
        for p, name in enumerate(ids_of(self.grid)):
            self.assertEqual(places.setdefault(name, self.grid.GetPoint(p)), self.grid.GetPoint(p))
        self.assertEqual(sorted(places), list(range(self.report["num_vertices"])))
        self.assertEqual(self.grid.GetCellType(0), QUADRATIC_TETRA)

    def test_of_the_boundary_are_those_of_its_tets(self):
        faces = set()
        ids = ids_of(self.grid)
        for nodes in cells_of(self.grid):
            names = [ids[p] for p in nodes]
            between = {frozenset((names[a], names[b])): names[4 + e] for e, (a, b) in enumerate(EDGES)}
            for skipped in range(4):
                face = [names[c] for c in range(4) if c != skipped]
                edges = [between[frozenset(pair)] for pair in ((face[0], face[1]), (face[1], face[2]), (face[0], face[2]))]
                faces.add((frozenset(face), frozenset(edges)))
        ids = ids_of(self.boundary)
        tet_places = dict(zip(ids_of(self.grid), map(self.grid.GetPoint, range(self.grid.GetNumberOfPoints()))))
        for c, nodes in enumerate(cells_of(self.boundary)):
            self.assertEqual(self.boundary.GetCellType(c), QUADRATIC_TRIANGLE)
            names = [ids[p] for p in nodes]
            self.assertIn((frozenset(names[:3]), frozenset(names[3:])), faces)
            for i, (a, b) in enumerate(((0, 1), (1, 2), (2, 0))):
                near = middle(tet_places[names[a]], tet_places[names[b]])
                self.assertLess(math.dist(tet_places[names[3 + i]], near), 0.2)
            for p, name in zip(nodes, names):
                self.assertEqual(self.boundary.GetPoint(p), tet_places[name])
                self.assertAlmostEqual(math.hypot(*self.boundary.GetPoint(p)), 1.0, places=12)


class Volume(SecondOrderTest):
    """Order 4 is what nodes on the geometry give."""

    def assert_converges(self, name, exact, *values):
        case = program.CONFIGS / "cases" / f"{name}.toml"
        errors = []
        for levels in (2, 3):
            folder = f"{name}_{levels}"
            out = self.made(case, folder, f"refine.levels={levels}", "fill.kernel=subdivide", *values)
            errors.append(abs(self.checked(out)["volume"] / exact - 1.0))
        order = math.log2(errors[0] / errors[1])
        self.assertGreaterEqual(order, 3.8, errors)

    def test_of_a_ball_converges(self):
        self.assert_converges("sphere", 4.0 / 3.0 * math.pi, "geometry.file=" + str(program.CONFIGS / "geometry/sphere.geo"))

    def test_of_a_cylinder_converges(self):
        self.assert_converges("cylinder", 2.0 * math.pi, "geometry.file=" + str(program.CONFIGS / "geometry/cylinder.geo"))


class ThinShell(SecondOrderTest):
    """So thin that faces on the outside, once curved, would make their tets invalid."""

    SHELL = (
        "algebraic3d\nsolid outer = sphere (0, 0, 0; 1);\nsolid inner = sphere (0, 0, 0; 0.97);\n"
        "solid shell = outer and not inner;\ntlo shell;\n"
    )

    def test_keeps_nodes_in_the_middle_is_degraded_and_valid(self):
        self.write("shell.geo", self.SHELL)
        case = self.write_case(geometry="shell.geo", max_size=1.0, subdomains=4)
        options = ("--progress", "never", *sets("output.order=2", "fill.kernel=subdivide"))
        found = []
        for ranks in (None, 3):
            outcome = self.run_program("mesh", case, "--output", f"out_{ranks}", *options, ranks=ranks)
            self.assertEqual(outcome.code, DEGRADED, outcome.err)
            found.append(self.checked(self.folder / f"out_{ranks}"))
            self.assertIn("nodes of second order stayed in the middle", found[-1]["reason"])
        self.assertEqual(found[0], found[1])
        self.assertGreater(found[0]["second_order"]["num_straightened"], 0)
        self.assertGreaterEqual(found[0]["num_points_off_geometry"], found[0]["second_order"]["num_straightened"])


class Damage(SecondOrderTest):
    """`check` sees what is wrong with nodes."""

    def damaged(self, replace):
        case = self.write_case(subdomains=2)
        out = self.made(case, "out", "output.compression=none", "fill.kernel=subdivide", ranks=None)
        file = out / "mesh" / "piece_000000.vtu"
        data = bytearray(file.read_bytes())
        head = data.index(b"_", data.index(b"<AppendedData")) + 1
        def offset(name):
            found = re.search(rb'Name="' + name + rb'"[^>]*offset="(\d+)"', bytes(data[:head]))
            return head + int(found.group(1)) + 8
        replace(data, offset(b"Points"), offset(b"connectivity"))
        file.write_bytes(data)
        outcome = self.run_program("check", out / "mesh.pvtu", "--json")
        self.assertEqual(outcome.code, FAILED, outcome.out)
        return {one["kind"] for one in json.loads(outcome.out)["offenders"]}

    def test_nodes_in_another_order(self):
        def replace(data, _, cells):
            fifth, sixth = data[cells + 16:cells + 20], data[cells + 20:cells + 24]
            data[cells + 16:cells + 20], data[cells + 20:cells + 24] = sixth, fifth
        self.assertIn("edge_node", self.damaged(replace))

    def test_a_node_that_makes_a_tet_invalid(self):
        def replace(data, points, cells):
            corner = int.from_bytes(data[cells + 8:cells + 12], "little")  # Not of this node's edge.
            node = int.from_bytes(data[cells + 16:cells + 20], "little")
            for i in range(8, 24):  # All but the first coordinate: no duplicate point.
                data[points + 24 * node + i] = data[points + 24 * corner + i]
        self.assertIn("non_positive_jacobian", self.damaged(replace))


class Refusals(SecondOrderTest):
    def test_name_the_key_and_a_way_out(self):
        case = self.write_case(levels=2)
        order = sets("output.order=2")
        for words, more in ((("fill.levels", "leave out"), sets("fill.levels=1")),
                            (("--dry-run", "output.order = 1"), ["--dry-run"]),
                            (("--only-subdomains", "output.order = 1"),
                             ["--only-subdomains", "0", *sets("fill.kernel=subdivide")])):
            outcome = self.run_program("mesh", case, "--output", "no", *order, *more)
            self.assert_refused(outcome, WRONG_INPUT, *words)
        outcome = self.run_program("mesh", case, "--output", "no", *sets("output.order=3"))
        self.assert_refused(outcome, WRONG_INPUT, "output.order")


if __name__ == "__main__":
    unittest.main()
