# SPDX-License-Identifier: BSD-3-Clause
"""[[embed]]: faces inside of bodies, which may end there, cross each other and lie in several solids."""
import collections
import json
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import program  # noqa: E402
from poly_mesh import PolyMesh  # noqa: E402
from program import FAILED, OK, WRONG_INPUT, sets  # noqa: E402
from vtk_grids import grid_of  # noqa: E402

# Three layers of rock, a fault that ends in the middle one, and one that crosses it and ends in the layers at all of its rim.
LAYERS = (
    "algebraic3d\nsolid low = orthobrick (0, 0, 0; 2, 1, 0.3);\nsolid middle = orthobrick (0, 0, 0.3; 2, 1, 0.6);\n"
    "solid high = orthobrick (0, 0, 0.6; 2, 1, 1);\ntlo low;\ntlo middle;\ntlo high;\n"
)
FAULTS = (
    "[[embed]]\nname = 'fault'\npolygon = [[0.8, -0.1, -0.1], [0.8, 1.1, -0.1], [1.2, 1.1, 0.5], [1.2, -0.1, 0.5]]\n"
    "[[embed]]\nname = 'cross'\npolygon = [[0.5, 0.3, 0.2], [1.6, 0.3, 0.2], [1.6, 0.6, 0.8], [0.5, 0.6, 0.8]]\n"
)
AREAS = {"fault": 0.5 / 0.6 * math.hypot(0.4, 0.6), "cross": 1.1 * math.hypot(0.3, 0.6)}
# A penny in the middle of a block.
BLOCK = "algebraic3d\nsolid block = orthobrick (-1, -1, -1; 1, 1, 1);\ntlo block;\n"
PENNY = "[[embed]]\nname = 'crack'\ndisk = { centre = [0, 0, 0], normal = [0, 0, 1], radius = 0.5 }\n"


def triangles_by_patch(boundary):
    """Triangles of each patch name as sets of places."""
    texts = boundary.GetFieldData().GetAbstractArray("patch_names")
    names = [texts.GetValue(row) for row in range(texts.GetNumberOfValues())]
    patch = boundary.GetCellData().GetArray("patch")
    found = collections.defaultdict(list)
    for cell in range(boundary.GetNumberOfCells()):
        points = boundary.GetCell(cell).GetPointIds()
        found[names[int(patch.GetValue(cell))]].append(frozenset(boundary.GetPoint(points.GetId(i)) for i in range(3)))
    return found


class EmbedTest(program.ProgramTest):
    def case(self, model=LAYERS, embedded=FAULTS, more="coarse.max_size = 0.2\nrefine.levels = 1\n"):
        self.write("model.geo", model)
        return self.write("case.toml", f"geometry.file = 'model.geo'\ndecompose.subdomains = 7\n{program.NO_PAGE}{more}{embedded}")

    def checked(self, folder):
        figures, _ = self.assert_checked(folder, volume_tolerance=1e-12)
        return figures

    def assert_faults(self, report):
        areas = {one["name"]: one["area"] for one in report["patches"]}
        for name, area in AREAS.items():
            self.assertAlmostEqual(areas[name], area, delta=1e-9)
        volumes = {one["name"]: one["volume"] for one in report["materials"]}
        self.assertEqual(set(volumes), {"low", "middle", "high"})
        for name, volume in {"low": 0.6, "middle": 0.6, "high": 0.8}.items():
            self.assertAlmostEqual(volumes[name], volume, delta=1e-9)


class Faults(EmbedTest):
    def test_are_in_the_mesh_with_the_same_bits_for_any_number_of_ranks(self):
        case = self.case()
        alone = self.mesh(case, "alone")
        report = self.checked(alone)
        self.assert_faults(report)
        self.assertEqual([one["name"] for one in report["model"]["assembly"]["embedded"]], ["fault", "cross"])
        for ranks in (2, 5):
            other = self.mesh(case, f"ranks_{ranks}", ranks=ranks)
            self.assertEqual(program.mesh_files(other), program.mesh_files(alone))

    def test_have_the_same_material_on_both_sides(self):
        out = self.mesh(self.case(), "out")
        tets, boundary = grid_of(out / "mesh.pvtu"), grid_of(out / "boundary.pvtu")
        material = tets.GetCellData().GetArray("attribute")
        sides = collections.defaultdict(list)
        for cell in range(tets.GetNumberOfCells()):
            corners = [tets.GetPoint(tets.GetCell(cell).GetPointId(i)) for i in range(4)]
            for left_out in range(4):
                sides[frozenset(corners[:left_out] + corners[left_out + 1:])].append(int(material.GetValue(cell)))
        patches = triangles_by_patch(boundary)
        for name in AREAS:
            self.assertGreater(len(patches[name]), 50)
            for triangle in patches[name]:
                self.assertEqual(len(sides[triangle]), 2)
                self.assertEqual(*sides[triangle])
        texts = boundary.GetFieldData().GetAbstractArray("inside_patches")
        self.assertEqual([texts.GetValue(row) for row in range(texts.GetNumberOfValues())], ["cross", "fault"])

    def test_go_with_all_kernels_orders_and_splits_after_the_fill(self):
        case = self.case()
        for settings in (
            ("fill.kernel=subdivide",),
            ("fill.kernel=optimize", "output.files=2"),
            ("output.order=2",),
            ("refine.levels=2", "fill.levels=1"),
            ("refine.levels=2", "fill.levels=1", "fill.kernel=optimize"),
        ):
            with self.subTest(settings=settings):
                out = self.mesh(case, "_".join(settings).replace("=", "_"), *sets(*settings), ranks=2)
                self.assert_faults(self.checked(out))

    def test_go_into_parts_and_formats(self):
        out = self.mesh(self.case(), "out", *sets('output.formats=["openfoam-serial", "msh"]'))
        report = self.checked(out)
        parts = self.folder / "parts"
        self.run_program("repartition", out / "mesh.pvtu", "--parts", 3, "--output", parts, ranks=2)
        self.assertEqual(self.run_program("check", parts / "mesh.pvtu", ranks=2).code, OK)
        self.assertIn(b'"fault"', (out / "mesh.msh").read_bytes())
        mesh = PolyMesh(out)
        self.assertEqual(mesh.num_cells(), report["num_tets"])

    def test_keep_the_numbers_of_faces_and_have_sizes_of_their_own(self):
        more = (
            "size.target = 0.15\n[[size.region]]\npatch = 'fault'\nsize = 0.05\n"
            "[[geometry.name]]\nname = 'foot'\npatch = { normal = [0, 0, -1], box = { min = [0, 0, 0], max = [2, 1, 0] } }\n"
        )
        out = self.mesh(self.case(more="", embedded=more + FAULTS), "out")
        report = self.checked(out)
        self.assert_faults(report)
        patches = {one["name"]: one for one in report["patches"]}
        self.assertAlmostEqual(patches["foot"]["area"], 2.0, delta=1e-9)
        self.assertEqual(len(patches["foot"]["faces"]), 2)
        self.assertGreater(patches["fault"]["triangles"], AREAS["fault"] / (0.05**2))


class Crack(EmbedTest):
    def test_is_open_but_at_its_rim(self):
        split = "[[split]]\npatch = 'crack'\n"
        out = self.mesh(self.case(BLOCK, PENNY + split, "coarse.max_size = 0.4\nrefine.levels = 1\n"), "out", ranks=2)
        report = self.checked(out)
        self.assertEqual(report["splits"], [{"plus": "crack_plus", "minus": "crack_minus"}])
        boundary = grid_of(out / "boundary.pvtu")
        patches = triangles_by_patch(boundary)
        self.assertEqual(sorted(map(sorted, patches["crack_plus"])), sorted(map(sorted, patches["crack_minus"])))
        ids_at = collections.defaultdict(set)
        tets = grid_of(out / "mesh.pvtu")
        for row in range(tets.GetNumberOfPoints()):
            ids_at[tets.GetPoint(row)].add(int(tets.GetPointData().GetGlobalIds().GetValue(row)))
        self.assertEqual(self.sides_of_the_crack(tets, boundary), {"crack_plus": {True}, "crack_minus": {False}})
        on_crack = {place for triangle in patches["crack_plus"] for place in triangle}
        for x, y, z in on_crack:
            self.assertEqual(len(ids_at[x, y, z]), 2 if math.hypot(x, y) < 0.5 - 1e-6 else 1)

    @staticmethod
    def sides_of_the_crack(tets, boundary):
        """Of each patch, whether its tets are above the plane of the crack: its normal points up."""
        ids = tets.GetCellData().GetGlobalIds()
        is_above = {}
        for cell in range(tets.GetNumberOfCells()):
            heights = [tets.GetPoint(tets.GetCell(cell).GetPointId(i))[2] for i in range(4)]
            is_above[int(ids.GetValue(cell))] = sum(heights) > 0
        texts = boundary.GetFieldData().GetAbstractArray("patch_names")
        patch, behind = (boundary.GetCellData().GetArray(name) for name in ("patch", "tet"))
        found = collections.defaultdict(set)
        for cell in range(boundary.GetNumberOfCells()):
            name = texts.GetValue(int(patch.GetValue(cell)))
            if name.startswith("crack"):
                found[name].add(is_above[int(behind.GetValue(cell))])
        return found

    def test_survives_a_kill(self):
        case = self.case(more="coarse.max_size = 0.12\nrefine.levels = 2\n")
        whole = self.mesh(case, "whole")
        process = self.start("mesh", case, "--output", self.folder / "killed", ranks=2)
        program.wait_until(lambda: program.num_filled(self.folder / "killed") > 0, "a filled subdomain")
        program.end_tree(process)
        resumed = self.run_program("mesh", case, "--output", self.folder / "killed", "--resume", ranks=3)
        self.assertEqual(resumed.code, OK, resumed.err)
        self.assertEqual(program.figures(self.folder / "killed")["digest"], program.figures(whole)["digest"])


class Together(EmbedTest):
    """With what else the coarse mesh can have."""

    def pair(self, more, name, embedded=PENNY, model=BLOCK):
        out = self.mesh(self.case(model, embedded + more, "coarse.max_size = 0.4\nrefine.levels = 1\n"), name, ranks=2)
        report = self.checked(out)
        self.assertEqual(len(report["materials"]), 1)
        return report

    def test_layers_grow_beside_it(self):
        report = self.pair("[[layer]]\npatch = '*'\nfirst = 0.02\ncount = 3\n", "layers")
        self.assertAlmostEqual(report["volume"], 8.0, delta=1e-9)

    def test_the_inside_of_the_coarse_mesh_is_optimised(self):
        report = self.pair("", "optimised", "coarse.optimize = true\n" + PENNY)
        crack = next(one for one in report["patches"] if one["name"] == "crack")
        self.assertAlmostEqual(crack["area"] / (math.pi / 4), 1.0, delta=0.03)

    def test_a_contact_of_a_body_with_itself_opens_nothing(self):
        report = self.pair("[[geometry.contact]]\nbody = '*'\nother = '*'\n", "contact")
        self.assertEqual(report.get("splits", []), [])

    def test_a_disk_on_a_wall_is_a_patch_also_if_the_wall_has_a_name(self):
        disk = "[[embed]]\nname = 'inlet'\ndisk = { centre = [0, 0, 1], normal = [0, 0, 1], radius = 0.5 }\n"
        report = self.pair("[[geometry.name]]\nname = 'wall'\npatch = { normal = [0, 0, 1] }\n", "inlet", disk)
        areas = {one["name"]: one["area"] for one in report["patches"]}
        self.assertEqual(len(areas), 7)
        self.assertAlmostEqual(areas["inlet"] + areas["wall"], 4.0, delta=1e-9)

    def test_periodic_sides_are_cut_alike_or_refused(self):
        sides = "".join(
            f"[[geometry.name]]\nname = '{name}'\npatch = {{ normal = [{x}, 0, 0] }}\n" for name, x in (("left", -1), ("right", 1))
        )
        sides += "[[periodic]]\nfrom = 'left'\nto = 'right'\n"
        self.pair(sides, "periodic")
        tilted = PENNY.replace("normal = [0, 0, 1]", "normal = [1, 2, 3]")
        case = self.case(BLOCK, tilted + sides, "coarse.max_size = 0.4\nrefine.levels = 1\n")
        self.assert_refused(self.run_program("mesh", case, "--output", "tilted", ranks=2), FAILED, "periodic sides", "not the other one")


class Check(EmbedTest):
    def test_finds_triangles_that_are_inside_of_a_body_but_not_on_a_face_of_it(self):
        out = self.mesh(self.case(), "out")
        for file in (out / "boundary").glob("*.vtu"):
            content = file.read_bytes().replace(b'Name="inside_patches"', b'Name="inside_nothing"')
            file.write_bytes(content)
        for file in (out / "mesh").glob("*.vtu"):
            file.write_bytes(file.read_bytes().replace(b'Name="inside_patches"', b'Name="inside_nothing"'))
        found = self.run_program("check", out / "mesh.pvtu", "--json")
        self.assertEqual(found.code, FAILED, found.err)
        self.assertIn("boundary_extra", json.dumps(json.loads(found.out)))


class Refused(EmbedTest):
    def test_is_what_lies_outside_or_is_for_other_models(self):
        far = "[[embed]]\nname = 'far'\npolygon = [[5, 0, 0], [6, 0, 0], [5, 1, 0]]\n"
        self.assert_refused(self.run_program("mesh", self.case(embedded=far), ranks=2), WRONG_INPUT, "model.geo", '[[embed]] "far"', "outside")
        case = self.case()
        self.write("model.stl", program.stl_text(program.CUBE_TRIANGLES))
        case.write_text(case.read_text().replace("model.geo", "model.stl"))
        self.assert_refused(self.run_program("mesh", case), WRONG_INPUT, "case.toml", "[[embed]]", ".stl")


if __name__ == "__main__":
    unittest.main()
