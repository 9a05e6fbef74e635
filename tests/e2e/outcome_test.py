# SPDX-License-Identifier: BSD-3-Clause
"""Bad input ends in the documented exit code with one message, on any number of ranks, without a hang."""
import contextlib
import os
import resource
import shutil
import unittest

import program
from program import CANNOT_WRITE, FAILED, WRONG_INPUT

RANKS = (None, 3)  # The bare program, and three ranks under mpirun.

# A spline through a point that does not exist: NETGEN's parser reads wild memory and dies.
CRASHES_NETGEN = (
    "algebraic3d\ncurve2d c = (3; 0,0; 1,0; 0,1; 1; 2,1,100000000);\n"
    "solid s = extrusion (0,0,0; 0,0,1; c);\ntlo s;\n"
)
# Nothing is left of two balls far from each other.
EMPTY_MODEL = (
    "algebraic3d\nsolid nothing = sphere (0,0,0; 1) and sphere (9,0,0; 1);\ntlo nothing;\n"
)
# A cylinder with an axis of length 0 and a plane without a normal: no coarse size makes tets of it.
UNMESHABLE = (
    "algebraic3d\nsolid s = cylinder (0,0,0; 0,0,0; 1) and plane (0,0,0; 0,0,0);\ntlo s;\n"
)


class OutcomeTest(program.ProgramTest):
    def assert_refuses(self, arguments, code, *words, ranks=RANKS):
        """The same end for every number of ranks."""
        for number in ranks:
            with self.subTest(arguments=[str(a) for a in arguments], ranks=number):
                self.assert_refused(self.run_program(*arguments, ranks=number), code, *words)

    def assert_refuses_case(self, case, code, *words, ranks=RANKS):
        """The same, each run into a fresh folder."""
        for number in ranks:
            with self.subTest(case=case.read_text(), ranks=number):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                outcome = self.run_program("mesh", case, "--output", "out", ranks=number)
                self.assert_refused(outcome, code, *words)
                headline = outcome.messages[0].splitlines()[0]
                self.assertEqual(headline.count(words[0]), 1, "said more than once")


class WrongCommandLine(OutcomeTest):
    def test_wrong_command_lines(self):
        case = self.write_case()
        for arguments, words in (
            ([], ["command", "tessera --help"]),
            (["mash"], ["mash", "tessera --help"]),
            (["mesh"], ["CASE.toml", "tessera mesh --help"]),
            (["mesh", case, "--fast"], ["--fast", "tessera mesh --help"]),
            (["mesh", case, "--set"], ["--set", "TABLE.KEY=VALUE", "tessera mesh --help"]),
            (["mesh", case, "--set", "coarse.max_size"], ["--set coarse.max_size", "table.key=value"]),
            (["mesh", case, "--progress", "maybe"], ["--progress", "always", "never"]),
            (["mesh", case, "-q", "-v"], ["--quiet", "--verbose"]),
        ):
            self.assert_refuses(arguments, WRONG_INPUT, *words, ranks=[None])

    def test_on_every_rank(self):
        self.assert_refuses(["mash"], WRONG_INPUT, "mash", "--help", ranks=[3])


class WrongCase(OutcomeTest):
    def test_wrong_values(self):
        """Key, value and what is allowed are named."""
        case = self.write_case()
        for setting, words in (
            ("coarse.max_size=0", ["must be a number > 0"]),
            ("coarse.max_size=-1", ["must be a number > 0"]),
            ("coarse.max_size=nan", ["must be a number > 0"]),
            ("coarse.max_size=inf", ["must be a number > 0"]),
            ("coarse.max_size='big'", ["must be a number > 0"]),
            ("refine.levels=1.5", ["whole number"]),
            ("decompose.subdomains=0", ["whole number from 1"]),
            ("output.cell_quality=1", ["true or false"]),
            ("output.compression='gzip'", ["lz4"]),
            ("coarse.max_sise=1", ['did you mean "coarse.max_size"', "reference.toml"]),
        ):
            self.assert_refuses(
                ["mesh", case, "--set", setting], WRONG_INPUT, f"--set {setting}", *words, ranks=[None]
            )

    def test_unknown_key_in_the_file_is_named_with_its_line(self):
        case = self.write("case.toml", "[geometry]\nfile = 'a.geo'\n[coarse]\nmax_sise = 1\n")
        self.assert_refuses(
            ["mesh", case], WRONG_INPUT, "case.toml:4", "coarse.max_sise", "did you mean"
        )

    def test_broken_toml(self):
        case = self.write("case.toml", "[geometry\n")
        self.assert_refuses(["mesh", case], WRONG_INPUT, "case.toml:1", ranks=[None])

    def test_no_case_file(self):
        self.assert_refuses(["mesh", "none.toml"], WRONG_INPUT, "none.toml", "no such")
        self.assert_refuses(["mesh", "."], WRONG_INPUT, "is a folder", ranks=[None])

    def test_region_of_an_unknown_material(self):
        case = self.write_case()
        region = "[[fill.region]]\nmaterial = 'steel'\nkernel = 'subdivide'\n"
        case.write_text(case.read_text() + region)
        self.assert_refuses_case(case, WRONG_INPUT, "/ball.geo: fill.region", "steel", "ball")


class WrongModel(OutcomeTest):
    def assert_refuses_model(self, name, content, code, *words, ranks=RANKS):
        if content is not None:
            self.write(name, content)
        case = self.write_case(geometry=name)
        self.assert_refuses_case(case, code, f"/{name}:", *words, ranks=ranks)

    def test_missing_model(self):
        self.assert_refuses_model("none.geo", None, WRONG_INPUT, "no such file", "geometry.file")
        self.assertFalse((self.folder / "out").exists(), "in the way of the next try")

    def test_unknown_kind_of_model(self):
        self.assert_refuses_model("model.dwg", "x", WRONG_INPUT, ".step", ".stl", ranks=[None])

    @unittest.skipIf(os.geteuid() == 0, "root may read everything")
    def test_unreadable_model(self):
        self.write("closed.geo", program.BALL).chmod(0)
        self.assert_refuses_model("closed.geo", None, WRONG_INPUT, "permission")

    def test_folder_as_model(self):
        (self.folder / "model.geo").mkdir()
        self.assert_refuses_model("model.geo", None, WRONG_INPUT, "is a folder", ranks=[None])

    def test_empty_file(self):
        for name in ("model.geo", "model.stl", "model.step", "model.brep"):
            self.assert_refuses_model(name, "", WRONG_INPUT, "is empty", ranks=[None])

    def test_file_of_another_kind(self):
        for name in ("model.geo", "model.stl", "model.step", "model.iges", "model.brep"):
            self.assert_refuses_model(name, "not what it says\n" * 9, WRONG_INPUT, ranks=[None])

    def test_syntax_error(self):
        text = "algebraic3d\nsolid s = spere (0,0,0; 1);\ntlo s;\n"
        self.assert_refuses_model("model.geo", text, WRONG_INPUT, "line 2", "spere", ranks=[None])

    def test_empty_model(self):
        self.assert_refuses_model("model.geo", EMPTY_MODEL, WRONG_INPUT, "empty")
        self.assert_refuses_model("model.geo", "algebraic3d\n", WRONG_INPUT, "no solid", ranks=[None])

    def test_model_that_crashes_netgen(self):
        self.assert_refuses_model("model.geo", CRASHES_NETGEN, WRONG_INPUT, "signal 11", "repair it")

    def test_model_that_cannot_be_meshed(self):
        self.assert_refuses_model("model.geo", UNMESHABLE, FAILED, "coarse.max_size", "repair")

    def test_stl_with_a_hole(self):
        text = program.stl_text(program.CUBE_TRIANGLES[1:])
        self.assert_refuses_model("model.stl", text, WRONG_INPUT, "not closed", "3 edges")

    def test_stl_with_three_triangles_at_an_edge(self):
        text = program.stl_text([*program.CUBE_TRIANGLES, (0, 1, 7)])
        self.assert_refuses_model("model.stl", text, WRONG_INPUT, "more than two triangles", ranks=[None])

    def test_truncated_stl(self):
        plate = (program.CONFIGS / "geometry" / "plate_with_hole.stl").read_bytes()
        self.assert_refuses_model("model.stl", plate[:-7], WRONG_INPUT, "truncated", ranks=[None])

    def test_stl_with_a_bad_number(self):
        text = program.stl_text(program.CUBE_TRIANGLES).replace("vertex 1 1 1", "vertex 1 nan 1")
        self.assert_refuses_model("model.stl", text, WRONG_INPUT, "number", ranks=[None])

    def test_step_without_a_solid(self):
        cylinder = (program.CONFIGS / "geometry" / "cylinder.step").read_text()
        text = cylinder.replace("MANIFOLD_SOLID_BREP", "SHELL_BASED_SURFACE_MODEL")
        self.assertNotEqual(text, cylinder)
        self.assert_refuses_model("model.step", text, WRONG_INPUT)

    def test_truncated_step(self):
        text = (program.CONFIGS / "geometry" / "cylinder.step").read_text()
        self.assert_refuses_model("model.step", text[: len(text) // 2], WRONG_INPUT, "truncated", ranks=[None])


class RepairedModel(OutcomeTest):
    """What can be put right without a guess is, and the report says so."""

    def assert_repaired(self, triangles, *words):
        self.write("cube.stl", program.stl_text(triangles))
        case = self.write_case(geometry="cube.stl", max_size=1, subdomains=2)
        out = self.mesh(case, "out", ranks=3)
        report = (out / "report.json").read_text()
        for word in words:
            self.assertIn(word, report)

    def test_flipped_triangle(self):
        triangles = [tuple(reversed(program.CUBE_TRIANGLES[0])), *program.CUBE_TRIANGLES[1:]]
        self.assert_repaired(triangles, "1 triangle turned")

    def test_duplicate_triangle(self):
        self.assert_repaired([*program.CUBE_TRIANGLES, program.CUBE_TRIANGLES[5]], "1 repeated triangle dropped")


class CannotWrite(OutcomeTest):
    def test_output_folder_is_not_empty(self):
        case = self.write_case()
        self.write("precious", "")
        for arguments in ([], ["--overwrite"]):
            self.assert_refuses(
                ["mesh", case, "--output", ".", *arguments], CANNOT_WRITE, "not empty", "choose another"
            )
        self.assertTrue((self.folder / "precious").exists())
        self.assert_refuses(["mesh", case, "--output", ""], WRONG_INPUT, "--output", "empty", ranks=[None])

    def test_output_folder_of_another_run(self):
        case = self.write_case()
        self.mesh(case, "out")
        other = ["--set", "refine.levels=0"]
        self.assert_refuses(["mesh", case, "--output", "out", *other], CANNOT_WRITE, "not empty", "--overwrite")

    def test_output_folder_cannot_be_made(self):
        case = self.write_case()
        self.write("file", "")
        self.assert_refuses(["mesh", case, "--output", "file"], CANNOT_WRITE, "cannot make folder")
        self.assert_refuses(["mesh", case, "--output", "/proc/out"], CANNOT_WRITE, "/proc/out", ranks=[None])

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_output_folder_is_not_writable(self):
        case = self.write_case()
        (self.folder / "locked").mkdir(mode=0o555)
        self.assert_refuses(["mesh", case, "--output", "locked"], CANNOT_WRITE, "locked", "ermission")

    def test_output_folder_is_in_use(self):
        case = self.write_case()
        running = self.start("mesh", case, "--output", "out", env=os.environ | {"TESSERA_TEST_FAULT": "fill=sleep"})
        program.wait_until((self.folder / "out" / "log" / "run.log").exists, "the first run's log")
        self.assert_refuses(
            ["mesh", case, "--output", "out", "--overwrite"], CANNOT_WRITE, "in use by", f"process {running.pid}"
        )
        self.assertIsNone(running.poll())

    def limit_files(self, pid, num_bytes=20000):
        with contextlib.suppress(ProcessLookupError):  # A job that has ended.
            resource.prlimit(pid, resource.RLIMIT_FSIZE, (num_bytes, num_bytes))

    def limit_files_below(self, pid):
        """A process before what it has started: what it starts later inherits the limit."""
        for child in program.children(pid):
            self.limit_files(child)
            self.limit_files_below(child)

    def assert_reports_full_disk(self, ranks, limit, file, *arguments):
        """`limit`: of a rank process, or of those that its jobs come from. It is set while the fills are held."""
        case = self.write_case(max_size=0.2, levels=2)
        self.write("hold", "")
        env = os.environ | {"TESSERA_TEST_FAULT": "fill=hold"}
        process = self.start("mesh", case, "--output", "out", *arguments, ranks=ranks, env=env)
        program.wait_until((self.folder / "out" / "pieces" / "plan.record").exists, "the plan")
        for rank in [process.pid] if ranks is None else program.ranks_of(process):
            limit(rank)
        (self.folder / "hold").unlink()
        self.assert_refused(self.finish(process), CANNOT_WRITE, f"cannot write out/{file}", "File too large")
        self.assertFalse((self.folder / "out" / "mesh.pvtu").exists())
        # A job of another rank, cancelled while it was writing, leaves its file to --resume.
        half_written = list((self.folder / "out").glob("*/*.tmp-*"))
        self.assertLess(len(half_written), ranks or 1, half_written)

    def test_disk_full_when_a_job_ends(self):
        for ranks in RANKS:
            with self.subTest(ranks=ranks):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                self.assert_reports_full_disk(ranks, self.limit_files_below, "pieces/piece_")

    def test_disk_full_when_seams_are_improved(self):
        for ranks in RANKS:
            with self.subTest(ranks=ranks):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                self.assert_reports_full_disk(ranks, self.limit_files, "pieces/log_")

    def test_disk_full_when_the_mesh_is_written(self):
        for ranks in RANKS:
            with self.subTest(ranks=ranks):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                self.assert_reports_full_disk(ranks, self.limit_files, "mesh/piece_", "--set", "improve.seams=false")


class WrongMesh(OutcomeTest):
    def test_garbage(self):
        self.write("garbage.pvtu", os.urandom(5000))
        self.assert_refuses(["check", "garbage.pvtu"], WRONG_INPUT, "garbage.pvtu")
        self.write("empty.vtu", "")
        self.assert_refuses(["check", "empty.vtu"], WRONG_INPUT, "empty.vtu", ranks=[None])
        self.assert_refuses(["check", "none.pvtu"], WRONG_INPUT, "none.pvtu")
        self.assert_refuses(["info", "none.step"], WRONG_INPUT, "none.step", ranks=[None])
        self.assert_refuses(["info", "none.xyz"], WRONG_INPUT, "none.xyz: no such file", ranks=[None])

    def test_truncated_piece(self):
        out = self.mesh(self.write_case(subdomains=2), "out")
        piece = out / "mesh" / "piece_000001.vtu"
        content = piece.read_bytes()
        for size in (100, len(content) // 2, len(content) - 40):
            piece.write_bytes(content[:size])
            self.assert_refuses(["check", "out/mesh.pvtu"], WRONG_INPUT, "piece_000001.vtu", ranks=[None])
        self.assert_refuses(["check", "out/mesh.pvtu"], WRONG_INPUT, "piece_000001.vtu", ranks=[3])


if __name__ == "__main__":
    unittest.main()
