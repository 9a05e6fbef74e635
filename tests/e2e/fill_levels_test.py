# SPDX-License-Identifier: BSD-3-Clause
"""fill.levels: subdomains are filled on some levels and split for the others. The result is one mesh, better than
subdivision, with the same bits for any number of ranks and after any interruption."""
import json
import os
import signal
import re
import unittest

import kill
import program
from program import DEGRADED, FAILED, OK, sets

OPTIMIZE = "fill.kernel=optimize"


class FillLevelsTest(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("core.geo", program.TWO_MATERIALS)
        self.case = self.write_case(geometry="core.geo", max_size=1.0, subdomains=6, levels=2)

    def made(self, folder, *values, case=None, ranks=None):
        return self.mesh(case or self.case, folder, *sets(*values), ranks=ranks)

    def checked(self, folder):
        """Its figures; `check` finds the same in the files, and nothing wrong."""
        figures = program.figures(folder)
        outcome = self.run_program("check", folder / "mesh.pvtu", "--json")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        found = json.loads(outcome.out)
        self.assertEqual(found["digest"], figures["digest"])
        for key in ("num_tets", "num_vertices"):
            self.assertEqual(found[key], figures[key], key)
        for key in ("volume", "boundary_area"):
            self.assertAlmostEqual(found[key], figures[key], delta=1e-9 * figures[key])
        return figures

    def assert_is_split(self, figures, levels):
        """Every tet of a filled piece has become 8^levels."""
        for piece in figures["subdomains"]:
            self.assertGreater(piece["tets"], 0)
            self.assertEqual(piece["tets"] % 8**levels, 0)


class AnyNumberOfRanks(FillLevelsTest):
    def test_has_the_same_bits(self):
        for kernel, others in (("optimize", (2, 3, 5)), ("netgen", (3,))):
            with self.subTest(kernel=kernel):
                arguments = (f"fill.kernel={kernel}", "fill.levels=1")
                alone = self.made(kernel, *arguments, ranks=None)
                figures = self.checked(alone)
                self.assert_is_split(figures, 1)
                self.assertGreater(figures["improve"]["improved"], 0)
                for ranks in others:
                    other = self.made(f"{kernel}_{ranks}", *arguments, ranks=ranks)
                    self.assertEqual(program.figures(other), figures)
                    self.assertEqual(program.mesh_files(other), program.mesh_files(alone))


class Cases(FillLevelsTest):
    """Three materials; a periodic STEP model; a ball whose coarse tets are large beside its curvature."""

    def assert_conforms(self, name, fill_levels, *values):
        folder = f"{name}_{fill_levels}"
        case = program.CONFIGS / "cases" / f"{name}.toml"
        levels = ("refine.levels=3", f"fill.levels={fill_levels}", "output.report_html=false")
        out = self.made(folder, *levels, *values, case=case)
        figures = self.checked(out)
        self.assert_is_split(figures, 2 if fill_levels == 1 else 1)
        return figures

    def test_core(self):
        small = ("coarse.max_size=6", "decompose.subdomains=9")
        one = self.assert_conforms("core", 1, OPTIMIZE, *small)
        two = self.assert_conforms("core", 2, *small)
        self.assertEqual(len({piece["material"] for piece in two["subdomains"]}), 3)
        self.assertAlmostEqual(one["volume"], two["volume"], delta=1e-9 * two["volume"])
        self.assertAlmostEqual(one["boundary_area"], two["boundary_area"], delta=1e-9)

    def test_torus(self):
        small = ("coarse.max_size=8", "coarse.curvature=1", "decompose.subdomains=5")
        self.assert_conforms("torus", 1, OPTIMIZE, *small)
        self.assert_conforms("torus", 2, *small)

    def test_sphere(self):
        """Automatically two levels are filled on, where there are three."""
        self.assert_conforms("sphere", 1, "coarse.max_size=1")
        two = self.assert_conforms("sphere", 2, OPTIMIZE, "coarse.max_size=1")
        auto = self.assert_conforms("sphere", "auto", OPTIMIZE, "coarse.max_size=1")
        self.assertEqual(auto["digest"], two["digest"])


# A thin can, so coarse that surfaces lie far from its tets.
CAN = (
    "algebraic3d\n"
    "solid hole = cylinder (0, 0, -5; 0, 0, 5; 5) and plane (0, 0, -3; 0, 0, -1) and plane (0, 0, 3; 0, 0, 1);\n"
    "solid all = cylinder (0, 0, -5; 0, 0, 5; 6) and plane (0, 0, -2; 0, 0, -1) and plane (0, 0, 2; 0, 0, 1);\n"
    "solid can = all and not hole;\ntlo can;\n"
)


class Folds(FillLevelsTest):
    """Children of filled tets that fold on finer levels, whatever is smoothed."""

    def setUp(self):
        super().setUp()
        self.write("can.geo", CAN)
        self.case = self.write_case("can.toml", geometry="can.geo", max_size=10, subdomains=6)

    def meshed(self, folder, levels, code, ranks=None):
        values = ("coarse.curvature=0.6", "coarse.grading=0.3", OPTIMIZE, "fill.levels=1", f"refine.levels={levels}")
        outcome = self.run_program(
            "mesh", self.case, "--output", folder, "--progress", "never", *sets(*values), ranks=ranks
        )
        self.assertEqual(outcome.code, code, outcome.err)
        self.assertEqual("kept off the geometry" in outcome.out, code == DEGRADED, outcome.out)
        return self.folder / folder

    def test_points_are_held_back_until_no_tet_is_folded(self):
        self.meshed("filled", 1, OK)
        split = self.meshed("split", 3, DEGRADED)
        figures = self.checked(split)
        self.assertGreater(figures["num_points_off_geometry"], 0)
        self.assert_is_split(figures, 2)
        other = self.meshed("other", 3, DEGRADED, ranks=3)
        self.assertEqual(program.figures(other), figures)
        self.assertEqual(program.mesh_files(other), program.mesh_files(split))


class Options(FillLevelsTest):
    def test_all_levels_are_filled_on_if_there_are_no_more(self):
        plain = self.made("plain", OPTIMIZE)
        for levels in (3, "auto"):
            other = self.made(f"levels_{levels}", OPTIMIZE, f"fill.levels={levels}")
            self.assertEqual(program.mesh_files(other), program.mesh_files(plain))
        subdivided = self.made("subdivided", "fill.kernel=subdivide")
        other = self.made("other", "fill.kernel=subdivide", "fill.levels=1")
        self.assertEqual(program.mesh_files(other), program.mesh_files(subdivided))

    def test_better_than_subdivision_with_the_same_surface(self):
        children = self.checked(self.made("children", "fill.kernel=subdivide"))
        split = self.checked(self.made("split", OPTIMIZE, "fill.levels=1"))
        for key in ("mean", "p01"):
            self.assertGreater(split["quality"]["mean_ratio"][key], children["quality"]["mean_ratio"][key])
        self.assertAlmostEqual(split["volume"], children["volume"], delta=1e-9 * children["volume"])
        self.assertAlmostEqual(split["boundary_area"], children["boundary_area"], delta=1e-9)

    def test_beside_a_material_that_is_subdivided(self):
        for kernel in ("optimize", "netgen"):
            with self.subTest(kernel=kernel):
                region = 'fill.region=[{material="core",kernel="subdivide"}]'
                figures = self.checked(self.made(kernel, f"fill.kernel={kernel}", "fill.levels=1", region))
                kernels = {(piece["material"], piece["kernel"]) for piece in figures["subdomains"]}
                self.assertEqual({kernel for _, kernel in kernels}, {kernel, "subdivide"})
                self.assertEqual(len(kernels), 2)
                self.assert_is_split(figures, 1)

    def test_without_seams_or_their_improvement(self):
        self.assert_is_split(
            self.checked(self.made("unimproved", OPTIMIZE, "fill.levels=1", "improve.seams=false")), 1
        )
        ball = self.write_case("ball.toml", max_size=0.6, subdomains=1, levels=2)
        figures = self.checked(self.made("one", OPTIMIZE, "fill.levels=1", case=ball))
        self.assertEqual(len(figures["subdomains"]), 1)

    def test_files_of_several_pieces_hold_the_same_mesh(self):
        plain = self.made("plain", OPTIMIZE, "fill.levels=1")
        files = self.made("files", OPTIMIZE, "fill.levels=1", "output.files=2", ranks=3)
        self.assertEqual(self.checked(files), program.figures(plain))
        self.assertEqual(len(list((files / "mesh").iterdir())), 2)
        parts = self.made("parts", OPTIMIZE, "fill.levels=1", "output.parts=3")
        figures = self.checked(parts)
        self.assertEqual(sum(figures["parts"]["tets"]), figures["num_tets"])
        self.assertEqual(len(list((parts / "mesh").iterdir())), 3)
        again = self.made("again", OPTIMIZE, "fill.levels=1", "output.parts=3", ranks=None)
        self.assertEqual(program.mesh_files(again), program.mesh_files(parts))

    def test_a_dry_run_foretells_the_mesh(self):
        case = self.write_case(max_size=0.4, subdomains=10, levels=3)
        arguments = sets(OPTIMIZE, "fill.levels=2")
        outcome = self.run_program("mesh", case, "--dry-run", "--output", "out", *arguments)
        self.assertEqual(outcome.code, OK, outcome.err)
        out = self.mesh(case, "out", *arguments, ranks=2)
        compared = json.loads((out / "report.json").read_text())["prediction"]
        self.assertLess(abs(compared["tets"]["error"]), 0.1)
        self.assertEqual(compared["boundary_triangles"]["error"], 0)
        self.assertEqual(compared["files"]["error"], 0)


def with_fault(fault):
    return os.environ | {"TESSERA_TEST_FAULT": fault}


class Faults(FillLevelsTest):
    """One of six subdomains is number 3."""

    arguments = sets("fill.kernel=optimize", "fill.levels=1")

    def test_subdomain_that_no_kernel_could_fill_is_split_as_well(self):
        netgen = sets("fill.levels=1")
        outcome = self.run_program(
            "mesh", self.case, "--output", "out", *netgen, ranks=2, env=with_fault("fill=throw@3")
        )
        self.assertEqual(outcome.code, DEGRADED, outcome.err)
        figures = self.checked(self.folder / "out")
        self.assertEqual([piece["id"] for piece in figures["subdomains"] if piece["kernel"] == "subdivide"], [3])
        self.assert_is_split(figures, 1)

    def test_split_that_fails_ends_the_run(self):
        """With the cause; it goes on where it ended."""
        reference = self.made("reference", OPTIMIZE, "fill.levels=1")
        causes = {"segv": "signal 11", "garbage": "cannot be used"}
        for kind, cause in causes.items():
            with self.subTest(kind=kind):
                outcome = self.run_program(
                    "mesh", self.case, "--output", kind, *self.arguments, ranks=2,
                    env=with_fault(f"refine={kind}@3")
                )  # fmt: skip
                self.assert_refused(outcome, FAILED, "subdomain 3", cause, "fill.levels")
                out = self.folder / kind
                self.assertFalse((out / "mesh.pvtu").exists())
                self.assertIn(cause, (out / "failure" / "refine_subdomain_3" / "log.txt").read_text())
                self.mesh(self.case, kind, *self.arguments, "--resume", ranks=3)
                self.assertEqual(program.mesh_files(out), program.mesh_files(reference))
                self.assertFalse((out / "failure").exists())

    def test_split_is_replayed_and_changes_nothing(self):
        fault = with_fault("refine=throw@3")
        outcome = self.run_program("mesh", self.case, "--output", "out", *self.arguments, env=fault)
        self.assertEqual(outcome.code, FAILED, outcome.err)
        before = self.contents()
        job = self.folder / "out" / "failure" / "refine_subdomain_3"
        again = self.run_program("replay", job, env=fault)
        self.assertEqual(again.code, FAILED, again.err)
        self.assertIn("thrown for a test", again.out)
        crashed = self.run_program("replay", job, env=with_fault("refine=segv@3"))
        self.assertEqual(crashed.code, -signal.SIGSEGV, "a debugger would stop here")
        sound = self.run_program("replay", job, ranks=2)
        self.assertEqual(sound.code, OK, sound.err)
        self.assertIn("refine: subdomain 3: succeeded", sound.out)
        self.assertEqual(self.contents(), before)

    def contents(self):
        """Of all files of the run."""
        out = self.folder / "out"
        return {file: file.read_bytes() for file in out.rglob("*") if file.is_file()}


class Killed(kill.RestartTest):
    """While pieces are split: the jobs write the files themselves."""

    STAGES = (*kill.STAGES[:-1], "refine")  # Then verified again.

    @staticmethod
    def make_arguments(maker):
        case = maker.write_case(max_size=0.6, subdomains=8, levels=4)
        return [case, *sets(OPTIMIZE, "fill.levels=1")]

    def has_split(self, number):
        return lambda watch: watch.wait_for(
            lambda: sum(re.fullmatch(r"refined_\d+\.record", name) is not None
                        for name in kill.names_in(self.out / "pieces")) >= number
        )

    def test_when_the_stage_begins(self):
        self.kill_run(lambda watch: watch.wait_for_stage("refine", self.STAGES), kind="rank", ranks=2)
        self.resume()

    def test_pieces_that_were_split_are_not_made_again(self):
        self.kill_run(self.has_split(3), ranks=2)
        split = {file.stem.replace("refined", "piece") for file in (self.out / "pieces").glob("refined_*.record")}
        files = [self.out / "mesh" / f"{name}.vtu" for name in split]
        times = {file: file.stat().st_mtime_ns for file in files}
        self.assertGreaterEqual(len(times), 3)
        out = self.resume(ranks=3)
        self.assertEqual({file: file.stat().st_mtime_ns for file in files}, times)
        self.assertNotRegex(out, r"(?m)^(coarse|decompose|plan) ")

    def test_while_a_file_is_written(self):
        self.kill_run(lambda watch: watch.wait_for_half_written_file("mesh"), ranks=2)
        self.resume()

    def test_pieces_that_are_damaged_are_made_again(self):
        self.kill_run(self.has_split(3))
        first, second, third = sorted((self.out / "pieces").glob("refined_*.record"))[:3]
        first.write_bytes(first.read_bytes()[:-5])
        for record, folder in ((second, "mesh"), (third, "boundary")):
            file = self.out / folder / record.with_suffix(".vtu").name.replace("refined", "piece")
            file.write_bytes(file.read_bytes()[:-5])
        self.resume()

    def test_signal(self):
        self.assert_signal_is_resumable(signal.SIGTERM, "refine", self.STAGES)


if __name__ == "__main__":
    unittest.main()
