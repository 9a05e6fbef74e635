# SPDX-License-Identifier: BSD-3-Clause
"""Every file that cannot be written: one message that names it, nothing half written, and --resume goes on."""
import concurrent.futures
import json
import os
import re
import resource
import shutil
import subprocess
import tempfile
import unittest

import program
from program import CANNOT_WRITE, DEGRADED, OK

# Either is what a system says of a file that may not grow.
FULL = r"File too large|no space left"

# What a run writes, in the order of the first time; of files by the dozen, one.
FILES = (
    "case.toml",
    "log/run.log",
    "pieces/run.record",
    "pieces/coarse.record",
    "pieces/plan.record",
    "pieces/piece_000001.record",
    "pieces/improve.record",
    "pieces/log_000000.record",
    "mesh/piece_000001.vtu",
    "boundary/piece_000001.vtu",
    "mesh.pvtu",
    "boundary.pvtu",
    "report.html",
    "report.json",
)

# These fail by other means, see below.
LOCK, LOG_OF_JOBS = ".tessera.lock", "log/rank_000000.log"


def without_files_of_mpi(folder):
    """An environment in which MPI makes folders, but no files, so a limit on sizes meets the program alone."""
    return os.environ | {
        "OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_btl": "self", "PMIX_MCA_gds": "hash",
        **program.mpi_files_in(tempfile.mkdtemp(prefix="mpi_", dir=folder)),
    }  # fmt: skip


def without_numbers(name):
    return re.sub(r"\d+", "#", name)


class WritesTest(program.ProgramTest):
    """One tiny case, its mesh by a run that nothing disturbed, and runs that something does."""

    @classmethod
    def setUpClass(cls):
        maker = cls.make_maker()
        cls.case = maker.write_case(max_size=0.9, subdomains=3, page=True)
        cls.reference = maker.mesh(cls.case, "reference")

    def run_alone(self, *arguments, largest_file=None, env=None, **options):
        """Without mpirun; no file may become larger than `largest_file` bytes. Pages have no view to turn, with which
        they would be larger than all records."""

        def limit():
            if largest_file is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))

        env = without_files_of_mpi(self.folder) | {"TESSERA_THREE_JS": "none"} | (env or {})
        return self.run_program(*arguments, preexec_fn=limit, env=env, **options)

    def run_mesh(self, output, *arguments, **options):
        return self.run_alone(
            "mesh", self.case, "--output", output, "--progress", "never", *arguments, **options
        )

    def begun(self, output):
        """A folder that a run may go on in."""
        folder = self.folder / output
        folder.mkdir()
        (folder / LOCK).touch()
        return folder

    def assert_nothing_is_half_written(self, output):
        self.assertEqual(list((self.folder / output).glob("**/*.tmp-*")), [])

    def assert_cannot_write(self, outcome, output, *words):
        self.assert_refused(outcome, CANNOT_WRITE, *words)
        self.assert_nothing_is_half_written(output)
        report = self.folder / output / "report.json"
        if report.is_file():
            self.assertEqual(json.loads(report.read_text())["exit_code"], CANNOT_WRITE)

    def assert_resumes(self, output, *arguments):
        """To the bits of the run that nothing disturbed."""
        outcome = self.run_mesh(output, "--resume", *arguments)
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual(program.mesh_files(self.folder / output), program.mesh_files(self.reference))
        self.assertEqual(program.figures(self.folder / output), program.figures(self.reference))
        self.assertFalse((self.folder / output / "pieces").exists())


class FullDisk(WritesTest):
    def test_every_limit_of_size(self):
        """Each one a little later; the file that meets it first is named."""
        named, limit, outcome = [], 0, None
        while outcome is None or outcome.code != OK:
            output = f"limit_{limit}"
            outcome = self.run_mesh(output, largest_file=limit)
            if outcome.code != OK:
                with self.subTest(limit=limit):
                    self.assert_cannot_write(outcome, output, f"cannot write {output}/")
                    self.assertRegex(outcome.messages[0], FULL)
                    has_mesh = (self.folder / output / "mesh.pvtu").exists()
                    self.assertEqual(has_mesh, "report.html" in outcome.messages[0], "it comes after the mesh")
                    named += re.findall(rf"cannot write {output}/(\S+):", outcome.messages[0])
                    self.assert_resumes(output)
            limit = max(16, 3 * limit)
            self.assertLess(limit, 1e6)
        for file in (LOCK, "case.toml", "pieces/coarse.record"):
            self.assertIn(file, named)
        self.assertRegex(" ".join(named), r"pieces/piece_\d+\.record")

    def test_piece_files(self):
        """Without improvement, and uncompressed, they are larger than all records."""
        plain = ("--set", "improve.seams=false", "--set", "output.compression='none'", "--set", "refine.levels=2")
        one_pass = ("--set", "fill.kernel='subdivide'", *plain)
        for name, settings in (("stored", plain), ("one_pass", one_pass)):
            with self.subTest(name):
                sound = self.folder / f"{name}_sound"
                self.assertEqual(self.run_mesh(sound.name, *settings).code, OK)
                limit = max(file.stat().st_size for file in sound.glob("mesh/*")) - 1
                outcome = self.run_mesh(name, *settings, largest_file=limit)
                self.assert_cannot_write(outcome, name, f"cannot write {name}/mesh/piece_")
                self.assertRegex(outcome.messages[0], FULL)
                resumed = self.run_mesh(name, "--resume", *settings)
                self.assertEqual(resumed.code, OK, resumed.err)
                self.assertEqual(program.mesh_files(self.folder / name), program.mesh_files(sound))

    def test_logs(self):
        """They are no reason to end a run."""
        folder = self.begun("out")
        (folder / "log").mkdir()
        for name in ("run.log", "rank_000000.log"):
            (folder / "log" / name).write_bytes(b"x" * 300000)
        outcome = self.run_mesh("out", "--resume", largest_file=200000)
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual(outcome.err.count("the log is incomplete"), 1, outcome.err)
        self.assertEqual(program.mesh_files(folder), program.mesh_files(self.reference))

    def test_failed_jobs(self):
        """What cannot be kept of them is a warning."""
        limit = 300000  # Above the records.
        fault = {"TESSERA_TEST_FAULT": "fill=throw@1"}
        folder = self.begun("out")
        (folder / "failure").mkdir()
        (folder / "failure" / "inputs").touch()
        outcome = self.run_mesh("out", "--resume", env=fault, largest_file=limit)
        self.assertEqual(outcome.code, DEGRADED, outcome.err)
        self.assertIn("warning: failure: cannot make folder out/failure/inputs", outcome.out)
        self.assert_nothing_is_half_written("out")

    def test_repartition(self):
        named, limit = set(), 0
        while True:
            output = f"limit_{limit}"
            outcome = self.run_alone(
                "repartition", self.reference / "mesh.pvtu", "--parts", 2, "--output", output, largest_file=limit
            )
            if outcome.code == OK:
                break
            with self.subTest(limit=limit):
                self.assert_cannot_write(outcome, output, f"cannot write {output}/")
                self.assertRegex(outcome.messages[0], FULL)
                named.add(without_numbers(outcome.messages[0].split()[3]))
            limit = max(16, limit * 3)
        self.assertTrue(any("mesh/piece" in name for name in named), named)

    def test_standard_output(self):
        mesh = self.reference / "mesh.pvtu"
        commands = (
            ["info", mesh], ["check", mesh], ["check", mesh, "--json"], ["--version"], ["mesh", "--help"],
            ["mesh", self.case, "--dump-config"]
        )  # fmt: skip
        with open("/dev/full", "wb") as full:
            for command in commands:
                with self.subTest(command=command):
                    done = subprocess.run(
                        [program.PROGRAM, *map(str, command)], stdout=full, stderr=subprocess.PIPE, check=False
                    )
                    self.assertEqual(done.returncode, CANNOT_WRITE)
                    self.assertEqual(done.stderr.decode(), "tessera: cannot write to standard output\n")

    def test_nobody_reads_the_progress(self):
        """As of `tessera mesh CASE | head`: the mesh is in its folder all the same."""
        reading, writing = os.pipe()
        os.close(reading)
        with open(writing, "wb") as nobody:
            done = subprocess.run(
                [program.PROGRAM, "mesh", self.case, "--output", "unread"], stdout=nobody, stderr=subprocess.PIPE,
                check=False, cwd=self.folder
            )  # fmt: skip
        self.assertEqual(done.returncode, OK, done.stderr)
        self.assertEqual(program.mesh_files(self.folder / "unread"), program.mesh_files(self.reference))


# A run on a disk of its own of $SIZE, then, moved, on one with room. If $FILL, somebody else takes all that is left
# when the run has a plan.
ON_A_SMALL_DISK = """
mkdir out && mount -t tmpfs -o size=$SIZE none out || exit 99
test -z "$FILL" || (until test -e out/pieces/plan.record; do sleep 0.002; done; cat /dev/zero > out/log/filler 2>&-) &
"$@"; echo "ended with $?"
find out -name '*.tmp-*' -o -name mesh.pvtu
kill $! 2>&-; wait
rm -f out/log/filler
cp -a out room && umount out && cp -a room/. out || exit 99
"$@" --resume > resumed.txt 2>&1; echo "resumed with $?"
cp -r out copy
"""


def can_mount():
    """Whether a user may have a disk of his own here."""
    command = ["unshare", "-rm", "mount", "-t", "tmpfs", "none", "/mnt"]
    return subprocess.run(command, stderr=subprocess.DEVNULL, check=False).returncode == 0


@unittest.skipUnless(can_mount(), "no small disk to be had; FullDisk has the same failures, one file at a time")
class SmallDisk(WritesTest):
    def assert_ends_and_resumes(self, size, *, is_filled):
        home = self.folder / f"disk_{size}"
        home.mkdir()
        run = [program.PROGRAM, "mesh", self.case, "--output", "out", "--progress", "never"]
        outcome = self.finish(self.start_command(
            ["env", "-C", home, "unshare", "-rm", "sh", "-c", ON_A_SMALL_DISK, "sh", *run],
            env=without_files_of_mpi(self.folder) | {"SIZE": size, "FILL": "1" if is_filled else ""},
        ))  # fmt: skip
        self.assertEqual(re.findall(r"^(?:ended|resumed) with .*|^out/.*", outcome.out, re.MULTILINE),
                         [f"ended with {CANNOT_WRITE}", f"resumed with {OK}"], outcome.err + outcome.out)
        self.assertEqual(len(outcome.messages), 1, outcome.err)
        self.assertRegex(outcome.messages[0], r"out/\S+: (No|no) space left|\d GB are needed")
        self.assertEqual(program.mesh_files(home / "copy"), program.mesh_files(self.reference))

    def test_disk_is_too_small(self):
        for size in ("4k", "12k", "24k", "40k", "64k"):
            with self.subTest(size):
                self.assert_ends_and_resumes(size, is_filled=False)

    def test_disk_gets_full_on_the_way(self):
        self.assert_ends_and_resumes("16m", is_filled=True)


class NoPlaceForAFile(WritesTest):
    """A folder where the file belongs: each file has its turn, however small it is."""

    def blocked(self, file):
        output = without_numbers(file).replace("/", "_")
        folder = self.begun(output)
        (folder / file).mkdir(parents=True)
        (folder / file / "foreign").touch()
        return output

    def run_blocked(self, file):
        output = self.blocked(file)
        return output, self.run_mesh(output, "--resume")

    def test_every_file_of_a_run(self):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for file, (output, outcome) in zip(FILES, pool.map(self.run_blocked, FILES)):
                with self.subTest(file):
                    self.assert_cannot_write(outcome, output, f"{output}/{file}")
                    shutil.rmtree(self.folder / output / file)
                    self.assert_resumes(output)

    def test_list_of_files_is_complete(self):
        """All that a run has written, and not removed, when it comes to its last file."""
        output, outcome = self.run_blocked("report.json")
        self.assert_cannot_write(outcome, output, "report.json")
        folder = self.folder / output
        written = {file.relative_to(folder).as_posix() for file in folder.rglob("*") if file.is_file()}
        known = {without_numbers(file) for file in (*FILES, LOCK, LOG_OF_JOBS, "report.json/foreign")}
        self.assertEqual({without_numbers(file) for file in written} - known, set())

    def test_log_of_jobs(self):
        """It gets lost, nothing else."""
        output = self.blocked(LOG_OF_JOBS)
        self.assert_resumes(output)

    def test_lock(self):
        (self.folder / "out" / LOCK).mkdir(parents=True)
        self.assert_refused(self.run_mesh("out"), CANNOT_WRITE, "cannot write to folder out", "directory")

    def test_folders(self):
        for name in ("log", "mesh", "boundary", "pieces"):
            with self.subTest(name):
                folder = self.begun(f"no_{name}")
                (folder / name).touch()
                outcome = self.run_mesh(folder.name, "--resume")
                self.assert_cannot_write(outcome, folder.name, f"no_{name}/{name}", "irectory")
                (folder / name).unlink()
                self.assert_resumes(folder.name)

    def test_prediction(self):
        output = self.blocked("prediction.json")
        self.assert_cannot_write(self.run_mesh(output, "--dry-run"), output, "prediction.json")
        self.assertFalse((self.folder / output / "dry_run").exists())

    def test_failed_jobs(self):
        fault = {"TESSERA_TEST_FAULT": "fill=throw@1"}
        folder = self.begun("out")
        (folder / "failure").touch()
        outcome = self.run_mesh("out", "--resume", env=fault)
        self.assertEqual(outcome.code, DEGRADED, outcome.err)
        self.assertIn("warning: failure: cannot make folder out/failure", outcome.out)

    def test_repartition(self):
        for file in ("mesh/piece_000001.vtu", "boundary/piece_000001.vtu", "mesh.pvtu", "boundary.pvtu", "report.json"):
            with self.subTest(file):
                output = self.blocked(file)
                outcome = self.run_alone(
                    "repartition", self.reference / "mesh.pvtu", "--parts", 2, "--output", output, "--overwrite"
                )
                self.assert_cannot_write(outcome, output, f"{output}/{file}")


if __name__ == "__main__":
    unittest.main()
