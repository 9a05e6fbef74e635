# SPDX-License-Identifier: BSD-3-Clause
"""STL files whose triangles bound no body: where they do not is shown, and a wrap is meshed if that is asked for."""
import unittest

import program
from program import DEGRADED, FAILED, OK, WRONG_INPUT, sets

WRAP = sets("geometry.repair=wrap", "geometry.wrap_tolerance=0.04")

# A second cube that cuts the first one.
SHIFT = (0.52, 0.44, 0.36)
CROSSING_VOLUME = 2 - (1 - 0.52) * (1 - 0.44) * (1 - 0.36)


def crossing_cubes():
    corners = [*program.CUBE_CORNERS, *(tuple(x + s for x, s in zip(p, SHIFT)) for p in program.CUBE_CORNERS)]
    second = [tuple(c + 8 for c in triangle) for triangle in program.CUBE_TRIANGLES]
    return program.stl_text([*program.CUBE_TRIANGLES, *second], corners)


class Wrap(program.ProgramTest):
    def write_model(self, text):
        self.write("model.stl", text)
        self.case = self.write_case(geometry="model.stl", max_size=0.4, subdomains=2)

    def wrap(self, output, ranks=None, code=DEGRADED, arguments=WRAP):
        outcome = self.run_program(
            "mesh", self.case, "--output", output, "--progress", "never", *arguments, ranks=ranks
        )
        self.assertEqual(outcome.code, code, outcome.err + outcome.out)
        self.said = outcome.out + outcome.err
        return program.figures(self.folder / output)

    def test_open_cube(self):
        self.write_model(program.stl_text(program.CUBE_TRIANGLES[1:]))
        report = self.wrap("one")
        wrap = report["model"]["wrap"]
        self.assertIn("not closed: only one triangle at 3 edges", wrap["reason"])
        self.assertAlmostEqual(wrap["tolerance"], 0.04)
        self.assertGreater(wrap["distance_max"], 0.01)  # The hole is closed by another surface.
        self.assertLess(wrap["distance_max"], 0.4)
        self.assertLess(wrap["file_distance_max"], 0.04)
        self.assertGreater(wrap["num_triangles"], 1000)
        self.assertEqual(report["repairs"]["wrapped_surface"], 1)
        self.assertTrue(any("wrap" in reason for reason in report["reasons"]), report["reasons"])
        self.assertIn(f"{wrap['distance_max']:.3g}", self.said)
        self.assertAlmostEqual(report["volume"], 1, delta=0.1)
        self.assert_checked(self.folder / "one", 1e-9)
        self.assertEqual(self.wrap("three", ranks=3), report)

    def test_lengths_are_those_of_the_output(self):
        self.write_model(program.stl_text(program.CUBE_TRIANGLES[1:]))
        wrap = self.wrap("one")["model"]["wrap"]
        scaled = self.wrap("ten", arguments=sets(
            "geometry.repair=wrap", "geometry.wrap_tolerance=0.4", "geometry.scale=10", "coarse.max_size=4"
        ))["model"]["wrap"]  # fmt: skip
        self.assertEqual(scaled["num_triangles"], wrap["num_triangles"])
        for key in ("tolerance", "distance_max", "file_distance_max"):
            self.assertAlmostEqual(scaled[key], 10 * wrap[key], delta=1e-9)

    def test_bodies_that_cross(self):
        self.write_model(crossing_cubes())
        report = self.wrap("out")
        self.assertIn("cuts itself", report["model"]["wrap"]["reason"])
        self.assertAlmostEqual(report["volume"], CROSSING_VOLUME, delta=0.01)
        self.assert_checked(self.folder / "out", 1e-9)

    def test_a_body_is_not_wrapped(self):
        self.write_model(program.stl_text(program.CUBE_TRIANGLES))
        report = self.wrap("out", code=OK)
        self.assertNotIn("wrap", report["model"])
        self.assertNotIn("wrapped_surface", report["repairs"])
        self.assertAlmostEqual(report["volume"], 1)

    def test_what_cannot_be_wrapped(self):
        self.write_model(program.stl_text(program.CUBE_TRIANGLES[1:]))
        too_small = sets("geometry.repair=wrap", "geometry.wrap_tolerance=1e-5")
        outcome = self.run_program("mesh", self.case, "--output", "small", *too_small)
        self.assert_refused(outcome, WRONG_INPUT, "geometry.wrap_tolerance of 1e-05", "give at least 0.00")
        alone = sets("geometry.wrap_tolerance=0.1")
        outcome = self.run_program("mesh", self.case, "--output", "alone", *alone)
        self.assert_refused(outcome, WRONG_INPUT, 'needs geometry.repair = "wrap"')
        step = program.CONFIGS / "geometry" / "cylinder.step"
        outcome = self.run_program("mesh", step, "--size", "1", "--output", "step", *sets("geometry.repair=wrap"))
        self.assert_refused(outcome, WRONG_INPUT, 'geometry.repair = "wrap" is for .stl', ".step")
        self.write_model(program.stl_text(program.CUBE_TRIANGLES[:2]))
        outcome = self.run_program("mesh", self.case, "--output", "sheet", *WRAP)
        self.assert_refused(outcome, WRONG_INPUT, "enclose nothing")


class Places(program.ProgramTest):
    def assert_shown(self, folder, array, words):
        self.assertIn(array.encode(), (folder / "places.vtu").read_bytes())
        self.assertEqual((folder / "places.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertIn(words, (folder / "places.html").read_text())

    def test_of_a_refused_file(self):
        self.write("model.stl", program.stl_text(program.CUBE_TRIANGLES[1:]))
        case = self.write_case(geometry="model.stl")
        outcome = self.run_program("mesh", case, "--output", "out", ranks=2)
        self.assert_refused(outcome, WRONG_INPUT, "only one triangle at 3 edges", 'geometry.repair = "wrap"')
        self.assert_shown(self.folder / "out" / "failure", "open_edges", "edges with one triangle: 3")

    def test_of_bodies_that_cross(self):
        self.write("model.stl", crossing_cubes())
        case = self.write_case(geometry="model.stl", max_size=0.5)
        outcome = self.run_program("mesh", case, "--output", "out")
        self.assert_refused(outcome, FAILED, 'geometry.repair = "wrap"')
        self.assert_shown(self.folder / "out" / "failure", "crossings", "pairs of triangles that cut each other")

    def test_page_of_info(self):
        self.write("model.stl", program.stl_text([*program.CUBE_TRIANGLES, (0, 1, 7)]))
        outcome = self.run_program("info", "model.stl", "--html", "page.html", "--picture", "page.png")
        self.assert_refused(outcome, WRONG_INPUT, "more than two triangles")
        page = (self.folder / "page.html").read_text()
        self.assertIn("edges with more than two triangles: 1", page)
        self.assertIn("one of the edges with more than two triangles", page)
        self.assertTrue((self.folder / "page.png").exists())

    def test_nothing_is_written_of_what_is_no_stl_file(self):
        self.write("model.stl", "not what it says\n" * 9)
        outcome = self.run_program("info", "model.stl", "--html", "page.html")
        self.assert_refused(outcome, WRONG_INPUT)
        self.assertFalse((self.folder / "page.html").exists())


if __name__ == "__main__":
    unittest.main()
