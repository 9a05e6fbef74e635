# SPDX-License-Identifier: BSD-3-Clause
"""Sizes that differ: regions and field files. Edges are as long as is wanted where they are; the result has the same
bits for any number of ranks and after any interruption; what makes no sense is refused by name."""
import json
import math
import statistics
import unittest

import kill
import program
from program import NO_PAGE, OK, WRONG_INPUT
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

SUBDIVIDE = ("--set", "fill.kernel=subdivide")
TARGET = 0.4
GROWTH = 0.3  # size.grading of every case here.

# A bar from 0 to 4 of two materials that meet at x = 2.
BAR = (
    "algebraic3d\n"
    "solid inlet = plane (0, 0, 0; -1, 0, 0);\n"
    "solid others = plane (0, 0, 0; 0, -1, 0) and plane (0, 0, 0; 0, 0, -1)\n"
    "  and plane (4, 1, 1; 0, 1, 0) and plane (4, 1, 1; 0, 0, 1) and plane (4, 1, 1; 1, 0, 0);\n"
    "solid near = plane (2, 0, 0; 1, 0, 0);\n"
    "solid left = inlet and others and near;\nsolid right = inlet and others and not near;\n"
    "tlo left;\ntlo right;\n"
)

CORNER_BALL = '[[size.region]]\nball = { centre = [4, 1, 1], radius = 0.2 }\nsize = 0.05\n'


def edges_of(folder):
    """The ends of every edge."""
    reader = vtkXMLPUnstructuredGridReader()
    reader.SetFileName(str(folder / "mesh.pvtu"))
    reader.Update()
    grid = reader.GetOutput()
    ids, cell, edges = grid.GetPointData().GetGlobalIds(), vtkIdList(), {}
    for c in range(grid.GetNumberOfCells()):
        grid.GetCellPoints(c, cell)
        corners = sorted((ids.GetValue(cell.GetId(i)), cell.GetId(i)) for i in range(4))
        for i, one in enumerate(corners):
            for other in corners[i + 1:]:
                edges[one[0], other[0]] = one[1], other[1]
    return [(grid.GetPoint(a), grid.GetPoint(b)) for a, b in edges.values()]


def numbers(values):
    return " ".join(f"{value:.17g}" for value in values)


def data_array(kind, name, values, components=1):
    return (
        f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
        f"{numbers(values)}</DataArray>"
    )


def vti(size_at, counts=(17, 5, 5), step=0.25, name="size"):
    """A grid from the origin on."""
    points = [
        (step * i, step * j, step * k)
        for k in range(counts[2]) for j in range(counts[1]) for i in range(counts[0])
    ]  # fmt: skip
    extent = " ".join(f"0 {count - 1}" for count in counts)
    sizes = data_array("Float64", name, [size_at(point) for point in points])
    return (
        f'<VTKFile type="ImageData" version="0.1"><ImageData WholeExtent="{extent}" Origin="0 0 0" '
        f'Spacing="{step} {step} {step}"><Piece Extent="{extent}"><PointData>{sizes}</PointData>'
        "</Piece></ImageData></VTKFile>"
    )


def vtu(size_at, begin=0, end=8, name="size"):
    """Hexahedra of half a length along the bar, from number `begin` to `end`."""
    points = [(0.5 * i, j, k) for i in range(begin, end + 1) for k in (0, 1) for j in (0, 1)]
    cells = [
        4 * i + corner
        for i in range(end - begin) for corner in (0, 4, 5, 1, 2, 6, 7, 3)
    ]  # fmt: skip
    num_cells = end - begin
    return (
        '<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid>'
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{num_cells}">'
        f"<PointData>{data_array('Float64', name, [size_at(point) for point in points])}</PointData><Points>"
        f"{data_array('Float64', 'Points', [x for point in points for x in point], 3)}</Points><Cells>"
        f"{data_array('Int64', 'connectivity', cells)}"
        f"{data_array('Int64', 'offsets', [8 * (c + 1) for c in range(num_cells)])}"
        f"{data_array('UInt8', 'types', [12] * num_cells)}</Cells></Piece></UnstructuredGrid></VTKFile>"
    )


def pvtu(*pieces):
    sources = "".join(f'<Piece Source="{piece}"/>' for piece in pieces)
    return (
        '<VTKFile type="PUnstructuredGrid" version="0.1"><PUnstructuredGrid GhostLevel="0">'
        '<PPointData><PDataArray type="Float64" Name="size"/></PPointData>'
        '<PPoints><PDataArray type="Float64" Name="Points" NumberOfComponents="3"/></PPoints>'
        f"{sources}</PUnstructuredGrid></VTKFile>"
    )


def along_the_bar(point):
    return 0.08 + 0.1 * point[0]


class BarTest(program.ProgramTest):
    def write_bar(self, text, target=TARGET, subdomains=4):
        """A case of the bar; `text` follows the keys of [size]."""
        self.write("bar.geo", BAR)
        size = f"target = {target}\n" if target else ""
        return self.write(
            "case.toml",
            f"geometry.file = 'bar.geo'\ndecompose.subdomains = {subdomains}\n{NO_PAGE}"
            f"[size]\ngrading = {GROWTH}\n{size}{text}",
        )

    def made(self, text, *arguments, target=TARGET, ranks=None, output="out"):
        return self.mesh(self.write_bar(text, target), output, *SUBDIVIDE, *arguments, ranks=ranks)

    def assert_follows(self, folder, size_at):
        """All edges, and those where sizes are smallest alone, against the size at their middles. `subdivide` moves
        no point, and few edges are near a small region."""
        parts = []
        for a, b in edges_of(folder):
            size = size_at([0.5 * (p + q) for p, q in zip(a, b)])
            parts.append((size, math.dist(a, b) / size))
        smallest = sorted(parts)[: len(parts) // 10]
        for some, most_median, most in ((parts, 1.2, 1.7), (smallest, 1.5, 2.0)):
            lengths = sorted(part for _, part in some)
            self.assertGreater(statistics.median(lengths), 0.6)
            self.assertLess(statistics.median(lengths), most_median)
            self.assertLess(lengths[int(0.95 * len(lengths))], most)


def grown(distance_to, size, growth=GROWTH, most=TARGET):
    return lambda point: min(most, size + growth * max(0.0, distance_to(point)))


def distance_to_box(low, high):
    return lambda point: math.dist(point, [min(max(x, a), b) for x, a, b in zip(point, low, high)])


class Regions(BarTest):
    def test_solids(self):
        for text, distance_to in (
            ("box = { min = [0, 0, 0], max = [0.3, 1, 1] }", distance_to_box((0, 0, 0), (0.3, 1, 1))),
            ("ball = { centre = [4, 1, 1], radius = 0.3 }", lambda p: math.dist(p, (4, 1, 1)) - 0.3),
            (
                "cylinder = { start = [2, 0, 0], end = [2, 1, 0], radius = 0.2 }",
                lambda p: math.dist((p[0], p[2]), (2, 0)) - 0.2,
            ),
            ("halfspace = { point = [0.5, 0, 0], normal = [1, 0, 0] }", lambda p: p[0] - 0.5),
        ):
            with self.subTest(text):
                out = self.made(f"[[size.region]]\n{text}\nsize = 0.1\n", "--overwrite")
                self.assert_follows(out, grown(distance_to, 0.1))

    def test_patches_and_materials(self):
        out = self.made('[[size.region]]\nmaterial = "lef*"\nsize = 0.12\ngrowth = 0.6\n', output="left")
        self.assert_follows(out, grown(lambda p: p[0] - 2.0, 0.12, 0.6))
        out = self.made('[[size.region]]\npatch = "patch_*"\nsize = 0.12\n', output="skin")

        def depth(point):
            return min(abs(point[0] - 2.0), *(min(x, m - x) for x, m in zip(point, (4, 1, 1))))

        self.assert_follows(out, grown(depth, 0.12))

    def curve_along(self, axis, *place):
        """Number of the only edge of the bar along an axis that begins at a place."""
        found = json.loads(self.run_program("info", self.write("bar.geo", BAR), "--json").out)["edges"]
        there = [
            edge["number"] for edge in found
            if all(abs(edge["box"]["low"][i] - place[i]) < 1e-6 for i in range(3))
            and all(edge["box"]["high"][i] - edge["box"]["low"][i] < 1e-6 for i in range(3) if i != axis)
        ]  # fmt: skip
        self.assertEqual(len(there), 1, found)
        return there[0]

    def test_curves(self):
        upright = self.curve_along(2, 4, 1, 0)
        out = self.made(f'[[size.region]]\ncurve = "{upright}"\nsize = 0.06\n')
        self.assert_follows(out, grown(lambda p: math.dist(p[:2], (4, 1)), 0.06))

    def test_the_smallest_wins_within_bounds(self):
        out = self.made(
            "min = 0.1\nmax = 0.3\n"
            "[[size.region]]\nball = { centre = [0, 0, 0], radius = 0.3 }\nsize = 0.01\n"
            "[[size.region]]\nhalfspace = { point = [3.5, 0, 0], normal = [-1, 0, 0] }\nsize = 0.15\n"
        )
        near_ball = grown(lambda p: math.dist(p, (0, 0, 0)) - 0.3, 0.01)
        near_end = grown(lambda p: 3.5 - p[0], 0.15)
        self.assert_follows(out, lambda p: min(0.3, max(0.1, min(near_ball(p), near_end(p)))))

    def test_with_the_coarse_size_alone(self):
        """Elsewhere, coarse edges stay as they are: nothing wants them shorter."""
        out = self.made(CORNER_BALL, "--set", "coarse.max_size=0.8", target=None)
        report = json.loads((out / "report.json").read_text())
        self.assertGreater(report["coarse"]["edges_by_level"][0], 0)
        near = [
            math.dist(a, b) / grown(lambda p: math.dist(p, (4, 1, 1)) - 0.2, 0.05)(a)
            for a, b in edges_of(out) if math.dist(a, (4, 1, 1)) < 0.3
        ]  # fmt: skip
        self.assertGreater(len(near), 50)
        self.assertLess(statistics.median(near), 1.25)

    def test_one_to_a_hundred_needs_a_finer_coarse_mesh(self):
        out = self.made("[[size.region]]\nball = { centre = [4, 1, 1], radius = 0.02 }\nsize = 0.004\n")
        report = json.loads((out / "report.json").read_text())
        self.assertEqual(report["coarse"]["tries"], 2)
        self.assert_follows(out, grown(lambda p: math.dist(p, (4, 1, 1)) - 0.02, 0.004))

    def test_curvature(self):
        self.write("ball.geo", program.BALL)
        case = self.write("case.toml", "geometry.file = 'ball.geo'\ncoarse.max_size = 1.0\nsize.curvature = 8.0\n" + NO_PAGE)
        out = self.mesh(case, "out", *SUBDIVIDE)
        on_sphere = [
            math.dist(a, b) for a, b in edges_of(out) if all(math.hypot(*p) > 0.999 for p in (a, b))
        ]  # fmt: skip
        self.assertLess(statistics.median(on_sphere), 1.3 / 8.0)


class Fields(BarTest):
    def write_field(self, kind, size_at=along_the_bar):
        if kind == "vti":
            return self.write("field.vti", vti(size_at))
        if kind == "vtu":
            return self.write("field.vtu", vtu(size_at))
        self.write("one.vtu", vtu(size_at, 0, 3))
        self.write("two.vtu", vtu(size_at, 3, 8))
        return self.write("field.pvtu", pvtu("one.vtu", "two.vtu"))

    def test_of_every_format(self):
        for kind in ("vti", "vtu", "pvtu"):
            with self.subTest(kind):
                self.write_field(kind)
                out = self.made(f"field = 'field.{kind}'\n", output=kind)
                self.assert_follows(out, lambda p: min(along_the_bar(p), TARGET))

    def test_without_another_size(self):
        self.write_field("vtu")
        out = self.made("field = 'field.vtu'\n", "--set", "coarse.max_size=0.6", target=None)
        self.assert_follows(out, along_the_bar)

    def test_of_a_name(self):
        self.write("field.vti", vti(along_the_bar, name="h"))
        case = self.write_bar("field = 'field.vti'\n")
        outcome = self.run_program("mesh", case, "--output", "wrong")
        self.assert_refused(outcome, WRONG_INPUT, "size.field", "field.vti", '"size"', '"h"')
        self.mesh(case, "right", *SUBDIVIDE, "--set", "size.field_array=h")

    def test_growth_is_limited(self):
        """A jump from 0.05 to 0.4: beside it sizes grow as grading lets them."""
        self.write("field.vti", vti(lambda p: 0.05 if p[0] == 0.0 else 0.4))
        out = self.made("field = 'field.vti'\n")
        self.assert_follows(out, grown(lambda p: p[0], 0.05))


class Refusals(BarTest):
    def refused(self, text, *words, ranks=None):
        outcome = self.run_program("mesh", self.write_bar(text), "--output", "out", "--overwrite", ranks=ranks)
        self.assert_refused(outcome, WRONG_INPUT, *words)

    def test_regions(self):
        away = "[[size.region]]\nball = { centre = [9, 9, 9], radius = 1 }\nsize = 0.1\n"
        for ranks in (None, 3):
            self.refused(away, "bar.geo", "[[size.region]] number 1 (ball)", "meets nothing", ranks=ranks)
        self.refused(CORNER_BALL + '[[size.region]]\npatch = "patch_0"\nsize = 0.1\n', "number 2", '"patch_1"')
        self.refused('[[size.region]]\nmaterial = "lift"\nsize = 0.1\n', '"lift"', '"left"', '"right"')
        self.refused('[[size.region]]\ncurve = "1-1"\nsize = 0.1\n', "number 1 (curve)", "no such curve", '"1-2"')

    def test_fields(self):
        for ranks in (None, 3):
            self.refused("field = 'field.vti'\n", "size.field", "field.vti", ranks=ranks)
        self.write("field.vti", vti(lambda p: along_the_bar(p) if p[0] < 1.0 else -1.0))
        self.refused("field = 'field.vti'\n", "size.field", "-1")
        self.write("field.vti", vti(along_the_bar).replace('Origin="0 0 0"', 'Origin="50 0 0"'))
        self.refused("field = 'field.vti'\n", "size.field", "does not meet")
        self.write("field.vti", "no XML")
        self.refused("field = 'field.vti'\n", "size.field", "field.vti")


class Runs(BarTest):
    def setUp(self):
        super().setUp()
        self.write("field.vti", vti(along_the_bar))
        self.text = "field = 'field.vti'\n" + CORNER_BALL

    def test_any_number_of_ranks_makes_the_same_bits(self):
        alone = self.made(self.text, ranks=None, output="alone")
        for ranks in (2, 3):
            other = self.made(self.text, ranks=ranks, output=f"ranks_{ranks}")
            self.assertEqual(program.figures(other), program.figures(alone))
            self.assertEqual(program.mesh_files(other), program.mesh_files(alone))
        outcome = self.run_program("check", alone / "mesh.pvtu", "--json")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        self.assertEqual(json.loads(outcome.out)["digest"], program.figures(alone)["digest"])

    def test_some_subdomains_alone_are_those_of_the_whole(self):
        whole = program.mesh_files(self.made(self.text, output="whole"))
        some = self.made(self.text, "--only-subdomains", "0,2", output="some")
        files = {name: hash_ for name, hash_ in program.mesh_files(some).items() if "/" in name}
        self.assertEqual(len(files), 4)
        for name, hash_ in files.items():
            self.assertEqual(hash_, whole[name], name)

    def test_a_dry_run_foretells_the_mesh_of_this_field(self):
        def prediction():
            out = self.made(self.text, "--overwrite")
            return json.loads((out / "report.json").read_text()).get("prediction")

        case = self.write_bar(self.text)
        outcome = self.run_program("mesh", case, "--dry-run", "--output", "out", *SUBDIVIDE)
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual(prediction()["tets"]["error"], 0)
        self.assertEqual(self.run_program("mesh", case, "--dry-run", "--output", "out", *SUBDIVIDE).code, OK)
        self.write("field.vti", vti(lambda p: 1.1 * along_the_bar(p)))
        self.assertIsNone(prediction())


class Killed(kill.RestartTest):
    @staticmethod
    def make_arguments(maker):
        maker.write("field.vti", vti(along_the_bar))
        maker.write("bar.geo", BAR)
        case = maker.write(
            "case.toml",
            f"geometry.file = 'bar.geo'\ndecompose.subdomains = 8\n{NO_PAGE}"
            f"[size]\ntarget = 0.2\nfield = 'field.vti'\n{CORNER_BALL}",
        )
        return [case, "--set", "fill.kernel=optimize"]

    @property
    def field(self):
        return self.arguments[0].parent / "field.vti"

    def resume_refused(self):
        outcome = self.run_program("mesh", *self.arguments, "--output", "out", "--resume", ranks=2)
        self.assert_refused(outcome, WRONG_INPUT, "size.field has changed", "--overwrite")

    def repeat_refused(self):
        outcome = self.run_program("mesh", *self.arguments, "--output", "out")
        self.assert_refused(outcome, program.CANNOT_WRITE, "size.field has changed", "--overwrite")

    def with_another_field(self, work):
        self.field.write_text(vti(lambda p: 1.1 * along_the_bar(p)))
        self.addCleanup(self.field.write_text, vti(along_the_bar))
        work()
        self.field.write_text(vti(along_the_bar))

    def test_a_changed_field_is_refused_and_the_right_one_goes_on(self):
        self.kill_run(self.has_pieces(2), ranks=2)
        self.with_another_field(self.resume_refused)
        self.resume(ranks=3)
        self.with_another_field(self.resume_refused)
        self.with_another_field(self.repeat_refused)


if __name__ == "__main__":
    unittest.main()
