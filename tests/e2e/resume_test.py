# SPDX-License-Identifier: BSD-3-Clause
"""What --resume refuses and why; a disk that is full, or would be."""
import json
import os
import shutil
import subprocess
import unittest

import kill
import program
from program import CANNOT_WRITE, OK, WRONG_INPUT

SUBDIVIDE = ("--set", "fill.kernel=subdivide")


class Refusals(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"
        self.case = self.write_case(subdomains=8, levels=4)

    def resume(self, *arguments, ranks=None):
        return self.run_program(
            "mesh", self.case, "--output", "out", *SUBDIVIDE, "--resume", *arguments, ranks=ranks
        )

    def stop_halfway(self):
        watch = kill.Watch(self.start("mesh", self.case, "--output", "out", *SUBDIVIDE), self.out)
        self.assertTrue(watch.wait_for_half_written_file("mesh"))
        watch.kill([watch.process.pid])

    def test_folder_without_a_run(self):
        for ranks in (None, 3):
            self.assert_refused(self.resume(ranks=ranks), WRONG_INPUT, "cannot resume", "no run has begun")
        self.assertFalse(self.out.exists())
        self.out.mkdir()
        self.assert_refused(self.resume(), WRONG_INPUT, "no run has begun")
        (self.out / "precious").touch()
        self.assert_refused(self.resume(), CANNOT_WRITE, "no Tessera run has used it")
        self.assertEqual(os.listdir(self.out), ["precious"])

    def test_changed_case(self):
        """The line is named; nothing is lost, the right case goes on."""
        self.stop_halfway()
        for ranks in (None, 3):
            outcome = self.resume("--set", "refine.levels=3", ranks=ranks)
            self.assert_refused(outcome, WRONG_INPUT, "`levels = 4` there, `levels = 3` now", "--overwrite")
        self.assertEqual(self.resume().code, OK)

    def test_limits_may_change(self):
        self.stop_halfway()
        outcome = self.resume("--set", "fill.timeout_s=500", "--set", "fill.memory_gib=2")
        self.assertEqual(outcome.code, OK, outcome.err)

    def test_changed_model(self):
        self.stop_halfway()
        self.write("ball.geo", program.BALL.replace("; 1)", "; 1.5)"))
        self.assert_refused(self.resume(ranks=3), WRONG_INPUT, "model file has changed", "--overwrite")
        self.write("ball.geo", program.BALL)
        self.assertEqual(self.resume().code, OK)

    def test_changed_model_of_a_finished_run(self):
        self.mesh(self.case, "out", *SUBDIVIDE)
        before = program.mesh_files(self.out), program.figures(self.out)
        self.write("ball.geo", program.BALL.replace("; 1)", "; 1.5)"))
        self.assert_refused(self.resume(), WRONG_INPUT, "model file has changed")
        self.assertEqual((program.mesh_files(self.out), program.figures(self.out)), before)

    def test_other_version(self):
        """Of a finished run the report names it."""
        self.mesh(self.case, "out", *SUBDIVIDE)
        report = json.loads((self.out / "report.json").read_text())
        report["version"] = "0.0.1"
        (self.out / "report.json").write_text(json.dumps(report))
        self.assert_refused(self.resume(), WRONG_INPUT, "begun by version 0.0.1")

    def test_other_subdomains(self):
        self.mesh(self.case, "out", *SUBDIVIDE, "--only-subdomains", "1,2")
        self.assert_refused(self.resume(), WRONG_INPUT, "--only-subdomains")
        self.assert_refused(self.resume("--only-subdomains", "2,3"), WRONG_INPUT, "--only-subdomains")
        self.assertEqual(self.resume("--only-subdomains", "1,2").code, OK)

    def test_finished_run(self):
        """Nothing to do; the exit code is that of the run."""
        target = ("--set", "quality.min_dihedral_deg=40")
        first = self.run_program("mesh", self.case, "--output", "out", *SUBDIVIDE, *target)
        self.assertEqual(first.code, program.DEGRADED)
        files = {file: file.stat().st_mtime_ns for file in self.out.glob("**/*.*vtu")}
        for ranks in (None, 3):
            outcome = self.resume(*target, ranks=ranks)
            self.assertEqual(outcome.code, program.DEGRADED, outcome.err)
            self.assertIn("nothing to do", outcome.out)
        self.assertEqual({file: file.stat().st_mtime_ns for file in files}, files)


class GivenTwice(program.ProgramTest):
    """The same command once more, without --resume and --overwrite."""

    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"
        self.case = self.write_case(levels=0)

    def mesh_again(self, *arguments, ranks=None):
        return self.run_program("mesh", self.case, "--output", "out", *arguments, ranks=ranks)

    def files(self):
        """All but the log, which goes on, and the lock."""
        files = (file for file in self.out.glob("**/*") if file.is_file() and file.parent.name != "log")
        return {file: file.stat().st_mtime_ns for file in files if file.name != ".tessera.lock"}

    def test_the_mesh_stays_and_its_exit_code_too(self):
        for target, code in (((), OK), (("--set", "quality.min_dihedral_deg=60"), program.DEGRADED)):
            first = self.mesh_again(*target, "--overwrite")
            self.assertEqual(first.code, code, first.err)
            num_tets = json.loads((self.out / "report.json").read_text())["num_tets"]
            files = self.files()
            self.assertIn(self.out / "mesh.pvtu", files)
            for ranks in (None, 3):
                again = self.mesh_again(*target, ranks=ranks)
                self.assertEqual(again.code, code, again.err)
                self.assertRegex(again.out, rf"nothing to do: the run in out has ended.* {num_tets} tets.*--overwrite")
                self.assertEqual("degraded" in again.out, code == program.DEGRADED)
                self.assertEqual(self.files(), files)

    def test_what_has_changed_is_refused(self):
        """Case, limits, what is made of it, model, version, pieces: a run of something else is in the way."""
        self.mesh(self.case, "out")
        files = self.files()
        for other in (("--set", "refine.levels=1"), ("--set", "fill.timeout_s=500"), ("--set", "output.report_html=true")):
            self.assert_refused(self.mesh_again(*other), CANNOT_WRITE, "not empty", "--overwrite")
        self.write("ball.geo", program.BALL.replace("; 1)", "; 1.5)"))
        for ranks in (None, 3):
            refused = self.mesh_again(ranks=ranks)
            self.assert_refused(refused, CANNOT_WRITE, "model file has changed", "--overwrite")
        self.write("ball.geo", program.BALL)
        self.assertEqual(self.files(), files)
        self.assertEqual(self.mesh_again().code, OK)
        piece = next(self.out.glob("mesh/*.vtu"))
        piece.rename(self.folder / "piece")
        self.assert_refused(self.mesh_again(), CANNOT_WRITE, "not empty", "--overwrite")
        (self.folder / "piece").rename(piece)
        report = json.loads((self.out / "report.json").read_text())
        (self.out / "report.json").write_text(json.dumps(report | {"version": "0.0.1"}))
        self.assert_refused(self.mesh_again(), CANNOT_WRITE, "begun by version 0.0.1", "--overwrite")


class Disk(program.ProgramTest):
    def test_too_little_space_is_seen_before_the_work(self):
        """10^11 tets, uncompressed, fit no disk that a test runs on."""
        case = self.write_case(max_size=0.25, subdomains=600, levels=9)
        for ranks in (None, 2):
            outcome = self.run_program(
                "mesh", case, "--output", "out", "--overwrite", *SUBDIVIDE,
                "--set", "output.compression=none", ranks=ranks,
            )  # fmt: skip
            self.assert_refused(outcome, CANNOT_WRITE, "GB are needed", "GB are free", "refine.levels")
            self.assertEqual(os.listdir(self.folder / "out" / "mesh"), [])

    @unittest.skipUnless(os.geteuid() == 0, "only root may mount a small disk")
    def test_disk_that_gets_full_is_resumable_on_a_larger_one(self):
        """The estimate sees the disk as large enough; then somebody else fills it."""
        disk = self.folder / "disk"
        disk.mkdir()
        mount = ["mount", "-t", "tmpfs", "-o", "size=40m", "tmpfs", disk]
        if subprocess.run(mount, capture_output=True, check=False).returncode != 0:
            self.skipTest("no right to mount")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        case = self.write_case(subdomains=8, levels=4)
        process = self.start("mesh", case, "--output", disk / "out", *SUBDIVIDE)
        watch = kill.Watch(process, disk / "out")
        self.assertTrue(watch.wait_for((disk / "out" / "pieces" / "plan.record").exists))
        filler = disk / "filler"
        with filler.open("wb") as file:
            os.posix_fallocate(file.fileno(), 0, shutil.disk_usage(disk).free - (4 << 20))
        outcome = self.finish(process)
        self.assert_refused(outcome, CANNOT_WRITE, "No space left on device")
        filler.unlink()
        outcome = self.run_program("mesh", case, "--output", disk / "out", *SUBDIVIDE, "--resume")
        self.assertEqual(outcome.code, OK, outcome.err)
        reference = self.mesh(case, "reference", *SUBDIVIDE)
        self.assertEqual(program.mesh_files(disk / "out"), program.mesh_files(reference))


if __name__ == "__main__":
    unittest.main()
