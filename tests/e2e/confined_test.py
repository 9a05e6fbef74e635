# SPDX-License-Identifier: BSD-3-Clause
"""A run writes into its output folder and nowhere else, whatever that holds and however files are called."""
import os
import shutil
import unittest

import program
from program import CANNOT_WRITE, DEGRADED, OK

# None of them means anything to the program, to mpirun, to a shell or to a format.
NAMES = (
    "two  spaces, Grüße, 日本, it's \"quoted\" \\ <&amp;>",
    "$(touch pwned) `touch pwned`; touch pwned & | * ? %s%n {} {0} #",
    "--line\nfeed\tand tab",
)


def content_of(folder):
    """Every file of a folder with what it holds, and every link with where it leads."""
    return {
        path.relative_to(folder).as_posix(): os.readlink(path) if path.is_symlink() else path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_symlink() or not path.is_dir()
    }


class Names(program.ProgramTest):
    def assert_works(self, *arguments, code=OK, **options):
        outcome = self.run_program(*arguments, **options)
        self.assertEqual(outcome.code, code, outcome.err + outcome.out)
        return outcome

    def assert_all_commands_work(self, name, model):
        """Each file and folder is called so, in a folder that is called so."""
        home = self.folder / name
        home.mkdir()
        (home / f"{name}.toml").write_text(
            f"geometry.file = {toml_text(model.name)}\ncoarse.max_size = 0.9\n"
            "decompose.subdomains = 2\nrefine.levels = 1\n" + program.NO_PAGE
        )
        shutil.copy(model, home)
        case, out, parts = home / f"{name}.toml", home / name, home / f"{name} 2"
        fault = os.environ | {"TESSERA_TEST_FAULT": "fill=throw@1"}
        self.assert_works("mesh", case, "--output", out, code=DEGRADED, ranks=2, env=fault)
        self.assert_works("replay", out / "failure" / "fill_subdomain_1")
        self.assert_works("mesh", case, "--output", out, "--overwrite", ranks=2)
        self.assert_works("check", out / "mesh.pvtu")
        self.assertRegex(self.assert_works("info", out / "mesh.pvtu").out, r"^mesh: \d+ pieces, ")
        self.assertIn("box diagonal", self.assert_works("info", home / model.name).out)
        self.assertIn("max_size", self.assert_works("info", case).out)
        self.assert_works("repartition", out / "mesh.pvtu", "--parts", 3, "--output", parts)
        self.assert_works("check", parts / "mesh.pvtu")
        again = self.folder / "again"  # From the resolved case, which names the model.
        self.assert_works("mesh", out / "case.toml", "--output", again)
        self.assertEqual(program.figures(again)["digest"], program.figures(out)["digest"])
        shutil.rmtree(again)

    def test_names(self):
        for name in NAMES:
            with self.subTest(name=name):
                model = self.write(f"{name}.geo", program.BALL)
                self.assert_all_commands_work(name, model)
                model.unlink()
        self.assertEqual(list(self.folder.rglob("pwned")), [])

    def test_names_of_other_models(self):
        """OpenCASCADE reads these itself."""
        for number, kind in enumerate(("step", "brep", "iges", "stl")):
            source = next((program.CONFIGS / "geometry").glob(f"*.{kind}"))
            name = NAMES[number % len(NAMES)]
            model = self.folder / f"{name}.{kind}"
            shutil.copy(source, model)
            with self.subTest(name=model.name):
                self.assertIn("box diagonal", self.assert_works("info", model).out)


def toml_text(text):
    """A TOML string."""
    for plain, escaped in (("\\", "\\\\"), ('"', '\\"'), ("\n", "\\n"), ("\t", "\\t")):
        text = text.replace(plain, escaped)
    return f'"{text}"'


class NothingElseIsWritten(program.ProgramTest):
    """Working directory, home and the folder for temporary files stay empty, the input as it was."""

    def assert_writes_only_there(self, model, *arguments, code=OK, fault=""):
        name = f"{model.stem}_{model.suffix[1:]}_{fault.replace('=', '_')}"
        home = self.folder / name
        inputs, cwd, user, temporary = (home / part for part in ("inputs", "cwd", "user", "temporary"))
        for folder in (inputs, cwd, user, temporary):
            folder.mkdir(parents=True)
        shutil.copy(model, inputs)
        (inputs / "case.toml").write_text(
            f"geometry.file = '{model.name}'\ncoarse.max_size = 1000\ndecompose.subdomains = 2\nrefine.levels = 0\n"
        )
        before = {path: path.stat().st_mtime_ns for path in (inputs, *inputs.iterdir())}
        environment = os.environ | {
            "HOME": str(user), "TMPDIR": str(temporary), "TESSERA_TEST_FAULT": fault,
            **program.mpi_files_in(self.folder),  # They are not the program's.
        }  # fmt: skip
        command = ["env", "-C", cwd, *program.command_line(
            ["mesh", inputs / "case.toml", "--output", home / "out", *arguments], ranks=2
        )]  # fmt: skip
        outcome = self.finish(self.start_command([str(word) for word in command], env=environment))
        self.assertEqual(outcome.code, code, outcome.err + outcome.out)
        for folder in (cwd, user, temporary):
            self.assertEqual(list(folder.rglob("*")), [])
        self.assertEqual({path: path.stat().st_mtime_ns for path in (inputs, *inputs.iterdir())}, before)
        self.assertEqual(len(list(home.iterdir())), 5)

    def test_every_kind_of_model(self):
        geometry = program.CONFIGS / "geometry"
        ball = self.write("ball.geo", program.BALL)
        for model in (ball, *(next(geometry.glob(f"*.{kind}")) for kind in ("step", "iges", "brep", "stl"))):
            with self.subTest(model=model.name):
                self.assert_writes_only_there(model)

    def test_jobs_that_fail(self):
        ball = self.write("ball.geo", program.BALL.replace("; 1)", "; 1000)"))  # More than one tet.
        no_mesh = "coarse=segv remesh=segv"
        for fault, code in (("fill=segv@1", DEGRADED), ("improve=exit", OK), (no_mesh, program.FAILED)):
            with self.subTest(fault=fault):
                self.assert_writes_only_there(ball, code=code, fault=fault)

    def test_dry_run(self):
        self.assert_writes_only_there(self.write("ball.geo", program.BALL), "--dry-run")


class SymbolicLinks(program.ProgramTest):
    """In the output folder they are replaced or refused; what they lead to stays as it is."""

    FILES = (
        "mesh.pvtu", "boundary.pvtu", "case.toml", "report.html", "report.json", "log/run.log", "log/rank_000000.log",
        "pieces/run.record", "pieces/coarse.record", "pieces/piece_000000.record", "pieces/log_000000.record",
        "mesh/piece_000000.vtu", "boundary/piece_000000.vtu", "failure/coarse.vtu", "failure/fill_subdomain_1",
    )  # fmt: skip
    LEFT_ALONE = {"log/rank_000000.log", "failure/coarse.vtu", "failure/fill_subdomain_1"}
    FOLDERS = ("mesh", "boundary", "log", "pieces")

    def setUp(self):
        super().setUp()
        self.case = self.write_case(max_size=0.9, subdomains=3, page=True)
        self.out = self.folder / "out"
        self.elsewhere = self.folder / "elsewhere"

    def prepare(self, names, *, is_folder):
        """A folder that a run has begun in, in which `names` lead out of it."""
        for folder in (self.out, self.elsewhere):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
        (self.out / ".tessera.lock").touch()
        for number, name in enumerate(names):
            target = self.elsewhere / str(number)
            (self.out / name).parent.mkdir(exist_ok=True)
            (self.out / name).symlink_to(target)
            if is_folder:
                target.mkdir()
                for file in ("piece_000000.vtu", "run.record", "run.log", "precious", "job.bin", "a.tmp-1-2"):
                    (target / file).write_text("precious")
            else:
                target.write_text("precious")
        return content_of(self.elsewhere)

    def run_mesh(self, *arguments, **options):
        return self.run_program(
            "mesh", self.case, "--output", "out", "--progress", "never", *arguments, ranks=2, **options
        )

    def test_files(self):
        fault = os.environ | {"TESSERA_TEST_FAULT": "fill=throw@1"}
        before = self.prepare(self.FILES, is_folder=False)
        outcome = self.run_mesh("--resume", env=fault)
        self.assertEqual(outcome.code, DEGRADED, outcome.err)
        self.assertEqual(content_of(self.elsewhere), before)
        self.assertEqual({name for name in self.FILES if (self.out / name).is_symlink()}, self.LEFT_ALONE)

    def test_links_into_nothing(self):
        self.prepare(self.FILES, is_folder=False)
        for target in self.elsewhere.iterdir():
            target.unlink()
        outcome = self.run_mesh("--resume")
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual(list(self.elsewhere.iterdir()), [])

    def test_folders_are_refused(self):
        for name in self.FOLDERS:
            with self.subTest(name):
                before = self.prepare([name], is_folder=True)
                self.assert_refused(self.run_mesh("--resume"), CANNOT_WRITE, f"out/{name} is a symbolic link")
                self.assertEqual(content_of(self.elsewhere), before)

    def test_folders_are_replaced_when_asked_to(self):
        names = (*self.FOLDERS, "failure", "dry_run")
        before = self.prepare(names, is_folder=True)
        outcome = self.run_mesh("--overwrite")
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual([name for name in names if (self.out / name).is_symlink()], [])
        self.assertEqual(content_of(self.elsewhere), before)

    def test_folder_of_failed_jobs(self):
        fault = os.environ | {"TESSERA_TEST_FAULT": "fill=throw@1"}
        for name in ("failure", "failure/inputs"):
            with self.subTest(name):
                before = self.prepare([name], is_folder=True)
                # One rank: others keep jobs without a word.
                outcome = self.run_program(
                    "mesh", self.case, "--output", "out", "--progress", "never", "--resume", env=fault
                )
                self.assertEqual(outcome.code, DEGRADED, outcome.err)
                self.assertIn(f"out/{name} is a symbolic link", outcome.out)
                self.assertEqual(content_of(self.elsewhere), before)

    def test_samples_of_a_dry_run(self):
        before = self.prepare(["dry_run"], is_folder=True)
        outcome = self.run_mesh("--dry-run")
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual(content_of(self.elsewhere), before)

    def test_lock(self):
        before = self.prepare(["log"], is_folder=True)
        (self.out / ".tessera.lock").unlink()
        (self.out / ".tessera.lock").symlink_to(self.elsewhere / "0" / "precious")
        for how in ("--resume", "--overwrite"):
            self.assert_refused(self.run_mesh(how), CANNOT_WRITE, "cannot write to folder out")
        self.assertEqual(content_of(self.elsewhere), before)

    def test_finished_run_takes_no_piece_from_elsewhere(self):
        """The same bytes behind a link: the piece is made again."""
        settings = ("--set", "fill.kernel='subdivide'")
        self.assertEqual(self.run_mesh(*settings).code, OK)
        sound = program.mesh_files(self.out)
        shutil.rmtree(self.out)
        (self.out / "report.json" / "foreign").mkdir(parents=True)
        (self.out / ".tessera.lock").touch()
        self.assertEqual(self.run_mesh("--resume", *settings).code, CANNOT_WRITE)
        shutil.rmtree(self.out / "report.json")
        for file in ("mesh/piece_000000.vtu", "pieces/piece_000001.record"):
            moved = self.folder / file.replace("/", "_")
            shutil.move(self.out / file, moved)
            (self.out / file).symlink_to(moved)
        self.assertEqual(self.run_mesh("--resume", *settings).code, OK)
        self.assertEqual(program.mesh_files(self.out), sound)
        self.assertFalse(any(path.is_symlink() for path in self.out.rglob("*")))

    def test_repartition(self):
        mesh = self.mesh(self.case, "mesh") / "mesh.pvtu"
        for names, is_folder in ((("mesh", "boundary"), True), (("mesh.pvtu", "boundary.pvtu", "report.json"), False)):
            with self.subTest(names):
                before = self.prepare(names, is_folder=is_folder)
                outcome = self.run_program("repartition", mesh, "--parts", 2, "--output", "out", "--overwrite")
                self.assertEqual(outcome.code, OK, outcome.err)
                self.assertEqual(content_of(self.elsewhere), before)

    def test_output_folder_may_be_a_link(self):
        self.elsewhere.mkdir()
        self.out.symlink_to(self.elsewhere)
        self.assertEqual(self.run_mesh().code, OK)
        self.assertEqual(self.run_mesh("--overwrite").code, OK)
        self.assertEqual(self.run_mesh("--resume").code, OK)
        self.assertTrue((self.elsewhere / "mesh.pvtu").is_file())
        self.assertTrue(self.out.is_symlink())


if __name__ == "__main__":
    unittest.main()
