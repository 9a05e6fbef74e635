# SPDX-License-Identifier: BSD-3-Clause
"""coarse.defeature: small edges and narrow faces of a model are merged, and the report says which."""
import json
import unittest

import program
from program import WRONG_INPUT, sets

# A block whose upper half is narrower by 0.001.
STEP = 0.001
PROFILE = [(4, 0), (4, 3), (STEP, 3), (STEP, 1.5), (0, 1.5), (0, 0)]
VOLUME = 48.0


def ledge_stl():
    """The block as triangles: walls between two copies of the profile, and lids."""
    near = [(x, 0, z) for x, z in PROFILE]
    far = [(x, 4, z) for x, z in PROFILE]
    n = len(PROFILE)
    triangles = []
    for k in range(n):
        a, b = k, (k + 1) % n
        triangles += [(a, n + a, b), (b, n + a, n + b)]
    for k in range(1, n - 1):
        triangles += [(0, k, k + 1), (n, n + k + 1, n + k)]
    return program.stl_text(triangles, near + far)


class Defeature(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("ledge.stl", ledge_stl())

    def case(self, geometry, *lines, max_size=1.0, subdomains=4):
        case = self.write_case(geometry=geometry, max_size=max_size, subdomains=subdomains)
        case.write_text(case.read_text() + "".join(line + "\n" for line in lines))
        return case

    def merged(self, folder):
        report = json.loads((folder / "report.json").read_text())
        self.assertEqual((report["status"], report["num_points_off_geometry"]), ("ok", 0))
        self.assertAlmostEqual(report["volume"], VOLUME, delta=4 * 4 * 0.01)
        return report, report["coarse"]["defeatured"]

    def test_a_step_is_merged_named_and_sound_on_any_number_of_ranks(self):
        model = program.CONFIGS / "geometry" / "ledge.brep"
        for name in (model, "ledge.stl"):
            with self.subTest(model=name):
                case = self.case(name, "coarse.defeature = 0.01")
                one = self.mesh(case, "one", "--overwrite")
                three = self.mesh(case, "three", "--overwrite", ranks=3)
                self.assertEqual(program.mesh_files(one), program.mesh_files(three))
                self.assertEqual(program.figures(one), program.figures(three))
                report, merged = self.merged(one)
                self.assertEqual((merged["tolerance"], merged["num_faces"], merged["num_edges"]), (0.01, 1, 3))
                face = merged["faces"][0]
                self.assertAlmostEqual(face["area"], 4 * STEP)
                self.assertAlmostEqual(face["centre"][2], 1.5)
                self.assertTrue(face["name"])
                self.assertGreater(merged["num_vertices"], 0)
                self.assertLessEqual(merged["distance_max"], 0.01)
                self.assertGreater(report["quality"]["min_dihedral_deg"], 10)
                self.assertLess(report["num_tets"], 20000)
                self.assert_checked(one, 1e-9)
                log = (one / "log/run.log").read_text()
                self.assertIn("has merged 3 edges and 1 faces", log)
                self.assertIn(face["name"], log)
                self.assertIn("merged", (one / "report.html").read_text())

    def test_what_is_larger_stays_and_the_mesh_is_as_without(self):
        self.write("ledge.stl", ledge_stl().replace(str(STEP), "0.5"))
        case = self.case("ledge.stl", "fill.kernel = 'subdivide'")
        plain = self.mesh(case, "plain")
        asked = self.mesh(case, "asked", *sets("coarse.defeature=0.01"))
        self.assertEqual(program.figures(plain)["digest"], program.figures(asked)["digest"])
        self.assertNotIn("defeatured", program.figures(plain)["coarse"])
        self.assertEqual(program.figures(asked)["coarse"]["defeatured"]["num_faces"], 0)
        self.assertIn("as small as coarse.defeature", (asked / "log/run.log").read_text())

    def test_a_scaled_model_has_its_tolerance_in_output_units(self):
        case = self.case("ledge.stl", "coarse.defeature = 10.0", "geometry.scale = 1000.0", max_size=1000.0)
        report = json.loads((self.mesh(case, "mm") / "report.json").read_text())
        merged = report["coarse"]["defeatured"]
        self.assertEqual((report["status"], merged["num_faces"]), ("ok", 1))
        self.assertAlmostEqual(merged["faces"][0]["area"], 4e6 * STEP, places=3)

    def test_what_may_not_be_asked(self):
        self.write("mesh.vtu", "")
        for geometry, lines, words in (
            ("ledge.stl", ["coarse.defeature = -1"], ["case.toml", "coarse.defeature = -1", "must be"]),
            ("ledge.stl", ["coarse.defeature = 0.6"], ["case.toml", "coarse.defeature = 0.6", "at most 0.5"]),
            ("ledge.stl", ["coarse.defeature = 'x'"], ["coarse.defeature", "must be"]),
        ):
            with self.subTest(lines=lines):
                case = self.case(geometry, *lines)
                for ranks in (None, 2):
                    outcome = self.run_program("mesh", case, "--output", "no", ranks=ranks)
                    self.assert_refused(outcome, WRONG_INPUT, *words)
        target = self.write("target.toml", "geometry.file = 'ledge.stl'\nsize.target = 0.5\ncoarse.defeature = 2\n")
        outcome = self.run_program("mesh", target, "--output", "no")
        self.assert_refused(outcome, WRONG_INPUT, "coarse.defeature = 2", "half of coarse.max_size")
        own = self.write("own.toml", "geometry.file = 'mesh.vtu'\ncoarse.defeature = 0.1\n")
        outcome = self.run_program("mesh", own, "--output", "no")
        self.assert_refused(outcome, WRONG_INPUT, "coarse.defeature", "leave it out")


if __name__ == "__main__":
    unittest.main()
