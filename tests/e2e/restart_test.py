# SPDX-License-Identifier: BSD-3-Clause
"""A one-pass run that was killed or stopped at any moment ends, with --resume, with the bits of one that never was."""
import contextlib
import os
import shutil
import signal
import unittest

import kill
import program

ONE_PASS_STAGES = tuple(stage for stage in kill.STAGES if stage not in ("improve", "write"))

# Nothing of a one-pass run is left to be stopped after these.
LONG_ONE_PASS_STAGES = ONE_PASS_STAGES[:-1]


class OnePass(kill.RestartTest):
    """Jobs write the files themselves."""

    @staticmethod
    def make_arguments(maker):
        return [maker.write_case(subdomains=8, levels=4), "--set", "fill.kernel=subdivide"]

    def test_all_killed_while_a_file_is_written(self):
        self.kill_run(lambda watch: watch.wait_for_half_written_file("mesh"), ranks=2)
        self.resume(ranks=3)

    def test_job_killed_while_it_writes(self):
        """The run goes on by itself, and leaves no half-written file."""
        for _ in range(kill.TRIES):
            watch = self.start_run()
            self.assertTrue(watch.wait_for_half_written_file("mesh"))
            with contextlib.suppress(OSError, StopIteration):  # The file has got its name meanwhile.
                half_written = next(self.out.glob("mesh/*.tmp-*"))
                os.kill(int(half_written.name.split("-")[-2]), signal.SIGKILL)
            outcome = self.finish(watch.process)
            self.assertEqual(outcome.code, program.OK, outcome.err)
            self.assertEqual(program.mesh_files(self.out), program.mesh_files(self.reference))
            if "done again: ended by signal 9" in outcome.out:
                return
        self.fail("no job could be killed while it wrote")

    def test_finished_pieces_are_not_made_again(self):
        self.kill_run(self.has_pieces(3))
        finished = {file: file.stat().st_mtime_ns for file in self.out.glob("mesh/*.vtu")
                    if self.record(file.stem).exists()}
        self.assertGreaterEqual(len(finished), 3)
        out = self.resume()
        self.assertEqual({file: file.stat().st_mtime_ns for file in finished}, finished)
        self.assertNotRegex(out, r"(?m)^(coarse|decompose|plan) ")

    def test_damaged_pieces_are_made_again(self):
        """A flipped byte in a record, in a piece, in a boundary; and a piece that is gone."""
        self.kill_run(self.has_pieces(5))
        names = [f"piece_{s:06}" for s in range(8) if self.record(f"piece_{s:06}").exists()]
        flip_byte(self.record(names[0]))
        flip_byte(self.out / "mesh" / f"{names[1]}.vtu")
        flip_byte(self.out / "boundary" / f"{names[2]}.vtu")
        (self.out / "mesh" / f"{names[3]}.vtu").unlink()
        self.resume()

    def test_damaged_records_of_the_stages_before_are_made_again(self):
        self.kill_run(self.has_pieces(2))
        for names in self.from_here((("coarse", "plan"), ("run",))):
            with self.subTest(records=names):
                for name in names:
                    flip_byte(self.record(name))
                self.resume()

    def test_killed_before_anything_was_done(self):
        (self.out / "log").mkdir(parents=True)
        (self.out / ".tessera.lock").write_text("")
        self.resume()

    def test_killed_while_an_old_run_is_removed(self):
        """The old report is the first to go, so nobody takes what is left for a finished run."""
        shutil.copytree(self.reference, self.out)
        (self.out / "report.json").unlink()
        (self.out / "mesh" / "piece_000002.vtu").unlink()
        self.resume()

    def test_signals_in_every_stage(self):
        for number, stage in zip((signal.SIGTERM, signal.SIGUSR1) * 3, LONG_ONE_PASS_STAGES):
            with self.subTest(stage=stage):
                self.assert_signal_is_resumable(number, stage, ONE_PASS_STAGES)


def flip_byte(file):
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)


if __name__ == "__main__":
    unittest.main()
