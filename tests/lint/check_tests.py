#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fail unless each public header with a function or a class has a test that calls it and can be found: one
of its name, or that of a line `HEADER: TEST` in tests/where.txt. A test that reaches it through something
else says so: `HEADER: TEST by NAME`. ctest: lint.tests."""
import pathlib
import re
import sys

LIST = "tests/where.txt"
COMMENT = re.compile(r"//.*")
# In a namespace, so at the first column; what comes before the name is its type.
FUNCTION = re.compile(r"^(?!using |namespace |static_assert|requires|\s)[^\n(=#]*?\b([a-z]\w*)\(", re.MULTILINE)
CLASS = re.compile(r"^class (\w+)[^;\n]*\{$", re.MULTILINE)
ASKED_OF_ENUMS = {"last_value", "enum_words"}  # By templates; tests of these go through all enums.
LINE = re.compile(r"(\S+): (\S+)(?: by (\w+))?")


def called_names(header: pathlib.Path):
    text = COMMENT.sub("", header.read_text())
    return set(FUNCTION.findall(text)) - ASKED_OF_ENUMS | set(CLASS.findall(text))


def includes(test: pathlib.Path, header: pathlib.PurePath):
    return f'"tessera/{header.as_posix()}"' in test.read_text()


def calls_one(test: pathlib.Path, names: set[str]):
    """Whether it has one of the names in its code, and not in a comment or an #include alone."""
    code = re.sub(r"(//|^#).*", "", test.read_text(), flags=re.MULTILINE)
    return re.search(rf"\b({'|'.join(sorted(names))})\b", code) is not None


def has_test_of_name(root: pathlib.Path, header: pathlib.PurePath, names: set[str]):
    """Among unit tests and those on several ranks, whatever the room of the module's folder."""
    folders = (root / "tests" / kind / header.parent for kind in ("unit", "mpi"))
    of_name = re.compile(rf"{header.stem}(_mpi)?_test\.cpp")
    tests = (test for folder in folders for test in folder.rglob("*_test.cpp") if of_name.fullmatch(test.name))
    return any(includes(test, header) or calls_one(test, names) for test in tests)


def listed(root: pathlib.Path):
    """Each header with its test, and what the test calls instead, or None."""
    for line in (root / LIST).read_text().splitlines():
        if not line.startswith("#"):
            match = LINE.fullmatch(line)
            yield (match[1], match.groups()[1:]) if match else (line, ("", None))


def problem_of_line(root: pathlib.Path, header: pathlib.PurePath, names: set[str], test: str, by: str | None):
    file = root / "tests" / test
    if not file.is_file():
        return "does not exist"
    if not calls_one(file, {by} if by else names):
        return f"has no {by or ' or '.join(sorted(names))}"
    return None if by or includes(file, header) else f"does not include {header}"


def problems(root: pathlib.Path):
    where = dict(listed(root))
    if list(where) != sorted(where):
        yield f"{LIST}: lines are not in order"
    for file in sorted((root / "include/tessera").rglob("*.hpp")):
        header = file.relative_to(root / "include/tessera")
        names = called_names(file)
        is_found = not names or has_test_of_name(root, header, names)
        line = where.pop(header.as_posix(), None)
        if line and is_found:
            yield f"{LIST}: {header} needs no line"
        elif line and (problem := problem_of_line(root, header, names, *line)):
            yield f"{LIST}: {line[0]} {problem}"
        elif not line and not is_found:
            yield f"{header}: no test of its name calls it, and {LIST} names none"
    yield from (f"{LIST}: {header} is no public header" for header in where)


found = list(problems(pathlib.Path(sys.argv[1])))
print("\n".join(found) or "tests: ok")
sys.exit(1 if found else 0)
