# SPDX-License-Identifier: BSD-3-Clause
"""The same for a run of NETGEN, whose pieces wait in the store until all are there."""
import contextlib
import os
import signal
import unittest

import kill
import program


class Netgen(kill.RestartTest):
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

    def test_coarse_job_killed(self):
        """The same is tried again: a finer coarse mesh, the next fallback, would be another mesh."""
        case = self.write_case(max_size=0.13, levels=0)
        # With a limit of its own no job measures the model for one: the surface's is the first.
        self.arguments = [case, "--set", "coarse.timeout_s=300"]
        reference = self.mesh(case, "undisturbed", *self.arguments[1:])
        watch = self.start_run()
        self.assertTrue(watch.wait_for_stage("coarse"))
        os.kill(watch.victims("job")[0], signal.SIGKILL)
        outcome = self.finish(watch.process)
        self.assertEqual(outcome.code, program.OK, outcome.err)
        self.assertRegex(outcome.out, "warning: coarse: done again: .*Killed.* from outside")
        self.assertEqual(program.mesh_files(self.out), program.mesh_files(reference))

    def test_all_killed_in_the_coarse_mesh(self):
        self.kill_run(lambda watch: watch.wait_for_stage("coarse"), ranks=2)
        self.resume(ranks=2)

    def test_all_killed_while_the_mesh_is_written(self):
        self.kill_run(lambda watch: watch.wait_for_half_written_file("mesh"), ranks=2)
        out = self.resume(ranks=2)
        self.assertNotRegex(out, r"(?m)^(coarse|decompose|plan) ", "stages that were done")

    def test_all_killed_while_seams_are_improved(self):
        """At the begin, in the midst, and at the end: the file of a rank grows all the time."""
        for num_bytes in (1, 200_000, 400_000):
            with self.subTest(num_bytes=num_bytes):
                self.kill_run(self.has_log_of(num_bytes), ranks=2)
                self.resume(ranks=3)

    def test_records_of_other_pieces_are_not_taken(self):
        """What was improved is of no use once the pieces are others, as after a try that a limit had ended."""
        arguments = self.arguments
        self.arguments = [self.write_case(max_size=0.45, subdomains=8, levels=2)]
        self.kill_run(self.has_log_of(200_000), ranks=2)
        logs = {log.name: log.read_bytes() for log in self.logs()}
        self.arguments = arguments
        self.kill_run(self.has_log_of(200_000), ranks=2)
        for name, content in logs.items():  # Of these pieces they are wrong.
            (self.record("improve").parent / name).write_bytes(content)
        self.record("improve").write_bytes(b"damaged")
        self.resume(ranks=2)

    def test_damaged_records_of_the_improvement(self):
        """All that stands behind the damage is made again."""
        self.kill_run(self.has_log_of(200_000), ranks=2)
        for place in self.from_here((0, 30, 5000, 100_000)):
            with self.subTest(place=place):
                log = max(self.logs(), key=lambda file: file.stat().st_size)
                content = bytearray(log.read_bytes())
                content[place] ^= 1
                log.write_bytes(content)
                self.resume()

    def test_damaged_bands_of_a_fill(self):
        """They stand behind the piece, in its record: the piece is filled again, and what was improved counts."""
        self.kill_run(self.has_log_of(200_000), ranks=2)
        for share in self.from_here((0.5, 1.0)):
            with self.subTest(share=share):
                record = self.record("piece_000003")
                content = bytearray(record.read_bytes())
                content[int(share * (len(content) - 1))] ^= 1
                record.write_bytes(content)
                self.resume()

    def logs(self):
        """None if the store is gone, as it is when a run has ended."""
        store = self.record("improve").parent
        return sorted(store / name for name in kill.names_in(store) if name.startswith("log_") and name.endswith(".record"))

    def has_log_of(self, num_bytes):
        def has_grown():
            with contextlib.suppress(FileNotFoundError):
                return any(log.stat().st_size >= num_bytes for log in self.logs())
            return False

        return lambda watch: watch.wait_for(has_grown)

    def test_signals_while_the_mesh_is_written(self):
        for number in (signal.SIGTERM, signal.SIGUSR1):
            self.assert_signal_is_resumable(number, "write", kill.STAGES)


# Along its edge two faces meet at six degrees: no tet there has a larger angle.
WEDGE = """algebraic3d
solid wedge = plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 0; -0.1045, 0, 0.9945)
  and plane (2, 0, 0; 1, 0, 0) and plane (0, -1, 0; 0, -1, 0) and plane (0, 1, 0; 0, 1, 0);
tlo wedge;
"""


class Layers(kill.RestartTest):
    """Columns come with the coarse mesh and with the pieces, whoever has made these."""

    @staticmethod
    def make_arguments(maker):
        return [program.CONFIGS / "cases" / "pipe_layers.toml", *program.sets("size.target=0.12", "output.report_html=false")]

    def test_all_killed_in_every_stage(self):
        for number, stage in enumerate(kill.LAYER_STAGES):
            with self.subTest(stage=stage):
                self.kill_run(lambda watch, stage=stage: watch.wait_for_stage(stage, kill.LAYER_STAGES), ranks=2)
                self.resume(ranks=1 + number % 3)


class PoorPiece(kill.RestartTest):
    """NETGEN gets a second try at a piece with a small angle: the first one is not the last word."""

    @staticmethod
    def make_arguments(maker):
        maker.write("wedge.geo", WEDGE)
        return [maker.write_case(geometry="wedge.geo", max_size=0.5, subdomains=4, levels=1)]

    def test_killed_between_two_tries(self):
        tries = {s["id"]: s["tries"] for s in program.figures(self.reference)["subdomains"]}
        poor = [s for s, number in tries.items() if number == 2]
        self.assertTrue(poor, "no piece had a second try: nothing is tested")
        record = self.record(f"piece_{poor[0]:06}")
        self.kill_run(lambda watch: watch.wait_for(record.exists))
        killed = (self.out / "log" / "run.log").read_text()
        self.resume()
        self.assertNotIn(f"fill: subdomain {poor[0]}: try 2", killed, "the kill came too late")


if __name__ == "__main__":
    unittest.main()
