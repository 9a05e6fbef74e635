#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a wheel for pip of a package with MPI inside.

    cd build/release && cpack -G TGZ -D TESSERA_MPI_INSIDE=ON
    ../../pipeline/tools/make_wheel.py tessera-*-mpi.tar.gz

It has the Python package and, for the prefix of the environment, the program with all that it needs.
Needs Debian's python3-wheel, which belongs to /usr/bin/python3.
"""
import argparse
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile

DESCRIPTION = """
This wheel has the program `tessera`, the Python package `tessera`, and an Open MPI for one machine:

    tessera-mpirun -n 2 tessera mesh part.step --size 0.5 --output out

On a cluster, ranks must be started by the cluster's own MPI. Unpack the package without MPI there, or build
Tessera, and let the environment variable TESSERA name that program: `import tessera` then runs it with the
`mpirun` in PATH. Reading meshes needs VTK: `pip install vtk`.
"""


def wanted_glibc(folder: pathlib.Path) -> int:
    """The minor version of the oldest glibc 2 that all programs and libraries run with."""
    files = (file for file in folder.rglob("*") if file.is_file() and file.read_bytes()[:4] == b"\x7fELF")
    return max(int(minor) for file in files for minor in re.findall(rb"\0GLIBC_2\.(\d+)\0", file.read_bytes()))


def lay_out(tree: pathlib.Path, wheel: pathlib.Path, name: str) -> None:
    """Moves what is in an unpacked package to where a wheel has it: no headers, no links."""
    packages = tree / "lib/python3/dist-packages"
    for part in ("tessera", f"{name}.dist-info"):
        shutil.move(packages / part, wheel / part)
    for folder in (tree / "include", tree / "lib/python3", *tree.glob("lib/**/cmake")):
        shutil.rmtree(folder)
    for link in (file for file in sorted(tree.rglob("*")) if file.is_symlink()):
        target = link.resolve()
        link.unlink()
        if link.suffix != ".so" and target.exists():
            target.rename(link)
    data = wheel / f"{name}.data"
    data.mkdir()
    shutil.move(tree, data / "data")


def make_wheel(package: pathlib.Path, output: pathlib.Path) -> None:
    with tempfile.TemporaryDirectory() as scratch:
        with tarfile.open(package) as archive:
            archive.extractall(scratch)
        (tree,) = pathlib.Path(scratch).iterdir()
        if not (tree / "bin/tessera-mpirun").is_file():
            sys.exit(f"make_wheel.py: {package} has no MPI inside: cpack -G TGZ -D TESSERA_MPI_INSIDE=ON")
        (info,) = tree.glob("lib/python3/dist-packages/*.dist-info")
        wheel = pathlib.Path(scratch) / "wheel"
        wheel.mkdir()
        tag = f"py3-none-manylinux_2_{wanted_glibc(tree)}_{platform.machine()}"
        lay_out(tree, wheel, info.stem)
        info = wheel / info.name
        fields = (info / "METADATA").read_text().rstrip("\n")
        fields += "\nRequires-Python: >=3.9\nDescription-Content-Type: text/markdown\n"
        (info / "METADATA").write_text(fields + DESCRIPTION)
        (info / "WHEEL").write_text(
            f"Wheel-Version: 1.0\nGenerator: make_wheel.py\nRoot-Is-Purelib: false\nTag: {tag}\n"
        )
        subprocess.run([sys.executable, "-m", "wheel", "pack", wheel, "--dest-dir", output], check=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("package", type=pathlib.Path, help="the .tar.gz that cpack has made")
    parser.add_argument("--output", type=pathlib.Path, default=".", help="folder for the wheel; default: this one")
    arguments = parser.parse_args()
    make_wheel(arguments.package, arguments.output)


if __name__ == "__main__":
    main()
