# SPDX-License-Identifier: BSD-3-Clause
"""Whatever third-party code does in a job, at any stage and on any rank: a documented end with the cause, no hang.

All faults of a fill are in fallbacks_test.py, those of an improvement in improve_test.py as well."""
import concurrent.futures
import dataclasses
import json
import os
import shutil
import unittest

import program
from program import DEGRADED, FAILED, OK, WRONG_INPUT

# CPU time and sleep in seconds, GiB: far from what the sound jobs of these models need.
LIMITS = {"TESSERA_TEST_LIMITS": "1.5 1 0.3"}

CAUSES = {
    "throw": "thrown for a test",
    "segv": "signal 11",
    "exit": "called exit(1)",
    "loop": "more than 1.5 s of CPU time",
    "sleep": "no CPU time for 1 s",
    "memory": "more than 0.3 GiB",
    "garbage": "gave a result that cannot be used",
}
NO_RESULT = tuple(kind for kind in CAUSES if kind != "garbage")
BOTH_RANKS = (0, 1)
THREE_RANKS = range(3)
ALL = -1  # In place of a rank: where one rank takes over what failed on another.

# Stages whose jobs go to the rank that asks first.
SHARED_OUT = ("plan", "fill", "improve")
TRIES = 5

# Runs at a time: they wait more than they work.
AT_A_TIME = 3


@dataclasses.dataclass(frozen=True)
class Fault:
    """One run: what happens in which jobs of which rank, with words that the message must have."""

    stage: str
    kind: str
    rank: int = 0
    more: str = ""  # Further faults.

    @property
    def output(self):
        return f"{self.stage}_{self.kind}_{self.rank}"

    @property
    def asked(self):
        return f"{self.stage}={self.kind} {self.more}"


def on_both_ranks(stage, kinds):
    """Every kind on one rank, one kind on each, and one on both."""
    return [Fault(stage, "segv", 0), Fault(stage, "segv", ALL), *(Fault(stage, kind, number % 2) for number, kind in enumerate(kinds))]


class FaultsTest(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.case = self.write_case(max_size=0.6, subdomains=6)

    def run_with(self, fault, command, *arguments):
        """On two ranks, one of which has the fault, or on three that share their workers and have it all."""
        ranks = THREE_RANKS if fault.rank == ALL else BOTH_RANKS
        asked = [fault.asked if fault.rank in (rank, ALL) else "" for rank in ranks]
        command = program.with_setting_of_rank("TESSERA_TEST_FAULT", asked, [program.PROGRAM, command, *arguments])
        start = [program.MPIEXEC, "-n", str(len(ranks))]
        return self.finish(self.start_command([*start, *command], env=os.environ | LIMITS))

    def mesh_with(self, fault, *arguments):
        """On a busy machine the other rank may have done all jobs of a stage: then once more."""
        for _ in range(TRIES):
            outcome = self.run_with(
                fault, "mesh", self.case, "--output", fault.output, "--progress", "never", *arguments
            )
            folder = self.folder / fault.output
            if outcome.code != OK or fault.stage not in SHARED_OUT or not (folder / "mesh.pvtu").exists():
                return outcome
            if (folder / "failure").exists():
                return outcome
            shutil.rmtree(folder)
        self.fail(f"rank {fault.rank} has never had a job of {fault.stage}")

    def for_all(self, faults, look, *arguments):
        """`look(fault, outcome)` at the end of each run."""
        with concurrent.futures.ThreadPoolExecutor(AT_A_TIME) as pool:
            outcomes = pool.map(lambda fault: self.mesh_with(fault, *arguments), faults)
            for fault, outcome in zip(faults, outcomes):
                with self.subTest(fault=fault.output):
                    look(fault, outcome)

    def report(self, fault):
        return json.loads((self.folder / fault.output / "report.json").read_text())

    def kept_jobs(self, fault):
        """Folders of failed jobs, each with its request and why it failed."""
        jobs = sorted(
            path for path in (self.folder / fault.output / "failure").glob("*")
            if path.is_dir() and path.name != "inputs"
        )  # fmt: skip
        for job in jobs:
            self.assertIn(CAUSES[fault.kind], (job / "log.txt").read_text())
            self.assertGreater((job / "job.bin").stat().st_size, 0)
        return [job.name for job in jobs]

    def assert_ended(self, fault, outcome, code, *words):
        """With one message, a report that says the same, and nothing that looks like a mesh."""
        self.assert_refused(outcome, code, CAUSES[fault.kind], *words)
        folder = self.folder / fault.output
        report = self.report(fault)
        self.assertEqual((report["status"], report["exit_code"]), ("failed", code))
        self.assertIn(CAUSES[fault.kind], report["reason"])
        for pattern in ("*.pvtu", "mesh/*", "boundary/*", "**/*.tmp-*"):
            self.assertEqual(list(folder.glob(pattern)), [])

    def assert_conforms(self, fault):
        outcome = self.run_program("check", f"{fault.output}/mesh.pvtu")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        self.assertEqual(list((self.folder / fault.output).glob("**/*.tmp-*")), [])


class WithoutAMesh(FaultsTest):
    """Stages that nothing can take the place of."""

    def test_reading_the_model(self):
        def look(fault, outcome):
            self.assert_ended(fault, outcome, WRONG_INPUT, "ball.geo", "cannot read this model")
            self.assertEqual(self.kept_jobs(fault), ["model"])

        self.for_all([Fault("import", kind) for kind in CAUSES], look)

    def test_loading_the_model(self):
        def look(fault, outcome):
            self.assert_ended(fault, outcome, WRONG_INPUT, "ball.geo", "cannot read this model")

        together = [Fault("load", kind, ALL) for kind in ("exit", "loop", "memory", "sleep")]
        self.for_all(on_both_ranks("load", NO_RESULT) + together, look)

    def test_size_of_the_model(self):
        self.case = self.write("case.toml", "geometry.file = 'ball.geo'\nsize.target = 0.5\n")

        def look(fault, outcome):
            self.assert_ended(fault, outcome, FAILED, "ball.geo", "size of the model")
            self.assertEqual(self.kept_jobs(fault), ["box"])

        self.for_all([Fault("box", kind) for kind in ("throw", "exit", "sleep", "garbage")], look)

    def test_coarse_mesh(self):
        """All tries fail, those from triangles and NETGEN's."""
        self.write("cube.stl", program.stl_text(program.CUBE_TRIANGLES))
        self.case = self.write_case(geometry="cube.stl", subdomains=2)

        def look(fault, outcome):
            self.assert_ended(fault, outcome, FAILED, "cube.stl", "no coarse mesh", "NETGEN's surface")
            self.assertEqual(len(self.kept_jobs(fault)), 3)

        self.for_all([Fault("remesh", kind, ALL, f"coarse={kind}") for kind in CAUSES], look)

    def test_domain_of_the_coarse_mesh(self):
        def look(fault, outcome):
            self.assert_ended(fault, outcome, FAILED, "ball.geo", "no coarse mesh")

        self.for_all([Fault("domain", kind, ALL) for kind in ("throw", "segv", "sleep")], look)

    def test_plan(self):
        def look(fault, outcome):
            self.assert_ended(fault, outcome, FAILED, "plan from subdomain")
            # On three ranks more than one job may have failed before the first failure is known.
            self.assertEqual({job.partition(".")[0] for job in self.kept_jobs(fault)}, {"plan"})

        self.for_all(on_both_ranks("plan", CAUSES), look)

    def test_goes_on_where_it_ended(self):
        """Without the fault, to the same mesh."""
        reference = self.mesh(self.case, "reference", ranks=2)
        faults = (Fault("load", "segv", 1), Fault("coarse", "segv", ALL, "remesh=segv"), Fault("plan", "segv", 1))
        for fault in faults:
            with self.subTest(fault=fault):
                self.assertNotEqual(self.mesh_with(fault).code, OK)
                resumed = self.mesh(self.case, fault.output, "--resume", ranks=2)
                self.assertEqual(program.mesh_files(resumed), program.mesh_files(reference))
                self.assertFalse((resumed / "failure").exists())


class WithAMesh(FaultsTest):
    """Stages with something to fall back on."""

    def test_netgens_surface_takes_the_place_of_the_remesher(self):
        self.write("cube.stl", program.stl_text(program.CUBE_TRIANGLES))
        self.case = self.write_case(geometry="cube.stl", subdomains=2)

        def look(fault, outcome):
            self.assertEqual(outcome.code, OK, outcome.err)
            self.assertIn(CAUSES[fault.kind], outcome.out)
            self.assert_conforms(fault)

        self.for_all([Fault("remesh", kind, ALL) for kind in ("throw", "segv", "sleep")], look)

    def test_lost_tet_of_the_coarse_mesh(self):
        fault = Fault("coarse", "drop", ALL, "remesh=drop")
        self.assert_refused(self.mesh_with(fault), FAILED, "no coarse mesh")

    def test_fill(self):
        def look(fault, outcome):
            self.assertEqual(outcome.code, DEGRADED, outcome.err)
            self.assertIn("subdivided", self.report(fault)["reason"])
            faulty = [s for s in self.report(fault)["subdomains"] if s["kernel"] == "subdivide"]
            self.assertIn(len(faulty), range(1, 7))
            for subdomain in faulty:
                self.assertEqual(len(subdomain["failures"]), 4)
                for text in subdomain["failures"]:
                    self.assertIn(CAUSES[fault.kind], text)
                folder = self.folder / fault.output / "failure" / f"fill_subdomain_{subdomain['id']}"
                self.assertGreater((folder / "skin.vtu").stat().st_size, 0)
            self.assertTrue(self.kept_jobs(fault))
            self.assert_conforms(fault)

        self.for_all([Fault("fill", kind, ALL) for kind in ("garbage", "segv", "exit", "sleep")], look)

    def test_skin_of_a_failed_fill(self):
        """A diagnosis that fails leaves itself out, and changes nothing else."""

        def look(fault, outcome):
            self.assertEqual(outcome.code, DEGRADED, outcome.err)
            folder = self.folder / fault.output / "failure"
            logs = list(folder.glob("fill_subdomain_*/log.txt"))
            self.assertTrue(logs)
            for log in logs:
                self.assertIn("thrown for a test", log.read_text())
            self.assertEqual(list(folder.glob("*/skin.vtu")), [])
            self.assert_conforms(fault)

        self.for_all([Fault("skin", kind, ALL, "fill=throw") for kind in ("exit", "sleep", "garbage")], look)

    def test_improve(self):
        def look(fault, outcome):
            self.assertEqual(outcome.code, OK, outcome.err)
            self.assertGreaterEqual(self.report(fault)["improve"]["failed"], 1)
            self.assertEqual(self.report(fault)["reproducible"], fault.kind not in ("sleep", "memory"))
            for job in self.kept_jobs(fault):
                self.assertRegex(job, r"^improve_region_\d+$")
                region = self.folder / fault.output / "failure" / job / "region.vtu"
                self.assertGreater(region.stat().st_size, 0)
            self.assert_conforms(fault)

        self.for_all(on_both_ranks("improve", ("memory", "segv", "sleep", "garbage")), look)


class OtherCommands(FaultsTest):
    def test_dry_run_that_ends(self):
        """It leaves the folder free for a run."""

        def look(fault, outcome):
            code = WRONG_INPUT if fault.stage == "import" else FAILED
            self.assert_refused(outcome, code, CAUSES[fault.kind])
            folder = self.folder / fault.output
            self.assertLessEqual({path.name for path in folder.iterdir()}, {".tessera.lock", "log", "failure"})
            self.mesh(self.case, fault.output, ranks=2)
            self.assertFalse((folder / "failure").exists())

        stages = ("import", "coarse", "plan")
        self.for_all([Fault(stage, "segv", ALL, "remesh=segv") for stage in stages], look, "--dry-run")

    def test_dry_run_with_fills_that_fail(self):
        def look(fault, outcome):
            self.assertEqual(outcome.code, OK, outcome.err)
            names = {path.name for path in (self.folder / fault.output).iterdir()}
            self.assertEqual(names, {".tessera.lock", "log", "prediction.json"})

        self.for_all([Fault("fill", "segv", 0), Fault("fill", "sleep", 1)], look, "--dry-run")

    def test_info(self):
        for stage, kind in (("import", "segv"), ("import", "sleep"), ("load", "exit"), ("describe", "garbage")):
            with self.subTest(stage=stage, kind=kind):
                outcome = self.run_with(Fault(stage, kind), "info", "ball.geo")
                self.assert_refused(outcome, WRONG_INPUT, "ball.geo", "cannot read this model", CAUSES[kind])


class Described(FaultsTest):
    """A CSG model whose surface NETGEN cannot mesh is described by OpenCASCADE's solids."""

    def info(self, **options):
        outcome = self.run_program("info", program.CONFIGS / "geometry/core.geo", "--json", **options)
        self.assertEqual(outcome.code, OK, outcome.err)
        return json.loads(outcome.out)

    def test_numbers_and_names_are_the_same(self):
        for kind in ("segv", "garbage"):
            with self.subTest(kind=kind):
                self.compare(self.info(), self.info(env=os.environ | {"TESSERA_TEST_FAULT": f"describe={kind}@0"}))

    def compare(self, wanted, found):
        self.assertNotEqual(found, wanted)  # Other triangles.
        for group, keys in (("solids", ["name"]), ("faces", ["number", "name", "solids"]), ("edges", ["number"])):
            of = [[[row[key] for key in keys] for row in figures[group]] for figures in (wanted, found)]
            self.assertEqual(*of, group)
        for row, other in zip(wanted["faces"], found["faces"]):
            self.assertAlmostEqual(other["area"] / row["area"], 1, delta=0.05)
        for row, other in zip(wanted["solids"], found["solids"]):
            self.assertAlmostEqual(other["volume"] / row["volume"], 1, delta=0.05)

    def test_names_of_a_case_are_found(self):
        case = self.folder / "named.toml"
        case.write_text("geometry.file = 'ball.geo'\ncoarse.max_size = 1\nfill.kernel = 'subdivide'\n"
                        "[[geometry.name]]\nname = 'skin'\npatch.faces = [1]\n")
        outcome = self.run_program("mesh", case, "--output", "named",
                                   env=os.environ | {"TESSERA_TEST_FAULT": "describe=segv@0"})
        self.assertEqual(outcome.code, OK, outcome.err)


class PlainReader(FaultsTest):
    """A STEP that kills OpenCASCADE's reader with names has another way in."""

    def setUp(self):
        super().setUp()
        shutil.copy(program.CONFIGS / "geometry/two_blocks.step", self.folder / "two.step")

    def run_faulty(self, fault, *arguments):
        return self.run_program(*arguments, env=os.environ | {"TESSERA_TEST_FAULT": fault})

    def test_is_tried_and_named(self):
        outcome = self.run_faulty("import=segv@0", "mesh", "two.step", "--size", 2, "--kernel", "subdivide",
                                  "--output", "plain")
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertIn("plain reader", outcome.err + outcome.out)
        report = json.loads((self.folder / "plain/report.json").read_text())
        self.assertIn(CAUSES["segv"], report["model"]["repairs"][0])
        self.assertIn("plain reader", report["model"]["repairs"][1])
        self.assertAlmostEqual(report["volume"], 1288, places=6)

    def test_serves_info_as_well(self):
        outcome = self.run_faulty("import=segv@0", "info", "two.step")
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertIn("plain reader", outcome.out)

    def test_that_dies_too_leaves_the_first_error(self):
        outcome = self.run_faulty("import=segv", "info", "two.step")
        self.assert_refused(outcome, WRONG_INPUT, "two.step", "cannot read this model", CAUSES["segv"])


class WrongNames(FaultsTest):
    def test_unknown_fault_is_refused(self):
        """Else a misspelt name would make every test here pass."""
        for asked in ("fill=loup@2", "fil=loop", "fill@2", "fill=loop sleep"):
            outcome = self.run_program(
                "mesh", self.case, "--output", "out", env=os.environ | {"TESSERA_TEST_FAULT": asked}
            )
            self.assert_refused(outcome, WRONG_INPUT, "TESSERA_TEST_FAULT", asked.split()[-1])


if __name__ == "__main__":
    unittest.main()
