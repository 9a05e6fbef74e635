#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fail if a source file breaks a rule that a line count or a pattern can see. ctest: lint.style."""
import pathlib
import re
import sys

SPDX = "SPDX-License-Identifier: BSD-3-Clause"
LONGEST_FILE = 450
LONGEST_FUNCTION = 60  # The aim is 40; what is between is named, but does not fail.
AIM_FUNCTION = 40
OPEN_WORK = re.compile(r"\b(TODO|FIXME|XXX|HACK)\b")
# A shell would read file names as commands; no process of the program becomes another program.
STARTS_PROGRAM = re.compile(r"\b(system|popen|wordexp|exec[lv]p?e?|execvpe|fexecve|posix_spawnp?)\(")
# Clang 14 cannot instantiate these with the library of GCC 12: views, sub-ranges, extremes of a list.
NOT_FOR_CLANG = re.compile(
    r"\bstd::(views::|ranges::((unique|rotate|(stable_)?partition|remove(_if)?|equal_range|search(_n)?|find_end|subrange)\b"
    r"|(min|max|minmax)\(\{))"
)
# The places that start another program, without a shell; the second becomes mpirun and does nothing else.
PROGRAM_RUNNERS = ("src/jobs/run_program.cpp", "pipeline/package/mpirun.cpp")
PROGRAM_FOLDERS = ("include/", "src/", "pipeline/")
PUBLIC_FOLDER = "include/"
TYPE = re.compile(r"(struct|class|enum class) \w+(?!.*\w;$)")  # No declaration without a body.
FOLDERS = ("include", "src", "pipeline", "tests", "cmake", ".ci", "configs")
TEXT = {".hpp", ".cpp", ".py", ".cmake", ".txt", ".in", ".toml", ""}


def functions(lines: list[str]):
    """(line number, length) of each body: .clang-format puts its braces on lines of their own,
    in column 0 for all that is not a member defined in its class."""
    start = None
    for number, line in enumerate(lines, 1):
        if line == "{":
            start = number
        elif line == "}" and start is not None:
            yield start, number - start + 1
            start = None


def undocumented(lines: list[str]):
    """Line number of each type in a namespace that has no comment above it."""
    above = ""
    for number, line in enumerate(lines, 1):
        if TYPE.match(line) and "///<" not in line and not above.startswith("///"):
            yield number
        if not line.startswith(("template", "  requires")):
            above = line


def problems(root: pathlib.Path):
    files = (f for top in FOLDERS for f in sorted((root / top).rglob("*")) if f.is_file())
    for file in files:
        here = file.relative_to(root).as_posix()
        is_input = here.startswith("tests/data/")  # Bytes for readers, bad ones on purpose.
        if file.suffix not in TEXT or "__pycache__" in file.parts or is_input:
            continue
        lines = file.read_text().splitlines()
        is_cpp = file.suffix in (".hpp", ".cpp")
        is_script = bool(lines) and lines[0].startswith("#!")
        if (is_cpp or is_script) and SPDX not in "".join(lines[:2]):
            yield here, 1, f"no line '{SPDX}' at the top"
        if file.suffix == ".hpp" and "#pragma once" not in lines:
            yield here, 1, "no '#pragma once'"
        if (is_cpp or is_script) and len(lines) > LONGEST_FILE:
            yield here, len(lines), f"more than {LONGEST_FILE} lines"
        for number, line in enumerate(lines, 1):
            if OPEN_WORK.search(line) and file.name != pathlib.Path(__file__).name:
                yield here, number, "open work belongs in an issue, not in the code"
            may_start = here in PROGRAM_RUNNERS or not here.startswith(PROGRAM_FOLDERS)
            if is_cpp and not may_start and STARTS_PROGRAM.search(line):
                yield here, number, "starts a shell or another program"
            if is_cpp and NOT_FOR_CLANG.search(line):
                yield here, number, "Clang 14 cannot compile this with GCC 12's library"
            if line != line.rstrip():
                yield here, number, "blanks at the end of the line"
        for number in undocumented(lines) if here.startswith(PUBLIC_FOLDER) else ():
            yield here, number, "a public type without a comment for the reference"
        for number, length in functions(lines) if is_cpp else ():
            if length > LONGEST_FUNCTION:
                yield here, number, f"function of {length} lines, more than {LONGEST_FUNCTION}"
            elif length > AIM_FUNCTION:
                print(f"{here}:{number}: note: function of {length} lines, the aim is {AIM_FUNCTION}")


root = pathlib.Path(sys.argv[1])
found = [f"{here}:{number}: {what}" for here, number, what in problems(root)]
print("\n".join(found) or "style: ok")
sys.exit(1 if found else 0)
