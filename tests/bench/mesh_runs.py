# SPDX-License-Identifier: BSD-3-Clause
"""What the benches that run `tessera mesh` share: what to mesh, one run, its figures."""
import argparse
import dataclasses
import json
import os
import pathlib
import resource
import subprocess
import sys
import time

GMSH = pathlib.Path(__file__).resolve().parent / "gmsh_hxt"
MILLIMETRES = {"in": 25.4, "cm": 10.0, "m": 1000.0}

@dataclasses.dataclass(frozen=True)
class Subject:
    """What a bench meshes: a model with its size, or a case file as it is."""
    name: str
    file: pathlib.Path
    size: str  # Empty: `file` is a case.
    is_target: bool = False  # The size is `size.target`, not `coarse.max_size`.

    def case_in(self, folder):
        if not self.size:
            return self.file
        case = folder / "case.toml"
        key = "size.target" if self.is_target else "coarse.max_size"
        case.write_text(f"geometry.file = '{self.file}'\n{key} = {self.size}\n")
        return case


def subject(argument):
    """MODEL=MAX_SIZE or CASE.toml, for argparse."""
    file, _, size = argument.rpartition("=") if "=" in argument else (argument, "", "")
    path = pathlib.Path(file).resolve()
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"{path} is no file")
    if not size and path.suffix != ".toml":
        raise argparse.ArgumentTypeError(f"{argument}: MODEL=MAX_SIZE or CASE.toml expected")
    return Subject(f"{path.name}, {size}" if size else path.stem, path, size)


@dataclasses.dataclass(frozen=True)
class Run:
    """What a run said and took. CPU time is that of all ranks and jobs, and of mpirun."""
    report: dict
    wall_s: float
    cpu_s: float

    @property
    def tets(self):
        return self.report["num_tets"]

    @property
    def unit_of_gmsh(self):
        """How many of Gmsh's units one of ours is: it takes STEP in millimetres."""
        return MILLIMETRES.get(self.report["model"]["length_unit"], 1.0)

    def stage_cpu_s(self, name):
        return sum(stage["cpu_s"] for stage in self.report["stages"] if stage["name"] == name)

    def quality(self):
        """Mean, 1st percentile and minimum of the mean ratio, smallest angle."""
        found = self.report["quality"]
        return {**{name: found["mean_ratio"][name] for name in ("mean", "p01", "min")},
                "angle": found["min_dihedral_deg"]}


def cpu_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_mesh(program, what, overrides, work, ranks=2):
    """One run of a subject in the folder `work`. A degraded one counts; any other failure ends the bench."""
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    command = ["mpirun", "-n", str(ranks), "--bind-to", "none", "--oversubscribe", program, "mesh",
               what.case_in(work), "--output", work / "mesh", "--overwrite", "--quiet"]
    for override in overrides:
        command += ["--set", override]
    start, cpu = time.monotonic(), cpu_of_children()
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    wall_s, cpu_s = time.monotonic() - start, cpu_of_children() - cpu
    if done.returncode not in (0, 3):
        sys.exit(f"{what.name} with {', '.join(overrides)}: exit code {done.returncode}\n{done.stderr}")
    return Run(json.loads((work / "mesh" / "report.json").read_text()), wall_s, cpu_s)


def gmsh(*arguments):
    """What gmsh_hxt prints, in a process of its own. Its failure ends the bench."""
    done = subprocess.run([GMSH, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"gmsh_hxt {' '.join(map(str, arguments))}: exit code {done.returncode}\n{done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])
