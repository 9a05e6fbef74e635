# SPDX-License-Identifier: BSD-3-Clause
"""[[layer]]: flat cells on walls, the same for any number of ranks, on the geometry, and a mesh that conforms."""
import math
import pathlib
import sys
import unittest

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import program  # noqa: E402
from poly_mesh import PolyMesh  # noqa: E402
from program import DEGRADED, OK, STOPPED, WRONG_INPUT, sets  # noqa: E402
from vtk_grids import grid_of  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

PIPE = (
    "algebraic3d\nsolid inlet = plane (0, 0, 0; 0, 0, -1);\nsolid outlet = plane (0, 0, 2; 0, 0, 1);\n"
    "solid pipe = cylinder (0, 0, 0; 0, 0, 2; 0.5) and inlet and outlet;\ntlo pipe;\n"
)
# A ball cut out of a ball, and what is left cut by a plane: walls at both rims of a flat ring.
SHELL = (
    "algebraic3d\nsolid outer = sphere (0, 0, 0; 1);\nsolid inner = sphere (0, 0, 0; 0.5);\n"
    "solid shell = outer and not inner and plane (0, 0, 0; 0, 0, -1);\ntlo shell;\n"
)


def points_of(grid, cell):
    ids = grid.GetCell(cell).GetPointIds()
    return [grid.GetPoint(ids.GetId(i)) for i in range(ids.GetNumberOfIds())]


class LayersTest(program.ProgramTest):
    def case(self, text=PIPE, patch="patch_3", first=0.02, count=4, max_size=0.3):
        self.write("model.geo", text)
        return self.write(
            "case.toml",
            f"geometry.file = 'model.geo'\ncoarse.max_size = {max_size}\ndecompose.subdomains = 6\n"
            f"refine.levels = 1\n{program.NO_PAGE}[[layer]]\npatch = '{patch}'\nfirst = {first}\ncount = {count}\n",
        )

    def checked(self, folder):
        figures, _ = self.assert_checked(folder, volume_tolerance=1e-12)
        return figures

    def assert_goes_on_after_a_stop(self, case):
        whole = self.mesh(case, "whole")
        stopped = self.start("mesh", case, "--output", "out")
        program.wait_until(lambda: (self.folder / "out" / "pieces").is_dir(), "a store")
        stopped.send_signal(15)
        self.assertIn(self.finish(stopped).code, (STOPPED, OK))
        self.mesh(case, "out", "--resume", ranks=3)
        self.assertEqual(program.figures(self.folder / "out"), program.figures(whole))


class AnyNumberOfRanks(LayersTest):
    def test_has_the_same_bits(self):
        case = self.case()
        for kernel, others in (("subdivide", (2, 3, 5)), ("optimize", (3,)), ("netgen", (2,))):
            with self.subTest(kernel=kernel):
                alone = self.mesh(case, kernel, *sets(f"fill.kernel={kernel}"))
                figures = self.checked(alone)
                self.assertGreater(figures["layers"]["num_tets"], 1000)
                for ranks in others:
                    other = self.mesh(case, f"{kernel}_{ranks}", *sets(f"fill.kernel={kernel}"), ranks=ranks)
                    self.assertEqual(program.figures(other), figures)
                    self.assertEqual(program.mesh_files(other), program.mesh_files(alone))

    def test_and_of_subdomains_and_files_has_the_same_layers(self):
        case = self.case()
        found = []
        for subdomains, files in ((1, 0), (9, 0), (9, 2)):
            out = self.mesh(
                case, f"out_{subdomains}_{files}",
                *sets("fill.kernel=subdivide", f"decompose.subdomains={subdomains}", f"output.files={files}"))
            figures = self.checked(out)
            layers = figures["layers"]
            found.append((layers["num_tets"], round(layers["volume"], 9), figures["num_tets"], figures["num_vertices"]))
        self.assertEqual(len(set(found)), 1, found)

    def test_goes_on_after_a_stop(self):
        self.assert_goes_on_after_a_stop(self.case())


class Shape(program.ResultTest, LayersTest):
    """Of a pipe of radius 0.5: four layers on its side, none on its ends."""

    FIRST, GROWTH, COUNT = 0.02, 1.2, 4

    @classmethod
    def make_result(cls, maker):
        return maker.mesh(LayersTest.case(maker), "out")

    def setUp(self):
        super().setUp()
        self.grid = grid_of(self.out / "mesh.pvtu")
        self.layer = self.grid.GetCellData().GetArray("layer")

    def test_every_layer_is_as_high_as_the_case_says(self):
        ends = [0.5 - sum(self.FIRST * self.GROWTH**i for i in range(n)) for n in range(self.COUNT + 1)]
        num_of_layer = [0] * (self.COUNT + 1)
        for cell in range(self.grid.GetNumberOfCells()):
            layer = int(self.layer.GetValue(cell))
            num_of_layer[layer] += 1
            radii = [math.hypot(x, y) for x, y, _ in points_of(self.grid, cell)]
            if layer == 0:
                self.assertLess(max(radii), ends[-1] + 1e-3)
                continue
            # Walls are curved, so columns of coarse vertices lean a little against each other.
            self.assertAlmostEqual(max(radii), ends[layer - 1], delta=2e-3)
            self.assertAlmostEqual(min(radii), ends[layer], delta=2e-3)
        self.assertEqual(len(set(num_of_layer[1:])), 1, "all layers have as many cells")
        self.assertEqual(self.report["layers"]["num_tets"], sum(num_of_layer[1:]))
        self.assertEqual(self.report["layers"]["full_height"], 1.0)

    def test_the_boundary_is_on_the_geometry(self):
        boundary = grid_of(self.out / "boundary.pvtu")
        patch = boundary.GetCellData().GetArray("patch")
        area = [0.0, 0.0, 0.0]
        for cell in range(boundary.GetNumberOfCells()):
            points = points_of(boundary, cell)
            area[int(patch.GetValue(cell))] += boundary.GetCell(cell).ComputeArea()
            for x, y, z in points:
                if patch.GetValue(cell) == 2:
                    self.assertAlmostEqual(math.hypot(x, y), 0.5, places=12)
                else:
                    self.assertEqual(z, 2.0 * patch.GetValue(cell))
        for found, exact in zip(area, (math.pi / 4, math.pi / 4, 2.0 * math.pi)):
            self.assertAlmostEqual(found / exact, 1.0, delta=0.03)


class OpenFoam(LayersTest):
    """Has prisms, not the tets that they are cut into."""

    def assert_sound(self, mesh, case, of_layers):
        """Closed cells of positive volume, each seen from its owner; a prism stands for its tets."""
        for axis in range(3):
            self.assertLess(abs(mesh.cell_sums(mesh.face_areas[:, axis])).max(), 1e-12)
        self.assertGreater(mesh.cell_volumes().min(), 0.0)
        self.assertTrue((mesh.owner[: len(mesh.neighbour)] < mesh.neighbour).all())
        self.assertEqual(mesh.num_cells(), of_layers // 3 + case["num_tets"] - of_layers)
        self.assertEqual(case["num_cells"], mesh.num_cells())
        self.assertEqual(case["layers"]["num_cells"], of_layers // 3)

    def test_in_one_mesh_and_in_parts(self):
        out = self.mesh(self.case(), "out", *sets('output.formats=["openfoam-serial"]', "output.files=3"))
        report = self.checked(out)
        mesh = PolyMesh(out)
        self.assert_sound(mesh, report, report["layers"]["num_tets"])
        self.assertAlmostEqual(mesh.cell_volumes().sum(), report["volume"], places=9)
        # Of the walls triangles, of the ends triangles and one quad a layer and edge of the rim.
        sizes = {name: mesh.num_corners[begin:end] for name, (_, begin, end, _) in mesh.patches.items()}
        self.assertEqual(set(sizes["patch_3"]), {3})
        rim = sum(int((sizes[name] == 4).sum()) for name in ("patch_1", "patch_2"))
        self.assertGreater(rim, 0)
        self.assertEqual(rim % 4, 0)

        self.run_program("convert", out / "mesh.pvtu", "--format", "openfoam", "--output", self.folder / "parts", ranks=2)
        parts = [PolyMesh(folder) for folder in sorted((self.folder / "parts").glob("processor*"))]
        self.assertEqual(len(parts), 3)
        self.assertEqual(sum(part.num_cells() for part in parts), mesh.num_cells())
        self.assertAlmostEqual(sum(part.cell_volumes().sum() for part in parts), report["volume"], places=9)
        num_shared = 0
        for here, part in enumerate(parts):
            for kind, begin, end, pair in part.patches.values():
                if kind != "processor":
                    continue
                _, there = pair
                _, first, last, _ = parts[there].patches[f"procBoundary{there}to{here}"]
                self.assertEqual(end - begin, last - first)
                ours = part.points[part.quads[begin:end]]
                others = parts[there].points[parts[there].quads[first:last]]
                numpy.testing.assert_array_equal(ours[:, 0], others[:, 0])
                numpy.testing.assert_allclose(part.face_areas[begin:end], -parts[there].face_areas[first:last], atol=1e-14)
                num_shared += int((part.num_corners[begin:end] == 4).sum())
        self.assertGreater(num_shared, 0, "no prism stands on a seam")


class Repartitioned(LayersTest):
    def test_keeps_columns_whole(self):
        """So that the parts have the same prisms; above the tets of a wall's triangle stand all its layers."""
        out = self.mesh(self.case(), "out", *sets("fill.kernel=subdivide"))
        report = self.checked(out)
        for ranks in (1, 3):
            parts, foam = self.folder / f"parts_{ranks}", self.folder / f"foam_{ranks}"
            self.run_program("repartition", out / "mesh.pvtu", "--parts", 5, "--output", parts, ranks=ranks)
            self.assertEqual(self.run_program("check", parts / "mesh.pvtu").code, program.OK)
            done = self.run_program("convert", parts / "mesh.pvtu", "--format", "openfoam-serial", "--output", foam)
            self.assertEqual(done.code, program.OK, done.err)
            of_layers = report["layers"]["num_tets"]
            self.assertEqual(PolyMesh(foam).num_cells(), of_layers // 3 + report["num_tets"] - of_layers)
            for file in sorted(parts.glob("mesh/*.vtu")):
                layer = vtk_to_numpy(grid_of(file).GetCellData().GetArray("layer"))
                counts = numpy.bincount(layer, minlength=5)[1:]
                self.assertEqual(set(counts), {counts[0]}, file.name)


class Rims(LayersTest):
    def test_of_walls_stay_on_the_patch_beside_them(self):
        """Of the shell's three patches only its round ones are walls, then only its flat one."""
        for patch in ("patch_[12]", "patch_3"):
            with self.subTest(patch=patch):
                case = self.case(text=SHELL, patch=patch, first=0.01)
                out = self.mesh(case, "out_" + patch[-2:], *sets("coarse.max_size=0.25", "fill.kernel=subdivide"))
                figures = self.checked(out)
                self.assertGreater(figures["layers"]["covered"], 0.99)
                boundary = grid_of(out / "boundary.pvtu")
                patches = boundary.GetCellData().GetArray("patch")
                for cell in range(boundary.GetNumberOfCells()):
                    for x, y, z in points_of(boundary, cell):
                        if patches.GetValue(cell) == 2:
                            self.assertEqual(z, 0.0)
                        else:
                            radius = (1.0, 0.5)[int(patches.GetValue(cell))]
                            self.assertAlmostEqual(math.dist((x, y, z), (0, 0, 0)), radius, places=9)

    def test_close_at_edges_that_the_material_goes_around(self):
        """A block in a channel: the columns at the rim of its top would lead off its sides."""
        block = (
            "algebraic3d\nsolid channel = orthobrick (-1, -1, 0; 2, 1, 1);\n"
            "solid block = plane (0, 0, 0; -1, 0, 0) and plane (0.8, 0, 0; 1, 0, 0) and plane (0, -0.4, 0; 0, -1, 0)\n"
            "  and plane (0, 0.4, 0; 0, 1, 0) and plane (0, 0, -1; 0, 0, -1) and plane (0, 0, 0.4; 0, 0, 1);\n"
            "solid flow = channel and not block;\ntlo flow;\n"
        )
        for name, patch in (("top", "patch_11"), ("sides", "patch_[789]")):
            with self.subTest(name=name):
                out = self.mesh(self.case(text=block, patch=patch, max_size=0.2), name)
                figures = self.checked(out)
                self.assertGreater(figures["layers"]["covered"], 0.1)
                self.assertLess(figures["layers"]["covered"], 1.0)
                self.assertAlmostEqual(figures["volume"], 6.0 - 0.8 * 0.8 * 0.4, places=9)


class Room(LayersTest):
    def test_that_is_missing_makes_layers_thinner(self):
        outcome = self.run_program("mesh", self.case(patch="*", first=0.1, count=8), "--output", "out")
        self.assertIn(outcome.code, (OK, DEGRADED), outcome.err)
        figures = self.checked(self.folder / "out")
        self.assertLess(figures["layers"]["full_height"], 0.5)
        self.assertGreater(figures["layers"]["num_tets"], 0)


class SeveralEntries(LayersTest):
    """A box: three layers at its floor, six thinner ones at a wall beside it, one at the wall across."""

    BOX = (
        "algebraic3d\nsolid box = plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 0; -1, 0, 0) and plane (1, 1, 1; 1, 0, 0)\n"
        "  and plane (0, 0, 0; 0, -1, 0) and plane (1, 1, 1; 0, 1, 0) and plane (1, 1, 1; 0, 0, 1);\ntlo box;\n"
    )
    ENTRIES = (("patch_1", 0.02, 1.5, 3), ("patch_2", 0.004, 1.3, 6), ("patch_3", 0.05, 1.2, 1))

    def box(self, more=""):
        self.write("box.geo", self.BOX)
        layers = "".join(
            f"[[layer]]\npatch = '{name}'\nfirst = {first}\ngrowth = {growth}\ncount = {count}\n"
            for name, first, growth, count in self.ENTRIES)
        return self.write(
            "box.toml", f"geometry.file = 'box.geo'\ncoarse.max_size = 0.2\ndecompose.subdomains = 5\n"
            f"refine.levels = 1\n{program.NO_PAGE}{more}{layers}")

    def test_have_layers_of_their_own_that_meet(self):
        case = self.box()
        alone = self.mesh(case, "alone")
        figures = self.checked(alone)
        self.assertEqual(figures["layers"]["count"], 6)
        for ranks in (2, 3):
            other = self.mesh(case, f"out_{ranks}", ranks=ranks)
            self.assertEqual(program.mesh_files(other), program.mesh_files(alone))
        layers = grid_of(alone / "mesh.pvtu")
        layer = vtk_to_numpy(layers.GetCellData().GetArray("layer"))
        for axis, at_wall, (_, first, growth, count) in zip((2, 0, 0), (0.0, 0.0, 1.0), self.ENTRIES):
            ends = numpy.cumsum([0.0] + [first * growth**i for i in range(count)])
            # In the middle of the wall, away from the others.
            found = set()
            for cell in numpy.flatnonzero(layer):
                points = numpy.array(points_of(layers, cell))
                away = numpy.abs(points[:, axis] - at_wall)
                others = numpy.delete(points, axis, axis=1)
                if away.max() > ends[-1] + 1e-9 or others.min() < 0.27 or others.max() > 0.73:
                    continue
                self.assertAlmostEqual(away.min(), ends[layer[cell] - 1], places=9)
                self.assertAlmostEqual(away.max(), ends[layer[cell]], places=9)
                found.add(int(layer[cell]))
            self.assertEqual(found, set(range(1, count + 1)))

    def test_where_edges_have_levels_of_their_own(self):
        """Near the edge where two of the entries meet."""
        case = self.box("size.target = 0.2\n[[size.region]]\nsize = 0.06\nball = { centre = [0, 0.5, 0], radius = 0.2 }\n")
        case.write_text(case.read_text().replace("refine.levels = 1\n", "").replace("coarse.max_size = 0.2\n", ""))
        out = self.mesh(case, "out", ranks=2)
        figures = self.checked(out)
        self.assertEqual(figures["layers"]["count"], 6)
        self.assertGreater(len(figures["coarse"]["edges_by_level"]), 1)
        self.assertAlmostEqual(figures["volume"], 1.0, places=9)

    def test_are_prisms_in_other_formats(self):
        out = self.mesh(self.box("output.formats = ['openfoam-serial']\n"), "out", ranks=2)
        figures = self.checked(out)
        mesh = PolyMesh(out)
        self.assertEqual(mesh.num_cells(), figures["num_cells"])
        self.assertGreater(mesh.cell_volumes().min(), 0.0)
        self.assertAlmostEqual(mesh.cell_volumes().sum(), 1.0, places=9)


class SharpEdge(LayersTest):
    """Of a wedge of 11 degrees across a channel, and of one that is shorter than the channel is wide."""

    WEDGE = (
        "algebraic3d\nsolid channel = orthobrick (-1, -1, 0; 2, 1, 1);\n"
        "solid wedge = plane (0, 0, 0; -1, 0, 0) and plane (1, 0, 0; 0.1, 1, 0) and plane (1, 0, 0; 0.1, -1, 0)\n"
        "  ENDS;\nsolid flow = channel and not wedge;\ntlo flow;\n"
    )
    ACROSS = WEDGE.replace("ENDS", "and plane (0, 0, -1; 0, 0, -1) and plane (0, 0, 2; 0, 0, 1)")
    SHORT = WEDGE.replace("ENDS", "and plane (0, 0, 0.2; 0, 0, -1) and plane (0, 0, 0.8; 0, 0, 1)")
    COUNT, FIRST = 4, 0.02

    def wedge(self, text=ACROSS, patch="patch_[789]"):
        return self.case(text=text, patch=patch, first=self.FIRST, count=self.COUNT)

    def assert_no_face_inside(self, out, report):
        """The boundary is that of the model, without the faces of the wake."""
        self.assertAlmostEqual(report["volume"], 5.9, places=9)
        area = sum(patch["area"] for patch in report["patches"])
        self.assertAlmostEqual(area, report["boundary_area"], places=9)
        self.assertEqual(len(report["patches"]), 9)
        self.assertAlmostEqual(area, 2 * 5.9 + 2 * 3.0 + 2 * 2.0 + 0.2 + 2 * math.hypot(1.0, 0.1), places=9)
        for x, y, z in vtk_to_numpy(grid_of(out / "boundary.pvtu").GetPoints().GetData()):
            self.assertFalse(1.001 < x < 1.999 and abs(y) < 0.5 and 0.001 < z < 0.999)

    def test_has_layers_all_around_it(self):
        out = self.mesh(self.wedge(), "out")
        report = self.checked(out)
        self.assertEqual(report["layers"]["covered"], 1.0)
        self.assertGreater(report["layers"]["full_height"], 0.9)
        self.assert_no_face_inside(out, report)
        # Both columns at the edge are as high as the layers should be.
        grid = grid_of(out / "mesh.pvtu")
        layer = vtk_to_numpy(grid.GetCellData().GetArray("layer"))
        height = self.FIRST * sum(1.2**i for i in range(self.COUNT))
        tops = {point for cell in numpy.flatnonzero(layer == self.COUNT) for point in points_of(grid, cell)}
        for side in (1.0, -1.0):
            off = [side * y for x, y, z in tops if 0.9 < x < 1.1 and 0.3 < z < 0.7]
            self.assertGreater(max(off), 0.95 * height)

    def test_has_the_same_bits_for_any_number_of_ranks(self):
        for name, text, patch in (("across", self.ACROSS, "patch_[789]"), ("short", self.SHORT, "*")):
            for kernel, others in (("subdivide", (2, 3, 5)), ("optimize", (3,)), ("netgen", (2,))):
                with self.subTest(name=name, kernel=kernel):
                    case = self.wedge(text, patch)
                    alone = self.mesh(case, f"{name}_{kernel}", *sets(f"fill.kernel={kernel}"))
                    self.checked(alone)
                    for ranks in others:
                        other = self.mesh(case, f"{name}_{kernel}_{ranks}", *sets(f"fill.kernel={kernel}"), ranks=ranks)
                        self.assertEqual(program.mesh_files(other), program.mesh_files(alone))

    def test_has_the_same_layers_for_any_number_of_subdomains(self):
        case = self.wedge()
        found = set()
        for subdomains in (1, 2, 8, 20):
            out = self.mesh(case, f"out_{subdomains}",
                            *sets("fill.kernel=subdivide", f"decompose.subdomains={subdomains}"), ranks=2)
            report = self.checked(out)
            layers = report["layers"]
            found.add((layers["num_tets"], layers["num_cells"], round(layers["volume"], 9), report["num_vertices"]))
        self.assertEqual(len(found), 1, found)

    def test_goes_on_across_periodic_sides(self):
        sides = "".join(f"[[geometry.name]]\nname = '{name}'\npatch = {{ normal = [0, 0, {z}] }}\n" for name, z in (("low", -1), ("high", 1)))
        for kernel in ("subdivide", "netgen"):
            with self.subTest(kernel=kernel):
                case = self.wedge()
                case.write_text(case.read_text() + sides + "[[periodic]]\nfrom = 'low'\nto = 'high'\n")
                out = self.mesh(case, kernel, *sets(f"fill.kernel={kernel}"))
                report = self.checked(out)
                self.assertEqual(report["layers"]["covered"], 1.0)
                self.assert_no_face_inside(out, report)
                other = self.mesh(case, f"{kernel}_3", *sets(f"fill.kernel={kernel}"), ranks=3)
                self.assertEqual(program.mesh_files(other), program.mesh_files(out))

    def test_where_edges_have_levels_of_their_own(self):
        case = self.wedge()
        text = case.read_text().replace("refine.levels = 1\n", "").replace("coarse.max_size = 0.3\n", "")
        case.write_text(text + "[size]\ntarget = 0.2\n[[size.region]]\nsize = 0.06\n"
                        "ball = { centre = [1, 0, 0.5], radius = 0.2 }\n")
        out = self.mesh(case, "out", ranks=2)
        report = self.checked(out)
        self.assertGreater(len(report["coarse"]["edges_by_level"]), 1)
        self.assert_no_face_inside(out, report)

    def test_goes_on_after_a_stop(self):
        self.assert_goes_on_after_a_stop(self.wedge())

    def test_has_cells_of_openfoam_and_parts(self):
        out = self.mesh(self.wedge(), "out", *sets('output.formats=["openfoam-serial"]'))
        report = self.checked(out)
        mesh = PolyMesh(out)
        for axis in range(3):
            self.assertLess(abs(mesh.cell_sums(mesh.face_areas[:, axis])).max(), 1e-12)
        self.assertEqual(mesh.num_cells(), report["num_cells"])
        self.assertGreater(mesh.cell_volumes().min(), 0.0)
        self.assertAlmostEqual(mesh.cell_volumes().sum(), 5.9, places=9)
        self.run_program("repartition", out / "mesh.pvtu", "--parts", "3", "--output", "parts", ranks=2)
        self.assertEqual(self.run_program("check", self.folder / "parts" / "mesh.pvtu").code, OK)

    def test_keeps_tets_of_a_mesh_of_ones_own(self):
        self.wedge()
        plain = self.write("plain.toml", f"geometry.file = 'model.geo'\ncoarse.max_size = 0.2\nrefine.levels = 0\n{program.NO_PAGE}")
        made = self.mesh(plain, "made", *sets('output.formats=["pvtu", "msh2"]'))
        case = self.write("own.toml", f"geometry.file = '{made / 'mesh_v2.msh'}'\nfill.kernel = 'subdivide'\nrefine.levels = 1\n"
                          f"{program.NO_PAGE}[[layer]]\npatch = 'patch_[789]'\nfirst = 0.002\ncount = 3\n")
        out = self.mesh(case, "own", ranks=2)
        report = self.checked(out)
        self.assertEqual(report["layers"]["covered"], 1.0)
        self.assert_no_face_inside(out, report)


class Baffle(LayersTest):
    """A plate that reaches into a channel from its floor, and ends in the middle."""

    CHANNEL = (
        "algebraic3d\nsolid channel = plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 0; -1, 0, 0) and plane (2, 1, 1; 1, 0, 0)\n"
        "  and plane (0, 0, 0; 0, -1, 0) and plane (2, 1, 1; 0, 1, 0) and plane (2, 1, 1; 0, 0, 1);\ntlo channel;\n"
    )
    FLOOR = "patch_1"
    THICKNESS = 0.01 * (1.0 + 1.2 + 1.44)

    def channel(self, walls):
        self.write("model.geo", self.CHANNEL)
        layers = "".join(f"[[layer]]\npatch = '{name}'\nfirst = 0.01\ncount = 3\n" for name in walls)
        return self.write(
            "case.toml",
            f"geometry.file = 'model.geo'\ncoarse.max_size = 0.25\ndecompose.subdomains = 5\nrefine.levels = 1\n{program.NO_PAGE}"
            "[[embed]]\nname = 'plate'\npolygon = [[1, 0, 0], [1, 1, 0], [1, 1, 0.5], [1, 0, 0.5]]\n"
            f"[[split]]\npatch = 'plate'\n{layers}")

    def made(self, name, *walls):
        """The report of a checked mesh, which says that both sides of the plate still are alike; its folder."""
        out = self.mesh(self.channel(walls), name)
        report = self.checked(out)
        self.assertEqual(report["splits"], [{"plus": "plate_plus", "minus": "plate_minus"}])
        self.assertAlmostEqual(report["volume"], 2.0, places=9)
        return report, out

    def sides_with_layers(self, out):
        """On which sides of the plate there are layers."""
        grid = grid_of(out / "mesh.pvtu")
        signs = set()
        for cell in numpy.flatnonzero(vtk_to_numpy(grid.GetCellData().GetArray("layer"))):
            away = numpy.array(points_of(grid, cell))[:, 0] - 1.0
            self.assertLess(abs(away).max(), 1.01 * self.THICKNESS)
            signs.add(math.copysign(1.0, away.mean()))
        return len(signs)

    def test_has_layers_on_both_sides_or_on_one(self):
        for wall, sides in (("plate", {"plate_minus", "plate_plus"}), ("plate_minus", {"plate_minus"})):
            with self.subTest(wall=wall):
                report, out = self.made(wall, wall)
                self.assertEqual({patch["name"] for patch in report["layers"]["patches"]}, sides)
                self.assertGreater(report["layers"]["full_height"], 0.5)
                self.assertEqual(self.sides_with_layers(out), len(sides))
                other = self.mesh(self.folder / "case.toml", f"{wall}_3", ranks=3)
                self.assertEqual(program.mesh_files(other), program.mesh_files(out))

    def test_has_them_up_to_periodic_sides(self):
        """Here the plate is a contact that goes from one side to the other; with layers on both sides of it, or on one."""
        self.write("model.geo", """algebraic3d
solid slab = plane (0, 0, 0; -1, 0, 0) and plane (2, 1, 1; 1, 0, 0) and plane (0, 0, 0; 0, -1, 0) and plane (2, 1, 1; 0, 1, 0);
solid low = slab and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 0.5; 0, 0, 1);
solid top = slab and not plane (0, 0, 0.5; 0, 0, 1) and plane (2, 1, 1; 0, 0, 1);
tlo low;
tlo top;
""")
        names = "".join(f"[[geometry.name]]\nname = '{name}'\npatch = {{ normal = [0, {y}, 0] }}\n" for name, y in (("front", -1), ("back", 1)))
        names += "[[geometry.name]]\nname = 'plate'\npatch = { box = { min = [0, 0, 0.5], max = [2, 1, 0.5] } }\n"
        for wall in ("plate", "plate_plus"):
            with self.subTest(wall=wall):
                out = self.mesh(self.write(
                    "case.toml",
                    f"geometry.file = 'model.geo'\ncoarse.max_size = 0.25\ndecompose.subdomains = 6\nrefine.levels = 1\n{program.NO_PAGE}{names}"
                    "[[periodic]]\nfrom = 'front'\nto = 'back'\n[[split]]\npatch = 'plate'\n"
                    f"[[layer]]\npatch = '{wall}'\nfirst = 0.01\ncount = 3\n"), wall)
                report = self.checked(out)
                self.assertAlmostEqual(report["layers"]["covered"], 1.0)
                self.assertAlmostEqual(report["volume"], 2.0, places=9)

    def test_stands_in_layers_of_the_floor(self):
        covered = {}
        for walls in ((self.FLOOR,), (self.FLOOR, "plate"), (self.FLOOR, "plate_plus")):
            with self.subTest(walls=walls):
                report, _ = self.made("_".join(walls), *walls)
                covered[walls] = {patch["name"]: patch["covered"] for patch in report["layers"]["patches"]}
        # Beside a plate without layers those of the floor go through; beside one that has them on one side they close.
        self.assertGreater(covered[(self.FLOOR,)][self.FLOOR], 0.999)
        self.assertGreater(covered[(self.FLOOR, "plate")][self.FLOOR], 0.999)
        self.assertLess(covered[(self.FLOOR, "plate_plus")][self.FLOOR], 0.999)


class BetweenSolids(LayersTest):
    """A pipe full of water through a block: the face between them has layers on the side that is named."""

    BLOCK = (
        "algebraic3d\nsolid ends = plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 2; 0, 0, 1);\n"
        "solid water = cylinder (0, 0, 0; 0, 0, 2; 0.5) and ends;\n"
        "solid block = orthobrick (-1, -1, -1; 1, 1, 3) and ends and not water;\ntlo water;\ntlo block;\n"
    )
    RADIUS = 0.5
    HEIGHTS = {"water": 0.02 * (1.0 + 1.2 + 1.44), "block": 0.01 * (1.0 + 1.2)}
    LAYERS = {"water": (0.02, 3), "block": (0.01, 2)}

    def block(self, *sides, more=""):
        self.write("model.geo", self.BLOCK)
        text = (f"geometry.file = 'model.geo'\ncoarse.max_size = 0.35\ndecompose.subdomains = 6\nrefine.levels = 1\n"
                f"{program.NO_PAGE}{more}")
        for side in sides:
            first, count = self.LAYERS[side]
            text += f"[[layer]]\npatch = 'patch_5'\nside = '{side}'\nfirst = {first}\ncount = {count}\n"
        return self.write("case.toml", text)

    def assert_layers_on(self, sides, out):
        """Layers are where the case says, and nowhere else: in each solid from the face on, as thick as all of them."""
        cells = grid_of(out / "mesh.pvtu")
        material = vtk_to_numpy(cells.GetCellData().GetArray("attribute"))
        found = {}
        for cell in numpy.flatnonzero(vtk_to_numpy(cells.GetCellData().GetArray("layer"))):
            away = max(abs(math.hypot(x, y) - self.RADIUS) for x, y, _ in points_of(cells, cell))
            side = ("water", "block")[material[cell] - 1]
            found[side] = max(found.get(side, 0.0), away)
        self.assertEqual(set(found), set(sides))
        for side, height in found.items():
            self.assertAlmostEqual(height, self.HEIGHTS[side], delta=0.05 * self.HEIGHTS[side])

    def test_has_layers_on_the_side_that_is_named(self):
        bare = self.checked(self.mesh(self.block(), "bare"))
        area = {patch["name"]: patch["area"] for patch in bare["patches"]}
        for sides in (("water",), ("block",), ("water", "block")):
            with self.subTest(sides=sides):
                name = "_".join(sides)
                out = self.mesh(self.block(*sides), name)
                report = self.checked(out)
                self.assertEqual(report["layers"]["full_height"], 1.0)
                self.assertAlmostEqual(report["volume"], 8.0, places=9)
                self.assertAlmostEqual(report["boundary_area"], bare["boundary_area"], places=9)
                found = {patch["name"]: patch["area"] for patch in report["patches"]}
                self.assertAlmostEqual(found["patch_5"], area["patch_5"], places=9)
                self.assert_layers_on(sides, out)
                for ranks in (1, 3):
                    other = self.mesh(self.folder / "case.toml", f"{name}_{ranks}", ranks=ranks)
                    self.assertEqual(program.mesh_files(other), program.mesh_files(out))

    def test_has_them_with_any_kernel_and_graded_levels(self):
        sizes = "[[size.region]]\nball = { centre = [0.5, 0.0, 1.0], radius = 0.3 }\nsize = 0.09\n"
        for kernel in ("subdivide", "optimize", "netgen"):
            with self.subTest(kernel=kernel):
                case = self.block("water", "block", more=sizes)
                self.checked(self.mesh(case, kernel, *sets(f"fill.kernel={kernel}")))

    def test_goes_on_after_a_stop(self):
        self.assert_goes_on_after_a_stop(self.block("water"))

    def test_has_them_across_periodic_sides(self):
        periodic = "".join(f"[[geometry.name]]\nname = '{name}'\npatch = {{ normal = [0, 0, {z}] }}\n" for name, z in (("low", -1), ("high", 1)))
        periodic += "[[periodic]]\nfrom = 'low'\nto = 'high'\n"
        for sides in (("water",), ("water", "block")):
            with self.subTest(sides=sides):
                out = self.mesh(self.block(*sides, more=periodic), "_".join(sides))
                self.assertEqual(self.checked(out)["layers"]["full_height"], 1.0)
                self.assert_layers_on(sides, out)

    def test_between_planes_are_no_blemish_where_points_are_held_back(self):
        slabs = "".join(f"solid s{i} = orthobrick (0, 0, {low}; 1, 1, {high});\n" for i, (low, high) in
                        enumerate(((0.0, 0.3), (0.3, 0.5), (0.5, 1.0))))
        self.write("model.geo", f"algebraic3d\n{slabs}tlo s0;\ntlo s1;\ntlo s2;\n")
        out = self.mesh(self.write(
            "case.toml",
            f"geometry.file = 'model.geo'\ncoarse.max_size = 0.25\ndecompose.subdomains = 9\nrefine.levels = 1\n{program.NO_PAGE}"
            "[[layer]]\npatch = '*'\nside = 's0'\nfirst = 0.01\ncount = 2\n"
            "[[layer]]\npatch = '*'\nside = 's1'\nfirst = 0.02\ncount = 3\n"), "out")
        report = self.checked(out)
        self.assertGreater(report["repairs"]["held_back_points"], 0)
        self.assertEqual(report["status"], "ok")

    def test_are_cells_of_openfoam_and_parts(self):
        out = self.mesh(self.block("water"), "out", *sets('output.formats=["openfoam-serial"]'))
        mesh = PolyMesh(out)
        self.assertEqual(mesh.num_cells(), self.checked(out)["num_cells"])
        self.assertGreater(mesh.cell_volumes().min(), 0.0)
        parted = self.run_program("repartition", out / "mesh.pvtu", "--parts", "3", "--output", "parts", ranks=2)
        self.assertIn(parted.code, (OK, DEGRADED))
        self.assertEqual(self.run_program("check", self.folder / "parts" / "mesh.pvtu").code, OK)

    def test_are_one_mesh_in_any_number_of_files(self):
        case = self.block("water", "block")
        for keys in (("output.files=1",), ("output.files=2",), ("output.parts=2", 'output.formats=["openfoam"]')):
            for kernel in ("subdivide", "netgen"):
                with self.subTest(keys=keys, kernel=kernel):
                    self.checked(self.mesh(case, f"{keys[0]}_{kernel}", *sets(*keys, f"fill.kernel={kernel}"), ranks=2))

    def test_stand_beside_splits(self):
        """A baffle in the water that stands on the block, and two blocks that touch in water, with a triangle at a corner
        of what they share that has nothing but the rim."""
        box = "plane (0, 0, {}; 0, 0, -1) and plane (0, 0, 0; -1, 0, 0) and plane (2, 1, 1; 1, 0, 0)\n  and plane (0, 0, 0; 0, -1, 0) and plane (2, 1, 1; 0, 1, 0) and plane (2, 1, {}; 0, 0, 1)"
        self.write("model.geo", f"algebraic3d\nsolid block = {box.format(-0.5, 0)};\nsolid water = {box.format(0, 1)};\ntlo water;\ntlo block;\n")
        plate = "[[embed]]\nname = 'plate'\npolygon = [[1, 0, 0], [1, 1, 0], [1, 1, 0.5], [1, 0, 0.5]]\n[[split]]\npatch = 'plate'\n"
        for subdomains, count in ((1, 1), (1, 2), (5, 2)):
            with self.subTest(subdomains=subdomains, count=count):
                self.checked(self.mesh(self.write(
                    "case.toml",
                    f"geometry.file = 'model.geo'\ncoarse.max_size = 0.25\ndecompose.subdomains = {subdomains}\nrefine.levels = 1\n"
                    f"{program.NO_PAGE}{plate}[[layer]]\npatch = '*'\nside = 'water'\nfirst = 0.01\ncount = {count}\n"),
                    f"plate_{subdomains}_{count}"))
        self.write("model.geo", (
            "algebraic3d\nsolid a = orthobrick (0.3, 0.3, 0.3; 0.5, 0.7, 0.7);\nsolid b = orthobrick (0.5, 0.3, 0.3; 0.7, 0.7, 0.7);\n"
            "solid water = orthobrick (0, 0, 0; 1, 1, 1) and not a and not b;\ntlo a;\ntlo b;\ntlo water;\n"))
        self.checked(self.mesh(self.write(
            "case.toml",
            f"geometry.file = 'model.geo'\ncoarse.max_size = 0.3\ndecompose.subdomains = 6\nrefine.levels = 1\n{program.NO_PAGE}"
            "[[geometry.contact]]\nbody = 'a'\nother = 'b'\n[[layer]]\npatch = '*'\nside = 'water'\nfirst = 0.005\ncount = 2\n"), "contact"))

    def test_do_not_follow_curves_of_another_solid(self):
        """A box on a foot that narrows downwards: the foot's edges lead inwards from the corners of the box."""
        self.write("model.geo", """algebraic3d
solid box = orthobrick (0, 0, 0; 1, 1, 0.5);
solid foot = plane (0, 0, 0; 0, 0, 1) and plane (0, 0, -0.5; 0, 0, -1)
         and plane (0, 0, 0; -1, 0, -0.4) and plane (1, 1, 0; 1, 0, -0.4)
         and plane (0, 0, 0; 0, -1, -0.4) and plane (1, 1, 0; 0, 1, -0.4);
tlo box;
tlo foot;
""")
        sides = "".join(
            f"[[geometry.name]]\nname = 'side'\npatch = {{ normal = {normal}, box = {{ min = [0, 0, 0], max = [1, 1, 0.5] }} }}\n"
            for normal in ([1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]))
        out = self.mesh(self.write(
            "case.toml",
            f"geometry.file = 'model.geo'\ncoarse.max_size = 0.25\ndecompose.subdomains = 4\nrefine.levels = 1\n{program.NO_PAGE}{sides}"
            "[[layer]]\npatch = 'side'\nfirst = 0.02\ncount = 3\n"), "foot")
        volumes = {one["name"]: one["volume"] for one in self.checked(out)["materials"]}
        self.assertAlmostEqual(volumes["box"], 0.5, places=9)
        self.assertAlmostEqual(volumes["foot"], (1 - 0.6**3) / (6 * 0.4), places=9)

    def test_needs_a_solid_and_a_side(self):
        case = self.block("water")
        text = case.read_text()
        case.write_text(text.replace("side = 'water'", "side = 'steel'"))
        self.assert_refused(self.run_program("mesh", case, "--output", "out", ranks=2), WRONG_INPUT, "[[layer]]", '"steel"', '"water"')
        case.write_text(text.replace("side = 'water'\n", ""))
        self.assert_refused(self.run_program("mesh", case, "--output", "none", ranks=2), WRONG_INPUT, "patch_5", "side =")


class Refused(LayersTest):
    def test_is_what_names_no_patch_or_several(self):
        outcome = self.run_program("mesh", self.case(patch="inlet"), "--output", "out", ranks=2)
        self.assert_refused(outcome, WRONG_INPUT, "[[layer]]", 'patch = "inlet"', "patch_1")
        case = self.case()
        case.write_text(case.read_text() + "[[layer]]\npatch = 'patch_*'\nfirst = 0.02\ncount = 4\n")
        self.assert_refused(self.run_program("mesh", case, "--output", "twice"), WRONG_INPUT, "one entry only")


if __name__ == "__main__":
    unittest.main()
