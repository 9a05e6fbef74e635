#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fail unless the version of CMakeLists.txt is that of the newest release in CHANGELOG.md, the one that every
find_package(tessera) of tests and docs asks for, and stands in no other file that says what the project is. ctest:
lint.versions."""
import pathlib
import re
import sys

PROJECT = re.compile(r"^project\(tessera VERSION (\d+\.\d+\.\d+) ", re.MULTILINE)
WANTED = re.compile(r"find_package\(tessera (\d+\.\d+)")
RELEASE = re.compile(r"^## \[(.+?)\](?: - (\d{4}-\d{2}-\d{2}))?$", re.MULTILINE)


def problems(root: pathlib.Path):
    version = PROJECT.search((root / "CMakeLists.txt").read_text())[1]
    releases = RELEASE.findall((root / "CHANGELOG.md").read_text())
    if not releases or releases[0] != ("Unreleased", ""):
        yield "CHANGELOG.md: its first heading is not [Unreleased]"
    dated = [(name, date) for name, date in releases if name != "Unreleased"]
    if not dated or dated[0][0] != version or not dated[0][1]:
        yield f"CHANGELOG.md: its newest release is not [{version}] with a date, as CMakeLists.txt has it"
    for file in (root / "README.md", *sorted((root / "docs").glob("*.md")), *sorted(root.glob("include/**/*.hpp"))):
        if re.search(rf"(?<![\d.]){re.escape(version)}(?![\d.]*\d)", file.read_text()):
            yield f"{file.relative_to(root).as_posix()}: names {version}, which the next release makes wrong"
    users = [*root.glob("tests/**/CMakeLists.txt"), root / "docs" / "library.md"]
    wanted = [(file, number) for file in users for number in WANTED.findall(file.read_text())]
    if not wanted:
        yield "tests, docs/library.md: no find_package(tessera VERSION) found"
    for file, number in wanted:
        if not version.startswith(number + "."):
            yield f"{file.relative_to(root).as_posix()}: find_package(tessera {number}), but this is {version}"


found = list(problems(pathlib.Path(sys.argv[1])))
print("\n".join(found) or "versions: ok")
sys.exit(1 if found else 0)
