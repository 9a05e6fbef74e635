# SPDX-License-Identifier: BSD-3-Clause
"""[[periodic]]: sides that are images of each other, with the same points and triangles."""
import itertools
import math
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import program  # noqa: E402
from msh_file import Msh  # noqa: E402
from periodic_models import PACKING, PAIRS, PIPE, SECTOR, packing_case, sector_case  # noqa: E402
from program import FAILED, OK, WRONG_INPUT, sets  # noqa: E402
from vtk_grids import grid_of  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter  # noqa: E402


def write_grid(grid, file):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(grid)
    writer.Write()


def shifted(by):
    return lambda p: tuple(a + b for a, b in zip(p, by))


def turned(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda p: (c * p[0] - s * p[1], s * p[0] + c * p[1], p[2])


class PeriodicTest(program.ProgramTest):
    def packing(self, *changes, **more):
        self.write("model.geo", PACKING)
        return self.write("case.toml", packing_case(*changes, **more))

    def sector(self, *changes):
        self.write("model.geo", SECTOR)
        return self.write("case.toml", sector_case(*changes))

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

    def test_of_a_sector_may_meet_on_its_axis(self):
        self.write("model.geo", SECTOR.replace(" and not hub", ""))
        names = "".join(f"[[geometry.name]]\nname = '{n}'\npatch = {{ normal = [0, 0, {z}] }}\n" for n, z in (("low", -1), ("high", 1)))
        case = self.write("case.toml", sector_case() + names + "[[periodic]]\nfrom = 'low'\nto = 'high'\n")
        out = self.mesh(case, "out", *sets("fill.kernel=netgen"), ranks=2)
        self.assert_checked(out, volume_tolerance=1e-12)
        self.assert_alike(out, "start", "end", turned(30))
        self.assert_alike(out, "low", "high", shifted((0, 0, 0.3)))

    def test_have_the_sizes_that_one_of_them_has(self):
        more = "[[size.region]]\nsize = 0.03\nball = { centre = [0, 0.3, 0.7], radius = 0.15 }\n"
        out = self.mesh(self.packing(more), "out", ranks=2)
        self.assert_packing(out)

    def test_are_those_of_a_mesh_of_the_user(self):
        first = self.mesh(self.packing("refine.levels = 0\n"), "coarse", *sets('output.formats=["msh"]'))
        sides = "".join(f"[[periodic]]\nfrom = '{a}'\nto = '{b}'\n" for a, b in PAIRS)
        case = self.write("own.toml", f"geometry.file = '{first}/mesh.msh'\nrefine.levels = 2\n{program.NO_PAGE}{sides}")
        out = self.mesh(case, "out", ranks=2)
        self.assert_packing(out)
        parts = self.folder / "parts"
        self.run_program("repartition", out / "mesh.pvtu", "--parts", 3, "--output", parts, ranks=2)
        self.assertEqual(self.run_program("check", parts / "mesh.pvtu", ranks=2).code, OK)
        for (start, end), shift in PAIRS.items():
            self.assert_alike(parts, start, end, shifted(shift))


class Cracks(PeriodicTest):
    def test_go_through_sides(self):
        self.write("model.geo", PACKING)
        case = self.write("case.toml", packing_case() + "[[split]]\npatch = 'patch_*'\n")
        for settings in (("fill.kernel=netgen",), ("output.order=2",)):
            with self.subTest(settings=settings):
                report = self.assert_packing(self.mesh(case, settings[0][:8], *sets(*settings), ranks=2))
                self.assertGreater(len(report["splits"]), 8)


# A part of a channel between two arcs.
BENT = (
    "algebraic3d\nsolid before = cylinder (-1, 0.5, 0; -1, 0.5, 1; 1.2);\nsolid within = cylinder (0, 0.5, 0; 0, 0.5, 1; 1.2);\n"
    "solid slab = plane (0, 0, 0; 0, -1, 0) and plane (0, 1, 0; 0, 1, 0) and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 0.8; 0, 0, 1)\n"
    "  and plane (-1, 0, 0; -1, 0, 0);\nsolid body = slab and within and not before;\ntlo body;\n"
)
LAYERS = "[[layer]]\npatch = '*'\nfirst = 0.005\ncount = 3\n"


class Layers(PeriodicTest):
    """End at the sides, and go on from their partners."""

    def between(self, model, start, end):
        self.write("model.geo", model)
        names = "".join(
            f"[[geometry.name]]\nname = '{name}'\npatch = {{ box = {{ min = {box[0]}, max = {box[1]} }} }}\n"
            for name, box in (("start", start), ("end", end))
        )
        head = "geometry.file = 'model.geo'\ncoarse.max_size = 0.25\nrefine.levels = 2\ndecompose.subdomains = 5\n"
        return self.write("case.toml", program.NO_PAGE + head + names + "[[periodic]]\nfrom = 'start'\nto = 'end'\n" + LAYERS)

    def assert_full(self, report):
        self.assertEqual(report["layers"]["count"], 3)
        self.assertGreater(report["layers"]["full_height"], 0.99)

    def test_in_three_directions_have_the_same_bits_for_any_number_of_ranks(self):
        self.write("model.geo", PACKING.replace("tlo grains;\n", ""))
        case = self.write("case.toml", packing_case() + LAYERS)
        alone = self.mesh(case, "alone", *sets("output.formats=['msh']"))
        self.assert_full(self.assert_packing(alone))
        self.assertEqual([len(link[4]) > 20 for link in Msh(alone / "mesh.msh").periodic], [True] * 3)
        others = self.mesh(case, "others", *sets("output.formats=['msh']"), ranks=3)
        self.assertEqual(program.mesh_files(others), program.mesh_files(alone))

    def test_of_a_pipe(self):
        case = self.between(PIPE, [[-1, -1, -0.1], [1, 1, 0.1]], [[-1, -1, 0.9], [1, 1, 1.1]])
        for kernel in ("netgen", "subdivide"):
            out = self.mesh(case, kernel, *sets(f"fill.kernel={kernel}"), ranks=2)
            self.assert_full(self.assert_checked(out, volume_tolerance=1e-12)[0])
            self.assert_alike(out, "start", "end", shifted((0, 0, 1)))

    def test_of_a_pipe_whose_points_have_parameters(self):
        """Its rims are one closed curve each, on which a point without a guess goes to another place."""
        names = "".join(f"[[geometry.name]]\nname = '{n}'\npatch = {{ normal = [0, 0, {z}] }}\n" for n, z in (("start", -1), ("end", 1)))
        head = f"geometry.file = '{program.CONFIGS / 'geometry/cylinder.step'}'\ncoarse.max_size = 3\nrefine.levels = 2\n"
        layers = LAYERS.replace("0.005", "0.1")
        case = self.write("case.toml", program.NO_PAGE + head + "decompose.subdomains = 5\n" + names + "[[periodic]]\nfrom = 'start'\nto = 'end'\n" + layers)
        for kernel in ("netgen", "subdivide"):
            out = self.mesh(case, kernel, *sets(f"fill.kernel={kernel}"), ranks=2)
            report = self.assert_checked(out, volume_tolerance=1e-12)[0]
            self.assert_full(report)
            self.assertEqual(report["num_points_off_geometry"], 0)
            self.assert_alike(out, "start", "end", shifted((0, 0, 20)))

    def test_lie_on_round_sides(self):
        boxes = [[0.05, -0.1, -0.1], [0.25, 1.1, 0.9]], [[1.05, -0.1, -0.1], [1.25, 1.1, 0.9]]
        out = self.mesh(self.between(BENT, *boxes), "out", ranks=2)
        self.assert_full(self.assert_checked(out, volume_tolerance=1e-12)[0])
        self.assert_alike(out, "start", "end", shifted((1, 0, 0)))
        for x, y, _ in itertools.chain(*self.triangles(out, "end")):
            self.assertAlmostEqual(math.hypot(x, y - 0.5), 1.2, delta=1e-9)

    def test_end_where_the_side_has_no_wall_beyond(self):
        """Only a part of the balls has layers, so its rims have partners without."""
        self.write("model.geo", PACKING.replace("tlo grains;\n", ""))
        walls = "[[geometry.name]]\nname = 'wall'\npatch = { box = { min = [-0.1, -0.1, -0.1], max = [0.35, 0.35, 0.35] } }\n"
        case = self.write("case.toml", packing_case() + walls + LAYERS.replace("'*'", "'wall'"))
        report = self.assert_packing(self.mesh(case, "out", ranks=2))
        self.assertEqual([patch["name"] for patch in report["layers"]["patches"]], ["wall"])


class NodesOfFiles(PeriodicTest):
    """Both forms of Gmsh's files, and those of Abaqus, say which nodes are images of which."""

    def convert(self, mesh, name, ranks):
        formats = [word for form in ("msh", "msh2", "abaqus") for word in ("--format", form)]
        done = self.run_program("convert", mesh / "mesh.pvtu", *formats, "--output", name, ranks=ranks)
        self.assertEqual(done.code, OK, done.err)
        return [self.folder / name / file for file in ("mesh.msh", "mesh_v2.msh", "mesh.inp")]

    def assert_same_pairs(self, deck, msh):
        """Nodes have one number in all files."""
        for number, link in enumerate(msh.periodic, 1):
            image, original = (
                re.search(rf"^\*NSET, NSET=PERIODIC_{number}_{side}, UNSORTED\n([\d\s]+)", deck, re.MULTILINE)[1].split()
                for side in ("TO", "FROM")
            )
            self.assertEqual(list(zip(map(int, image), map(int, original))), [tuple(pair) for pair in link[4].tolist()])
        self.assertEqual(deck.count("UNSORTED"), 2 * len(msh.periodic))

    def cracked_packing(self):
        """With two points at one place where a ball meets a side."""
        self.write("model.geo", PACKING)
        return self.write("case.toml", packing_case() + "[[split]]\npatch = 'patch_*'\n")

    def assert_all_nodes(self, msh, pairs):
        """Each node of a patch is listed once, and lies where its partner's image is; so do the triangles."""
        tags = {name: tag for (_, tag), name in msh.names.items()}
        triangles_of = {}
        for dimension, entity, _, rows in msh.blocks:
            if dimension == 2:
                triangles_of.setdefault(entity, set()).update(map(frozenset, rows[:, 1:].tolist()))
        expected = [(2, tags[end], tags[start]) for start, end in pairs]
        self.assertEqual([link[:3] for link in msh.periodic], expected)
        for _, image, original, matrix, nodes in msh.periodic:
            self.assertGreater(len(nodes), 20)
            for entity, listed in zip((image, original), nodes.T.tolist()):
                self.assertEqual(sorted(listed), sorted(frozenset().union(*triangles_of[entity])))
            original_of = dict(nodes.tolist())
            triangles = {frozenset(original_of[node] for node in triangle) for triangle in triangles_of[image]}
            self.assertEqual(triangles, triangles_of[original])
            images = msh.node_xyz[nodes[:, 1]] @ matrix[:3, :3].T + matrix[:3, 3]
            self.assertLess(abs(msh.node_xyz[nodes[:, 0]] - images).max(), 1e-13)
            self.assertEqual(matrix[3].tolist(), [0, 0, 0, 1])

    def test_list_all_nodes_of_the_sides_for_any_number_of_ranks(self):
        for case, pairs, settings in (
            (self.packing, PAIRS, ()),
            (self.cracked_packing, PAIRS, ("refine.levels=0",)),
            (self.sector, [("start", "end")], ("refine.levels=1", "output.order=2")),
        ):
            with self.subTest(case=case.__name__):
                mesh = self.mesh(case(), case.__name__, *sets(*settings, "fill.kernel=subdivide"), ranks=2)
                alone = self.convert(mesh, f"{case.__name__}_1", 1)
                for file in alone[:2]:
                    self.assert_all_nodes(Msh(file), pairs)
                self.assert_same_pairs(alone[2].read_text(encoding="utf-8"), Msh(alone[0]))
                for file, other in zip(alone, self.convert(mesh, f"{case.__name__}_3", 3)):
                    self.assertEqual(file.read_bytes(), other.read_bytes())

    def test_say_nothing_of_other_meshes(self):
        mesh = self.mesh(self.packing(pairs=()), "mesh", *sets("fill.kernel=subdivide"))
        *gmsh_files, deck = self.convert(mesh, "out", 2)
        for file in gmsh_files:
            self.assertEqual(Msh(file).order[-1], "Elements")
        self.assertNotIn("UNSORTED", deck.read_text(encoding="utf-8"))

    def test_are_refused_if_a_point_has_no_partner(self):
        mesh = self.mesh(self.packing(), "mesh", *sets("fill.kernel=subdivide"))
        for file in mesh.glob("mesh/*.vtu"):
            grid = grid_of(file)
            texts = grid.GetFieldData().GetAbstractArray("periodic_patches")
            self.assertEqual(texts.GetValue(1), "right")
            texts.SetValue(2, "1 0 0 2 0 1 0 0 0 0 1 0")
            write_grid(grid, file)
        for ranks in (1, 3):
            done = self.run_program("convert", mesh / "mesh.pvtu", "--format", "msh", "--output", "no", ranks=ranks)
            self.assert_refused(done, WRONG_INPUT, '"right"', '"left"', "tessera check")
            self.assertFalse((self.folder / "no/mesh.msh").exists())


class Partners(PeriodicTest):
    """Point arrays of the boundary files: the ids of the points whose images others are."""

    def assert_partners(self, folder, pairs):
        """Of all points of triangles of an image, one by one; others have none."""
        grid = grid_of(folder / "boundary.pvtu")
        data, names = grid.GetPointData(), grid.GetFieldData().GetAbstractArray("patch_names")
        ids, patch = data.GetGlobalIds(), grid.GetCellData().GetArray("patch")
        position = {int(ids.GetValue(row)): grid.GetPoint(row) for row in range(grid.GetNumberOfPoints())}
        for number, ((_, end), shift) in enumerate(pairs.items(), 1):
            partner = data.GetArray(f"periodic_partner_{number}")
            rows = set()
            for cell in range(grid.GetNumberOfCells()):
                if names.GetValue(int(patch.GetValue(cell))) == end:
                    points = grid.GetCell(cell).GetPointIds()
                    rows.update(points.GetId(i) for i in range(points.GetNumberOfIds()))
            self.assertGreater(len(rows), 20)
            for row in range(grid.GetNumberOfPoints()):
                of_row = int(partner.GetValue(row))
                self.assertEqual(of_row >= 0, row in rows)
                if row in rows:
                    self.assertLess(math.dist(shifted(shift)(position[of_row]), grid.GetPoint(row)), 1e-13)

    def test_are_those_of_their_places(self):
        cracked = packing_case() + "[[split]]\npatch = 'patch_*'\n"
        self.write("model.geo", PACKING)
        for name, text, settings in (
            ("whole", packing_case(), ()),
            ("cracked", cracked, ("output.order=2", "output.compression=none")),
            ("at_once", packing_case(), ("fill.kernel=subdivide", "output.files=1")),
        ):
            with self.subTest(name=name):
                out = self.mesh(self.write(f"{name}.toml", text), name, *sets(*settings), ranks=2)
                self.assert_partners(out, PAIRS)
        parts = self.folder / "parts"
        self.run_program("repartition", self.folder / "whole/mesh.pvtu", "--parts", 3, "--output", parts, ranks=2)
        self.assert_partners(parts, PAIRS)

    def test_are_checked(self):
        out = self.mesh(self.packing(), "out", *sets("fill.kernel=subdivide"))
        for file in out.glob("boundary/*.vtu"):
            grid = grid_of(file)
            partner = grid.GetPointData().GetArray("periodic_partner_2")
            for row in range(grid.GetNumberOfPoints()):
                if partner.GetValue(row) >= 0:
                    partner.SetValue(row, partner.GetValue(row) + 1)
                    break
            write_grid(grid, file)
        found = self.run_program("check", out / "mesh.pvtu", "--json", ranks=2)
        self.assertEqual(found.code, FAILED, found.err)
        self.assertIn("periodic_point", found.out)
        self.assertIn("as the file says", found.out)


class Checked(PeriodicTest):
    def test_is_that_each_point_has_a_partner(self):
        out = self.mesh(self.packing(), "out", *sets("fill.kernel=subdivide"))
        for file in (*out.glob("mesh/*.vtu"), *out.glob("boundary/*.vtu")):
            grid = grid_of(file)
            rows = [row for row in range(grid.GetNumberOfPoints()) if grid.GetPoint(row)[0] == 1.0]
            for row in rows:
                x, y, z = grid.GetPoint(row)
                grid.GetPoints().SetPoint(row, x, y + 1e-5 * math.sin(math.pi * y) * math.sin(math.pi * z), z)
            if rows:
                write_grid(grid, file)
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
            ("to = 'right'\n[[layer]]\npatch = 'left'\nfirst = 0.01\ncount = 2", WRONG_INPUT, ("[[layer]]", '"left"', "side of [[periodic]]")),
        ):
            with self.subTest(wrong=wrong):
                case.write_text(text.replace("to = 'right'", wrong))
                self.assert_refused(self.run_program("mesh", case, "--output", words[0], "--overwrite", ranks=2), code, *words)


if __name__ == "__main__":
    unittest.main()
