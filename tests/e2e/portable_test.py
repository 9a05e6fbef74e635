# SPDX-License-Identifier: BSD-3-Clause
"""`cpack -G TGZ`, with and without MPI inside, and the wheel: they need nothing of this machine but glibc and MPI."""
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest

import program

BUILD = pathlib.Path(os.environ["TESSERA_BUILD"])
CPACK = os.environ["TESSERA_CPACK"]
MAKE_WHEEL = pathlib.Path(__file__).resolve().parents[2] / "pipeline/tools/make_wheel.py"

GLIBC = re.compile(r"(ld-linux.*|lib(c|dl|m|mvec|pthread|resolv|rt|util))\.so\.\d+")
# What the package without MPI leaves to the machine: MPI, and the C++ runtime, which both use.
OF_HOST = re.compile(GLIBC.pattern + r"|lib(mpi|gcc_s|stdc\+\+)\.so\.\d+")
# No setting of this machine, but what Open MPI asks of root and of few cores, and version 5 for its files.
ENVIRONMENT = {"PATH": "/usr/bin:/bin", "HOME": os.environ["HOME"]} | {
    name: value for name, value in os.environ.items() if name.startswith(("OMPI_", "PRTE_"))
}


def output_of(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


def programs_and_libraries(tree):
    for file in sorted(tree.rglob("*")):
        if file.is_file() and not file.is_symlink() and file.read_bytes()[:4] == b"\x7fELF":
            yield file


def children_cpu_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


# MPI goes inside of Open MPI 4 alone; `cpack` refuses it with another one.
MPI_MAY_GO_INSIDE = " 4." in output_of(program.MPIEXEC, "--version").splitlines()[0]


def setUpModule():
    """Makes both packages at once, each takes one core."""
    kinds = (Portable, WithMpi) if MPI_MAY_GO_INSIDE else (Portable,)
    made = pathlib.Path(tempfile.mkdtemp(prefix="tessera_e2e_"))
    unittest.addModuleCleanup(shutil.rmtree, made)
    started = [
        subprocess.Popen([CPACK, "-G", "TGZ", "-B", made / kind.__name__, *kind.OPTIONS], cwd=BUILD, stdout=subprocess.DEVNULL)
        for kind in kinds
    ]
    for process in started:
        assert process.wait() == 0, process.args
    for kind in kinds:
        (kind.package,) = (made / kind.__name__).glob("*.tar.gz")


class Portable(program.ProgramTest):
    """Without MPI."""

    OPTIONS = ()
    SUFFIX = ""
    LEFT_TO_HOST = OF_HOST
    CASES = {"cases/brick.toml": ("--set", "size.target=0.3")}

    @classmethod
    def setUpClass(cls):
        place = cls.make_maker().folder / "moved to"  # A path with a blank.
        with tarfile.open(cls.package) as archive:
            archive.extractall(place)
        cls.tree = place / cls.package.name.removesuffix(".tar.gz")
        (cls.libraries,) = (library.parent for library in cls.tree.glob("lib/**/libtessera.so"))

    def mpirun(self):
        return program.MPIEXEC

    def run_packed(self, *command):
        return self.finish(self.start_command([str(word) for word in command], env=ENVIRONMENT))

    def test_it_is_named_after_what_it_is(self):
        version, machine = output_of(program.PROGRAM, "--version").split()[1], os.uname().machine
        self.assertEqual(self.package.name, f"tessera-{version}-linux-{machine}{self.SUFFIX}.tar.gz")

    def test_all_that_is_needed_is_inside(self):
        """What each file names, where it looks first, and what the loader takes for the program."""
        inside = {file.name for file in self.libraries.iterdir()}
        self.assertEqual({name for name in inside if GLIBC.fullmatch(name)}, set())
        files = [*programs_and_libraries(self.tree)]
        self.assertGreater(len(files), 100)
        for file, said in zip(files, output_of("objdump", "-p", *files).split("file format")[1:], strict=True):
            (way,) = re.findall(r" RPATH +\$ORIGIN/(.*)", said)
            self.assertEqual((file.parent / way).resolve(), self.libraries.resolve(), file)
            left = set(re.findall(r"NEEDED +(\S+)", said)) - inside
            self.assertEqual({name for name in left if not self.LEFT_TO_HOST.fullmatch(name)}, set(), file)
        (behind_door,) = self.libraries.glob("libtessera_netgen.so.?")
        said = output_of("ldd", self.tree / "bin/tessera", behind_door, env=ENVIRONMENT)
        loaded = re.findall(r"(\S+) => (.+) \(0x", said)
        self.assertGreater(len(loaded), 100)
        for name, found in loaded:
            if name in inside:
                self.assertEqual(pathlib.Path(found).resolve().parent, self.libraries.resolve(), name)

    def test_licences_of_all_that_is_inside_go_along(self):
        licenses = self.tree / "share/doc/tessera/licenses"
        packages = re.findall(r"^(\S+) \S+, source \S+ \S+$", (licenses / "list.txt").read_text(), re.MULTILINE)
        for package in ("libnglib", "libocct-foundation", "libmetis", "libvtk9", "libcli11-dev", "libjs-three"):
            self.assertTrue(any(name.startswith(package) for name in packages), package)
        for package in packages:
            self.assertGreater((licenses / f"{package}.txt").stat().st_size, 100, package)
        self.assertIn("LESSER GENERAL PUBLIC", (licenses / "common-licenses/LGPL-2.1").read_text())

    def test_it_starts_in_less_than_a_second(self):
        before = children_cpu_s()
        self.assertEqual(self.run_packed(self.tree / "bin/tessera", "--version").code, program.OK)
        self.assertLess(children_cpu_s() - before, 1.0)

    def test_it_meshes_as_the_program_that_was_built(self):
        for case, options in self.CASES.items():
            with self.subTest(case=case):
                file = self.tree / "share/tessera" / case
                arguments = ["mesh", file, *options, "--progress", "never", "--overwrite", "--output"]
                ranks = [self.mpirun(), "-n", "2", self.tree / "bin/tessera"]
                packed = self.run_packed(*ranks, *arguments, "packed")
                self.assertEqual((packed.code, packed.err), (program.OK, ""))
                self.assertEqual(self.run_program(*arguments, "built").code, program.OK)
                reports = (json.loads((self.folder / who / "report.json").read_text()) for who in ("packed", "built"))
                self.assertEqual(*(report["digest"] for report in reports))
        alone = self.run_packed(self.tree / "bin/tessera", "check", "packed/mesh.pvtu")
        self.assertEqual((alone.code, alone.err), (program.OK, ""))


@unittest.skipIf(MPI_MAY_GO_INSIDE, "it is not refused")
class MpiOfAnotherKind(unittest.TestCase):
    def test_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([CPACK, "-G", "TGZ", "-B", folder, *WithMpi.OPTIONS], cwd=BUILD, capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("TESSERA_MPI_INSIDE is for Open MPI 4", done.stderr)


@unittest.skipUnless(MPI_MAY_GO_INSIDE, "it is refused, see above")
class WithMpi(Portable):
    """With MPI inside, for one machine; and the wheel that is made of it."""

    OPTIONS = ("-D", "TESSERA_MPI_INSIDE=ON")
    SUFFIX = "-mpi"
    LEFT_TO_HOST = GLIBC
    CASES = {**Portable.CASES, "geometry/bracket.step": ("--size", "2")}

    def mpirun(self):
        return self.tree / "bin/tessera-mpirun"

    def test_ranks_of_another_mpirun_are_refused(self):
        outcome = self.run_packed(program.MPIEXEC, "-n", "2", self.tree / "bin/tessera", "--version")
        self.assertEqual(outcome.code, program.WRONG_INPUT, outcome.err)
        self.assertIn("tessera-mpirun", outcome.messages[0])

    def test_the_wheel_brings_program_and_package(self):
        output_of("/usr/bin/python3", MAKE_WHEEL, self.package, "--output", self.folder)
        (wheel,) = self.folder.glob("*.whl")
        self.assertRegex(wheel.name, rf"^tessera-[\d.]+-py3-none-manylinux_2_\d+_{os.uname().machine}\.whl$")
        place = self.folder / "an environment"
        # NumPy is that of this machine.
        output_of(sys.executable, "-m", "venv", "--system-site-packages", place)
        output_of(place / "bin/pip", "install", "--no-index", "--no-deps", wheel)
        (metadata,) = place.glob("lib/*/site-packages/tessera-*.dist-info/METADATA")
        self.assertIn("On a cluster", metadata.read_text())
        code = (
            "import pathlib, sys, tessera\n"
            "mesh = tessera.mesh(sys.argv[1], keys={'size.target': 0.3}, quiet=True, ranks=2)\n"
            "print(tessera.find_program(), tessera.__version__, len(mesh.cells) == mesh.report['num_tets'] > 0)\n"
        )
        case = place / "share/tessera/cases/brick.toml"
        outcome = self.run_packed(place / "bin/python", "-c", code, case)
        version = output_of(program.PROGRAM, "--version").split()[1]
        self.assertEqual(outcome.out, f"{place}/bin/tessera {version} True\n", outcome.err)
        self.assertEqual(self.run_packed(place / "bin/tessera", "--version").out, f"tessera {version}\n")
        output_of(place / "bin/pip", "uninstall", "--yes", "tessera")
        self.assertEqual([*place.rglob("*tessera*")], [])


if __name__ == "__main__":
    unittest.main()
