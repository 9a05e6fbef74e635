# SPDX-License-Identifier: BSD-3-Clause
"""A run that was killed at any moment ends, with --resume, with the bits of one that never was."""
import shutil
import signal
import unittest

import kill
import program
from program import OK

ONE_PASS_STAGES = tuple(stage for stage in kill.STAGES if stage != "write")

# Nothing of a one-pass run is left to be stopped after these.
LONG_ONE_PASS_STAGES = ONE_PASS_STAGES[:-1]


# On a busy machine a moment of some milliseconds can be missed; then the same is tried again.
TRIES = 5


class RestartTest(program.ProgramTest):
    """`make_arguments(maker)` says what is meshed; `reference` is the result of a run that was not disturbed."""

    @classmethod
    def setUpClass(cls):
        maker = program.ProgramTest()
        maker.setUp()
        cls.addClassCleanup(maker.doCleanups)
        cls.arguments = cls.make_arguments(maker)
        cls.reference = maker.mesh(cls.arguments[0], "reference", *cls.arguments[1:], ranks=2)

    def setUp(self):
        super().setUp()
        self.out = self.folder / "out"

    def start_run(self, ranks=None):
        shutil.rmtree(self.out, ignore_errors=True)
        process = self.start(
            "mesh", *self.arguments, "--output", "out", "--progress", "never", ranks=ranks
        )
        return kill.Watch(process, self.out)

    def kill_run(self, moment, kind="all", ranks=None):
        """Starts a run and kills the processes at the moment that `moment(watch)` waits for."""
        for _ in range(TRIES):
            watch = self.start_run(ranks)
            program.wait_until(lambda: watch.log.exists() or watch.has_ended(), "the log")
            victims = watch.victims(kind, which=1)
            if moment(watch) and watch.kill(victims) != OK and not (self.out / "mesh.pvtu").exists():
                return
        self.fail(f"{TRIES} runs have ended before they could be killed")

    def resume(self, ranks=None):
        """Compares the end with the reference; the output of the resumed run."""
        outcome = self.run_program(
            "mesh", *self.arguments, "--output", "out", "--progress", "never", "--resume", ranks=ranks
        )
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual(program.figures(self.out), program.figures(self.reference))
        self.assertEqual(program.mesh_files(self.out), program.mesh_files(self.reference))
        self.assertFalse((self.out / "pieces").exists())
        return outcome.out

    def assert_signal_is_resumable(self, number, stage, stages):
        for _ in range(TRIES):
            watch = self.start_run()
            if watch.wait_for_stage(stage, stages):
                watch.process.send_signal(number)
            outcome = self.finish(watch.process)
            if outcome.code != OK:
                break
        self.assert_refused(outcome, program.STOPPED, "stopped by a signal")
        self.resume()

    def record(self, name):
        return self.out / "pieces" / f"{name}.record"

    def has_pieces(self, number):
        """A moment: when there are so many finished pieces."""
        return lambda watch: watch.wait_for(lambda: len(list(self.out.glob("pieces/piece_*.record"))) >= number)


class OnePass(RestartTest):
    """Jobs write the files themselves."""

    @staticmethod
    def make_arguments(maker):
        return [maker.write_case(subdomains=8, levels=4), "--set", "fill.kernel=subdivide"]

    def test_all_killed_while_a_file_is_written(self):
        self.kill_run(lambda watch: watch.wait_for_half_written_file("mesh"), ranks=2)
        self.resume(ranks=3)

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
        for names in (("coarse", "plan"), ("run",)):
            with self.subTest(records=names):
                self.kill_run(self.has_pieces(2))
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


class Netgen(RestartTest):
    """Pieces wait in the store until all are there."""

    @staticmethod
    def make_arguments(maker):
        return [maker.write_case(max_size=0.5, subdomains=8, levels=2)]

    def test_rank_killed_while_filling(self):
        self.kill_run(self.has_pieces(2), "rank", ranks=2)
        self.resume(ranks=3)

    def test_model_zygote_killed_while_filling(self):
        """It takes what it had loaded with it: the run ends."""
        self.kill_run(lambda watch: watch.wait_for_stage("fill"), "model zygote", ranks=2)
        self.resume()

    def test_all_killed_in_the_coarse_mesh(self):
        self.kill_run(lambda watch: watch.wait_for_stage("coarse"), ranks=2)
        self.resume(ranks=2)

    def test_all_killed_while_the_mesh_is_written(self):
        self.kill_run(lambda watch: watch.wait_for_half_written_file("mesh"), ranks=2)
        out = self.resume(ranks=2)
        self.assertNotRegex(out, r"(?m)^(coarse|decompose|plan) ", "stages that were done")

    def test_signals_while_the_mesh_is_written(self):
        for number in (signal.SIGTERM, signal.SIGUSR1):
            self.assert_signal_is_resumable(number, "write", kill.STAGES)


class PoorPiece(RestartTest):
    """NETGEN gets a second try at a piece with a small angle: the first one is not the last word."""

    @staticmethod
    def make_arguments(maker):
        core = program.CONFIGS / "geometry" / "core.geo"
        return [maker.write_case(geometry=core, max_size=2.5, subdomains=30, levels=1)]

    def test_killed_between_two_tries(self):
        tries = {s["id"]: s["tries"] for s in program.figures(self.reference)["subdomains"]}
        poor = next(s for s, number in tries.items() if number == 2)
        record = self.record(f"piece_{poor:06}")
        self.kill_run(lambda watch: watch.wait_for(record.exists))
        killed = (self.out / "log" / "run.log").read_text()
        self.resume()
        self.assertNotIn(f"fill: subdomain {poor}: try 2", killed, "the kill came too late")


def flip_byte(file):
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes(content)


if __name__ == "__main__":
    unittest.main()
