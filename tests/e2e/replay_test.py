# SPDX-License-Identifier: BSD-3-Clause
"""What a run leaves of jobs that failed, and that `tessera replay` runs just such a job again."""
import os
import pathlib
import shutil
import signal
import unittest

import program
from program import DEGRADED, FAILED, OK, WRONG_INPUT

FAULTY = 2  # Number of the subdomain.


def with_fault(kind):
    return os.environ | {"TESSERA_TEST_FAULT": f"fill={kind}@{FAULTY}"}


class Replay(program.ProgramTest):
    def mesh_with(self, kind, *arguments, output="out", ranks=None):
        outcome = self.run_program(
            "mesh", self.write_case(), "--output", output, "--progress", "never", *arguments,
            ranks=ranks, env=with_fault(kind)
        )  # fmt: skip
        self.assertEqual(outcome.code, DEGRADED, outcome.err)
        return self.folder / output

    def failed_jobs(self, output):
        return sorted(path.name for path in (output / "failure").glob("fill*"))

    def assert_is_kept(self, job, words, mesh):
        """With the words of the job, the mesh that it was about and the coarse mesh."""
        self.assertIn(words, (job / "log.txt").read_text())
        about = self.run_program("info", job / mesh)
        self.assertRegex(about.out, r"1 pieces, [1-9]\d+ cells, [1-9]\d+ points")
        coarse = self.run_program("check", job.parent / "coarse.vtu", "--partial")
        self.assertRegex(coarse.out, r"[1-9]\d+ tets")

    def test_degraded_run_keeps_every_try_that_failed(self):
        output = self.mesh_with("throw", ranks=2)
        self.assertEqual(
            self.failed_jobs(output),
            ["fill_subdomain_2", "fill_subdomain_2.2", "fill_subdomain_2.3", "fill_subdomain_2.4"],
        )
        self.assert_is_kept(output / "failure" / "fill_subdomain_2", "thrown for a test", "skin.vtu")

    def test_replay_repeats_the_failure_in_the_process_itself(self):
        job = self.mesh_with("throw") / "failure" / "fill_subdomain_2"
        again = self.run_program("replay", job, env=with_fault("throw"))
        self.assertEqual(again.code, FAILED, again.err)
        self.assertIn("thrown for a test", again.out)
        crashed = self.run_program("replay", job, env=with_fault("segv"))
        self.assertEqual(crashed.code, -signal.SIGSEGV, "a debugger would stop here")

    def test_replay_without_the_fault_succeeds_and_changes_nothing(self):
        output = self.mesh_with("segv")
        before = program.mesh_files(output)
        files = sorted(output.rglob("*"))
        for ranks in (None, 2):
            outcome = self.run_program("replay", output / "failure" / "fill_subdomain_2", ranks=ranks)
            self.assertEqual(outcome.code, OK, outcome.err)
            self.assertEqual(outcome.out.count("succeeded"), 1)
        self.assertEqual(program.mesh_files(output), before)
        self.assertEqual(sorted(output.rglob("*")), files)

    def test_failed_improvement_is_kept_though_the_run_ends_ok(self):
        fault = os.environ | {"TESSERA_TEST_FAULT": "improve=segv@1"}
        output = self.mesh(self.write_case(), "out", ranks=2, env=fault)
        self.assertEqual(program.figures(output)["improve"]["failed"], 1)
        self.assert_is_kept(output / "failure" / "improve_region_1", "Segmentation fault", "region.vtu")

    def test_improvement_is_replayed_without_the_pieces_of_the_run(self):
        for kind in ("throw", "drop"):
            with self.subTest(fault=kind):
                fault = os.environ | {"TESSERA_TEST_FAULT": f"improve={kind}@1"}
                output = self.mesh(self.write_case(), kind, env=fault)
                self.assertEqual(list((output / "pieces").glob("*")), [])
                files = sorted(output.rglob("*"))
                job = output / "failure" / "improve_region_1"
                again = self.run_program("replay", job, env=fault)
                self.assertEqual(again.code, FAILED, again.err)
                self.assertIn(again.out.split("failed: ")[1].strip(), (job / "log.txt").read_text())
                sound = self.run_program("replay", job, ranks=2)
                self.assertEqual(sound.code, OK, sound.err)
                self.assertIn("improve: region 1: succeeded", sound.out)
                self.assertEqual(sorted(output.rglob("*")), files)

    def test_sound_run_leaves_no_folder(self):
        self.assertFalse((self.mesh(self.write_case(), "sound") / "failure").exists())

    def test_refused_model_is_kept(self):
        self.write("open.stl", program.stl_text(program.CUBE_TRIANGLES[:-1]))
        outcome = self.run_program("mesh", self.write_case(geometry="open.stl"), "--output", "out")
        self.assertEqual(outcome.code, WRONG_INPUT)
        again = self.run_program("replay", self.folder / "out" / "failure" / "model")
        self.assertEqual(again.code, FAILED)
        self.assertIn("only one triangle at 3 edges", again.out)

    def test_symbolic_link_is_not_followed(self):
        case, elsewhere = self.write_case(), self.folder / "elsewhere"
        elsewhere.mkdir()
        too_short = ("mesh", case, "--output", "out", "--set", "coarse.timeout_s=0.2")
        endless = os.environ | {"TESSERA_TEST_FAULT": "coarse=loop remesh=loop"}
        self.assertEqual(self.run_program(*too_short, env=endless).code, FAILED)
        failure = self.folder / "out" / "failure"
        self.assertIn("CPU time", (failure / "coarse" / "log.txt").read_text())
        shutil.rmtree(failure)
        failure.symlink_to(elsewhere)
        outcome = self.run_program(*too_short, "--resume", env=endless)
        self.assertEqual(outcome.code, FAILED, outcome.err)
        self.assertIn("is a symbolic link", outcome.out)
        self.assertEqual(list(elsewhere.iterdir()), [])

    def test_name_with_spaces_and_umlauts(self):
        output = self.mesh_with("throw", output="mein Körper")
        outcome = self.run_program("replay", output / "failure" / "fill_subdomain_2")
        self.assertEqual(outcome.code, OK, outcome.err)

    def test_damaged_jobs_are_refused(self):
        job = self.mesh_with("throw") / "failure" / "fill_subdomain_2"
        for content in (b"", b"tessera", (job / "job.bin").read_bytes()[:-5]):
            (job / "job.bin").write_bytes(content)
            self.assert_refused(self.run_program("replay", job), WRONG_INPUT, "job.bin")
        missing = pathlib.Path("no such folder")
        self.assert_refused(self.run_program("replay", missing), WRONG_INPUT, missing, "DIR/failure")


if __name__ == "__main__":
    unittest.main()
