# SPDX-License-Identifier: BSD-3-Clause
"""[[embed]] with a polyline: edges of the mesh on lines inside of bodies, as wells, by name."""
import collections
import json
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import program  # noqa: E402
import meshio  # noqa: E402
from program import FAILED, OK, WRONG_INPUT, sets  # noqa: E402
from vtk_grids import grid_of  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter  # noqa: E402

LAYERS = (
    "algebraic3d\nsolid low = orthobrick (0, 0, 0; 2, 1, 0.3);\nsolid middle = orthobrick (0, 0, 0.3; 2, 1, 0.6);\n"
    "solid high = orthobrick (0, 0, 0.6; 2, 1, 1);\ntlo low;\ntlo middle;\ntlo high;\n"
)
# A well that begins above the ground, goes through three layers and a fault, and ends in the lowest layer; a side track
# leaves it where it bends.
WELL = [[0.4, 0.5, 1.2], [0.4, 0.5, 0.45], [1.3, 0.45, 0.2]]
TRACK = [[0.4, 0.5, 0.45], [0.3, 0.2, 0.4]]
FAULT = "[[embed]]\nname = 'fault'\npolygon = [[0.8, -0.1, -0.1], [0.8, 1.1, -0.1], [1.2, 1.1, 0.5], [1.2, -0.1, 0.5]]\n"
LINES = f"[[embed]]\nname = 'well'\npolyline = {WELL}\n[[embed]]\nname = 'track'\npolyline = {TRACK}\n"
TAGS = {"mesh.mesh": "medit:ref", "mesh_v2.msh": "gmsh:physical"}
LENGTHS = {"well": 0.55 + math.dist(WELL[1], WELL[2]), "track": math.dist(*TRACK)}


def ids_of(grid):
    array = grid.GetPointData().GetArray("GlobalPointIds")
    return [int(array.GetValue(row)) for row in range(array.GetNumberOfTuples())]


def cells_of(grid):
    """Ids of the points of each cell, in VTK's order."""
    ids = ids_of(grid)
    for row in range(grid.GetNumberOfCells()):
        points = grid.GetCell(row).GetPointIds()
        yield [ids[points.GetId(i)] for i in range(points.GetNumberOfIds())]


def edges_of_tets(tets):
    """By ends: the node between them, None in a mesh of first order."""
    edges = {}
    for cell in cells_of(tets):
        for row, (a, b) in enumerate([(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]):
            edges[frozenset((cell[a], cell[b]))] = cell[4 + row] if len(cell) == 10 else None
    return edges


def lines_of(grid):
    """The edges of each line by its name."""
    texts = grid.GetFieldData().GetAbstractArray("line_names")
    names = [texts.GetValue(row) for row in range(texts.GetNumberOfValues())]
    line = grid.GetCellData().GetArray("line")
    found = collections.defaultdict(list)
    for row, cell in enumerate(cells_of(grid)):
        found[names[int(line.GetValue(row))]].append(cell)
    return found


def distance_to(line, point):
    def to_piece(a, b):
        along = [q - p for p, q in zip(a, b)]
        share = sum(d * (x - p) for d, x, p in zip(along, point, a)) / sum(d * d for d in along)
        return math.dist(point, [p + min(max(share, 0.0), 1.0) * d for p, d in zip(a, along)])

    return min(to_piece(a, b) for a, b in zip(line, line[1:]))


class LinesTest(program.ProgramTest):
    def case(self, embedded=LINES + FAULT, more="coarse.max_size = 0.25\nrefine.levels = 1\n"):
        self.write("model.geo", LAYERS)
        return self.write("case.toml", f"geometry.file = 'model.geo'\ndecompose.subdomains = 7\n{program.NO_PAGE}{more}{embedded}")

    def assert_lines(self, folder, expected=LENGTHS):
        """Each line is a chain of edges that tets have, on the polyline, as long as it is in the model."""
        report, _ = self.assert_checked(folder, volume_tolerance=1e-12)
        edges = edges_of_tets(grid_of(folder / "mesh.pvtu"))
        grid = grid_of(folder / "lines.pvtu")
        place = {point: grid.GetPoint(row) for row, point in enumerate(ids_of(grid))}
        lines = lines_of(grid)
        self.assertEqual(set(lines), set(expected))
        ids = grid.GetCellData().GetArray("GlobalCellIds")
        self.assertEqual([int(ids.GetValue(row)) for row in range(grid.GetNumberOfCells())], [*range(grid.GetNumberOfCells())])
        for name, cells in lines.items():
            num_at = collections.Counter(end for cell in cells for end in cell[:2])
            self.assertEqual(sorted(num_at.values())[:2], [1, 1])
            self.assertEqual(set(sorted(num_at.values())[2:]), {2})
            self.assertEqual(len({frozenset(cell[:2]) for cell in cells}), len(cells))
            for cell in cells:
                self.assertEqual(edges[frozenset(cell[:2])], cell[2] if len(cell) == 3 else None)
                for point in cell:
                    self.assertLess(distance_to({"well": WELL, "track": TRACK}[name], place[point]), 1e-9)
            length = sum(math.dist(place[cell[0]], place[cell[1]]) for cell in cells)
            self.assertAlmostEqual(length, expected[name], delta=1e-9)
        self.assertEqual(
            {one["name"]: (one["edges"], round(one["length"], 9)) for one in report["lines"]},
            {name: (len(lines[name]), round(length, 9)) for name, length in expected.items()},
        )
        return report


class Wells(LinesTest):
    def test_are_edges_with_the_same_bits_for_any_number_of_ranks(self):
        case = self.case()
        alone = self.mesh(case, "alone")
        report = self.assert_lines(alone)
        areas = {one["name"]: one["area"] for one in report["patches"]}
        self.assertAlmostEqual(areas["fault"], 0.5 / 0.6 * math.hypot(0.4, 0.6), delta=1e-9)
        self.assertEqual(len(report["materials"]), 3)
        lengths = {one["name"]: one["length"] for one in report["model"]["assembly"]["lines"]}
        self.assertEqual(set(lengths), set(LENGTHS))
        self.assertAlmostEqual(lengths["well"], LENGTHS["well"], delta=1e-9)
        for ranks in (2, 3, 5):
            other = self.mesh(case, f"ranks_{ranks}", ranks=ranks)
            self.assertEqual(program.mesh_files(other), program.mesh_files(alone))
            for file in (alone / "lines").iterdir():
                self.assertEqual((other / "lines" / file.name).read_bytes(), file.read_bytes())

    def test_go_with_all_kernels_orders_and_splits_after_the_fill(self):
        case = self.case()
        for settings in (
            ("fill.kernel=subdivide", "output.files=2"),
            ("fill.kernel=optimize",),
            ("output.order=2",),
            ("refine.levels=2", "fill.levels=1"),
            ("refine.levels=2", "fill.levels=1", "fill.kernel=optimize", "coarse.optimize=true"),
        ):
            with self.subTest(settings=settings):
                self.assert_lines(self.mesh(case, "_".join(settings).replace("=", "_"), *sets(*settings), ranks=2))

    def test_stay_where_many_subdomains_meet(self):
        """Seams around them are improved, and pieces exchange tets."""
        case = self.case(LINES, "coarse.max_size = 0.15\nrefine.levels = 1\n")
        for settings in (("fill.kernel=optimize",), ("fill.kernel=optimize", "refine.levels=2", "fill.levels=1")):
            with self.subTest(settings=settings):
                keys = sets("decompose.subdomains=60", *settings)
                report = self.assert_lines(self.mesh(case, settings[-1].replace("=", "_"), *keys, ranks=3))
                self.assertGreater(report["num_subdomains"], 50)

    def test_have_sizes_of_their_own(self):
        region = "size.target = 0.15\n[[size.region]]\ncurve = 'well'\nsize = 0.03\ngrowth = 0.6\n"
        report = self.assert_lines(self.mesh(self.case(more="", embedded=region + LINES), "out", ranks=2))
        edges = {one["name"]: one["edges"] for one in report["lines"]}
        self.assertGreater(edges["well"], LENGTHS["well"] / 0.04)

    def test_go_into_parts_and_formats(self):
        formats = ["msh", "msh2", "medit", "msh-parts", "xdmf", "abaqus", "exodus", "elmer", "mfem", "openfoam", "pvtu-cells"]
        out = self.mesh(self.case(), "out", *sets(f"output.formats={json.dumps(formats)}"), ranks=2)
        report = self.assert_lines(out)
        num_edges = {one["name"]: one["edges"] for one in report["lines"]}
        for file in ("mesh.mesh", "mesh_v2.msh"):
            mesh = meshio.read(out / file)
            tags = [tag for block, data in zip(mesh.cells, mesh.cell_data[TAGS[file]]) if block.type == "line" for tag in data]
            self.assertEqual(sorted(collections.Counter(tags).values()), sorted(num_edges.values()))
        groups = meshio.read(out / "mesh_v2.msh").field_data
        self.assertEqual({name for name, (_, dimension) in groups.items() if dimension == 1}, set(LENGTHS))
        parts = self.folder / "parts"
        self.run_program("repartition", out / "mesh.pvtu", "--parts", 3, "--output", parts, ranks=2)
        self.assertEqual(self.run_program("check", parts / "mesh.pvtu", ranks=2).code, OK)
        self.assertEqual({name: len(cells) for name, cells in lines_of(grid_of(parts / "lines.pvtu")).items()}, num_edges)
        edges = edges_of_tets(grid_of(parts / "mesh.pvtu"))
        for cell in cells_of(grid_of(parts / "lines.pvtu")):
            self.assertIn(frozenset(cell), edges)

    def test_are_held_against_the_tets_by_the_checker(self):
        out = self.mesh(self.case(), "out")
        file = max((out / "lines").iterdir(), key=lambda one: one.stat().st_size)
        grid = grid_of(file)
        x, y, z = grid.GetPoint(0)
        grid.GetPoints().SetPoint(0, x + 1e-3, y, z)
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(file))
        writer.SetInputData(grid)
        writer.Write()
        found = self.run_program("check", out / "mesh.pvtu")
        self.assertEqual(found.code, FAILED)
        self.assertIn("line_edge", found.out)

    def test_go_through_a_crack(self):
        split = "[[split]]\npatch = 'fault'\n"
        out = self.mesh(self.case(embedded=LINES + FAULT + split), "out", ranks=2)
        self.assertEqual(self.run_program("check", out / "mesh.pvtu").code, 0)
        report = json.loads((out / "report.json").read_text())
        self.assertAlmostEqual(sum(one["length"] for one in report["lines"]), sum(LENGTHS.values()), delta=1e-9)


class Refused(LinesTest):
    def test_outside_of_all_solids(self):
        far = "[[embed]]\nname = 'far'\npolyline = [[5, 0, 0], [5, 1, 0]]\n"
        run = self.run_program("mesh", self.case(far), "--output", self.folder / "out")
        self.assertEqual(run.code, WRONG_INPUT)
        self.assertIn('[[embed]] "far" lies outside of all solids', run.err)

    def test_beside_layers(self):
        layer = "[[layer]]\npatch = '*'\nfirst = 0.01\ncount = 2\ngrowth = 1.2\n"
        run = self.run_program("mesh", self.case(LINES + layer), "--output", self.folder / "out")
        self.assertNotEqual(run.code, 0)
        self.assertIn("[[layer]]", run.err)


if __name__ == "__main__":
    unittest.main()
