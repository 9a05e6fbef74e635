# SPDX-License-Identifier: BSD-3-Clause
"""`cpack -G DEB`: what is in the package, and that it works where it is unpacked."""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import program

BUILD = pathlib.Path(os.environ["TESSERA_BUILD"])
CPACK = os.environ["TESSERA_CPACK"]

# Of each kind of file one; configs/ is compared as a whole.
FILES = (
    "bin/tessera",
    "include/tessera/io/vtu.hpp",
    "lib/python3/dist-packages/tessera/__init__.py",
    "lib/python3/dist-packages/tessera/py.typed",
    "share/man/man1/tessera.1.gz",
    "share/bash-completion/completions/tessera",
    "share/doc/tessera/copyright",
    "share/doc/tessera/changelog.gz",
    "share/doc/tessera/README.md",
    "share/doc/tessera/docs/user_guide.md",
)
COMPLETE = """
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_tessera
printf '%s\\n' "${COMPREPLY[@]}"
"""


def output_of(*command, **options):
    return subprocess.run(command, check=True, capture_output=True, text=True, **options).stdout


class Package(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        folder = cls.make_maker().folder
        made = folder / "made"
        output_of(CPACK, "-G", "DEB", "-B", made, cwd=BUILD)
        (cls.package,) = made.glob("*.deb")
        output_of("dpkg-deb", "-x", cls.package, folder / "root")
        cls.usr = folder / "root" / "usr"

    def test_the_control_file_says_what_it_is_and_needs(self):
        fields = output_of("dpkg-deb", "-f", self.package)
        architecture = output_of("dpkg", "--print-architecture").strip()
        version = output_of(program.PROGRAM, "--version").split()[1]
        self.assertEqual(self.package.name, f"tessera_{version}_{architecture}.deb")
        self.assertIn("Package: tessera\n", fields)
        self.assertIn(f"Version: {version}\n", fields)
        self.assertIn("Section: science\n", fields)
        depends = next(line for line in fields.splitlines() if line.startswith("Depends: "))
        for needed in ("openmpi-bin", "libopenmpi", "libc6", "libnglib", "libocct-", "libmetis5", "libvtk9"):
            self.assertRegex(depends, rf"[ ,]{needed}")
        self.assertNotRegex(depends, r"-dev\b")

    def test_all_files_are_there_and_nothing_outside_of_usr(self):
        for file in FILES:
            self.assertTrue((self.usr / file).is_file(), file)
        for file in ("libtessera.so", "cmake/tessera/tesseraConfig.cmake"):
            self.assertEqual(len([*self.usr.glob(f"lib/**/{file}")]), 1, file)
        self.assertEqual([entry.name for entry in self.usr.parent.iterdir()], ["usr"])
        self.assertEqual([entry.name for entry in (self.usr / "bin").iterdir()], ["tessera"])
        for given in program.CONFIGS.rglob("*"):
            if given.is_file():
                installed = self.usr / "share" / "tessera" / given.relative_to(program.CONFIGS)
                self.assertEqual(installed.read_bytes(), given.read_bytes(), installed)

    def test_the_program_meshes_and_checks_where_it_is_unpacked(self):
        tessera = self.usr / "bin" / "tessera"
        case = self.usr / "share" / "tessera" / "cases" / "brick.toml"
        libraries = output_of("ldd", tessera)
        self.assertRegex(libraries, rf"libtessera\.so\S* => {self.usr}/")
        for command in (
            ["mesh", case, "--output", "out", "--progress", "never", "--set", "size.target=0.3"],
            ["check", "out/mesh.pvtu"],
        ):
            outcome = self.finish(self.start_command([program.MPIEXEC, "-n", "2", tessera, *command]))
            self.assertEqual(outcome.code, program.OK, outcome.err + outcome.out)

    def test_python_finds_the_program_beside_the_package_and_meshes(self):
        packages = self.usr / "lib/python3/dist-packages"
        self.assertEqual([*packages.rglob("__pycache__")], [])
        case = self.usr / "share/tessera/cases/brick.toml"
        code = (
            "import sys, tessera\n"
            "mesh = tessera.mesh(sys.argv[1], keys={'size.target': 0.3}, quiet=True, ranks=2)\n"
            "print(tessera.__file__, tessera.find_program(), tessera.__version__)\n"
            "print(len(mesh.cells) == mesh.report['num_tets'] > 0)\n"
        )
        environment = {k: v for k, v in os.environ.items() if k != "TESSERA"} | {"PYTHONPATH": str(packages)}
        process = self.start_command([sys.executable, "-B", "-c", code, str(case)], env=environment)
        outcome = self.finish(process)
        version = output_of(program.PROGRAM, "--version").split()[1]
        found = [f"{packages}/tessera/__init__.py", f"{self.usr}/bin/tessera", version, "True"]
        self.assertEqual(outcome.out.split(), found, outcome.err)

    def complete(self, *words):
        """What bash offers for the last word, in the folder of this test."""
        script = self.usr / "share/bash-completion/completions/tessera"
        return output_of("bash", "-c", COMPLETE, "-", script, *words, cwd=self.folder).split()

    def test_bash_completes_commands_options_files_and_words(self):
        for name in ("a.toml", "b.pvtu", "c.vtu", "d.txt", "e.step"):
            self.write(name, "")
        (self.folder / "folder").mkdir()
        for words, offered in (
            ([""], ["mesh", "check", "repartition", "convert", "info", "compare", "replay"]),
            (["--v"], ["--version"]),
            (["mesh", "--ov"], ["--overwrite"]),
            (["mesh", ""], ["a.toml", "e.step", "folder"]),
            (["mesh", "e.step", "--kernel", "s"], ["subdivide"]),
            (["check", "--partial", ""], ["b.pvtu", "c.vtu", "folder"]),
            (["info", ""], ["a.toml", "b.pvtu", "c.vtu", "d.txt", "e.step", "folder"]),
            (["mesh", "a.toml", "--output", ""], ["folder"]),
            (["mesh", "--progress", "a"], ["auto", "always"]),
            (["mesh", "--progress", "=", "n"], ["never"]),
            (["mesh", "--ranks", ""], []),
            (["mesh", "--set", "coarse.max"], ["coarse.max_size="]),
            (["mesh", "--set", "output.compression", "=", "n"], ["none"]),
            (["mesh", "--set", "=", "output.cell_quality", "="], ["true", "false"]),
            (["mesh", "--set", "refine.levels", "=", "2", ""], ["a.toml", "e.step", "folder"]),
        ):
            with self.subTest(words=words):
                self.assertEqual(self.complete("tessera", *words), offered)

    def test_every_option_of_the_help_is_in_the_man_page(self):
        page = gzip.decompress((self.usr / "share/man/man1/tessera.1.gz").read_bytes()).decode()
        plain = page.replace("\\%", "").replace("\\-", "-")
        commands = self.complete("tessera", "")
        for command in commands:
            self.assertIn(f".SS tessera {command} ", plain)
            for option in re.findall(r"--[a-z-]+", output_of(program.PROGRAM, command, "--help")):
                self.assertIn(option, plain)
        if shutil.which("groff"):
            formatted = subprocess.run(
                ["groff", "-man", "-ww", "-Tutf8"], input=page, check=True, capture_output=True, text=True
            )
            self.assertEqual(formatted.stderr, "")
            self.assertIn("EXIT STATUS", re.sub(".\b", "", formatted.stdout))


if __name__ == "__main__":
    unittest.main()
