# SPDX-License-Identifier: BSD-3-Clause
"""[[periodic]]: sides that are images of each other, with the same points and triangles."""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import program  # noqa: E402
from program import FAILED, OK, WRONG_INPUT, sets  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter  # noqa: E402

# One cell of a packing: balls in the corners, which its sides cut, and one off the middle.
BALLS = [(x, y, z, 0.3) for x in (0, 1) for y in (0, 1) for z in (0, 1)] + [(0.45, 0.5, 0.55, 0.25)]
PACKING = (
    "algebraic3d\n"
    + "".join(f"solid b{i} = sphere ({x}, {y}, {z}; {r});\n" for i, (x, y, z, r) in enumerate(BALLS))
    + f"solid balls = {' or '.join(f'b{i}' for i in range(len(BALLS)))};\nsolid box = orthobrick (0, 0, 0; 1, 1, 1);\n"
    "solid matrix = box and not balls;\nsolid grains = box and balls;\ntlo matrix;\ntlo grains;\n"
)
SIDES = {"left": 14, "right": 15, "front": 12, "back": 13, "bottom": 10, "top": 11}
PAIRS = {("left", "right"): (1, 0, 0), ("front", "back"): (0, 1, 0), ("bottom", "top"): (0, 0, 1)}

# A sector of 30 degrees of a wheel with a hole in each.
SECTOR = (
    "algebraic3d\nsolid wheel = cylinder (0, 0, 0; 0, 0, 1; 1) and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 0.3; 0, 0, 1);\n"
    "solid hub = cylinder (0, 0, 0; 0, 0, 1; 0.3);\nsolid hole = cylinder (0.676, 0.181, 0; 0.676, 0.181, 1; 0.09);\n"
    "solid start = plane (0, 0, 0; 0, -1, 0);\nsolid end = plane (0, 0, 0; -0.5, 0.8660254037844386, 0);\n"
    "solid sector = wheel and start and end and not hub and not hole;\ntlo sector;\n"
)


def grid_of(file, reader_type=vtkXMLPUnstructuredGridReader):
    reader = reader_type()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def shifted(by):
    return lambda p: tuple(a + b for a, b in zip(p, by))


def turned(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1], p[2])


class PeriodicTest(program.ProgramTest):
    def packing(self, more="refine.levels = 1\n", pairs=tuple(PAIRS)):
        self.write("model.geo", PACKING)
        names = "".join(f"[[geometry.name]]\nname = '{n}'\npatch = {{ faces = [{f}] }}\n" for n, f in SIDES.items())
        sides = "".join(f"[[periodic]]\nfrom = '{a}'\nto = '{b}'\n" for a, b in pairs)
        head = "geometry.file = 'model.geo'\ncoarse.max_size = 0.25\ndecompose.subdomains = 7\n"
        return self.write("case.toml", head + more + names + sides)

    def sector(self, more="refine.levels = 2\n"):
        self.write("model.geo", SECTOR)
        head = "geometry.file = 'model.geo'\ncoarse.max_size = 0.15\ndecompose.subdomains = 4\n"
        normals = {"start": [0, -1, 0], "end": [-0.5, 0.8660254037844386, 0]}
        names = "".join(f"[[geometry.name]]\nname = '{n}'\npatch = {{ normal = {v} }}\n" for n, v in normals.items())
        side = "[[periodic]]\nfrom = 'start'\nto = 'end'\nrotation = { axis = [0, 0, 1], angle = 30 }\n"
        return self.write("case.toml", head + more + names + side)

    def triangles(self, folder, name):
        """Of a patch, all points of each triangle."""
        grid = grid_of(folder / "boundary.pvtu")
        texts = grid.GetFieldData().GetAbstractArray("patch_names")
        names = [texts.GetValue(row) for row in range(texts.GetNumberOfValues())]
        patch = grid.GetCellData().GetArray("patch")
        found = []
        for cell in range(grid.GetNumberOfCells()):
            if names[int(patch.GetValue(cell))] == name:
                points = grid.GetCell(cell).GetPointIds()
                found.append([grid.GetPoint(points.GetId(i)) for i in range(points.GetNumberOfIds())])
        return found

    def assert_alike(self, folder, start, end, image, least=20):
        """Each triangle of the one side has one of the other where its image is."""

        def sorted_triangles(triangles):
            keys = {}
            for triangle in triangles:
                key = tuple(sorted(tuple(round(x, 6) + 0.0 for x in p) for p in triangle))
                keys[key] = sorted(triangle, key=lambda p: [round(x, 6) for x in p])
            return keys

        there = sorted_triangles([[image(p) for p in triangle] for triangle in self.triangles(folder, start)])
        here = sorted_triangles(self.triangles(folder, end))
        self.assertGreater(len(here), least)
        self.assertEqual(there.keys(), here.keys())
        for key, triangle in here.items():
            for p, q in zip(triangle, there[key]):
                self.assertLess(math.dist(p, q), 1e-13)

    def assert_packing(self, folder):
        figures, _ = self.assert_checked(folder, volume_tolerance=1e-12)
        for (start, end), shift in PAIRS.items():
            self.assert_alike(folder, start, end, shifted(shift))
        return figures


class AnyNumberOfRanks(PeriodicTest):
    def test_has_the_same_bits(self):
        case = self.packing()
        for kernel, others in (("subdivide", (3,)), ("optimize", (2,)), ("netgen", (2,))):
            with self.subTest(kernel=kernel):
                alone = self.mesh(case, kernel, *sets(f"fill.kernel={kernel}"))
                report = self.assert_packing(alone)
                self.assertEqual(report["periodic"], [{"from": a, "to": b} for a, b in PAIRS])
                for ranks in others:
                    other = self.mesh(case, f"{kernel}_{ranks}", *sets(f"fill.kernel={kernel}"), ranks=ranks)
                    self.assertEqual(program.mesh_files(other), program.mesh_files(alone))


class Sides(PeriodicTest):
    def test_are_alike_with_what_else_a_case_asks_for(self):
        for settings in (("output.order=2",), ("refine.levels=3", "fill.levels=1"), ("output.files=1",)):
            with self.subTest(settings=settings):
                out = self.mesh(self.sector(), "out_" + "".join(settings)[:12], *sets(*settings), ranks=2)
                self.assert_checked(out, volume_tolerance=1e-12)
                self.assert_alike(out, "start", "end", turned(30))

    def test_have_the_sizes_that_one_of_them_has(self):
        more = "[[size.region]]\nsize = 0.03\nball = { centre = [0, 0.3, 0.7], radius = 0.15 }\n"
        out = self.mesh(self.packing(more), "out", ranks=2)
        self.assert_packing(out)

    def test_are_those_of_a_mesh_of_the_user(self):
        first = self.mesh(self.packing("refine.levels = 0\n"), "coarse", *sets('output.formats=["msh"]'))
        sides = "".join(f"[[periodic]]\nfrom = '{a}'\nto = '{b}'\n" for a, b in PAIRS)
        case = self.write("own.toml", f"geometry.file = '{first}/mesh.msh'\nrefine.levels = 2\n{sides}")
        out = self.mesh(case, "out", ranks=2)
        self.assert_packing(out)
        parts = self.folder / "parts"
        self.run_program("repartition", out / "mesh.pvtu", "--parts", 3, "--output", parts, ranks=2)
        self.assertEqual(self.run_program("check", parts / "mesh.pvtu", ranks=2).code, OK)
        for (start, end), shift in PAIRS.items():
            self.assert_alike(parts, start, end, shifted(shift))


class Checked(PeriodicTest):
    def test_is_that_each_point_has_a_partner(self):
        out = self.mesh(self.packing(), "out", *sets("fill.kernel=subdivide"))
        for file in (*out.glob("mesh/*.vtu"), *out.glob("boundary/*.vtu")):
            grid = grid_of(file, vtkXMLUnstructuredGridReader)
            rows = [row for row in range(grid.GetNumberOfPoints()) if grid.GetPoint(row)[0] == 1.0]
            for row in rows:
                x, y, z = grid.GetPoint(row)
                grid.GetPoints().SetPoint(row, x, y + 1e-5 * math.sin(math.pi * y) * math.sin(math.pi * z), z)
            if rows:
                writer = vtkXMLUnstructuredGridWriter()
                writer.SetFileName(str(file))
                writer.SetInputData(grid)
                writer.Write()
        for ranks in (1, 3):
            found = self.run_program("check", out / "mesh.pvtu", "--json", ranks=ranks)
            self.assertEqual(found.code, FAILED, found.err)
            self.assertIn("periodic_point", found.out)
            self.assertIn("has no partner on", found.out)


class Refused(PeriodicTest):
    def test_is_what_does_not_fit(self):
        text = self.packing().read_text()
        case = self.folder / "case.toml"
        for wrong, code, words in (
            ("to = 'right'\ntranslation = [0.9, 0, 0]", FAILED, ("[[periodic]]", "the sides do not match", "translation")),
            ("to = 'nowhere'", WRONG_INPUT, ("[[periodic]]", 'patch = "nowhere"')),
            ("to = 'right'\nrotation.angle = 3", WRONG_INPUT, ("[[periodic]]", "rotation.axis")),
            ("to = 'right'\n[[layer]]\npatch = 'left'\nfirst = 0.01\ncount = 2", WRONG_INPUT, ("[[periodic]] excludes [[layer]]",)),
        ):
            with self.subTest(wrong=wrong):
                case.write_text(text.replace("to = 'right'", wrong))
                self.assert_refused(self.run_program("mesh", case, "--output", words[0], "--overwrite", ranks=2), code, *words)


if __name__ == "__main__":
    unittest.main()
