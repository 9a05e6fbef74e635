# SPDX-License-Identifier: BSD-3-Clause
"""Results of a bench as data: a JSON file of rows, with the commit, machine, date and command that made
them. make_pages makes the pages from such files."""
import datetime
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MEASURED = ("CMakeLists.txt", "cmake", "configs", "include", "pipeline", "src", "tests/bench/*.cpp")
UNCOMMITTED = "+"  # Behind the commit: sources differ from it.
DIGITS = 6         # Of a figure.
LOAD = os.getloadavg()[0]  # Before the bench itself has begun.


def add_option(parser):
    parser.add_argument("--data", type=pathlib.Path, metavar="FILE", help="also write the rows as data")


def write(file, rows, libraries=None, made_by=None):
    """Nothing without a file, so that a bench can pass on its option as it is. `made_by`: another command."""
    if file is None:
        return
    save(file, {"command": made_by or command(), "commit": commit(), "date": datetime.date.today().isoformat(),
                "machine": machine(), "libraries": libraries or {}, "rows": rows})


def save(file, data):
    """One row a line, so that a diff shows which have changed."""
    *head, _ = data
    lines = [f"  {json.dumps(key)}: {json.dumps(rounded(data[key]), ensure_ascii=False)},\n" for key in head]
    rows = ",\n".join(f"    {json.dumps(rounded(row), ensure_ascii=False)}" for row in data["rows"])
    file.write_text("{\n" + "".join(lines) + '  "rows": [\n' + rows + "\n  ]\n}\n")


def rounded(value):
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(one) for one in value]
    return float(f"{value:.{DIGITS}g}") if isinstance(value, float) else value


def git(*arguments):
    if not shutil.which("git"):  # As in the roots of tests/on_debian.
        return ""
    done = subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else ""


def commit():
    return git("rev-parse", "HEAD") + (UNCOMMITTED if git("status", "--porcelain", "--", *MEASURED) else "")


def machine():
    cpu = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    version = pathlib.Path("/etc/debian_version")
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return {"cpu": cpu[1] if cpu else "unknown", "cores": len(os.sched_getaffinity(0)),
            "memory_gb": round(memory / 2**30),
            "system": f"Debian {version.read_text().strip()}" if version.exists() else "unknown",
            "load": round(LOAD, 1)}


def command():
    """As it was given, without --data and without folders of this machine."""
    words, skip = [], False
    for word in sys.argv[1:]:
        if not skip and not word.startswith("--data"):
            words.append(word)
        skip = word == "--data"
    return f"tests/bench/{pathlib.Path(sys.argv[0]).name} {portable_words(words)}".rstrip()


def portable_words(words):
    return " ".join(re.sub(r"[^\s=,'\"]*/[^\s=,'\"]*", lambda path: portable(path[0]), word) for word in words)


def portable(path):
    """Of a file in the repository its place there, of a build BIN, of others the name."""
    absolute = pathlib.Path(path).resolve()
    if absolute.name == "bin":
        return "BIN"
    if absolute.parent.name == "bin":
        return f"BIN/{absolute.name}"
    return absolute.relative_to(ROOT).as_posix() if absolute.is_relative_to(ROOT) else absolute.name
