# SPDX-License-Identifier: BSD-3-Clause
"""A mesh from a CAD model alone, without a case file."""
import json
import shutil
import unittest

import program
from program import OK, WRONG_INPUT

GEOMETRY = program.CONFIGS / "geometry"


class Model(program.ProgramTest):
    def setUp(self):
        super().setUp()
        shutil.copy(GEOMETRY / "cylinder.step", self.folder / "part.step")

    def mesh_model(self, model, *arguments, **options):
        outcome = self.run_program("mesh", model, *arguments, **options)
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        return outcome

    def test_the_case_it_made_gives_the_same_mesh(self):
        self.mesh_model("part.step", "--size", "1.5", ranks=2)
        out = self.folder / "outputs" / "part"
        case = (out / "case.toml").read_text()
        self.assertIn("target = 1.5", case)
        self.assertIn(f'file = "{self.folder / "part.step"}"', case)
        again = self.mesh(out / "case.toml", "again")
        self.assertEqual(program.mesh_files(again), program.mesh_files(out))
        self.assertEqual(program.figures(again)["digest"], program.figures(out)["digest"])

    def test_the_size_is_met_on_as_many_levels_as_it_takes(self):
        made = []
        for size in (1.6, 0.8):
            self.mesh_model("part.step", "--size", size, "--kernel", "subdivide", "--output", f"of_{size}")
            report = json.loads((self.folder / f"of_{size}" / "report.json").read_text())
            median = report["quality"]["edge_length"]["median"]
            self.assertGreater(median, 0.75 * size)
            self.assertLess(median, 1.25 * size)
            made.append(report["num_tets"])
        self.assertGreater(made[1], 5 * made[0])

    def test_options_are_keys_and_set_works_on_top(self):
        self.mesh_model("part.step", "--size", "1.5", "--parts", 2, "--kernel", "subdivide", "--output", "a",
                        "--set", "size.target=1.2", "--set", "output.cell_quality=true")
        case = (self.folder / "a/case.toml").read_text()
        for line in ("target = 1.2", "parts = 2", 'kernel = "subdivide"', "cell_quality = true"):
            self.assertIn(line, case)
        self.assertEqual(len(list((self.folder / "a/mesh").iterdir())), 2)

    def test_every_kind_of_model(self):
        for name, size in (("sphere.geo", 0.5), ("plate_with_hole.stl", 3), ("frustum.iges", 2), ("cone.brep", 1)):
            with self.subTest(model=name):
                self.mesh_model(GEOMETRY / name, "--size", size, "--kernel", "subdivide")
                self.assertTrue((self.folder / "outputs" / name.split(".")[0] / "mesh.pvtu").exists())

    def test_what_is_within_the_tolerance_of_the_file_is_no_defect(self):
        text = (GEOMETRY / "cone.brep").read_text()
        sound = "1e-07\n8 -1.95943487863577e-15 0\n"
        self.assertIn(sound, text)
        # The rim's vertex is off the rim, and the file says that it is no more exact than that.
        self.write("loose.brep", text.replace(sound, "0.01\n8.003 0 0.002\n"))
        self.mesh_model("loose.brep", "--size", 1, "--kernel", "subdivide", "--output", "loose")
        report = json.loads((self.folder / "loose/report.json").read_text())
        self.assertEqual((report["status"], report["num_points_off_geometry"]), ("ok", 0))
        within = report["points_within_tolerance"]
        self.assertEqual(within["num"], 1)
        self.assertGreater(within["distance_max"], 1e-3)
        self.assertLess(within["distance_max"], 0.01)
        self.assertEqual(report["model_distance_max"], within["distance_max"])
        self.assertIn("within the tolerance", (self.folder / "loose/log/run.log").read_text())
        self.assertIn("within the tolerance", (self.folder / "loose/report.html").read_text())

    def test_what_does_not_fit(self):
        case = self.write_case()
        self.write("part.obj", "v 0 0 0\n")
        for arguments, words in (
            (["part.step"], ["part.step is a CAD model", "--size", "tessera info part.step"]),
            ([case, "--size", "1"], ["is a case file", "size.target"]),
            (["none.step", "--size", "1"], ["none.step", "no such file"]),
            (["part.obj", "--size", "1"], ["part.obj", ".step"]),
            (["part.step", "--size", "1", "--set", "size.min=2", "--set", "size.max=1"], ["size.min", "size.max"]),
            (["part.step", "--size", "1", "--set", "size.targe=1"], ["size.target"]),
        ):
            for ranks in (None, 2):
                with self.subTest(arguments=arguments, ranks=ranks):
                    outcome = self.run_program("mesh", *arguments, ranks=ranks)
                    self.assert_refused(outcome, WRONG_INPUT, *words)
        self.assertFalse((self.folder / "outputs").exists())


if __name__ == "__main__":
    unittest.main()
