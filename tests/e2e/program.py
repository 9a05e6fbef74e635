# SPDX-License-Identifier: BSD-3-Clause
"""What the end-to-end tests share: starting the program, tiny models and cases, its processes."""
import contextlib
import dataclasses
import glob
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["TESSERA_PROGRAM"]
MPIEXEC = os.environ["TESSERA_MPIEXEC"]
CONFIGS = pathlib.Path(__file__).resolve().parents[2] / "configs"

# Runs here take seconds; one that takes this long, also on a busy machine, hangs.
HANG_S = 180.0

# Exit codes of the program.
OK, FAILED, DEGRADED, WRONG_INPUT, INTERNAL, CANNOT_WRITE, STOPPED = 0, 2, 3, 64, 70, 73, 75

# For cases of tests that do not look at the report's page: its pictures take a third of a tiny run.
NO_PAGE = "output.report_html = false\n"

BALL = "algebraic3d\nsolid ball = sphere (0, 0, 0; 1);\ntlo ball;\n"

# A ball of one material in a shell of another.
TWO_MATERIALS = (
    "algebraic3d\nsolid core = sphere (0, 0, 0; 1);\nsolid all = sphere (0, 0, 0; 2);\n"
    "solid shell = all and not core;\ntlo core;\ntlo shell;\n"
)

CUBE_CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
CUBE_TRIANGLES = [  # Rows of CUBE_CORNERS, normals outwards.
    (0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
    (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5),
]  # fmt: skip


def stl_text(triangles, corners=CUBE_CORNERS):
    """An ASCII STL file of triangles given by rows of `corners`."""
    facets = (
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*corners[c]) for c in triangle)
        + "endloop\nendfacet\n"
        for triangle in triangles
    )
    return "solid model\n" + "".join(facets) + "endsolid model\n"


@dataclasses.dataclass
class Outcome:
    """How the program ended."""

    code: int
    out: str
    err: str

    @property
    def messages(self):
        """What the program itself, not mpirun, said on standard error: one text a message."""
        return re.findall(r"^tessera: .*(?:\n  .*)*", self.err, re.MULTILINE)


def command_line(arguments, ranks):
    """`ranks` None: the bare program, without mpirun."""
    start = [] if ranks is None else [MPIEXEC, "-n", str(ranks)]
    return [*start, PROGRAM, *map(str, arguments)]


def with_setting_of_rank(variable, values, command):
    """`command` for mpirun, with a value of an environment variable for each rank. Several programs, with `:` between them,
    would do the same, but mpirun of Debian 13 (Open MPI 5.0.7) dies of them."""
    script = (
        'variable=$1 rank=${OMPI_COMM_WORLD_RANK:-$PMI_RANK} number=$2; shift 2\n'
        'eval "export $variable=\\${$((rank + 1))}"; shift "$number"; exec "$@"'
    )
    return ["sh", "-c", script, "sh", variable, str(len(values)), *values, *map(str, command)]


def mpi_files_in(folder):
    """Settings by which Open MPI 4 and 5 put their own files into a folder."""
    return {"OMPI_MCA_orte_tmpdir_base": str(folder), "PRTE_MCA_prte_tmpdir_base": str(folder)}


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own that runs the program in it."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tessera_e2e_"))
        self.addCleanup(shutil.rmtree, self.folder)

    @classmethod
    def make_maker(cls):
        """A test whose folder lasts as long as the class, for what all of its tests share."""
        maker = ProgramTest()
        maker.setUp()
        cls.addClassCleanup(maker.doCleanups)
        return maker

    def write(self, name, content):
        """Writes a text or bytes into the folder."""
        file = self.folder / name
        file.write_bytes(content if isinstance(content, bytes) else content.encode())
        return file

    def write_case(self, name="case.toml", geometry="ball.geo", max_size=0.7, subdomains=4, levels=1, page=False):
        """A case of a second or two; ball.geo is made if the case names it. `page`: with report.html."""
        if geometry == "ball.geo":
            self.write(geometry, BALL)
        return self.write(
            name,
            f"geometry.file = '{geometry}'\ncoarse.max_size = {max_size}\n"
            f"decompose.subdomains = {subdomains}\nrefine.levels = {levels}\n{'' if page else NO_PAGE}",
        )

    def start(self, *arguments, ranks=None, **options):
        """Starts the program in the folder; what it leaves running ends with the test."""
        if ranks is None:
            options["env"] = self.without_daemon(options.get("env") or os.environ)
        return self.start_command(command_line(arguments, ranks), **options)

    def without_daemon(self, env):
        """For the bare program: Open MPI 4 does not start its daemon, which takes as long as a small run. What a user has
        is in portable_test.py. Each process has a folder of its own: one that ends removes what is in it."""
        folder = tempfile.mkdtemp(prefix="tessera_mpi_")
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        return {"OMPI_MCA_ess_singleton_isolated": "1", **mpi_files_in(folder), **env}

    def start_command(self, command, **options):
        """The same with a command of its own."""
        # The program of users obeys no fault, so the test might pass for nothing.
        if {"TESSERA_TEST_FAULT", "TESSERA_TEST_LIMITS"} & set(options.get("env") or ()):
            self.assertEqual(pathlib.Path(PROGRAM).parts[-3:], ("tests", "bin", "tessera"), "tests/faults is asked for")
        process = subprocess.Popen(
            command,
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            **options,
        )
        self.addCleanup(end_tree, process)
        return process

    def finish(self, process, within_s=HANG_S):
        """Waits for a started program; one that takes longer fails the test."""
        try:
            out, err = process.communicate(timeout=within_s)
        except subprocess.TimeoutExpired:
            self.fail(f"{process.args} has not ended after {within_s} s")
        # Not the text mode of subprocess, which makes line feeds of carriage returns.
        return Outcome(process.returncode, out.decode(), err.decode())

    def run_program(self, *arguments, ranks=None, **options):
        return self.finish(self.start(*arguments, ranks=ranks, **options))

    def mesh(self, case, output, *arguments, ranks=None, **options):
        """Runs a case that must end well; its folder."""
        outcome = self.run_program(
            "mesh", case, "--output", output, "--progress", "never", *arguments, ranks=ranks, **options
        )
        self.assertEqual(outcome.code, OK, outcome.err)
        return self.folder / output

    def assert_checked(self, folder, volume_tolerance):
        """What `check` finds in the files is what the report says. Gives both."""
        reported = figures(folder)
        outcome = self.run_program("check", folder / "mesh.pvtu", "--json")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        found = json.loads(outcome.out)
        for key in ("digest", "num_tets", "num_vertices"):
            self.assertEqual(found[key], reported[key], key)
        self.assertAlmostEqual(found["volume"], reported["volume"], delta=volume_tolerance * reported["volume"])
        return reported, found

    def assert_refused(self, outcome, code, *words):
        """Ended with `code` and one message that holds `words`, and nothing like a crash."""
        self.assertEqual(outcome.code, code, outcome.err + outcome.out)
        self.assertEqual(len(outcome.messages), 1, outcome.err)
        for word in words:
            self.assertIn(str(word), outcome.messages[0])
        self.assertNotRegex(
            outcome.err + outcome.out,
            r"terminate called|\*\*\* Process received|MPI_ABORT|Sanitizer|runtime error|internal error",
        )


class ResultTest(ProgramTest):
    """Looks at one result: made once by `make_result(maker)`, copied to `self.out` for each test."""

    @classmethod
    def setUpClass(cls):
        maker = ProgramTest()
        maker.setUp()
        cls.addClassCleanup(maker.doCleanups)
        cls.result = cls.make_result(maker)

    def setUp(self):
        super().setUp()
        self.out = shutil.copytree(self.result, self.folder / "out")
        self.report = json.loads((self.out / "report.json").read_text())


def sets(*values):
    """The options that set keys: "table.key=value"."""
    return [word for value in values for word in ("--set", value)]


def mesh_files(folder):
    """Hash of every file of the mesh."""
    files = [*folder.glob("*.pvtu"), *folder.glob("mesh/*"), *folder.glob("boundary/*")]
    return {
        file.relative_to(folder).as_posix(): hashlib.sha256(file.read_bytes()).hexdigest()
        for file in files
    }


def figures(folder):
    """The report without what is allowed to differ: times, memory, ranks, whether it was resumed."""
    report = json.loads((folder / "report.json").read_text())
    for key in ("wall_time_s", "tets_per_second", "peak_rss_bytes_max", "stages", "num_ranks", "resumed"):
        del report[key]
    for subdomain in report["subdomains"]:
        del subdomain["seconds"]
    return report


def wait_until(condition, what, within_s=HANG_S):
    """The first true value of `condition`, polled."""
    end = time.monotonic() + within_s
    while time.monotonic() < end:
        if value := condition():
            return value
        time.sleep(0.01)
    raise AssertionError(f"waited {within_s} s in vain: {what}")


def num_filled(output):
    """How many pieces a run has in its store. A run begins with a store of nothing: it may remove the folder meanwhile,
    which pathlib's glob would raise for."""
    return len(glob.glob("piece_*.record", root_dir=output / "pieces"))


def is_running(pid):
    """Not gone, and no zombie that only waits for its parent."""
    return (stat := _stat(pid)) is not None and stat[0] not in "ZX"


def children(pid):
    """Processes started by `pid`, in the order of their numbers."""
    numbers = sorted(int(entry) for entry in os.listdir("/proc") if entry.isdigit())
    return [child for child in numbers if (stat := _stat(child)) and int(stat[1]) == pid]


def descendants(pid):
    """All processes that come from `pid`, itself not included."""
    below = {}
    for number in sorted(int(entry) for entry in os.listdir("/proc") if entry.isdigit()):
        if stat := _stat(number):
            below.setdefault(int(stat[1]), []).append(number)

    def all_below(parent):
        for child in below.get(parent, []):
            yield child
            yield from all_below(child)

    return [*all_below(pid)]


def is_program(pid):
    """Whether a process is the program: a rank or one that it forked."""
    with contextlib.suppress(OSError):
        return os.path.samefile(f"/proc/{pid}/exe", PROGRAM)
    return False


def program_children(pid):
    return [child for child in children(pid) if is_program(child)]


def ranks_of(process):
    """The rank processes under mpirun."""
    return program_children(process.pid)


def chain_of(rank):
    """Zygote, model zygote and job below a rank process: as many of them as there are."""
    chain = []
    while below := program_children(chain[-1] if chain else rank):
        chain.append(below[0])
    return chain


def workers_of_node(ranks):
    """Zygote, model zygote and job as chain_of(), of the rank that has the model zygote for all ranks of a node."""
    return max(map(chain_of, ranks), key=len)


def end_tree(process):
    """Ends a program and everything it started."""
    for pid in descendants(process.pid):
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
    if process.poll() is None:
        process.kill()
    process.wait()
    for stream in (process.stdout, process.stderr):
        if stream:
            stream.close()


def _stat(pid):
    """State and parent of a process, and what follows; None if it is gone."""
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8", errors="replace") as stat:
            return stat.read().rpartition(")")[2].split()
    except OSError:
        return None
