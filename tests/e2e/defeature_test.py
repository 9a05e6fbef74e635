# SPDX-License-Identifier: BSD-3-Clause
"""size.min: small edges and narrow faces of a model are merged, and the report says which."""
import json
import unittest

import program
from program import NO_PAGE, WRONG_INPUT, sets

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
                case = self.case(name, "size.min = 0.01")
                one = self.mesh(case, "one", "--overwrite", *sets("output.report_html=true"))
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
                self.assertIn("was merged (size.min), 3 edges and 1 faces", log)
                self.assertIn(face["name"], log)
                self.assertIn("merged", (one / "report.html").read_text())

    def test_what_is_larger_stays_and_the_mesh_is_as_without(self):
        self.write("ledge.stl", ledge_stl().replace(str(STEP), "0.5"))
        case = self.case("ledge.stl", "fill.kernel = 'subdivide'")
        none = self.mesh(case, "none", *sets("size.min=0"))
        asked = self.mesh(case, "asked", *sets("size.min=0.01"))
        self.assertEqual(program.figures(none)["digest"], program.figures(asked)["digest"])
        self.assertNotIn("defeatured", program.figures(asked)["coarse"])

    def test_the_default_follows_the_target(self):
        """A twentieth of 0.25, or nothing."""
        self.write("ledge.stl", ledge_stl().replace(str(STEP), "0.01"))
        kernel = "fill.kernel = 'subdivide'\n"
        case = self.write("target.toml", f"geometry.file = 'ledge.stl'\nsize.target = 0.25\n{kernel}{NO_PAGE}")
        report, merged = self.merged(self.mesh(case, "default"))
        self.assertEqual((merged["tolerance"], merged["num_faces"]), (0.0125, 1))
        none = self.mesh(case, "none", *sets("size.min=0"))
        self.assertNotIn("defeatured", program.figures(none)["coarse"])
        self.assertGreater(program.figures(none)["num_tets"], report["num_tets"])

    def test_what_the_case_names_stays(self):
        """The step is a face of its own, and has a name or a size; else it would be merged."""
        names = "[[geometry.name]]\nname = 'step'\npatch = {{ faces = [{}] }}\n"
        step = self.mesh(self.case("ledge.stl", "size.min = 0.01"), "plain")
        number = program.figures(step)["coarse"]["defeatured"]["faces"][0]["number"]
        for lines in (names.format(number), f"[[size.region]]\npatch = '*_{number}'\nsize = 0.9\n"):
            with self.subTest(lines=lines):
                case = self.case("ledge.stl", "size.min = 0.01", lines)
                folder = self.mesh(case, "kept", "--overwrite")
                merged = program.figures(folder)["coarse"].get("defeatured", {"faces": []})
                self.assertNotIn(number, [face["number"] for face in merged["faces"]])

    def test_a_scaled_model_has_its_tolerance_in_output_units(self):
        case = self.case("ledge.stl", "size.min = 10.0", "geometry.scale = 1000.0", max_size=1000.0)
        report = json.loads((self.mesh(case, "mm") / "report.json").read_text())
        merged = report["coarse"]["defeatured"]
        self.assertEqual((report["status"], merged["num_faces"]), ("ok", 1))
        self.assertAlmostEqual(merged["faces"][0]["area"], 4e6 * STEP, places=3)

    def test_what_may_not_be_asked(self):
        for line, words in (
            ("size.min = -1", ["case.toml", "size.min = -1", "must be"]),
            ("size.min = 'x'", ["size.min", "must be"]),
            ("coarse.defeature = 0.1", ["case.toml", "coarse.defeature is size.min now"]),
        ):
            with self.subTest(line=line):
                case = self.case("ledge.stl", line)
                for ranks in (None, 2):
                    outcome = self.run_program("mesh", case, "--output", "no", ranks=ranks)
                    self.assert_refused(outcome, WRONG_INPUT, *words)


if __name__ == "__main__":
    unittest.main()
