# SPDX-License-Identifier: BSD-3-Clause
"""[[split]] and [[geometry.contact]]: cracks and baffles, where both sides have points of their own at the same places."""
import collections
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import program  # noqa: E402
from poly_mesh import PolyMesh  # noqa: E402
from program import FAILED, OK, WRONG_INPUT, sets  # noqa: E402
from vtk_grids import grid_of  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter  # noqa: E402

RADIUS = 0.5
# Two blocks, one on the other, and a rod through both: the contact of its halves is the crack, a part of the plane between.
PENNY = (
    "algebraic3d\nsolid low = orthobrick (-1, -1, -1; 1, 1, 0);\nsolid high = orthobrick (-1, -1, 0; 1, 1, 1);\n"
    f"solid rod = cylinder (0, 0, -2; 0, 0, 2; {RADIUS}) and orthobrick (-2, -2, -1; 2, 2, 1);\n"
    "solid a = low and rod;\nsolid b = high and rod;\nsolid c = low and not rod;\nsolid d = high and not rod;\n"
    "tlo a;\ntlo b;\ntlo c;\ntlo d;\n"
)
# A rod in a block: its round side is a baffle that reaches the outside at both of its rims.
BAFFLE = (
    "algebraic3d\nsolid box = orthobrick (-1, -1, 0; 1, 1, 0.8);\n"
    f"solid rod = cylinder (0, 0, -2; 0, 0, 2; {RADIUS}) and box;\nsolid rest = box and not rod;\ntlo rod;\ntlo rest;\n"
)
FACES = {"penny": 2, "baffle": 7}
SPLITS = {"penny": "[[geometry.contact]]\nbody = 'a'\nother = 'b'\n", "baffle": "[[split]]\npatch = 'crack'\n"}


class SplitsTest(program.ProgramTest):
    def case(self, name="penny", levels=1, more=""):
        self.write("model.geo", PENNY if name == "penny" else BAFFLE)
        face = FACES[name]
        return self.write(
            "case.toml",
            f"geometry.file = 'model.geo'\ncoarse.max_size = 0.4\ndecompose.subdomains = 7\nrefine.levels = {levels}\n{program.NO_PAGE}{more}\n"
            f"[[geometry.name]]\nname = 'crack'\npatch = {{ faces = [{face}] }}\n{SPLITS[name]}",
        )

    def checked(self, folder):
        figures, _ = self.assert_checked(folder, volume_tolerance=1e-12)
        return figures

    def sides(self, folder):
        """Of crack_plus and crack_minus: triangles as sorted places of their points, and ids at each place."""
        grid = grid_of(folder / "boundary.pvtu")
        texts = grid.GetFieldData().GetAbstractArray("patch_names")
        names = [texts.GetValue(row) for row in range(texts.GetNumberOfValues())]
        patch, ids = grid.GetCellData().GetArray("patch"), grid.GetPointData().GetGlobalIds()
        triangles = {"crack_plus": [], "crack_minus": []}
        ids_at = collections.defaultdict(set)
        for cell in range(grid.GetNumberOfCells()):
            name = names[int(patch.GetValue(cell))]
            if name not in triangles:
                continue
            points = grid.GetCell(cell).GetPointIds()
            rows = [points.GetId(i) for i in range(points.GetNumberOfIds())]
            places = [grid.GetPoint(row) for row in rows]
            triangles[name].append(tuple(sorted(places)))
            for row, place in zip(rows, places):
                ids_at[place].add(int(ids.GetValue(row)))
        return triangles, ids_at

    def assert_both_sides_alike(self, folder):
        triangles, ids_at = self.sides(folder)
        self.assertGreater(len(triangles["crack_plus"]), 20)
        self.assertEqual(sorted(triangles["crack_plus"]), sorted(triangles["crack_minus"]))
        return ids_at

    def area_of(self, report, name):
        return sum(one["area"] for one in report["patches"] if one["name"] == name)


class AnyNumberOfRanks(SplitsTest):
    def test_has_the_same_bits(self):
        case = self.case()
        for kernel, others in (("subdivide", (3,)), ("optimize", (2,)), ("netgen", (2,))):
            with self.subTest(kernel=kernel):
                alone = self.mesh(case, kernel, *sets(f"fill.kernel={kernel}"))
                self.checked(alone)
                self.assert_both_sides_alike(alone)
                for ranks in others:
                    other = self.mesh(case, f"{kernel}_{ranks}", *sets(f"fill.kernel={kernel}"), ranks=ranks)
                    self.assertEqual(program.mesh_files(other), program.mesh_files(alone))


class Penny(SplitsTest):
    def test_is_double_but_at_its_rim(self):
        for settings in ((), ("output.order=2",), ("refine.levels=2", "fill.levels=1"), ("output.files=1",)):
            with self.subTest(settings=settings):
                out = self.mesh(self.case(), "out_" + str(len(settings)) + "".join(settings)[:12], *sets(*settings), ranks=2)
                report = self.checked(out)
                self.assertEqual(report["splits"], [{"plus": "crack_plus", "minus": "crack_minus"}])
                ids_at = self.assert_both_sides_alike(out)
                self.assertAlmostEqual(self.area_of(report, "crack_plus") / (math.pi * RADIUS**2), 1.0, delta=0.03)
                for (x, y, z), ids in ids_at.items():
                    is_inside = math.hypot(x, y) < RADIUS - 1e-6
                    self.assertEqual(len(ids), 2 if is_inside else 1, (x, y, z))

    def test_where_edges_have_levels_of_their_own(self):
        more = ("size.target = 0.2\n[[size.region]]\nsize = 0.05\nball = { centre = [0.3, 0, 0.1], radius = 0.15 }\n")
        case = self.case(more=more)
        case.write_text(case.read_text().replace("refine.levels = 1\n", "").replace("coarse.max_size = 0.4\n", ""))
        out = self.mesh(case, "out")
        self.checked(out)
        self.assert_both_sides_alike(out)


class Baffle(SplitsTest):
    def test_parts_a_mesh_to_the_outside(self):
        out = self.mesh(self.case("baffle", levels=2), "out", *sets("fill.kernel=subdivide", 'output.formats=["openfoam-serial"]'))
        report = self.checked(out)
        ids_at = self.assert_both_sides_alike(out)
        self.assertAlmostEqual(self.area_of(report, "crack_minus") / (2.0 * math.pi * RADIUS * 0.8), 1.0, delta=0.02)
        self.assertEqual({len(ids) for ids in ids_at.values()}, {2})
        for x, y, _ in ids_at:
            self.assertAlmostEqual(math.hypot(x, y), RADIUS, places=9)
        mesh = PolyMesh(out)
        self.assertEqual(mesh.num_cells(), report["num_tets"])
        sizes = {name: end - begin for name, (_, begin, end, _) in mesh.patches.items()}
        self.assertEqual(sizes["crack_plus"], sizes["crack_minus"])
        parts = self.folder / "parts"
        self.run_program("repartition", out / "mesh.pvtu", "--parts", 3, "--output", parts, ranks=2)
        self.assertEqual(self.run_program("check", parts / "mesh.pvtu", ranks=2).code, OK)

    def test_stays_alike_where_one_side_has_layers_and_edges_have_levels(self):
        more = (
            "size.target = 0.2\n[[size.region]]\nsize = 0.05\nball = { centre = [0.5, 0, 0.4], radius = 0.2 }\n"
            "[[layer]]\npatch = 'crack_plus'\nfirst = 0.03\ncount = 3\n")
        case = self.case("baffle", more=more)
        case.write_text(case.read_text().replace("refine.levels = 1\n", "").replace("coarse.max_size = 0.4\n", ""))
        out = self.mesh(case, "out", ranks=2)
        report = self.checked(out)
        self.assertGreater(len(report["coarse"]["edges_by_level"]), 1)
        self.assertGreater(report["layers"]["full_height"], 0.8)
        self.assert_both_sides_alike(out)


class Checked(SplitsTest):
    def test_is_that_both_sides_are_at_the_same_places(self):
        out = self.mesh(self.case(), "out", *sets("fill.kernel=subdivide"))
        ids_at = self.assert_both_sides_alike(out)
        moved = max(max(ids_at.values(), key=len))
        for file in (*out.glob("mesh/*.vtu"), *out.glob("boundary/*.vtu")):
            grid = grid_of(file)
            ids = grid.GetPointData().GetGlobalIds()
            rows = [row for row in range(grid.GetNumberOfPoints()) if int(ids.GetValue(row)) == moved]
            for row in rows:
                x, y, z = grid.GetPoint(row)
                grid.GetPoints().SetPoint(row, x + 1e-6, y, z)
            if rows:
                writer = vtkXMLUnstructuredGridWriter()
                writer.SetFileName(str(file))
                writer.SetInputData(grid)
                writer.Write()
        found = self.run_program("check", out / "mesh.pvtu", "--json")
        self.assertEqual(found.code, FAILED, found.err)
        self.assertIn("split_point", found.out)


class Refused(SplitsTest):
    def test_is_what_is_not_between_two_materials(self):
        case = self.case("baffle")
        text = case.read_text()
        for wrong, words in (
            ("patch = 'nowhere'", ("[[split]]", 'patch = "nowhere"', "crack")),
            ("patch = 'patch_1'", ("[[split]]", '"patch_1"', "only patches inside of it")),
        ):
            case.write_text(text.replace("patch = 'crack'", wrong))
            self.assert_refused(self.run_program("mesh", case, "--output", words[1], ranks=2), WRONG_INPUT, *words)


if __name__ == "__main__":
    unittest.main()
