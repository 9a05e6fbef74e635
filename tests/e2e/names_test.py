# SPDX-License-Identifier: BSD-3-Clause
"""[[geometry.name]]: names of patches and materials that a case gives."""
import json
import unittest

import program
from program import WRONG_INPUT
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader

GEOMETRY = program.CONFIGS / "geometry"
NAMES = """\
[[geometry.name]]
name = "sides"
patch = { normal = [1, 0, 0] }
[[geometry.name]]
name = "sides"
patch = { normal = [-1, 0, 0] }
[[geometry.name]]
name = "hot"
material = { pattern = "copper" }
"""


def read_boundary(folder):
    """Names of the rows, and how many triangles each has."""
    reader = vtkXMLPUnstructuredGridReader()
    reader.SetFileName(str(folder / "boundary.pvtu"))
    reader.Update()
    mesh = reader.GetOutput()
    names = [mesh.GetFieldData().GetAbstractArray("patch_names").GetValue(i)
             for i in range(mesh.GetFieldData().GetAbstractArray("patch_names").GetNumberOfValues())]
    array = mesh.GetCellData().GetArray("patch")
    rows = [int(array.GetValue(i)) for i in range(array.GetNumberOfValues())]
    texts = mesh.GetFieldData().GetAbstractArray("material_names")
    materials = [texts.GetValue(i) for i in range(texts.GetNumberOfValues())]
    return names, [rows.count(row) for row in range(len(names))], materials


class Names(program.ProgramTest):
    def blocks(self, names=NAMES, keys="", file="case.toml"):
        return self.write(
            file,
            f"geometry.file = '{GEOMETRY / 'two_blocks.step'}'\ncoarse.max_size = 6\nrefine.levels = 1\n"
            f"decompose.subdomains = 4\nfill.kernel = 'subdivide'\n{program.NO_PAGE}{keys}{names}",
        )

    def test_faces_of_one_name_become_one_patch_of_the_same_mesh(self):
        plain = self.mesh(self.blocks("", file="plain.toml"), "plain")
        named = self.mesh(self.blocks(), "named", ranks=2)
        self.assertEqual(program.figures(named)["digest"], program.figures(plain)["digest"])
        names, counts, materials = read_boundary(named)
        before, counts_before, materials_before = read_boundary(plain)
        self.assertEqual(names.count("sides"), 1)
        self.assertLess(len(names), len(before))
        self.assertEqual(sum(counts), sum(counts_before))
        self.assertNotIn(0, counts)
        self.assertEqual([m.replace("copper", "hot") for m in materials_before], materials)

    def test_any_number_of_ranks_and_the_case_that_was_kept_give_the_same_files(self):
        case = self.blocks()
        whole = self.mesh(case, "whole")
        self.assertEqual(program.mesh_files(self.mesh(case, "on_3", ranks=3)), program.mesh_files(whole))
        self.assertEqual(program.mesh_files(self.mesh(whole / "case.toml", "again")), program.mesh_files(whole))

    def test_sizes_and_kernels_know_the_new_names(self):
        case = self.blocks(keys="size.max = 3\n", names=NAMES + (
            '[[fill.region]]\nmaterial = "hot"\nkernel = "optimize"\n'
            '[[size.region]]\npatch = "sides"\nsize = 1\n[[size.region]]\nmaterial = "hot"\nsize = 2\n'))
        case.write_text(case.read_text().replace("refine.levels = 1\n", ""))
        made = json.loads((self.mesh(case, "out") / "report.json").read_text())
        self.assertEqual({piece["kernel"] for piece in made["subdomains"]}, {"subdivide", "optimize"})
        self.assertGreater(len(made["coarse"]["edges_by_level"]), 1)

    def test_every_kind_of_model_has_numbers_and_normals(self):
        for name, size, entry in (
            ("brick.geo", 0.5, "patch = { normal = [0, 0, 1] }"),
            ("core.geo", 4, "patch.pattern = 'out*'"),
            ("plate_with_hole.stl", 8, "patch.faces = [1, 2]"),
            ("cylinder.step", 6, "patch.faces = [2]"),
        ):
            with self.subTest(model=name):
                case = self.write("one.toml", f"geometry.file = '{GEOMETRY / name}'\ncoarse.max_size = {size}\n"
                                  f"refine.levels = 0\nfill.kernel = 'subdivide'\n{program.NO_PAGE}"
                                  f"[[geometry.name]]\nname = 'marked'\n{entry}\n")
                names, counts, _ = read_boundary(self.mesh(case, name))
                self.assertEqual(names.count("marked"), 1, names)
                self.assertGreater(counts[names.index("marked")], 0)

    def test_info_lists_normals_out_of_the_solid(self):
        for name in ("two_blocks.step", "brick.geo"):
            faces = json.loads(self.run_program("info", GEOMETRY / name, "--json").out)["faces"]
            for face in faces:
                normal, place = face["normal"], face["box"]["low"]
                axis = max(range(3), key=lambda a: abs(normal[a]))
                self.assertAlmostEqual(place[axis], face["box"]["high"][axis])
                solid = [f for f in faces if min(face["solids"]) in f["solids"]]
                outermost = max if normal[axis] > 0 else min
                self.assertAlmostEqual(place[axis], outermost(f["box"]["low"][axis] for f in solid if f["normal"][axis]))

    def test_what_fits_nothing_or_twice(self):
        entry = "[[geometry.name]]\nname = 'a'\n"
        for number, (names, words) in enumerate((
            (entry + "patch.faces = [99]\n", ["two_blocks.step", '"a"', "99", "1-12"]),
            (entry + "material.pattern = 'stel'\n", ['"steel"', '"copper"']),
            (entry + "patch.colour = '#123456'\n", ["no colours"]),
            (entry + "patch.box = { min = [900, 0, 0], max = [901, 1, 1] }\n", ["the model lies in"]),
            (entry + "patch.faces = [3]\n" + entry + "patch.faces = [3, 4]\n", ["face 3", "one entry only"]),
        )):
            with self.subTest(names=names):
                outcome = self.run_program("mesh", self.blocks(names), "--output", f"refused_{number}",
                                           ranks=2 if number == 0 else None)
                self.assert_refused(outcome, WRONG_INPUT, *words)


if __name__ == "__main__":
    unittest.main()
